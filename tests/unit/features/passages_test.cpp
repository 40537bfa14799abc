// Solids that are the air around vanes.
#include "features/passages.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/shapes.h"

namespace st {
namespace {

FaceRoles walls_alone(const Model& model) {
  FaceRoles roles = face_roles(model.tables());
  std::ranges::fill(roles.role, FaceRole::kWall);
  return roles;
}

bool is_passage(const std::string& shape) {
  const Model model = test::make_model(shape);
  return has_vanes(model, walls_alone(model), find_strips(model));
}

TEST(Passages, have_holes_with_the_profile_of_a_wing) {
  EXPECT_TRUE(is_passage("wing_in_box"));
  for (const char* shape : {"sharp_wing", "blunt_wing", "wing_on_body", "drilled_block", "passage", "stepped_box"})
    EXPECT_FALSE(is_passage(shape)) << shape;
}

TEST(Passages, have_holes_that_lead_through) {
  for (const char* shape : {"drilled_block", "thin_pipe", "torus"})
    EXPECT_TRUE(has_through_holes(test::make_model(shape).tables())) << shape;
  for (const char* shape : {"box", "sphere", "cone", "cylinder", "two_boxes", "sharp_wing", "wing_in_box"})
    EXPECT_FALSE(has_through_holes(test::make_model(shape).tables())) << shape;
}

TEST(Passages, are_no_matter_where_roles_tell_the_air) {
  const Model model = test::make_model("wing_in_box");
  FaceRoles roles = walls_alone(model);
  roles.role[0] = FaceRole::kFarfield;
  EXPECT_FALSE(has_vanes(model, roles, find_strips(model)));
}

TEST(Passages, are_looked_for_where_edges_of_holes_are_sharp) {
  const auto has_hollow = [](const std::string& shape) {
    const Model model = test::make_model(shape);
    bool is_hollow = true;
    find_wing_edges(model, walls_alone(model), find_strips(model), SerialExecutor(), nullptr, &is_hollow);
    return is_hollow;
  };
  EXPECT_TRUE(has_hollow("wing_in_box"));
  for (const char* shape : {"sharp_wing", "blunt_wing", "wing_on_body", "drilled_block", "box"})
    EXPECT_FALSE(has_hollow(shape)) << shape;
}

}  // namespace
}  // namespace st
