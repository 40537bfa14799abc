// Which limits each face and edge of a model is sampled with.
#pragma once

#include <optional>
#include <vector>

#include "geometry/model.h"
#include "sizing/size_limits.h"

namespace st {

/// Limits per face and edge, by the role of the face's group.
///
/// Walls take the limits as given. A far field takes its own largest length, 1/20 of the diagonal of the face's box (never less than the
/// walls'): sizes meant for the body would fill it with triangles. A symmetry plane asks for nothing: its sizes come from what it touches.
/// An edge takes the smallest limits of its faces. A model without walls is sampled like one wall.
struct ModelLimits {
  std::vector<std::optional<SamplingLimits>> face;  ///< [n_faces]; nullopt: not sampled
  std::vector<std::optional<SamplingLimits>> edge;  ///< [n_edges]; nullopt: not sampled (degenerate, or between symmetry planes only)
  SamplingLimits far;                               ///< the walls' limits with max_length = far_length: for what is not sampled but traced
  double far_length = 0;                            ///< largest max_length of all: the length where nothing asks for less

  /// Limits at which an edge is traced as part of a loop.
  const SamplingLimits& trace(EdgeId e) const { return edge[e] ? *edge[e] : far; }
};

/// Longest side of a far-field triangle over the diagonal of its face's box.
inline constexpr double kFarLengthPerDiagonal = 1.0 / 20;

ModelLimits model_limits(const ModelTables& tables, const SamplingLimits& wall);

}  // namespace st
