#include "sizing/multiscale_metric.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/eigen.h"
#include "unit/sizing/background_meshes.h"

namespace st {
namespace {

/// Two unit squares side by side, the second from x = 1 to 2, in 2 n^2 triangles each that share no nodes.
BackgroundMesh two_squares(int n) {
  BackgroundMesh mesh;
  for (int square = 0; square < 2; ++square) {
    const auto first = static_cast<int>(mesh.node_xyz.size());
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        mesh.node_xyz.push_back({square + static_cast<double>(i) / n, static_cast<double>(j) / n, 0});
    test::add_square_cells(n, first, mesh);
  }
  return mesh;
}

/// One tensor on each square.
std::vector<SymmetricTensor> by_square(const BackgroundMesh& mesh, SymmetricTensor a, SymmetricTensor b) {
  std::vector<SymmetricTensor> all(mesh.node_xyz.size() / 2, a);
  all.resize(mesh.node_xyz.size(), b);
  return all;
}

const MetricOptions kFor1000{.n_nodes = 1000, .greatest = 10};

double length_along_x(const SymmetricTensor& m) { return 1 / std::sqrt(m[0]); }

TEST(MultiscaleMetric, has_as_many_nodes_as_asked_for) {
  const BackgroundMesh mesh = two_squares(4);
  MultiscaleMetric metric(mesh, kFor1000);
  ASSERT_TRUE(metric.add(by_square(mesh, {-3, 3, 3, 0, 0, 0}, {3, 3, 3, 0, 0, 0})));
  EXPECT_NEAR(metric.n_nodes(), 1000, 1e-6);
  // an area of 2 in equilateral triangles, two for each node
  for (const SymmetricTensor& m : metric.metrics())
    EXPECT_NEAR(length_along_x(m), std::sqrt(4 / std::sqrt(3) / 1000), 1e-9);
}

TEST(MultiscaleMetric, spreads_the_error_as_its_norm_says) {
  const BackgroundMesh mesh = two_squares(4);
  for (const double p : {1.0, 2.0, 4.0}) {
    MetricOptions options = kFor1000;
    options.norm = p;
    MultiscaleMetric metric(mesh, options);
    metric.add(by_square(mesh, {1, 1, 1, 0, 0, 0}, {8, 8, 8, 0, 0, 0}));
    const std::vector<SymmetricTensor> m = metric.metrics();
    // by the paper: |H| det(|H|)^(-1/(2p+2)), so the metric goes with the power p/(p+1) of the second derivative
    EXPECT_NEAR(m.back()[0] / m.front()[0], std::pow(8, p / (p + 1)), 1e-9);
  }
}

TEST(MultiscaleMetric, keeps_lengths_and_their_ratio_in_their_bounds) {
  const BackgroundMesh mesh = two_squares(4);
  MetricOptions options = kFor1000;
  options.max_aspect = 5;
  MultiscaleMetric stretched(mesh, options);
  stretched.add(by_square(mesh, {100, 0, 100, 0, 0, 0}, {1, 1, 1, 0, 0, 0}));
  EXPECT_NEAR(stretched.metrics()[0][0] / stretched.metrics()[0][1], 25, 1e-9);
  EXPECT_NEAR(stretched.n_nodes(), 1000, 1e-6);

  options.max_aspect = 1;
  options.least = 0.05;  // above the 0.036 that 1000 nodes have
  options.greatest = 0.1;
  MultiscaleMetric bounded(mesh, options);
  bounded.add(by_square(mesh, {1e6, 1e6, 1e6, 0, 0, 0}, {0, 0, 0, 0, 0, 0}));
  EXPECT_NEAR(length_along_x(bounded.metrics().front()), 0.05, 1e-9);
  EXPECT_LE(length_along_x(bounded.metrics().back()), 0.1 + 1e-9);
}

TEST(MultiscaleMetric, of_several_fields_asks_for_no_more_than_any) {
  const BackgroundMesh mesh = two_squares(4);
  MultiscaleMetric both(mesh, kFor1000);
  const std::vector<SymmetricTensor> a = by_square(mesh, {9, 9, 9, 0, 0, 0}, {1, 1, 1, 0, 0, 0}),
                                     b = by_square(mesh, {1, 1, 1, 0, 0, 0}, {9, 9, 9, 0, 0, 0});
  both.add(a);
  both.add(b);
  const std::vector<SymmetricTensor> m = both.metrics();
  EXPECT_NEAR(m.front()[0], m.back()[0], 1e-9 * m.front()[0]);
  EXPECT_NEAR(both.n_nodes(), 1000, 1e-6);
}

TEST(MultiscaleMetric, has_nothing_of_a_field_without_second_derivatives) {
  const BackgroundMesh mesh = two_squares(2);
  MultiscaleMetric metric(mesh, kFor1000);
  EXPECT_FALSE(metric.add(std::vector<SymmetricTensor>(mesh.node_xyz.size())));
}

double squared_length(const SymmetricTensor& m, Vec3 d) {
  return m[0] * d.x * d.x + m[1] * d.y * d.y + m[2] * d.z * d.z +
         2 * (m[3] * d.x * d.y + m[4] * d.y * d.z + m[5] * d.x * d.z);
}

TEST(MultiscaleMetric, intersection_is_no_longer_than_either_in_any_direction) {
  const SymmetricTensor crossed = intersection({1, 4, 1, 0, 0, 0}, {4, 1, 1, 0, 0, 0});
  const SymmetricTensor wanted{4, 4, 1, 0, 0, 0};
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(crossed[k], wanted[k], 1e-12);
  const SymmetricTensor a{5, 2, 3, 1, -0.5, 0.2}, b{1, 7, 2, -1, 0.3, 0.6}, both = intersection(a, b);
  double least_excess = 1;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 20; ++j) {
      const double u = kPi * i / 20, v = kPi * j / 20;
      const Vec3 d{std::cos(u) * std::sin(v), std::sin(u) * std::sin(v), std::cos(v)};
      const double excess = squared_length(both, d) / std::max(squared_length(a, d), squared_length(b, d)) - 1;
      EXPECT_GT(excess, -1e-12);
      least_excess = std::min(least_excess, excess);
    }
  EXPECT_LT(least_excess, 0.01);  // it touches them
}

}  // namespace
}  // namespace st
