// Points on the inside of a face.
#include "geometry/import/face_probe.h"

#include <gtest/gtest.h>

#include "unit/geometry/bare_models.h"

namespace st {
namespace {

using test::polygon;

TopoDS_Face square() { return polygon({gp_Pnt(0, 0, 0), gp_Pnt(10, 0, 0), gp_Pnt(10, 10, 0), gp_Pnt(0, 10, 0)}); }

TEST(FaceProbe, finds_points_on_the_inside_and_their_largest_distance) {
  occt::FaceProbe probe(square(), 0.01);
  const auto distance = probe.distance_of({{3, 3, 0}, {4, 4, 0.005}, {5, 5, 2}});
  ASSERT_TRUE(distance);
  EXPECT_NEAR(*distance, 0.005, 1e-12);
}

TEST(FaceProbe, wants_two_points_one_after_the_other) {
  occt::FaceProbe probe(square(), 0.01);
  EXPECT_FALSE(probe.distance_of({{5, 5, -1}, {5, 5, 0}, {5, 5, 1}}));
  EXPECT_FALSE(probe.distance_of({{3, 3, 0}, {5, 5, 1}, {7, 7, 0}}));
}

TEST(FaceProbe, leaves_out_points_outside_and_at_the_edges) {
  occt::FaceProbe probe(square(), 0.01);
  EXPECT_FALSE(probe.distance_of({{11, 1, 0}, {11, 2, 0}, {11, 3, 0}}));
  EXPECT_FALSE(probe.distance_of({{9.98, 1, 0}, {9.98, 2, 0}, {9.98, 3, 0}}));
  EXPECT_TRUE(probe.distance_of({{9.9, 1, 0}, {9.9, 2, 0}, {9.9, 3, 0}}));
}

TEST(FaceProbe, samples_lie_on_the_inside) {
  occt::FaceProbe probe(polygon({gp_Pnt(0, 0, 0), gp_Pnt(10, 0, 0), gp_Pnt(0, 10, 0)}), 0.01);
  const std::vector<Vec3> points = probe.samples();
  EXPECT_GT(points.size(), 30u);
  for (const Vec3 p : points) EXPECT_LT(p.x + p.y, 10);
  occt::FaceProbe whole(square(), 0.01);
  EXPECT_TRUE(whole.distance_of(points));
  EXPECT_TRUE(occt::may_lie_on({{0, 0, 0}, {10, 10, 0}}, points, 0.01));
  EXPECT_FALSE(occt::may_lie_on({{0, 0, 5}, {10, 10, 6}}, points, 0.01));
}

}  // namespace
}  // namespace st
