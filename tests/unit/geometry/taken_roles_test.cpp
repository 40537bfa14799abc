#include "geometry/import/taken_roles.h"

#include <gtest/gtest.h>

#include "geometry/model/groups.h"
#include "geometry/model/model.h"

namespace st {
namespace {

/// Three faces in a row along x: a wing, and air that the import put around it.
ModelTables wing_in_air() {
  ModelTables t;
  t.face_is_reversed.assign(3, 0);
  t.labels.face_name = {"wing", "symmetry", "farfield"};
  t.face_type.assign(3, SurfaceType::kPlane);
  t.face_color.assign(3, kNone);
  t.face_layer.assign(3, "");
  t.face_tolerance.assign(3, 1e-7);
  for (double x = 0; x < 3; ++x) t.face_box.push_back({{x, 0, 0}, {x + 1, 1, 0}});
  t.labels.group_name = {"wing", "symmetry", "farfield"};
  t.labels.group_role = {"wall", "symmetry", "farfield"};
  t.labels.face_group = {0, 1, 2};
  t.labels.face_part.assign(3, kNone);
  return t;
}

/// What is said of a group of faces.
std::vector<std::string> said_of(const std::string& name, const std::vector<std::string>& faces,
                                 std::optional<std::string> role = std::nullopt) {
  ModelTables t = wing_in_air();
  GroupRule rule;
  rule.where = "g.toml:1";
  rule.name = name;
  rule.selection.faces = faces;
  rule.role = role;
  const FaceLabels before = t.labels;
  apply_groups({rule}, t);
  return find_taken_roles({rule}, before, t);
}

TEST(TakenRoles, a_group_that_makes_walls_of_air_is_named_with_the_faces) {
  const auto lines = said_of("near", {"1-3"});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0],
            "g.toml:1: group \"near\" is wall and takes face 2 \"symmetry\" (symmetry), face 3 \"farfield\" "
            "(farfield); give it a role, or select without these faces");
}

TEST(TakenRoles, nothing_is_said_of_walls_of_the_same_role_and_of_a_role_that_is_given) {
  EXPECT_TRUE(said_of("near", {"1"}).empty());
  EXPECT_TRUE(said_of("farfield_outer", {"3"}).empty());
  EXPECT_TRUE(said_of("tunnel", {"3"}, "wall").empty());
  EXPECT_TRUE(said_of("outflow", {"3"}, "outlet").empty());
}

}  // namespace
}  // namespace st
