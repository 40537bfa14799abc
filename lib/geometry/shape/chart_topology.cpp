#include "geometry/shape/chart_topology.h"

#include <algorithm>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/lists_by_key.h"
#include "geometry/shape/known_neighbours.h"

namespace st {
namespace {

/// A side by its lower node: side k of triangle t is 3 t + k.
struct UpperSide {
  std::int32_t high, side;
};

/// Those of each node ascend.
ListsByKey<UpperSide> sides_by_node(std::span<const Corners> corners) {
  std::int32_t n_nodes = 0;
  for (const Corners& c : corners) n_nodes = std::max({n_nodes, c[0] + 1, c[1] + 1, c[2] + 1});
  return {static_cast<std::size_t>(n_nodes), [&](const auto& visit) {
            for (std::size_t i = 0; i < 3 * corners.size(); ++i) {
              const Corners& c = corners[i / 3];
              const auto [low, high] = std::minmax(c[i % 3], c[(i + 1) % 3]);
              visit(low, UpperSide{high, static_cast<std::int32_t>(i)});
            }
          }};
}

/// Rim sides as a map from each node to the next one; false where a node has two.
bool follow_rim(std::span<const Corners> corners, std::span<const Corners> neighbours,
                std::vector<std::int32_t>& next) {
  bool is_unique = true;
  for (std::size_t t = 0; t < corners.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      if (neighbours[t][k] != kNone) continue;
      std::int32_t& after = next[corners[t][k]];
      is_unique = is_unique && after == kNone;
      after = corners[t][(k + 1) % 3];
    }
  return is_unique;
}

void add_loops(std::span<const Vec3> x, std::vector<std::int32_t> next, PatchTopology& result) {
  for (std::int32_t first = 0; first < static_cast<std::int32_t>(next.size()); ++first) {
    if (next[first] == kNone) continue;
    std::vector<std::int32_t> loop;
    double length = 0;
    std::int32_t at = first;
    while (next[at] != kNone) {
      loop.push_back(at);
      length += distance(x[at], x[next[at]]);
      at = std::exchange(next[at], kNone);
    }
    result.is_manifold = result.is_manifold && at == first;
    result.loops.push_back(std::move(loop));
    result.loop_length.push_back(length);
  }
}

/// The corner at the same node in the triangle across a side of corner i's triangle that begins or ends there; kNone
/// where there is none.
std::int32_t corner_across(std::span<const Corners> corners, std::span<const Corners> neighbours, std::int32_t i,
                           bool ends_there) {
  const std::int32_t t = i / 3, k = i % 3, other = neighbours[t][ends_there ? (k + 2) % 3 : k];
  if (other == kNone) return kNone;
  const Corners& c = corners[other];
  const std::int32_t next = corners[t][(k + (ends_there ? 2 : 1)) % 3];  // the side's other end
  for (int m = 0; m < 3; ++m)
    if (c[m] == next) return 3 * other + (ends_there ? m + 2 : m + 1) % 3;
  return kNone;
}

}  // namespace

std::vector<Corners> find_neighbours(std::span<const Corners> corners) {
  std::vector<Corners> result(corners.size(), {kNone, kNone, kNone});
  ListsByKey<UpperSide> sides = sides_by_node(corners);
  for (std::size_t node = 0; node < sides.n_keys(); ++node)
    for (std::span<UpperSide> rest = sides[node]; !rest.empty(); rest = rest.subspan(1)) {
      const auto [high, own] = rest[0];
      if (high == kNone) continue;  // met before
      std::int32_t n_uses = 1, other = kNone;
      for (UpperSide& side : rest.subspan(1))
        if (side.high == high) {
          ++n_uses;
          other = side.side;
          side.high = kNone;
        }
      if (n_uses != 2 || corners[own / 3][own % 3] == corners[other / 3][other % 3]) continue;
      result[own / 3][own % 3] = other / 3;
      result[other / 3][other % 3] = own / 3;
    }
  return result;
}

std::vector<std::int32_t> find_fans(std::span<const Corners> corners, std::span<const Corners> neighbours) {
  const auto n = static_cast<std::int32_t>(3 * corners.size());
  std::vector<std::int32_t> fan(3 * corners.size(), kNone);
  std::int32_t n_fans = 0;
  for (std::int32_t first = 0; first < n; ++first) {
    if (fan[first] != kNone) continue;
    std::int32_t i = first;
    do fan[i] = n_fans, i = corner_across(corners, neighbours, i, true);
    while (i != kNone && fan[i] == kNone);
    if (i == kNone)  // not all around
      for (i = corner_across(corners, neighbours, first, false); i != kNone && fan[i] == kNone;
           i = corner_across(corners, neighbours, i, false))
        fan[i] = n_fans;
    ++n_fans;
  }
  return fan;
}

std::size_t PatchTopology::outer_loop() const {
  return static_cast<std::size_t>(std::max_element(loop_length.begin(), loop_length.end()) - loop_length.begin());
}

PatchTopology find_topology(std::span<const Vec3> x, std::span<const Corners> corners) {
  return find_topology(x, corners, find_neighbours(corners));
}

PatchTopology find_topology(std::span<const Vec3> x, std::span<const Corners> corners,
                            std::span<const Corners> neighbours) {
  PatchTopology result;
  const auto n = static_cast<std::int32_t>(corners.size());
  DisjointSets parts(n);
  std::int64_t n_inner_sides = 0;
  for (std::int32_t t = 0; t < n; ++t)
    for (const std::int32_t other : neighbours[t])
      if (other != kNone) {
        ++n_inner_sides;
        parts.join(t, other);
      }
  for (std::int32_t t = 0; t < n; ++t) result.n_components += parts.find(t) == t;
  const auto n_nodes = static_cast<std::int64_t>(x.size());
  std::vector<std::int32_t> next(x.size(), kNone);
  std::int32_t last_fan = kNone;
  for (const std::int32_t fan : find_fans(corners, neighbours)) last_fan = std::max(last_fan, fan);
  result.is_manifold = follow_rim(corners, neighbours, next) && last_fan + 1 == n_nodes;  // one at each node
  add_loops(x, std::move(next), result);
  const std::int64_t n_edges = 3 * std::int64_t{n} - n_inner_sides / 2, euler = n_nodes - n_edges + n;
  result.genus =
      static_cast<std::int32_t>((2 * result.n_components - euler - static_cast<std::int64_t>(result.loops.size())) / 2);
  return result;
}

}  // namespace st
