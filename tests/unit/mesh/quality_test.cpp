#include "mesh/quality.h"

#include <gtest/gtest.h>

#include <numeric>

#include "unit/mesh/shapes.h"

namespace st {
namespace {

TEST(Quality, is_one_for_equilateral_and_zero_for_flat_triangles) {
  EXPECT_NEAR(triangle_quality({0, 0, 0}, {2, 0, 0}, {1, std::sqrt(3.0), 0}), 1, 1e-15);
  EXPECT_EQ(triangle_quality({0, 0, 0}, {1, 0, 0}, {3, 0, 0}), 0);
  EXPECT_EQ(triangle_quality({1, 1, 1}, {1, 1, 1}, {1, 1, 1}), 0);
}

TEST(Quality, of_a_cube_of_half_squares_is_exact) {
  const QualityReport r = measure_quality(shapes::cube(5));
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
  const QualityReport r = measure_quality(m);
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

TEST(Quality, sees_a_jump_between_neighbours) {
  const SurfaceMesh m = shapes::from({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -9, 0}}, {{{0, 1, 2}}, {{1, 0, 3}}});
  EXPECT_NEAR(measure_quality(m).jump_max, 3, 1e-12);
}

TEST(Conformity, compares_lengths_with_the_requested_ones) {
  const SurfaceMesh m = shapes::cube(4);  // sides 1/4, diagonals sqrt(2)/4
  const ConformityReport fits = measure_conformity(m, [](Vec3) { return 0.25; });
  EXPECT_EQ(fits.model.n_edges, 288);
  EXPECT_NEAR(fits.model.min, 1, 1e-12);
  EXPECT_NEAR(fits.model.max, std::sqrt(2.0), 1e-12);
  EXPECT_EQ(fits.model.n_within, 192) << "the diagonals are too long";
  EXPECT_EQ(measure_conformity(m, [](Vec3) { return 0.3; }).model.share(), 1);
  EXPECT_EQ(measure_conformity(m, [](Vec3) { return 1.0; }).model.share(), 0);
}

TEST(Conformity, follows_a_length_that_varies_along_the_edge) {
  const SurfaceMesh m = shapes::from({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}}});
  const ConformityReport r = measure_conformity(m, [](Vec3 p) { return 1 + p.x; });
  EXPECT_NEAR(r.model.min, std::log(2.0), 2e-3) << "the integral of dx / (1 + x)";
}

TEST(Conformity, tells_edges_inside_faces_from_those_the_cad_forces) {
  SurfaceMesh m = shapes::from({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 0}}, {{{0, 1, 3}}, {{1, 2, 3}}, {{2, 0, 3}}});
  m.node_entity_dim = {0, 0, 0, 2};
  const ConformityReport r = measure_conformity(m, [](Vec3) { return 1.0; });
  EXPECT_EQ(r.model.n_edges, 6);
  EXPECT_EQ(r.inner.n_edges, 3);
}

}  // namespace
}  // namespace st
