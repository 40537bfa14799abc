#include "meshing/hole/side_requests.h"

#include <algorithm>
#include <tuple>

#include "base/assert.h"
#include "base/sort_once.h"
#include "base/threads.h"

namespace st {
namespace {

std::array<NodeId, 2> ordered(NodeId a, NodeId b) { return {std::min(a, b), std::max(a, b)}; }

}  // namespace

SideRequests::SideRequests(const SurfaceMesh& mesh, TriangleId begin, TriangleId end,
                           const std::vector<std::array<NodeId, 2>>& segments, const SizeField& metrics) {
  std::vector<std::array<NodeId, 2>> nodes;
  for (const auto& [a, b] : segments) nodes.push_back(ordered(a, b));
  for (TriangleId t = begin; t < end; ++t)
    for (int k = 0; k < 3; ++k) nodes.push_back(ordered(mesh.triangles[t].n[k], mesh.triangles[t].n[(k + 1) % 3]));
  sort_once(nodes);
  for (const auto& [low, high] : nodes) sides_.push_back({low, high});
  constexpr std::size_t kPerPiece = 1024;
  parallel_for(sides_.size(), kPerPiece, [&](std::size_t first, std::size_t last) {
    int hint = 0;
    for (std::size_t i = first; i < last; ++i) {
      Side& s = sides_[i];
      const Vec3 from = mesh.node_xyz[s.low], to = mesh.node_xyz[s.high], way = to - from;
      s.length = norm(way);
      s.at_low = metrics.length_along(from, way, hint);
      s.at_high = metrics.length_along(to, way, hint);
    }
  });
}

double SideRequests::ratio(NodeId a, NodeId b, double most_at_a, double most_at_b) const {
  if (b < a) std::swap(a, b), std::swap(most_at_a, most_at_b);
  const auto before = [](const Side& s, const std::array<NodeId, 2>& key) {
    return std::tie(s.low, s.high) < std::tie(key[0], key[1]);
  };
  const auto side = std::lower_bound(sides_.begin(), sides_.end(), std::array{a, b}, before);
  ST_ASSERT(side != sides_.end() && side->low == a && side->high == b);
  return 2 * side->length / (std::min(most_at_a, side->at_low) + std::min(most_at_b, side->at_high));
}

}  // namespace st
