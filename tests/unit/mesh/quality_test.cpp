#include "mesh/quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "mesh/adjacency.h"
#include "mesh/conformity.h"
#include "unit/mesh/shapes.h"

namespace st {
namespace {

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
  const auto& t = m.triangles[r.model.worst.triangle].n;
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
  EXPECT_EQ(sum(measure_conformity(m, edges_of(m),
                                   [](Vec3, int&) {
                                     return LocalSize{0.3, 0.3, {}};
                                   })
                    .model.histogram),
            m.n_triangles() * 3 / 2);
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

}  // namespace
}  // namespace st
