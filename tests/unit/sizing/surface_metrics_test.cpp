#include "sizing/surface_metrics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace st {
namespace {

/// A root cube of edge 2 around the corner (1,1,1), with a plane through it for each normal.
struct PlanesOfCorner {
  OctreeShape octree;
  FaceCells faces;

  explicit PlanesOfCorner(std::initializer_list<Vec3> normals) {
    octree = build_octree({{0, 0, 0}, {2, 2, 2}}, {}).shape;
    for (const Vec3 n : normals) {
      CellArea cell{0, 4, {1, 1, 1}};
      const double xyz[] = {n.x, n.y, n.z};
      for (int k = 0; k < 3; ++k) cell.normal[k] = static_cast<float>(xyz[k]);
      faces.append_face(std::vector<CellArea>{cell});
    }
  }
  /// Of one node there.
  LocalSize size_at(Vec3 x, const SymmetricTensor& metric) const {
    BackgroundMesh mesh;
    mesh.node_xyz = {x};
    mesh.node_size = {size_of_metric(metric)};
    mesh.node_metric = {metric};
    project_metrics({faces, octree.view()}, mesh);
    EXPECT_TRUE(mesh.node_metric.empty());
    return mesh.node_size[0];
  }
};

/// Short across the plane with this normal, long along it.
SymmetricTensor metric_of_shock(Vec3 n, double across, double along) {
  const double most = 1 / (across * across), least = 1 / (along * along), d = most - least;
  return {least + d * n.x * n.x, least + d * n.y * n.y, least + d * n.z * n.z,
          d * n.x * n.y,         d * n.y * n.z,         d * n.x * n.z};
}

TEST(SurfaceMetrics, of_a_tilted_shock_are_short_across_its_trace_and_long_along_it) {
  const PlanesOfCorner floor({{0, 0, 1}});
  for (const double angle : {0.0, 0.5, 1.0, 1.4}) {
    const LocalSize size =
        floor.size_at({0.5, 0.5, 1.1}, metric_of_shock({std::cos(angle), 0, std::sin(angle)}, 0.1, 2));
    const double c = std::cos(angle), trace = 1 / std::sqrt(c * c / 0.01 + (1 - c * c) / 4);
    EXPECT_NEAR(size.length, trace, 1e-6 * trace) << angle;
    EXPECT_NEAR(size.along, 2, 1e-5) << angle;
    EXPECT_NEAR(std::abs(size.direction.y), 1, 1e-9) << angle;
  }
}

TEST(SurfaceMetrics, are_long_in_both_directions_of_a_face_that_the_shock_lies_on) {
  const PlanesOfCorner floor({{0, 0, 1}});
  const LocalSize size = floor.size_at({1, 1, 1}, metric_of_shock({0, 0, 1}, 0.1, 2));
  EXPECT_NEAR(size.length, 2, 1e-9);
  EXPECT_EQ(size.along, size.length);
}

TEST(SurfaceMetrics, keep_all_three_lengths_apart) {
  const SymmetricTensor metric{1 / 0.01, 1 / 0.25, 1.0, 0, 0, 0};  // lengths 0.1, 0.5, 1
  const LocalSize on_x = PlanesOfCorner({{1, 0, 0}}).size_at({1, 1, 1}, metric);
  EXPECT_NEAR(on_x.length, 0.5, 1e-9);
  EXPECT_NEAR(on_x.in({0, 0, 1}), 1, 1e-9);
  const LocalSize on_z = PlanesOfCorner({{0, 0, 1}}).size_at({1, 1, 1}, metric);
  EXPECT_NEAR(on_z.length, 0.1, 1e-9);
  EXPECT_NEAR(on_z.in({0, 1, 0}), 0.5, 1e-9);
}

TEST(SurfaceMetrics, ask_for_no_more_than_either_face_at_a_sharp_edge) {
  const PlanesOfCorner corner({{0, 0, 1}, {1, 0, 0}});
  const SymmetricTensor metric = metric_of_shock(normalized(Vec3{1, 1, 1}), 0.1, 2);
  const LocalSize size = corner.size_at({1, 0.3, 1}, metric);
  for (const Vec3 normal : {Vec3{0, 0, 1}, Vec3{1, 0, 0}}) {
    const LocalSize of_face = PlanesOfCorner({normal}).size_at({1, 0.3, 1}, metric);
    for (double angle = 0; angle < 3; angle += 0.1) {
      const Vec3 d = std::cos(angle) * Vec3{0, 1, 0} + std::sin(angle) * Vec3{normal.z, 0, normal.x};
      EXPECT_LE(size.in(d), (1 + 1e-9) * of_face.in(d)) << angle;
    }
  }
  // away from the edge the nearest face counts alone
  const LocalSize aside = corner.size_at({1.5, 0.3, 1}, metric);
  EXPECT_GT(aside.along, 1.5 * size.length);
  EXPECT_NEAR(aside.in({1, -1, 0}), 2, 1e-5);
}

TEST(SurfaceMetrics, are_no_shorter_at_a_sharp_edge_than_in_space) {
  const PlanesOfCorner edge({{0, 0, 1}, {0, 1, 0}});
  const LocalSize size = edge.size_at({1, 1, 1}, metric_of_shock(normalized(Vec3{1, 0, 1}), 1, 6));
  EXPECT_NEAR(size.length, 1, 1e-9) << "0.895 by the intersection";
  EXPECT_NEAR(size.in({0, 1, 0}), 6, 1e-6);
}

TEST(SurfaceMetrics, of_one_long_length_stay_as_they_are) {
  const Vec3 t = normalized(Vec3{1, 2, 3});
  const LocalSize own{0.1, 0.7, t}, size = PlanesOfCorner({{0, 0, 1}}).size_at({1, 1, 1}, metric_of(own));
  EXPECT_NEAR(size.length, own.length, 1e-12);
  EXPECT_NEAR(size.along, own.along, 1e-9);
  EXPECT_NEAR(dot(size.direction, t), 1, 1e-9);
}

}  // namespace
}  // namespace st
