#include "geometry/import/facet_plane_cut.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/facet/facet_faces.h"
#include "unit/geometry/facet_inputs.h"

namespace st {
namespace {

/// A bar with an edge in the plane y = 0 and a node very near to it, on one side.
FacetInput sharp_bar() {
  FacetInput in;
  in.part_name = {""};
  in.x = {{0, 0, 0}, {0, 0, 1}, {10, 0.5, 0}, {10, 0.5, 1}, {10, -0.5, 0}, {10, -0.5, 1}, {1e-3, 5e-5, 0.5}};
  in.corners = {{0, 1, 6}, {1, 3, 6}, {3, 2, 6}, {2, 0, 6}, {0, 4, 5},
                {0, 5, 1}, {0, 2, 4}, {1, 5, 3}, {2, 3, 5}, {2, 5, 4}};
  in.part.assign(in.corners.size(), 0);
  return in;
}

FacetMesh cut(const FacetInput& input, const occt::SymmetryPlane& plane) {
  FacetMesh mesh = find_smooth_faces(input, radians(30));
  cut_at_plane(mesh, plane);
  return mesh;
}

TEST(FacetPlaneCut, keeps_one_side_with_its_rim_in_the_plane) {
  const FacetMesh mesh = cut(test::torus_facets(48, 24), {0, 0.31, -1});
  const auto neighbours = find_neighbours(mesh.corners);
  ASSERT_GT(mesh.n_triangles(), 500);
  for (std::int32_t t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k) {
      EXPECT_LE(mesh.x[mesh.corners[t][k]].x, 0.31);
      if (neighbours[t][k] != kNone) continue;
      EXPECT_EQ(mesh.x[mesh.corners[t][k]].x, 0.31);
      EXPECT_EQ(mesh.x[mesh.corners[t][(k + 1) % 3]].x, 0.31);
      EXPECT_TRUE(mesh.is_line[t][k]);
    }
}

TEST(FacetPlaneCut, leaves_no_tooth_where_a_sharp_edge_lies_in_the_plane) {
  const FacetMesh mesh = cut(sharp_bar(), {1, 0, 1});
  double area = 0;
  for (std::int32_t t = 0; t < mesh.n_triangles(); ++t) area += 0.5 * norm(area_normal(mesh, t));
  EXPECT_NEAR(area, std::hypot(10, 0.5) + 0.5 + 2 * 2.5, 1e-9);
}

TEST(FacetPlaneCut, leaves_no_sliver_beside_the_plane) {
  const FacetMesh mesh = cut(test::sphere_facets(24), {1, 1e-3, 1});
  for (std::int32_t t = 0; t < mesh.n_triangles(); ++t) {
    const Corners& c = mesh.corners[t];
    double longest = 0;
    for (int k = 0; k < 3; ++k) longest = std::max(longest, distance(mesh.x[c[k]], mesh.x[c[(k + 1) % 3]]));
    EXPECT_GT(norm(area_normal(mesh, t)), 0.015 * longest * longest);
  }
}

}  // namespace
}  // namespace st
