#include "features/ridge_edges.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "features/smooth_edges.h"
#include "support/shapes.h"

namespace st {
namespace {

/// Ridges among the smooth edges of a shape.
std::vector<EdgeId> ridges_of(const std::string& shape) {
  const Model model = test::make_model(shape);
  const std::vector<std::uint8_t> is_ridge = find_ridge_edges(model, find_smooth_edges(model));
  std::vector<EdgeId> ridges;
  for (std::size_t e = 0; e < is_ridge.size(); ++e)
    if (is_ridge[e]) ridges.push_back(static_cast<EdgeId>(e));
  return ridges;
}

TEST(RidgeEdges, are_the_nose_of_a_wing) {
  const Model model = test::make_model("wing_of_8");
  const std::vector<EdgeId> ridges = ridges_of("wing_of_8");
  ASSERT_EQ(ridges.size(), 2u);  // of 30 times 0.5 and 0.46
  for (const EdgeId e : ridges) {
    const auto nose = model.curve(e);
    const Vec3 x = nose->point(0.5 * (nose->t_min() + nose->t_max()));
    EXPECT_LE(norm(x - Vec3{0, 0, x.z}), 1e-3) << e + 1;
  }
}

TEST(RidgeEdges, are_none_where_the_bend_is_even) { EXPECT_TRUE(ridges_of("cylinder_of_8").empty()); }

TEST(RidgeEdges, are_none_beside_the_nose) {
  EXPECT_TRUE(ridges_of("wing_of_200").empty());  // cut at 0.4 and 0.596 of the profile
}

}  // namespace
}  // namespace st
