#include "mesh/conformity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "unit/mesh/shapes.h"

namespace st {
namespace {

RequestedSize same_everywhere(double length) {
  return [length](Vec3, int&) { return LocalSize{length, length, {}}; };
}

TEST(Conformity, compares_lengths_with_the_requested_ones) {
  const SurfaceMesh m = shapes::cube(4);  // sides 1/4, diagonals sqrt(2)/4
  const ConformityReport fits = measure_conformity(m, edges_of(m), same_everywhere(0.25));
  EXPECT_EQ(fits.model.n_edges, 288);
  EXPECT_NEAR(fits.model.min, 1, 1e-12);
  EXPECT_NEAR(fits.model.max, std::sqrt(2.0), 1e-12);
  EXPECT_EQ(fits.model.n_within, 192) << "the diagonals are too long";
  EXPECT_EQ(measure_conformity(m, edges_of(m), same_everywhere(0.3)).model.share(), 1);
  EXPECT_EQ(measure_conformity(m, edges_of(m), same_everywhere(1.0)).model.share(), 0);
}

TEST(Conformity, follows_a_length_that_varies_along_the_edge) {
  const SurfaceMesh m = shapes::from({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}}});
  const ConformityReport r = measure_conformity(m, edges_of(m), [](Vec3 p, int&) {
    return LocalSize{1 + p.x, 1 + p.x, {}};
  });
  EXPECT_NEAR(r.model.min, std::log(2.0), 2e-3) << "the integral of dx / (1 + x)";
}

TEST(Conformity, tells_edges_inside_faces_from_those_the_cad_forces) {
  SurfaceMesh m =
      shapes::from({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 0}}, {{{0, 1, 3}}, {{1, 2, 3}}, {{2, 0, 3}}});
  m.node_entity_dim = {0, 0, 0, 2};
  const ConformityReport r = measure_conformity(m, edges_of(m), same_everywhere(1.0));
  EXPECT_EQ(r.model.n_edges, 6);
  EXPECT_EQ(r.inner.n_edges, 3);
}

/// A strip 10 x 0.2 of one face in 20 steps of 0.5: vertices at its corners, CAD edges 0 (lower), 1 (right), 2 (upper),
/// 3 (left).
SurfaceMesh strip() {
  constexpr int kSteps = 20;
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  for (int i = 0; i <= kSteps; ++i) points.push_back({0.5 * i, 0, 0}), points.push_back({0.5 * i, 0.2, 0});
  for (NodeId i = 0; i < 2 * kSteps; i += 2)
    triangles.push_back({{i, i + 2, i + 3}}), triangles.push_back({{i, i + 3, i + 1}});
  SurfaceMesh m = shapes::from(points, triangles);
  for (NodeId n = 0; n < m.n_nodes(); ++n) {
    const bool is_corner = n < 2 || n >= 2 * kSteps;
    m.node_entity_dim[n] = is_corner ? 0 : 1;
    m.node_entity[n] = is_corner ? n % 4 : n % 2 ? 2 : 0;
  }
  for (std::size_t t = 0; t < m.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      m.corner_uv[3 * t + k] = {m.node_xyz[m.triangles[t].n[k]].x, m.node_xyz[m.triangles[t].n[k]].y};
  return m;
}

TEST(Conformity, lists_what_the_cad_forces_apart) {
  const ConformityReport r = measure_conformity(strip(), edges_of(strip()), same_everywhere(0.5));
  EXPECT_EQ(r.model.n_edges, 81);
  EXPECT_EQ(r.model.n_within, 60) << "20 edges below, 20 above, 20 diagonals; not the 21 across";
  EXPECT_EQ(r.free.n_edges, 60);
  EXPECT_EQ(r.free.share(), 1);
  ASSERT_EQ(r.forced.size(), 3u) << "both short ends and the strip";
  for (int i : {0, 1}) {
    EXPECT_EQ(r.forced[i].kind, ForcedPlace::Kind::kShortEdge);
    EXPECT_EQ(r.forced[i].n_edges, 1);
  }
  EXPECT_EQ(r.forced[2].kind, ForcedPlace::Kind::kStrip);
  EXPECT_EQ(r.forced[2].entity, 0);
  EXPECT_EQ(r.forced[2].n_edges, 19);
  EXPECT_NEAR(r.forced[2].min_ratio, 0.4, 1e-12);
}

TEST(Conformity, excuses_no_edge_of_a_curve_that_has_room) {
  const ConformityReport r = measure_conformity(strip(), edges_of(strip()), same_everywhere(1.0));
  EXPECT_EQ(r.free.n_edges, 40) << "along both long edges";
  EXPECT_EQ(r.free.n_within, 0);
}

TEST(Conformity, excuses_no_short_edge_inside_a_face) {
  const ConformityReport r = measure_conformity(shapes::cube(4), edges_of(shapes::cube(4)), same_everywhere(1.0));
  EXPECT_TRUE(r.forced.empty());
  EXPECT_EQ(r.free.n_edges, r.model.n_edges);
}

TEST(Conformity, takes_a_seam_for_a_boundary) {
  SurfaceMesh m = strip();
  for (std::size_t c = 0; c < m.corner_uv.size(); c += 6)
    for (int k = 0; k < 3; ++k) m.corner_uv[c + k].x += 100;  // no two triangles have a common (u,v)
  for (const ForcedPlace& p : measure_conformity(m, edges_of(m), same_everywhere(0.5)).forced)
    EXPECT_EQ(p.kind, ForcedPlace::Kind::kShortEdge);
}

TEST(Conformity, excuses_short_edges_of_a_curve_of_three_segments_but_not_of_four) {
  for (const int n_inside : {2, 3}) {
    std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0.5, 3, 0}};
    std::vector<Triangle> triangles;
    for (int i = 1; i <= n_inside; ++i) points.push_back({static_cast<double>(i) / (n_inside + 1), 0, 0});
    for (int i = 0; i <= n_inside; ++i) triangles.push_back({{i ? 2 + i : 0, i < n_inside ? 3 + i : 1, 2}});
    SurfaceMesh m = shapes::from(points, triangles);
    m.node_entity_dim.assign(m.node_xyz.size(), 1);
    m.node_entity_dim[0] = m.node_entity_dim[1] = 0;
    m.node_entity_dim[2] = 2;
    const ConformityReport r = measure_conformity(m, edges_of(m), same_everywhere(1.0));
    EXPECT_EQ(r.forced.size(), n_inside == 2 ? 1u : 0u) << n_inside;
  }
}

TEST(Conformity, percentiles_have_one_of_a_hundred_edges_beyond_them) {
  const SurfaceMesh m = shapes::sphere(8);
  std::vector<double> length;
  EdgeTable(m.triangles, m.n_nodes()).for_each_edge([&](NodeId a, NodeId b, std::span<const SideId>) {
    length.push_back(distance(m.node_xyz[a], m.node_xyz[b]));
  });
  std::sort(length.begin(), length.end());
  const ConformityReport r = measure_conformity(m, edges_of(m), same_everywhere(1.0));
  const auto last = static_cast<double>(length.size() - 1);
  EXPECT_NEAR(r.p1, length[static_cast<std::size_t>(0.01 * last)], 1e-12);
  EXPECT_NEAR(r.p99, length[static_cast<std::size_t>(0.99 * last)], 1e-12);
  EXPECT_LT(r.p1, r.p99);
}

TEST(Conformity, takes_the_length_in_the_direction_of_each_edge) {
  const SurfaceMesh m = shapes::cube(4);
  const ConformityReport r = measure_conformity(m, edges_of(m), [](Vec3, int&) {
    return LocalSize{0.25, 2.5, {1, 0, 0}};
  });
  EXPECT_NEAR(r.p1, 0.1, 1e-9);
  EXPECT_GT(r.model.max, 0.99);
}

}  // namespace
}  // namespace st
