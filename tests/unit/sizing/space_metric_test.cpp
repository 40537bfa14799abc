#include "sizing/space_metric.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sizing/multiscale_metric.h"
#include "unit/sizing/shock_metric.h"

namespace st {
namespace {

using test::metric_of_shock;

Vec3 random_unit(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return normalized(Vec3{normal(random), normal(random), normal(random)});
}

/// What the metric asks for along `way`.
double length_in(const SymmetricTensor& m, Vec3 way) {
  const Vec3 d = normalized(way);
  return 1 / std::sqrt(m[0] * d.x * d.x + m[1] * d.y * d.y + m[2] * d.z * d.z +
                       2 * (m[3] * d.x * d.y + m[4] * d.y * d.z + m[5] * d.x * d.z));
}

TEST(SpaceMetric, of_a_tilted_shock_is_cut_short_across_its_trace_and_long_along_it) {
  for (const double angle : {0.0, 0.5, 1.0, 1.4}) {
    const double c = std::cos(angle), trace = 1 / std::sqrt(c * c / 0.01 + (1 - c * c) / 4);
    const LocalSize size = cut_by_plane(metric_of_shock({c, 0, std::sin(angle)}, 0.1, 2), {0, 0, 1});
    EXPECT_NEAR(size.length, trace, 1e-9 * trace) << angle;
    EXPECT_NEAR(size.along, 2, 1e-9) << angle;
    EXPECT_NEAR(std::abs(size.direction.y), 1, 1e-9) << angle;
  }
}

TEST(SpaceMetric, is_long_in_both_directions_of_a_plane_that_a_shock_lies_on) {
  const LocalSize size = cut_by_plane(metric_of_shock({0, 0, 1}, 0.1, 2), {0, 0, 1});
  EXPECT_NEAR(size.length, 2, 1e-9);
  EXPECT_EQ(size.along, size.length);
}

TEST(SpaceMetric, is_cut_to_what_it_asks_for_in_every_direction_of_any_plane) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const SymmetricTensor metric =
        intersection(metric_of_shock(random_unit(random), 0.01, 2), metric_of_shock(random_unit(random), 0.1, 3));
    const Vec3 normal = random_unit(random), u = a_normal_to(normal), v = cross(normal, u);
    const LocalSize size = cut_by_plane(metric, normal);
    EXPECT_NEAR(dot(size.direction, normal), 0, 1e-9);
    for (double angle = 0; angle < 3.1; angle += 0.1) {
      const Vec3 way = std::cos(angle) * u + std::sin(angle) * v;
      EXPECT_NEAR(size.in(way), length_in(metric, way), 1e-6 * length_in(metric, way)) << angle;
    }
  }
}

TEST(SpaceMetric, is_the_log_euclidean_mean_with_the_smallest_length_that_is_given) {
  const SymmetricTensor a = metric_of_shock({1, 0, 0}, 0.1, 1.6), b = metric_of_shock({1, 0, 0}, 0.1, 0.4);
  const std::array logs{log_of_metric(a), log_of_metric(b)};
  const SymmetricTensor mean = mean_metric(logs, std::array{0.5, 0.5}, 0.2);
  EXPECT_NEAR(length_in(mean, {1, 0, 0}), 0.2, 1e-12);
  EXPECT_NEAR(length_in(mean, {0, 1, 1}), 2 * std::sqrt(1.6 * 0.4), 1e-12);
  // weights below 0 are rounding at the side of a cell
  EXPECT_NEAR(length_in(mean_metric(logs, std::array{1.0, -1e-12}, 0.1), {0, 1, 0}), 1.6, 1e-9);
}

TEST(SpaceMetric, grows_alike_in_all_directions_and_is_raised_where_it_is_too_short) {
  const SymmetricTensor metric = metric_of_shock(normalized(Vec3{1, 2, 2}), 0.1, 2);
  const SymmetricTensor grown = GrowingMetric(metric).after(0.3), raised = raised_metric(metric, 0.5);
  EXPECT_NEAR(length_in(grown, {1, 2, 2}), 0.4, 1e-9);
  EXPECT_NEAR(length_in(grown, {2, -1, 0}), 2.3, 1e-9);
  EXPECT_NEAR(length_in(raised, {1, 2, 2}), 0.5, 1e-9);
  EXPECT_NEAR(length_in(raised, {2, -1, 0}), 2, 1e-9);
}

TEST(SpaceMetric, is_longer_where_one_direction_is) {
  const SymmetricTensor metric = metric_of_shock({0, 1, 0}, 0.1, 2), round = metric_of_shock({0, 1, 0}, 1.9, 1.9);
  EXPECT_TRUE(is_longer(metric, round, 0.01));
  EXPECT_FALSE(is_longer(metric, round, 0.1));
  EXPECT_FALSE(is_longer(metric, metric, 1e-6));
}

TEST(SpaceMetric, is_least_in_a_plane_as_no_direction_asks_for_more_than_either) {
  const Vec3 normal{0, 0, 1};
  for (double turn = 0.05; turn < 3; turn += 0.1) {
    const LocalSize a{0.1, 1, {1, 0, 0}}, b{0.2, 3, {std::cos(turn), std::sin(turn), 0}};
    const LocalSize both = least_in_plane(a, b, normal);
    EXPECT_GE(both.length, 0.1 / std::sqrt(2));
    for (double angle = 0; angle < 3.2; angle += 0.05) {
      const Vec3 way{std::cos(angle), std::sin(angle), 0};
      EXPECT_LE(both.in(way), (1 + 1e-9) * std::min(a.in(way), b.in(way))) << turn << " " << angle;
    }
  }
  const LocalSize round{0.5, 0.5, {}}, longer{0.1, 2, {0, 1, 0}}, cut = least_in_plane(round, longer, normal);
  EXPECT_EQ(cut.length, 0.1);
  EXPECT_EQ(cut.along, 0.5);
}

}  // namespace
}  // namespace st
