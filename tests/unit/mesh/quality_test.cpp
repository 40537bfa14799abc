#include "mesh/quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "mesh/adjacency.h"
#include "unit/mesh/shapes.h"

namespace st {
namespace {

RequestedSize same_everywhere(double length) {
  return [length](Vec3, int&) { return LocalSize{length, length, {}}; };
}

TEST(Quality, is_one_for_equilateral_and_zero_for_flat_triangles) {
  EXPECT_NEAR(triangle_quality({0, 0, 0}, {2, 0, 0}, {1, std::sqrt(3.0), 0}), 1, 1e-15);
  EXPECT_EQ(triangle_quality({0, 0, 0}, {1, 0, 0}, {3, 0, 0}), 0);
  EXPECT_EQ(triangle_quality({1, 1, 1}, {1, 1, 1}, {1, 1, 1}), 0);
}

TEST(Quality, of_a_cube_of_half_squares_is_exact) {
  const QualityReport r = measure_quality(shapes::cube(5), edges_of(shapes::cube(5)));
  const double expected = std::sqrt(3.0) / 2;
  EXPECT_NEAR(r.model.mean, expected, 1e-12);
  EXPECT_NEAR(r.model.p1, expected, 1e-12);
  EXPECT_NEAR(r.model.min, expected, 1e-12);
  EXPECT_NEAR(r.model.min_angle_deg, 45, 1e-9);
  EXPECT_NEAR(r.model.max_angle_deg, 90, 1e-9);
  EXPECT_EQ(r.model.histogram[8], 300);
  EXPECT_NEAR(r.jump_max, 1, 1e-9);
}

TEST(Quality, of_faces_adds_up_to_the_model) {
  SurfaceMesh m = shapes::cube(6);
  m.node_xyz[10] += {0.05, 0.04, 0.03};
  const QualityReport r = measure_quality(m, edges_of(m));
  ASSERT_EQ(r.faces.size(), 6u);
  std::int64_t n = 0;
  double sum = 0, worst = 1;
  for (const QualityStats& f : r.faces)
    n += f.n_triangles, sum += f.mean * static_cast<double>(f.n_triangles), worst = std::min(worst, f.min);
  EXPECT_EQ(n, m.n_triangles());
  EXPECT_NEAR(sum / static_cast<double>(n), r.model.mean, 1e-12);
  EXPECT_EQ(worst, r.model.min);
  EXPECT_EQ(std::accumulate(r.model.histogram.begin(), r.model.histogram.end(), std::int64_t{0}), n);
  const auto& t = m.triangles[r.model.worst].n;
  EXPECT_EQ(triangle_quality(m.node_xyz[t[0]], m.node_xyz[t[1]], m.node_xyz[t[2]]), r.model.min);
}

TEST(Quality, histograms_hold_every_angle_triangle_pair_and_edge_once) {
  const SurfaceMesh m = shapes::sphere(6);
  const QualityReport q = measure_quality(m, edges_of(m));
  const auto sum = [](const auto& histogram) {
    return std::accumulate(histogram.begin(), histogram.end(), std::int64_t{0});
  };
  EXPECT_EQ(sum(q.model.angle_histogram), 3 * m.n_triangles());
  EXPECT_EQ(sum(q.jumps.histogram), m.n_triangles() * 3 / 2);
  EXPECT_EQ(sum(measure_conformity(m, edges_of(m), same_everywhere(0.3)).model.histogram), m.n_triangles() * 3 / 2);
}

TEST(Quality, histogram_of_angles_of_half_squares_has_two_bins) {
  const QualityReport r = measure_quality(shapes::cube(5), edges_of(shapes::cube(5)));  // two angles of 45 and one of
                                                                                        // 90 degrees each
  EXPECT_EQ(r.model.angle_histogram[4], 600);
  EXPECT_EQ(r.model.angle_histogram[8] + r.model.angle_histogram[9], 300);
}

TEST(Quality, angles_are_those_of_the_inverse_tangent) {
  const std::vector<Vec3> x{{0, 0, 0},   {1, 0, 0},         {0.4, 0.02, 0}, {3, 0.3, 0.1},
                            {0.5, 2, 1}, {0.52, 2.1, 1.05}, {0, 1, 1e-3}};
  std::vector<Triangle> triangles;
  for (NodeId a = 0; a < 7; ++a)
    for (NodeId b = a + 1; b < 7; ++b)
      for (NodeId c = b + 1; c < 7; ++c) triangles.push_back({{a, b, c}});
  const SurfaceMesh m = shapes::from(x, triangles);
  const QualityStats q = measure_quality(m, edges_of(m)).model;
  QualityStats expected;
  expected.min_angle_deg = 180;
  for (const Triangle& t : triangles) {
    const std::array<double, 3> angles = triangle_angles_deg(x[t.n[0]], x[t.n[1]], x[t.n[2]]);
    for (const double angle : angles) ++expected.angle_histogram[static_cast<std::size_t>(angle / 10)];
    const auto [smallest, largest] = std::ranges::minmax(angles);
    expected.min_angle_deg = std::min(expected.min_angle_deg, smallest);
    expected.max_angle_deg = std::max(expected.max_angle_deg, largest);
    expected.n_below_20_deg += smallest < 20;
    expected.n_below_10_deg += smallest < 10;
    expected.n_below_5_deg += smallest < 5;
    expected.n_above_150_deg += largest > kLargeAngleDeg;
  }
  EXPECT_EQ(q.angle_histogram, expected.angle_histogram);
  EXPECT_EQ(q.min_angle_deg, expected.min_angle_deg);
  EXPECT_EQ(q.max_angle_deg, expected.max_angle_deg);
  EXPECT_EQ(q.n_below_20_deg, expected.n_below_20_deg);
  EXPECT_EQ(q.n_below_10_deg, expected.n_below_10_deg);
  EXPECT_EQ(q.n_below_5_deg, expected.n_below_5_deg);
  EXPECT_EQ(q.n_above_150_deg, expected.n_above_150_deg);
  EXPECT_GT(q.n_below_20_deg, q.n_below_10_deg);  // each count has triangles of its own
  EXPECT_GT(q.n_below_10_deg, q.n_below_5_deg);
  EXPECT_GT(q.n_above_150_deg, 0);
}

TEST(Quality, counts_triangles_by_their_smallest_angle) {
  const auto flat = [](double height) { return shapes::from({{0, 0, 0}, {1, 0, 0}, {0.5, height, 0}}, {{{0, 1, 2}}}); };
  const auto below = [&](double angle_deg) {
    const QualityStats s =
        measure_quality(flat(0.5 * std::tan(radians(angle_deg))), edges_of(flat(0.5 * std::tan(radians(angle_deg)))))
            .model;
    return std::array<std::int64_t, 3>{s.n_below_20_deg, s.n_below_10_deg, s.n_below_5_deg};
  };
  EXPECT_EQ(below(21), (std::array<std::int64_t, 3>{0, 0, 0}));
  EXPECT_EQ(below(19), (std::array<std::int64_t, 3>{1, 0, 0}));
  EXPECT_EQ(below(9), (std::array<std::int64_t, 3>{1, 1, 0}));
  EXPECT_EQ(below(4), (std::array<std::int64_t, 3>{1, 1, 1}));
}

TEST(Quality, jumps_of_faces_add_up_to_the_model) {
  SurfaceMesh m = shapes::cube(6);
  m.node_xyz[10] += {0.05, 0.04, 0.03};
  const QualityReport r = measure_quality(m, edges_of(m));
  std::int64_t n = 0;
  double largest = 1;
  for (const JumpStats& f : r.face_jumps) n += f.n_pairs, largest = std::max(largest, f.max);
  EXPECT_EQ(n, r.jumps.n_pairs);
  EXPECT_EQ(largest, r.jump_max);
}

TEST(Quality, sees_a_jump_between_neighbours) {
  const SurfaceMesh m = shapes::from({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -9, 0}}, {{{0, 1, 2}}, {{1, 0, 3}}});
  EXPECT_NEAR(measure_quality(m, edges_of(m)).jump_max, 3, 1e-12);
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

TEST(Quality, first_percentile_has_one_of_a_hundred_triangles_below_it) {
  const SurfaceMesh m = shapes::sphere(8);
  std::vector<double> quality;
  for (const Triangle& t : m.triangles)
    quality.push_back(triangle_quality(m.node_xyz[t.n[0]], m.node_xyz[t.n[1]], m.node_xyz[t.n[2]]));
  std::sort(quality.begin(), quality.end());
  ASSERT_LT(quality[quality.size() / 100], quality[quality.size() / 10]) << "a shape whose percentiles differ";
  EXPECT_EQ(measure_quality(m, edges_of(m)).model.p1, quality[quality.size() / 100]);
}

TEST(TriangleCorners, show_a_stretched_triangle_as_equilateral) {
  SurfaceMesh m;
  m.node_xyz = {{0, 0, 0}, {16, 0, 0}, {8, std::sqrt(0.75), 0}};
  m.triangles = {{{0, 1, 2}}};
  m.triangle_face = m.triangle_group = {0};
  m.labels.face_name = m.labels.group_name = {""};
  const std::vector<Vec3> squeeze(3, LocalSize{1, 16, {1, 0, 0}}.squeeze());
  std::vector<Vec3> signs = squeeze;
  signs[1] = -1.0 * signs[1];
  for (const std::vector<Vec3>& s : {squeeze, signs}) {
    const QualityReport r = measure_quality(m, edges_of(m), TriangleCorners(m, s));
    EXPECT_NEAR(r.model.mean, 1, 1e-12);
    EXPECT_NEAR(r.model.min_angle_deg, 60, 1e-9);
    EXPECT_GT(r.model.max_angle_deg, 165);  // in space
    EXPECT_EQ(r.model.n_above_150_deg, 1);
  }
  EXPECT_LT(measure_quality(m, edges_of(m)).model.mean, 0.2);
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
