// Distances and angles between a mesh and its CAD surfaces.
#include "judge/surface_deviation.h"

#include <gtest/gtest.h>

#include "unit/judge/deviation.h"
#include "unit/mesh/shapes.h"
#include "unit/meshing/shape_mesh.h"

namespace st {
namespace {

using test::measure_deviation;

using test::ShapeMesh;

TEST(SurfaceDeviation, of_planes_is_nothing) {
  const ShapeMesh box("box");
  const SurfaceDeviation d = measure_deviation(box.model, box.mesh);
  EXPECT_EQ(d.model.n_triangles, box.mesh.n_triangles());
  EXPECT_NEAR(d.model.max_distance, 0, 1e-9);
  EXPECT_NEAR(d.model.max_angle_deg, 0, 1e-5);
  EXPECT_EQ(d.model.angle_histogram[0], box.mesh.n_triangles());
}

TEST(SurfaceDeviation, of_a_sphere_is_the_depth_of_the_midpoints) {
  const ShapeMesh ball("sphere");
  double depth = 0, angle = 0;
  for (const Triangle& t : ball.mesh.triangles) {
    const Vec3 a = ball.mesh.node_xyz[t.n[0]], b = ball.mesh.node_xyz[t.n[1]], c = ball.mesh.node_xyz[t.n[2]],
               middle = (a + b + c) / 3;
    depth = std::max(depth, 10 - norm(middle));
    angle = std::max(angle, degrees(angle_between(cross(b - a, c - a), middle)));
  }
  const SurfaceDeviation d = measure_deviation(ball.model, ball.mesh);
  EXPECT_NEAR(d.model.max_distance, depth, 1e-6);
  EXPECT_NEAR(d.model.max_angle_deg, angle, 1e-3);
  EXPECT_NEAR(10 - norm(d.model.distance_place), depth, 1e-9) << "the place is the worst midpoint";
  EXPECT_EQ(d.worst_distance, 0);
}

TEST(SurfaceDeviation, does_not_mind_a_mesh_turned_as_a_whole) {
  ShapeMesh ball("sphere");
  const SurfaceDeviation as_made = measure_deviation(ball.model, ball.mesh);
  shapes::turn(ball.mesh);
  for (std::size_t c = 0; c < ball.mesh.corner_uv.size(); c += 3)
    std::swap(ball.mesh.corner_uv[c + 1], ball.mesh.corner_uv[c + 2]);
  EXPECT_NEAR(measure_deviation(ball.model, ball.mesh).model.max_angle_deg, as_made.model.max_angle_deg, 1e-9);
}

TEST(SurfaceDeviation, is_true_where_the_uv_of_a_triangle_lead_to_another_side) {
  ShapeMesh ball("sphere");
  const double before = measure_deviation(ball.model, ball.mesh).model.max_distance;
  for (int k = 0; k < 3; ++k) {  // to the other end of the diameter
    Vec2& uv = ball.mesh.corner_uv[300 + k];
    uv = {uv.x < kPi ? uv.x + kPi : uv.x - kPi, -uv.y};
  }
  const SurfaceDeviation d = measure_deviation(ball.model, ball.mesh);
  EXPECT_NEAR(d.model.max_distance, before, 1e-6);
  EXPECT_LT(d.model.max_angle_deg, 10);
}

TEST(SurfaceDeviation, names_the_worst_face) {
  ShapeMesh box("box");
  NodeId n = static_cast<NodeId>(box.mesh.n_nodes()) - 1;  // inside the last face
  const FaceId face = box.mesh.node_entity[n];
  box.mesh.node_xyz[n] = box.mesh.node_xyz[n] + Vec3{0.3, 0.3, 0.3};
  const SurfaceDeviation d = measure_deviation(box.model, box.mesh);
  EXPECT_EQ(d.worst_distance, face);
  EXPECT_EQ(d.worst_angle, face);
  EXPECT_NEAR(d.model.max_distance, 0.1, 1e-9) << "a third of the node's, at the midpoint";
}

TEST(SurfaceDeviation, of_no_triangles_is_zero) {
  const ShapeMesh box("box");
  SurfaceMesh empty;
  const SurfaceDeviation d = measure_deviation(box.model, empty);
  EXPECT_EQ(d.model.n_triangles, 0);
  EXPECT_EQ(d.model.mean_distance(), 0);
  EXPECT_EQ(d.worst_distance, kNone);
}

TEST(DeviationStats, count_by_angle_and_keep_the_worst) {
  DeviationStats a, b;
  a.add({1, 0, 0}, 0.1, 1.9);
  a.add({2, 0, 0}, 0.3, 2.1);
  b.add({3, 0, 0}, 0.2, 170);
  a.add(b);
  EXPECT_EQ(a.n_triangles, 3);
  EXPECT_NEAR(a.mean_distance(), 0.2, 1e-15);
  EXPECT_EQ(a.max_distance, 0.3);
  EXPECT_TRUE(a.distance_place == (Vec3{2, 0, 0}));
  EXPECT_EQ(a.max_angle_deg, 170);
  EXPECT_TRUE(a.angle_place == (Vec3{3, 0, 0}));
  EXPECT_EQ(a.angle_histogram[0], 1);
  EXPECT_EQ(a.angle_histogram[1], 1);
  EXPECT_EQ(a.angle_histogram[15], 1) << "the last has no end";
}

}  // namespace
}  // namespace st
