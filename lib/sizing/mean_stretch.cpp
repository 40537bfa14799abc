#include "sizing/mean_stretch.h"

#include <algorithm>
#include <cmath>

#include "base/eigen.h"

namespace st {

Vec3 log_stretch(const LocalSize& size) {
  return size.along > size.length ? std::sqrt(2 * std::log(size.along / size.length)) * size.direction : Vec3{};
}

MeanStretch mean_stretch(std::span<const Vec3> log_stretches, std::span<const double> weights) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const Eigen::Vector3d q = to_eigen(log_stretches[k]);
    sum += std::max(0.0, weights[k]) * q * q.transpose();
  }
  MeanStretch mean;
  if (!(sum.trace() > 0)) return mean;
  const PrincipalAxes axes = principal_axes(sum);
  for (std::size_t k = 0; k < 3; ++k) mean.exponent[k] = std::max(0.0, axes.value[k]);
  mean.direction = axes.axis[2];
  // all in one direction, the last exponent were the trace; what the middle axis gets is no stretch
  mean.kept = std::exp(-0.5 * mean.exponent[0] - mean.exponent[1]);
  return mean;
}

}  // namespace st
