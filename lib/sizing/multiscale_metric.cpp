#include "sizing/multiscale_metric.h"

#include <algorithm>
#include <cmath>

#include "base/eigen.h"
#include "base/threads.h"
#include "sizing/symmetric_tensor.h"

namespace st {
namespace {

SymmetricTensor tensor_with(const std::array<double, 3>& value, const std::array<Vec3, 3>& axis) {
  Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) m += value[k] * to_eigen(axis[k]) * to_eigen(axis[k]).transpose();
  return tensor_of(m);
}

/// Area or volume of each node's share of its cells.
std::vector<double> node_measures(const BackgroundMesh& mesh) {
  std::vector<double> measure(mesh.node_xyz.size(), 0);
  const auto at = [&](std::int32_t n) { return mesh.node_xyz[n]; };
  for (const auto& t : mesh.tets)
    for (const std::int32_t n : t)
      measure[n] += std::abs(dot(cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0])), at(t[3]) - at(t[0]))) / 24;
  if (mesh.tets.empty())
    for (const auto& t : mesh.triangles)
      for (const std::int32_t n : t) measure[n] += norm(cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]))) / 6;
  return measure;
}

}  // namespace

SymmetricTensor intersection(const SymmetricTensor& a, const SymmetricTensor& b) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> of_a(matrix_of(a));
  const Eigen::Matrix3d root = of_a.operatorSqrt(), inverse = of_a.operatorInverseSqrt();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> common(inverse * matrix_of(b) * inverse);
  const Eigen::Vector3d larger = common.eigenvalues().cwiseMax(1.0);
  const Eigen::Matrix3d m =
      root * common.eigenvectors() * larger.asDiagonal() * common.eigenvectors().transpose() * root;
  return tensor_of(Eigen::Matrix3d(0.5 * (m + m.transpose())));
}

MultiscaleMetric::MultiscaleMetric(const BackgroundMesh& mesh, const MetricOptions& options)
    : mesh_(mesh), options_(options), measure_(node_measures(mesh)) {}

double MultiscaleMetric::density(const std::array<double, 3>& value) const {
  return std::sqrt(is_volume() ? value[0] * value[1] * value[2] : value[0] * value[2]);
}

std::array<double, 3> MultiscaleMetric::bounded(const std::array<double, 3>& value, double factor) const {
  const double largest = options_.least > 0 ? 1 / (options_.least * options_.least) : HUGE_VAL,
               smallest = 1 / (options_.greatest * options_.greatest);
  std::array<double, 3> result{};
  for (std::size_t k = 0; k < 3; ++k) result[k] = std::clamp(factor * value[k], smallest, largest);
  return result;
}

bool MultiscaleMetric::add(std::span<const SymmetricTensor> hessian) {
  constexpr double kNothing = 1e-12;  // of the largest second derivative: as good as none
  const std::size_t n_nodes = hessian.size();
  const double p = options_.norm, d = is_volume() ? 3 : 2;
  std::vector<PrincipalAxes> axes(n_nodes);
  parallel_for(n_nodes, 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) axes[n] = principal_axes(matrix_of(hessian[n]));
  });
  double largest = 0;
  for (const PrincipalAxes& a : axes) largest = std::max({largest, std::abs(a.value[0]), std::abs(a.value[2])});
  if (!(largest > 0)) return false;
  std::vector<SymmetricTensor> metric(n_nodes);
  double own_complexity = 0;
  for (std::size_t n = 0; n < n_nodes; ++n) {
    std::array<double, 3> value = axes[n].value;
    for (double& v : value) v = std::abs(v);
    const double most = std::max({value[0], value[1], value[2], kNothing * largest});
    for (double& v : value) v = std::max(v, most / (options_.max_aspect * options_.max_aspect));
    std::array<double, 3> sorted = value;
    std::sort(sorted.begin(), sorted.end());
    const double determinant = density(sorted) * density(sorted);
    const double factor = std::pow(determinant, -1 / (2 * p + d));
    for (double& v : value) v *= factor;
    own_complexity += measure_[n] * std::sqrt(determinant) * std::pow(factor, d / 2);
    metric[n] = tensor_with(value, axes[n].axis);
  }
  const double to_one = std::pow(own_complexity, -2 / d);
  for (SymmetricTensor& m : metric)
    for (double& component : m) component *= to_one;
  if (metric_.empty())
    metric_ = std::move(metric);
  else
    for (std::size_t n = 0; n < n_nodes; ++n) metric_[n] = intersection(metric_[n], metric[n]);
  axes_.resize(n_nodes);
  for (std::size_t n = 0; n < n_nodes; ++n) {
    const PrincipalAxes own = principal_axes(matrix_of(metric_[n]));
    axes_[n] = {own.value, own.axis};
  }
  return true;
}

double MultiscaleMetric::complexity(double factor) const {
  double sum = 0;
  for (std::size_t n = 0; n < axes_.size(); ++n) sum += measure_[n] * density(bounded(axes_[n].value, factor));
  return sum;
}

double MultiscaleMetric::nodes_per_complexity() const { return is_volume() ? std::sqrt(2.0) : 2 / std::sqrt(3.0); }

double MultiscaleMetric::factor_for_nodes() const {
  constexpr double kMost = 1e60;  // of the factor: beyond it the bounds alone tell
  constexpr int kHalvings = 100;
  const double wanted = options_.n_nodes / nodes_per_complexity();
  double low = std::log(1 / kMost), high = std::log(kMost);
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (complexity(std::exp(middle)) < wanted ? low : high) = middle;
  }
  return std::exp(high);
}

double MultiscaleMetric::n_nodes() const { return nodes_per_complexity() * complexity(factor_for_nodes()); }

std::vector<SymmetricTensor> MultiscaleMetric::metrics() const {
  const double factor = factor_for_nodes();
  std::vector<SymmetricTensor> result;
  for (const PrincipalAxes& a : axes_) result.push_back(tensor_with(bounded(a.value, factor), a.axis));
  return result;
}

}  // namespace st
