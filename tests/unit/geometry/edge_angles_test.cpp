#include "geometry/model/edge_angles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/shapes.h"

namespace st {
namespace {

TEST(EdgeAngles, are_those_between_the_normals) {
  const Model model = test::make_model("pie");  // 40 degrees of a cylinder
  EdgeAngles angles(model);
  int n_sharp = 0;
  for (EdgeId e = 0; e < model.tables().n_edges(); ++e) {
    const double deg = angles.largest_deg(e);
    if (std::abs(deg - 140) < 1e-6)
      ++n_sharp;
    else
      EXPECT_NEAR(deg, 90, 1e-6);
    EXPECT_EQ(angles.largest_deg(e), deg);
  }
  EXPECT_EQ(n_sharp, 1) << "along the axis";
}

TEST(EdgeAngles, are_none_at_seams_and_half_a_turn_at_free_edges) {
  const Model cylinder = test::make_model("cylinder"), square = test::make_model("square");
  EdgeAngles of_cylinder(cylinder), of_square(square);
  double smallest = 180;
  for (EdgeId e = 0; e < cylinder.tables().n_edges(); ++e) smallest = std::min(smallest, of_cylinder.largest_deg(e));
  EXPECT_LT(smallest, 1e-6);
  for (EdgeId e = 0; e < square.tables().n_edges(); ++e) EXPECT_EQ(of_square.largest_deg(e), 180);
}

}  // namespace
}  // namespace st
