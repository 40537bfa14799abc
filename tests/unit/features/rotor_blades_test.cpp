// Blades that are images of one another.
#include "features/rotor_blades.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/shapes.h"

namespace st {
namespace {

/// Three blades around the x axis, chord 10, span 30.
class RotorBlades : public testing::Test {
 protected:
  std::vector<std::uint8_t> none() const {
    return std::vector<std::uint8_t>(static_cast<std::size_t>(model_.tables().n_edges()), 0);
  }
  std::vector<LiftingSurface> found() const {
    const FaceRoles roles = face_roles(model_.tables());
    return find_lifting_surfaces(model_, roles, find_wing_edges(model_, roles, find_strips(model_)));
  }
  void liken(std::vector<LiftingSurface>& wings, std::vector<UnusedTrailing> unused = {}) const {
    liken_blades(model_, none(), wings, unused);
  }

  const Model model_ = test::make_model("three_blades");
};

/// Half of its stations, and the noses of these elsewhere.
void spoil(LiftingSurface& wing) {
  for (ChordStation& s : wing.trailing.at(0).stations) {
    s.is_measured = s.is_measured && s.share < 0.5;
    s.nose = s.trailing - Vec3{7, 0, 0};
    s.chord = 7;
  }
  wing.leading.clear();
}

/// An edge of its faces that is neither trailing nor leading.
EdgeId tip_edge(const Model& model, const LiftingSurface& wing) {
  for (const EdgeId e : model.tables().edges_of(wing.faces[0]))
    if (e != wing.trailing[0].edge && std::ranges::count(wing.leading, e) == 0) return e;
  return kNone;
}

void expect_whole(const Model& model, const LiftingSurface& wing) {
  EXPECT_GT(wing.covered(), 0.99);
  EXPECT_EQ(wing.leading.size(), 1u);
  EXPECT_EQ(wing.faces.size(), 2u);
  ASSERT_EQ(wing.trailing.size(), 1u);
  const auto curve = model.curve(wing.trailing[0].edge);
  const Vec3 begin = curve->point(curve->t_min()), end = curve->point(curve->t_max());
  for (const ChordStation& s : wing.trailing[0].stations) {
    EXPECT_LT(distance(s.trailing, begin + s.share * (end - begin)), 1e-6) << "on its own edge, by its own share";
    EXPECT_NEAR(s.chord, 10, 0.02);
    if (!s.is_measured) continue;
    EXPECT_NEAR(s.nose.x, 0, 0.02);
    EXPECT_NEAR(std::hypot(s.nose.y, s.nose.z), std::hypot(s.trailing.y, s.trailing.z), 1e-2);
    EXPECT_EQ(std::ranges::count(wing.faces, s.nose_face), 1);
  }
}

TEST_F(RotorBlades, have_the_lines_of_the_best_of_them) {
  std::vector<LiftingSurface> wings = found();
  ASSERT_EQ(wings.size(), 3u);
  spoil(wings[0]);
  spoil(wings[2]);
  liken(wings);
  ASSERT_EQ(wings.size(), 3u);
  for (const LiftingSurface& wing : wings) expect_whole(model_, wing);
}

TEST_F(RotorBlades, are_found_by_their_sisters) {
  std::vector<LiftingSurface> wings = found();
  const LiftingSurface lost = wings.at(2);
  wings.pop_back();
  const EdgeId tip = tip_edge(model_, lost);
  std::vector<UnusedTrailing> unused{{{lost.trailing[0].edge}, 30, "lost"}, {{tip}, 1, "another"}};
  liken_blades(model_, none(), wings, unused);
  ASSERT_EQ(wings.size(), 3u);
  expect_whole(model_, wings[2]);
  EXPECT_EQ(wings[2].trailing[0].edge, lost.trailing[0].edge);
  ASSERT_EQ(unused.size(), 1u);
  EXPECT_EQ(unused[0].why, "another");
}

TEST_F(RotorBlades, are_what_the_user_says) {
  std::vector<LiftingSurface> wings = found();
  std::vector<std::uint8_t> is_excluded = none();
  is_excluded[wings.at(2).trailing[0].edge] = 1;
  wings.pop_back();
  std::vector<UnusedTrailing> unused;
  liken_blades(model_, is_excluded, wings, unused);
  EXPECT_EQ(wings.size(), 2u) << "taken out by a rule";
  spoil(wings[1]);
  wings[1].is_declared = true;
  liken_blades(model_, is_excluded, wings, unused);
  EXPECT_EQ(wings[1].trailing[0].stations[3].chord, 7) << "declared";
}

TEST_F(RotorBlades, need_a_second_one) {
  std::vector<LiftingSurface> wings = found();
  wings.resize(1);
  liken(wings);
  EXPECT_EQ(wings.size(), 1u);
}

TEST(OtherBlades, are_none_that_do_not_turn_into_each_other) {
  const Model model = test::make_model("two_tapering_wings");
  const FaceRoles roles = face_roles(model.tables());
  std::vector<LiftingSurface> wings =
      find_lifting_surfaces(model, roles, find_wing_edges(model, roles, find_strips(model)));
  ASSERT_EQ(wings.size(), 2u);
  spoil(wings[0]);
  std::vector<UnusedTrailing> unused;
  liken_blades(model, std::vector<std::uint8_t>(static_cast<std::size_t>(model.tables().n_edges()), 0), wings, unused);
  EXPECT_EQ(wings[0].trailing[0].stations[3].chord, 7);
}

TEST(OtherBlades, have_their_noses_before_their_edges_where_only_these_turn_into_each_other) {
  const Model model = test::make_model("two_wings_in_line");
  const FaceRoles roles = face_roles(model.tables());
  std::vector<LiftingSurface> wings =
      find_lifting_surfaces(model, roles, find_wing_edges(model, roles, find_strips(model)));
  ASSERT_EQ(wings.size(), 2u);
  std::vector<UnusedTrailing> unused;
  liken_blades(model, std::vector<std::uint8_t>(static_cast<std::size_t>(model.tables().n_edges()), 0), wings, unused);
  ASSERT_EQ(wings.size(), 2u);
  for (const LiftingSurface& wing : wings)
    for (const ChordStation& s : wing.trailing.at(0).stations)
      EXPECT_TRUE(!s.is_measured || std::abs(s.nose.x) < 0.02) << s.nose.x << " at " << s.trailing.z;
}

}  // namespace
}  // namespace st
