// Where faces touch and cross each other, from the CAD alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/model/edit_model.h"
#include "geometry/model/model.h"
#include "support/shapes.h"

namespace st {
namespace {

/// The side of a cylinder of radius 10 about z (0 to 30), and the square [0,10] x {y} x [0,10].
Model cylinder_and_square(double y, FaceId& side, FaceId& square) {
  const Model cylinder = test::make_model("cylinder");
  const Similarity upright = rotation_about({1, 0, 0}, radians(90)).then({.translation = {0, y, 0}});
  Model both = append(cylinder, transform(test::make_model("square"), upright));
  const auto& type = both.tables().face_type;
  side = static_cast<FaceId>(std::find(type.begin(), type.end(), SurfaceType::kCylinder) - type.begin());
  square = both.tables().n_faces() - 1;
  return both;
}

TEST(FaceContact, is_a_line_where_a_plane_is_tangent_to_a_cylinder) {
  FaceId side, square;
  const Model model = cylinder_and_square(10, side, square);
  const auto found = model.contacts(side, square);
  ASSERT_FALSE(found.empty());
  for (const FaceContact& c : found) {
    EXPECT_FALSE(c.passes_through);
    for (const Vec3 p : c.points) EXPECT_LE(std::hypot(p.x, p.y - 10), 1e-3);
  }
}

TEST(FaceContact, passes_through_where_a_plane_cuts_a_cylinder) {
  FaceId side, square;
  const Model model = cylinder_and_square(8, side, square);
  const auto found = model.contacts(side, square);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].passes_through);
  const auto [low, high] =
      std::minmax_element(found[0].points.begin(), found[0].points.end(), [](Vec3 p, Vec3 q) { return p.z < q.z; });
  EXPECT_NEAR(low->z, 0, 1e-6);  // up to the rims, which the faces do not share
  EXPECT_NEAR(high->z, 10, 1e-6);
  for (const Vec3 p : found[0].points) EXPECT_LE(std::hypot(p.x - 6, p.y - 8), 1e-6);
}

TEST(FaceContact, is_none_between_faces_apart) {
  FaceId side, square;
  const Model model = cylinder_and_square(10.001, side, square);
  EXPECT_TRUE(model.contacts(side, square).empty());
}

TEST(FaceContact, does_not_count_what_faces_share) {
  const Model model = test::make_model("cylinder");
  for (FaceId a = 0; a < model.tables().n_faces(); ++a)
    for (FaceId b = a + 1; b < model.tables().n_faces(); ++b)
      EXPECT_TRUE(model.contacts(a, b).empty()) << a << " " << b;
}

}  // namespace
}  // namespace st
