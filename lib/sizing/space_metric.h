// Metrics in space: their logarithms, growth, and what planes cut of them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sizing/background.h"

namespace st {

/// The logarithm of a metric. Precondition: positive definite.
SymmetricTensor log_of_metric(const SymmetricTensor& metric);
/// Of each, in its place.
void take_logs(std::vector<SymmetricTensor>& metrics);

/// The log-Euclidean mean of metrics by their logarithms (Arsigny, Fillard, Pennec, Ayache: Log-Euclidean metrics for
/// fast and simple calculus on diffusion tensors, Magnetic Resonance in Medicine 56, 2006), scaled to the smallest
/// length `shortest` (model unit, > 0). `weights`: of each; negative ones count as 0, and the sum as 1.
SymmetricTensor mean_metric(std::span<const SymmetricTensor> logs, std::span<const double> weights, double shortest);

/// A metric whose lengths all become longer with the distance: growth in space (Alauzet: Size gradation control of
/// anisotropic meshes, Finite Elements in Analysis and Design 46, 2010).
class GrowingMetric {
 public:
  explicit GrowingMetric(const SymmetricTensor& metric);
  /// All lengths longer by `rise` >= 0.
  SymmetricTensor after(double rise) const;

 private:
  std::array<double, 3> length_{};
  std::array<Vec3, 3> axis_;
};

/// None of its lengths below `least`.
SymmetricTensor raised_metric(const SymmetricTensor& metric, double least);

/// Whether `metric` asks in some direction for more than (1 + slack) times the length of `bound`.
bool is_longer(const SymmetricTensor& metric, const SymmetricTensor& bound, double slack);

/// Both lengths in the plane with this unit normal; zero: size_of_metric().
LocalSize cut_by_plane(const SymmetricTensor& metric, Vec3 normal);

/// In the plane with this unit normal the largest metric that asks for no more than either, their intersection. Its
/// smallest length may be below both, by a root of two at most. Normal zero: the smaller length of both across its
/// direction, and there the smaller of the lengths along it. Precondition: directions in the plane.
LocalSize least_in_plane(const LocalSize& a, const LocalSize& b, Vec3 normal);

}  // namespace st
