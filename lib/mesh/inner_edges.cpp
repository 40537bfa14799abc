#include "mesh/inner_edges.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "base/threads.h"
#include "mesh/adjacency.h"

namespace st {
namespace {

constexpr std::size_t kNodesPerWindow = 262'144;  // of a patch, whose sides are sorted together; at least
constexpr std::size_t kMostWindows = 16;          // each looks at all triangles of the patch

/// Counts the edges whose lower node is in [begin, end).
InnerEdges count_window(const FacePatch& p, NodeId begin, NodeId end) {
  const auto for_each_side = [&](const auto& visit) {
    for (const Triangle& t : p.triangles)
      for (int k = 0; k < 3; ++k) {
        const NodeId a = t.n[k], b = t.n[(k + 1) % 3], low = std::min(a, b), high = std::max(a, b);
        if (low >= begin && low < end && high >= p.n_boundary && !has_repeated_node(t)) visit(low, high, a == low);
      }
  };
  std::vector<std::size_t> offsets(static_cast<std::size_t>(end - begin) + 2, 0);
  for_each_side([&](NodeId low, NodeId, bool) { ++offsets[low - begin + 2]; });
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  std::vector<std::int64_t> sides(offsets.back());  // higher node, and which way
  for_each_side([&](NodeId low, NodeId high, bool runs_up) {
    sides[offsets[low - begin + 1]++] = 2 * static_cast<std::int64_t>(high) + runs_up;
  });
  InnerEdges found;
  for (NodeId low = 0; low < end - begin; ++low) {
    const auto last = sides.begin() + static_cast<std::ptrdiff_t>(offsets[low + 1]);
    auto side = sides.begin() + static_cast<std::ptrdiff_t>(offsets[low]);
    std::sort(side, last);
    while (side != last) {
      const std::int64_t high = *side / 2;
      std::int64_t n = 0, n_up = 0;
      for (; side != last && *side / 2 == high; ++side) ++n, n_up += *side % 2;
      found.n_open += n == 1;
      found.n_nonmanifold += n > 2;
      found.n_misoriented += n == 2 && n_up != 1;
      found.is_balanced = found.is_balanced && 2 * n_up == n;
    }
  }
  return found;
}

}  // namespace

InnerEdges count_inner_edges(const FacePatch& p) {
  const std::size_t n_nodes = p.n_boundary + p.inner_xyz.size();
  const std::size_t n_per_window = std::max(kNodesPerWindow, n_nodes / kMostWindows + 1);
  std::vector<InnerEdges> windows(n_nodes / n_per_window + 1);
  parallel_for(n_nodes, n_per_window, [&](std::size_t begin, std::size_t end) {
    windows[begin / n_per_window] = count_window(p, static_cast<NodeId>(begin), static_cast<NodeId>(end));
  });
  InnerEdges all;
  for (const InnerEdges& w : windows) {
    all.n_open += w.n_open;
    all.n_nonmanifold += w.n_nonmanifold;
    all.n_misoriented += w.n_misoriented;
    all.is_balanced = all.is_balanced && w.is_balanced;
  }
  return all;
}

}  // namespace st
