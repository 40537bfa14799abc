#include "sizing/space_metric.h"

#include <algorithm>
#include <cmath>

#include "base/threads.h"
#include "sizing/multiscale_metric.h"
#include "sizing/symmetric_tensor.h"

namespace st {
namespace {

/// The tensor of the same axes with other eigenvalues.
template <class Value>
SymmetricTensor with_values(const PrincipalAxes& axes, const Value& value) {
  SymmetricTensor t{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double v = value(axes.value[k]);
    const Vec3 a = axes.axis[k];
    const SymmetricTensor part{a.x * a.x, a.y * a.y, a.z * a.z, a.x * a.y, a.y * a.z, a.x * a.z};
    for (std::size_t i = 0; i < t.size(); ++i) t[i] += v * part[i];
  }
  return t;
}

double of_length(double length) { return 1 / (length * length); }

double product(const SymmetricTensor& t, Vec3 a, Vec3 b) {
  return a.x * (t[0] * b.x + t[3] * b.y + t[5] * b.z) + a.y * (t[3] * b.x + t[1] * b.y + t[4] * b.z) +
         a.z * (t[5] * b.x + t[4] * b.y + t[2] * b.z);
}

}  // namespace

SymmetricTensor log_of_metric(const SymmetricTensor& metric) {
  return with_values(principal_axes(matrix_of(metric)), [](double v) { return std::log(v); });
}

void take_logs(std::vector<SymmetricTensor>& metrics) {
  constexpr std::size_t kPerPiece = 4096;
  parallel_for(metrics.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) metrics[n] = log_of_metric(metrics[n]);
  });
}

SymmetricTensor mean_metric(std::span<const SymmetricTensor> logs, std::span<const double> weights, double shortest) {
  SymmetricTensor sum{};
  double total = 0;
  for (std::size_t k = 0; k < logs.size(); ++k) {
    const double w = std::max(0.0, weights[k]);
    total += w;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += w * logs[k][i];
  }
  for (double& s : sum) s /= total;
  const PrincipalAxes axes = principal_axes(matrix_of(sum));
  return with_values(axes, [&](double v) { return std::exp(v - axes.value[2]) * of_length(shortest); });
}

GrowingMetric::GrowingMetric(const SymmetricTensor& metric) {
  const PrincipalAxes axes = principal_axes(matrix_of(metric));
  for (std::size_t k = 0; k < 3; ++k) length_[k] = 1 / std::sqrt(axes.value[k]);
  axis_ = axes.axis;
}

SymmetricTensor GrowingMetric::after(double rise) const {
  return with_values({length_, axis_}, [&](double length) { return of_length(length + rise); });
}

SymmetricTensor raised_metric(const SymmetricTensor& metric, double least) {
  return with_values(principal_axes(matrix_of(metric)), [&](double v) { return std::min(v, of_length(least)); });
}

bool is_longer(const SymmetricTensor& metric, const SymmetricTensor& bound, double slack) {
  const double factor = (1 + slack) * (1 + slack);
  const Eigen::Matrix3d m = factor * matrix_of(metric) - matrix_of(bound);
  // Sylvester: the leading minors of a positive definite matrix are positive
  return !(m(0, 0) > 0 && m(0, 0) * m(1, 1) - m(0, 1) * m(0, 1) > 0 && m.determinant() > 0);
}

LocalSize cut_by_plane(const SymmetricTensor& metric, Vec3 normal) {
  if (normal == Vec3{}) return size_of_metric(metric);
  const Vec3 u = a_normal_to(normal), v = cross(normal, u);
  const double a = product(metric, u, u), b = product(metric, u, v), c = product(metric, v, v), middle = 0.5 * (a + c),
               half = std::hypot(0.5 * (a - c), b), large = middle + half, small = (a * c - b * b) / large;
  // rows of (m - large) lie along the axis of the smaller value: the longer one counts
  const Vec2 row = std::abs(a - large) > std::abs(c - large) ? Vec2{a - large, b} : Vec2{b, c - large};
  return uniaxial({1 / std::sqrt(large), 1 / std::sqrt(std::min(small, large)), row.x * u + row.y * v});
}

LocalSize least_in_plane(const LocalSize& a, const LocalSize& b, Vec3 normal) {
  if (b.length < a.length) return least_in_plane(b, a, normal);
  if (!(a.along > a.length)) return a;
  if (!(b.along > b.length)) return uniaxial({a.length, std::min(a.along, b.length), a.direction});
  if (normal == Vec3{}) return uniaxial({a.length, std::min(a.along, b.in(a.direction)), a.direction});
  return cut_by_plane(intersection(metric_of(a), metric_of(b)), normal);
}

}  // namespace st
