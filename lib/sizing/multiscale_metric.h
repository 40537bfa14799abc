// Metrics from second derivatives: which lengths make the interpolation error of fields smallest.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/eigen.h"
#include "sizing/background.h"
#include "sizing/field_hessian.h"

namespace st {

struct MetricOptions {
  double n_nodes = 0;     ///< of the mesh that the metric asks for, > 0
  double norm = 2;        ///< p >= 1 of the Lp norm in which the error is measured
  double max_aspect = 1;  ///< >= 1: longest over shortest length at a node
  double least = 0;       ///< no length is below, model unit, >= 0
  double greatest = 0;    ///< nor above it, model unit, > least
};

/// A metric for each node of a mesh, for all fields together: each field's second derivatives are made positive and
/// their ratio bounded, then multiplied by det^(-1/(2p+d)), d = 2 on surfaces and 3 in volumes, which spreads the error
/// over scales (Loseille & Alauzet, "Continuous mesh framework, part I", SIAM J. Numer. Anal. 49, 2011). Fields of the
/// same complexity, the integral of sqrt(det), are intersected by simultaneous reduction. One factor then gives the
/// number of nodes, with the bounds of lengths kept: complexity * 2/sqrt(3) on surfaces (equilateral triangles),
/// * sqrt(2) in volumes (closest packing). On a surface the length across it is the smallest of those in it.
class MultiscaleMetric {
 public:
  /// Keeps `mesh`, which outlives it. Precondition: options in their ranges.
  MultiscaleMetric(const BackgroundMesh& mesh, const MetricOptions& options);

  /// False: the field has no second derivatives anywhere, so nothing is added.
  bool add(std::span<const SymmetricTensor> hessian);
  /// [n_nodes] positive definite. Precondition: a field was added.
  std::vector<SymmetricTensor> metrics() const;
  /// Of metrics(), by its complexity; other than asked for where the bounds of lengths do not allow it.
  double n_nodes() const;

 private:
  bool is_volume() const { return !mesh_.tets.empty(); }
  double density(const std::array<double, 3>& value) const;
  std::array<double, 3> bounded(const std::array<double, 3>& value, double factor) const;
  double complexity(double factor) const;
  double nodes_per_complexity() const;
  double factor_for_nodes() const;

  const BackgroundMesh& mesh_;
  const MetricOptions options_;
  std::vector<double> measure_;          // [nodes] area or volume that each stands for
  std::vector<SymmetricTensor> metric_;  // [nodes] of all fields so far, of one factor; empty: none
  std::vector<PrincipalAxes> axes_;      // of metric_
};

/// The smallest metric known to ask in each direction for no more than either: simultaneous reduction of both.
/// Precondition: positive definite.
SymmetricTensor intersection(const SymmetricTensor& a, const SymmetricTensor& b);

}  // namespace st
