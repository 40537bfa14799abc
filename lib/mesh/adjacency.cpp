#include "mesh/adjacency.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/assert.h"
#include "base/limits.h"
#include "base/threads.h"

namespace st {

namespace {

constexpr std::size_t kNodesPerPiece = 16'384;

[[maybe_unused]] bool are_nodes_below(std::span<const Triangle> triangles, std::int64_t n_nodes) {
  return std::all_of(triangles.begin(), triangles.end(), [n_nodes](const Triangle& t) {
    return std::all_of(std::begin(t.n), std::end(t.n), [n_nodes](NodeId n) { return n >= 0 && n < n_nodes; });
  });
}

template <class Visit>
void for_each_side(std::span<const Triangle> triangles, const Visit& visit) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (has_repeated_node(triangles[t])) continue;
    for (int k = 0; k < 3; ++k) {
      const NodeId a = triangles[t].n[k], b = triangles[t].n[(k + 1) % 3];
      visit(std::min(a, b), std::max(a, b), static_cast<SideId>(3 * t + k));
    }
  }
}

}  // namespace

EdgeTable::EdgeTable(std::span<const Triangle> triangles, std::int64_t n_nodes) : offsets_(n_nodes + 1, 0) {
  ST_ASSERT(triangles.size() <= std::numeric_limits<SideId>::max() / 3);
  ST_ASSERT(are_nodes_below(triangles, n_nodes));
  require_countable(triangles.size(), "triangles of one mesh, with their sides,", kMaxTriangles);
  for_each_side(triangles, [&](NodeId low, NodeId, SideId) { ++offsets_[low + 1]; });
  std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
  high_.resize(offsets_.back());
  side_.resize(offsets_.back());
  // Fill behind a moving end, then shift the ends back to starts: no second array of offsets.
  for_each_side(triangles, [&](NodeId low, NodeId high, SideId side) {
    const std::int32_t i = offsets_[low]++;
    high_[i] = high;
    side_[i] = side;
  });
  std::move_backward(offsets_.begin(), offsets_.end() - 1, offsets_.end());
  offsets_[0] = 0;
  parallel_for(static_cast<std::size_t>(n_nodes), kNodesPerPiece,
               [&](std::size_t begin, std::size_t end) { sort_buckets(begin, end); });
}

/// Sorts the sides of the lower nodes in [first, last).
void EdgeTable::sort_buckets(std::size_t first, std::size_t last) {
  std::vector<std::pair<NodeId, SideId>> bucket;
  for (std::size_t low = first; low < last; ++low) {
    const std::int32_t begin = offsets_[low], end = offsets_[low + 1];
    bucket.clear();
    for (std::int32_t i = begin; i < end; ++i) bucket.emplace_back(high_[i], side_[i]);
    std::sort(bucket.begin(), bucket.end());
    for (std::int32_t i = begin; i < end; ++i) std::tie(high_[i], side_[i]) = bucket[i - begin];
  }
}

std::vector<SideId> find_fans(std::span<const Triangle> triangles, const EdgeTable& edges) {
  const auto end_of = [](SideId s) { return s % 3 == 2 ? s - 2 : s + 1; };
  std::vector<SideId> beyond(3 * triangles.size(), kNone);  // the next corner about the node, beyond the side from it
  std::vector<std::span<const SideId>> irregular;
  edges.for_each_edge([&](NodeId, NodeId, std::span<const SideId> sides) {
    if (sides.size() == 2 && !run_alike(triangles, sides[0], sides[1]))
      beyond[sides[0]] = end_of(sides[1]), beyond[sides[1]] = end_of(sides[0]);
    else if (sides.size() > 1)
      irregular.push_back(sides);
  });
  std::vector<SideId> fan(beyond.size(), kNone);
  for (SideId c = 0; c < static_cast<SideId>(fan.size()); ++c) {
    if (fan[c] != kNone) continue;
    SideId s = c;
    for (; s != kNone && fan[s] == kNone; s = beyond[s]) fan[s] = c;
    if (s == kNone || fan[s] == c) continue;
    const SideId lowest = fan[s];  // c is before it in an open fan
    for (s = c; fan[s] == c; s = beyond[s]) fan[s] = lowest;
  }
  if (irregular.empty()) return fan;
  DisjointSets fans(static_cast<std::int64_t>(fan.size()));
  for (SideId c = 0; c < static_cast<SideId>(fan.size()); ++c) fans.join(c, fan[c]);
  for (const std::span<const SideId> sides : irregular)
    for (std::size_t i = 1; i < sides.size(); ++i) {
      SideId from = sides[i], to = end_of(from);
      if (!run_alike(triangles, sides[0], sides[i])) std::swap(from, to);
      fans.join(sides[0], from);
      fans.join(end_of(sides[0]), to);
    }
  for (SideId c = 0; c < static_cast<SideId>(fan.size()); ++c) fan[c] = fans.find(c);
  return fan;
}

void ComponentFinder::add(std::span<const Triangle> triangles) {
  ST_ASSERT(are_nodes_below(triangles, static_cast<std::int64_t>(component_.size())));
  for (const Triangle& t : triangles) {
    sets_.join(t.n[0], t.n[1]);
    sets_.join(t.n[1], t.n[2]);
    for (const NodeId n : t.n) component_[n] = 0;
  }
}

std::vector<std::int32_t> ComponentFinder::components(std::int32_t& n_components) {
  n_components = 0;
  for (std::size_t n = 0; n < component_.size(); ++n) {
    if (component_[n] == kNone) continue;
    const std::int32_t root = sets_.find(static_cast<std::int32_t>(n));
    component_[n] = root == static_cast<std::int32_t>(n) ? n_components++ : component_[root];
  }
  return std::move(component_);
}

std::vector<std::int32_t> node_components(std::span<const Triangle> triangles, std::int64_t n_nodes,
                                          std::int32_t& n_components) {
  ComponentFinder finder(n_nodes);
  finder.add(triangles);
  return finder.components(n_components);
}

}  // namespace st
