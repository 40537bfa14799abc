// Edges around the ends of lifting surfaces.
#include <gtest/gtest.h>

#include <algorithm>

#include "features/lifting_surface.h"
#include "support/shapes.h"

namespace st {
namespace {

std::vector<EdgeWithChord> rims_of(const Model& model) {
  const FaceRoles roles = face_roles(model.tables());
  const auto wings = find_lifting_surfaces(model, roles, find_wing_edges(model, roles, find_strips(model)));
  return find_end_rims(model, wings.at(0));
}

TEST(EndRims, run_around_both_ends_of_a_wing) {
  const Model model = test::make_model("sharp_wing");
  const std::vector<EdgeWithChord> rims = rims_of(model);
  ASSERT_EQ(rims.size(), 4u) << "above and below at either end";
  for (const EdgeWithChord& rim : rims) {
    const auto curve = model.curve(rim.edge);
    const double z = curve->point(curve->t_min()).z;
    EXPECT_TRUE(std::abs(z) < 1e-9 || std::abs(z - 30) < 1e-9);
    EXPECT_NEAR(curve->point(curve->t_max()).z, z, 1e-9);
    EXPECT_NEAR(rim.chord, 10, 0.01);
  }
}

TEST(EndRims, are_not_those_in_the_middle_of_a_wing) {
  const Model model = test::make_model("wing_with_pod");
  for (const EdgeWithChord& rim : rims_of(model)) {
    const auto curve = model.curve(rim.edge);
    const double z = curve->point(0.5 * (curve->t_min() + curve->t_max())).z;
    EXPECT_TRUE(z < 2 || z > 28) << "edge " << rim.edge << " at " << z;
  }
}

TEST(EndRims, of_a_wing_on_a_body_run_along_its_root) {
  const Model model = test::make_model("wing_on_body");
  const std::vector<EdgeWithChord> rims = rims_of(model);
  const auto is_root = [&](const EdgeWithChord& rim) {
    const auto curve = model.curve(rim.edge);
    return std::abs(curve->point(0.5 * (curve->t_min() + curve->t_max())).z - 4) < 1e-6;
  };
  EXPECT_GE(std::ranges::count_if(rims, is_root), 2);
}

}  // namespace
}  // namespace st
