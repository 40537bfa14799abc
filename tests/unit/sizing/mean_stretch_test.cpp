#include "sizing/mean_stretch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "sizing/background.h"
#include "sizing/symmetric_tensor.h"

namespace st {
namespace {

/// A function of the eigenvalues of a symmetric matrix.
template <class Function>
Eigen::Matrix3d of_eigenvalues(const Eigen::Matrix3d& m, const Function& f) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(m);
  return solver.eigenvectors() * solver.eigenvalues().unaryExpr(f).asDiagonal() * solver.eigenvectors().transpose();
}

/// exp of the mean of the logarithms, as matrices.
Eigen::Matrix3d mean_of_logarithms(const std::vector<LocalSize>& sizes, const std::vector<double>& weights) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < sizes.size(); ++k)
    sum += weights[k] * of_eigenvalues(matrix_of(metric_of(sizes[k])), [](double x) { return std::log(x); });
  return of_eigenvalues(sum, [](double x) { return std::exp(x); });
}

MeanStretch mean_of(const std::vector<LocalSize>& sizes, const std::vector<double>& weights) {
  std::vector<Vec3> stretches;
  for (const LocalSize& s : sizes) stretches.push_back(log_stretch(s));
  return mean_stretch(stretches, weights);
}

TEST(MeanStretch, is_the_exponential_of_the_mean_of_logarithms) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.05, 1), sign(-1, 1);
  for (int i = 0; i < 200; ++i) {
    std::vector<LocalSize> sizes;
    std::vector<double> weights{uniform(random), uniform(random), uniform(random), uniform(random)};
    const double sum = weights[0] + weights[1] + weights[2] + weights[3];
    double log_length = 0;
    for (double& w : weights) {
      w /= sum;
      const double length = uniform(random);
      sizes.push_back(
          {length, (1 + 20 * uniform(random)) * length, normalized(Vec3{sign(random), sign(random), sign(random)})});
      log_length += w * std::log(length);
    }
    const MeanStretch mean = mean_of(sizes, weights);
    const PrincipalAxes axes = principal_axes(mean_of_logarithms(sizes, weights));
    for (std::size_t k = 0; k < 3; ++k)  // the longest length is that of the smallest eigenvalue
      EXPECT_NEAR(std::exp(log_length + 0.5 * mean.exponent[2 - k]) * std::sqrt(axes.value[k]), 1, 1e-9);
    EXPECT_NEAR(std::abs(dot(mean.direction, axes.axis[0])), 1, 1e-6);
  }
}

TEST(MeanStretch, of_two_turned_metrics_has_their_determinant_and_no_length_beyond_theirs) {
  for (const double turn : {0.0, 0.2, 0.7, 1.2, 1.5})
    for (const double weight : {0.0, 0.3, 0.5, 1.0}) {
      const LocalSize a{1, 10, {1, 0, 0}}, b{1, 10, {std::cos(turn), std::sin(turn), 0}};
      const MeanStretch mean = mean_of({a, b}, {weight, 1 - weight});
      double volume = 1;
      for (const double e : mean.exponent) {
        EXPECT_LE(std::exp(0.5 * e), 10 * (1 + 1e-12));
        EXPECT_GE(e, 0);
        volume *= std::exp(0.5 * e);
      }
      EXPECT_NEAR(volume, 10, 1e-9);
      if (weight == 0.5) {
        EXPECT_NEAR(std::exp(0.5 * mean.exponent[2]), std::pow(10, 0.5 * (1 + std::cos(turn))), 1e-9);
      }
      EXPECT_NEAR(mean.kept, std::exp(-mean.exponent[1]), 1e-12);
    }
}

TEST(MeanStretch, keeps_all_in_one_direction_and_nothing_across_two) {
  const Vec3 t = normalized(Vec3{1, 2, 0});
  EXPECT_NEAR(mean_of({{0.1, 0.8, t}, {0.2, 0.2, {}}, {0.1, 0.6, -1 * t}}, {0.2, 0.3, 0.5}).kept, 1, 1e-12);
  const MeanStretch across = mean_of({{0.1, 0.5, {1, 0, 0}}, {0.1, 0.5, {0, 1, 0}}}, {0.5, 0.5});
  EXPECT_NEAR(5 * across.kept, 1, 1e-12);
  const MeanStretch none = mean_of({{0.1, 0.1, {}}, {0.3, 0.3, {}}}, {0.5, 0.5});
  EXPECT_EQ(none.kept, 1);
  EXPECT_TRUE(none.direction == Vec3{});
}

}  // namespace
}  // namespace st
