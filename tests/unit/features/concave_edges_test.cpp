// Edges at which one body stands on another.
#include "features/concave_edges.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/shapes.h"

namespace st {
namespace {

std::ptrdiff_t count_concave(const Model& model, const FaceRoles& roles) {
  const std::vector<std::uint8_t> is_concave = find_concave_edges(model, roles);
  return std::count(is_concave.begin(), is_concave.end(), 1);
}

TEST(ConcaveEdges, are_none_of_convex_solids) {
  for (const char* shape : {"box", "cylinder", "cone", "sharp_wing", "blunt_wing"}) {
    const Model model = test::make_model(shape);
    EXPECT_EQ(count_concave(model, face_roles(model.tables())), 0) << shape;
  }
}

TEST(ConcaveEdges, are_those_where_a_step_rises) {
  const Model model = test::make_model("stepped_box");
  EXPECT_EQ(count_concave(model, face_roles(model.tables())), 1);
}

TEST(ConcaveEdges, go_on_where_a_body_fades_out_between_them) {
  const auto count = [](const char* shape) {
    const Model model = test::make_model(shape);
    return count_concave(model, face_roles(model.tables()));
  };
  EXPECT_EQ(count("fading_block"), 4) << "its ramp is shorter than the edges beside it";
  EXPECT_EQ(count("wide_ramp"), 3);
}

TEST(ConcaveEdges, turn_with_the_side_of_the_material) {
  const Model model = test::make_model("wing_in_box");
  FaceRoles roles = face_roles(model.tables());
  for (FaceId f = 0; f < model.tables().n_faces(); ++f)
    if (model.tables().face_box[f].diagonal() > 50) roles.role[f] = FaceRole::kFarfield;
  EXPECT_EQ(count_concave(model, roles), 0) << "the wing is solid, the box around it is not";
}

}  // namespace
}  // namespace st
