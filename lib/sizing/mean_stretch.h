// The mean of stretched sizes by the logarithms of their metrics.
#pragma once

#include <array>
#include <span>

#include "base/local_size.h"

namespace st {

/// The logarithm of a size's metric is -2 ln(length) I - q q^T, with this q: sqrt(2 ln(along / length)) along the
/// direction; zero where it is not stretched.
Vec3 log_stretch(const LocalSize& size);

/// Log-Euclidean mean of metrics (Arsigny, Fillard, Pennec, Ayache: Log-Euclidean metrics for fast and simple calculus
/// on diffusion tensors, Magnetic Resonance in Medicine 56, 2006) without the part that has no direction: the mean
/// asks along axis k for g exp(exponent[k] / 2), where g is the geometric mean of the smallest lengths.
struct MeanStretch {
  std::array<double, 3> exponent{};  ///< ascending, >= 0
  Vec3 direction;                    ///< unit vector along the last; zero where nothing is stretched
  /// Of the mean of the longer lengths, what is left because directions differ: 1 where they are one, and so little
  /// that nothing is longer where two axes are as long. In (0, 1].
  double kept = 1;
};

/// `log_stretches`: of some sizes, with `weights` that sum to 1; negative ones count as 0. One exponential.
MeanStretch mean_stretch(std::span<const Vec3> log_stretches, std::span<const double> weights);

}  // namespace st
