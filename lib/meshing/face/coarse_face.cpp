#include "meshing/face/coarse_face.h"

#include <algorithm>
#include <bit>

#include "meshing/face/scaled_field.h"

namespace st {
namespace {

constexpr int kCoarseRounds = 2;  // of the enhancer: cuts should be straight and meet at wide angles

}  // namespace

CoarseFace::CoarseFace(const Surface& surface, const FaceBoundary& boundary, std::span<const BoundaryPlace> places,
                       const SizeField& field)
    : surface_(surface), boundary_(boundary), places_(places), field_(field), is_closed_(follow_loops()) {}

/// The node after each; of those where several parts of the loops meet, any. False: a loop is open.
bool CoarseFace::follow_loops() {
  next_.assign(boundary_.nodes.size(), kNone);
  is_meeting_.assign(boundary_.nodes.size(), 0);
  std::vector<std::int32_t> n_ends(boundary_.nodes.size(), 0);
  for (const auto& [a, b] : boundary_.segments) {
    if (next_[a] != kNone) is_meeting_[a] = 1;
    next_[a] = b;
    ++n_ends[b];
  }
  for (std::size_t i = 0; i < next_.size(); ++i)
    if (next_[i] == kNone || (n_ends[i] > 1 && !is_meeting_[i])) return false;
  return true;
}

/// Vertices, poles, where parts of the loops meet, and nodes that are the further apart the further from the end of
/// their edge.
bool CoarseFace::is_kept(std::int32_t node, std::int32_t step) const {
  const BoundaryPlace& p = places_[node];
  if (p.to_end == 0 || boundary_.nodes[node].is_pole || is_meeting_[node]) return true;
  const auto graded = static_cast<std::int32_t>(std::bit_floor(static_cast<unsigned>(std::max(1, p.to_end / 2))));
  return p.index % std::min(step, graded) == 0;
}

/// Without the corners at their ends.
std::vector<CoarseFace::Part> CoarseFace::parts_between(const std::vector<char>& is_node) const {
  std::vector<Part> parts;
  for (const auto& [a, b] : boundary_.segments) {
    if (!is_node[a]) continue;
    std::int32_t end = b;
    while (!is_node[end]) end = next_[end];
    parts.push_back({a, b, end, kNone, kNone});
  }
  return parts;
}

/// The nodes of the coarse loops. Along the rough rim of a hole these lie within the hole: no cut meets the rim.
std::vector<char> CoarseFace::coarse_nodes(std::int32_t step) const {
  std::vector<char> is_node(boundary_.nodes.size());
  for (std::size_t i = 0; i < is_node.size(); ++i) is_node[i] = is_kept(static_cast<std::int32_t>(i), step);
  std::vector<Part> open = parts_between(is_node);
  while (!open.empty()) {
    const Part part = open.back();
    open.pop_back();
    if (!places_[part.second].is_rough) continue;
    const Vec2 from = boundary_.nodes[part.begin].uv, along = boundary_.nodes[part.end].uv - from;
    std::int32_t innermost = kNone;
    double most = 0;
    for (std::int32_t i = part.second; i != part.end; i = next_[i]) {
      const double left = cross(along, boundary_.nodes[i].uv - from);
      if (left > most) most = left, innermost = i;
    }
    if (innermost == kNone) continue;
    is_node[innermost] = 1;
    open.push_back({part.begin, part.second, innermost, kNone, kNone});
    open.push_back({innermost, next_[innermost], part.end, kNone, kNone});
  }
  return is_node;
}

bool CoarseFace::make(std::int32_t step) {
  if (!is_closed_) return false;
  FaceBoundary loops;
  boundary_nodes_.clear();
  std::vector<std::int32_t> corner_at(boundary_.nodes.size(), kNone);
  const std::vector<char> is_node = coarse_nodes(step);
  for (std::size_t i = 0; i < is_node.size(); ++i) {
    if (!is_node[i]) continue;
    corner_at[i] = n_on_boundary();
    boundary_nodes_.push_back(static_cast<std::int32_t>(i));
    loops.nodes.push_back(boundary_.nodes[i]);
  }
  parts_ = parts_between(is_node);
  for (Part& part : parts_) {
    part.from = corner_at[part.begin];
    part.to = corner_at[part.end];
    double length = 0;
    for_each_segment(
        part, [&](std::int32_t i, std::int32_t j) { length += distance(boundary_.nodes[i].x, boundary_.nodes[j].x); });
    loops.segments.push_back({part.from, part.to});
    if (length > 0) loops.nodes[part.from].h = std::max(loops.nodes[part.from].h, length);
  }
  FaceMeshOptions options;
  options.enhance_rounds = kCoarseRounds;
  mesh_ = mesh_face(surface_, loops, ScaledField(field_, step), options);
  return mesh_.cause == FailureCause::kNone && mesh_.n_folds == 0 && !mesh_.corners.empty();
}

}  // namespace st
