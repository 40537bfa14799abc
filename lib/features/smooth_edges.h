// Edges across which the surface goes on smoothly: where the CAD happens to be split.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/executor.h"
#include "geometry/model/edge_angles.h"
#include "geometry/model/model.h"

namespace st {

/// Tells of one edge after the other, or of several at the same time. Local.
class SmoothEdges {
 public:
  /// `model` outlives it.
  explicit SmoothEdges(const Model& model) : angles_(model, kSmoothEdgeDeg) {}

  /// Whether two coedges use the edge, of two faces or along a seam, and at nine places on it the normals on both
  /// sides differ by 3 degrees at most. Degenerate edges are not smooth. Cost: up to 18 evaluations, at the first
  /// call for each edge.
  bool operator()(EdgeId e) { return angles_.largest_deg(e) <= kSmoothEdgeDeg; }

 private:
  EdgeAngles angles_;
};

/// Collective. [n_edges] 1: the edge is smooth; complete on rank 0.
std::vector<std::uint8_t> find_smooth_edges(const Model& model, const Executor& executor = SerialExecutor());

/// Whether two uses of an edge by `faces` have normals within `most` of each other half way along it, radians. Local.
bool is_smooth_half_way(const Model& model, EdgeId e, std::span<const FaceId> faces, double most);

}  // namespace st
