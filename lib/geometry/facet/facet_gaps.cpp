#include "geometry/facet/facet_gaps.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "geometry/facet/facet_sides.h"

namespace st {
namespace {

constexpr double kWiderGaps[] = {1e-5, 1e-4};  // of the diagonal, as CAD is sewn
constexpr double kShareOfSide = 0.25;          // of the shortest side at a node, that it may move by at a wider gap

/// Of each node at a free side how far it may move; negative of all others.
struct FreeNodes {
  std::vector<double> reach;
  std::size_t n_sides = 0;
};

FreeNodes find_free(const FacetInput& in) {
  FreeNodes free{std::vector<double>(in.x.size(), -1), 0};
  std::vector<Corners> whole = in.corners;
  std::erase_if(whole, [](const Corners& c) { return c[0] == c[1] || c[1] == c[2] || c[2] == c[0]; });
  for_each_pair(sorted_sides(whole, in.x.size()), [&](std::span<const FacetSide> s) {
    if (s.size() != 1) return;
    free.reach[s[0].low] = free.reach[s[0].high] = std::numeric_limits<double>::max();
    ++free.n_sides;
  });
  for (const Corners& c : whole)
    for (int k = 0; k < 3; ++k)
      for (const std::int32_t n : {c[k], c[(k + 1) % 3]})
        if (free.reach[n] >= 0)
          free.reach[n] = std::min(free.reach[n], kShareOfSide * distance(in.x[c[k]], in.x[c[(k + 1) % 3]]));
  return free;
}

/// The node that each one becomes. `may_join`(first, second, distance).
template <class MayJoin>
std::vector<std::int32_t> join_within(const std::vector<Vec3>& x, const FreeNodes& free, double gap,
                                      const MayJoin& may_join) {
  std::vector<std::int32_t> order, one(x.size());
  std::iota(one.begin(), one.end(), 0);
  for (const std::int32_t n : one)
    if (free.reach[n] >= 0) order.push_back(n);
  std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) { return x[a].x < x[b].x; });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::int32_t a = order[i];
    if (one[a] != a) continue;
    for (std::size_t j = i + 1; j < order.size() && x[order[j]].x - x[a].x <= gap; ++j) {
      const std::int32_t b = order[j];
      if (one[b] == b && distance(x[b], x[a]) <= gap && may_join(a, b, distance(x[b], x[a]))) one[b] = a;
    }
  }
  return one;
}

std::vector<Corners> renamed(std::vector<Corners> corners, const std::vector<std::int32_t>& one) {
  for (Corners& c : corners)
    for (std::int32_t& n : c) n = one[n];
  return corners;
}

void count(const FacetInput& in, const std::vector<std::int32_t>& one, JoinedGaps& joined) {
  for (std::size_t n = 0; n < one.size(); ++n)
    if (one[n] != static_cast<std::int32_t>(n) && joined.n_nodes++ == 0) joined.place = in.x[one[n]];
}

}  // namespace

JoinedGaps join_gaps(FacetInput& input, double diagonal) {
  FreeNodes free = find_free(input);
  JoinedGaps joined{0, kFacetGap * diagonal, {}, free.n_sides > 0};
  if (free.n_sides == 0) return joined;
  const auto one = join_within(input.x, free, joined.gap, [](std::int32_t, std::int32_t, double) { return true; });
  input.corners = renamed(std::move(input.corners), one);
  count(input, one, joined);
  free = find_free(input);
  for (const double share : kWiderGaps) {
    if (free.n_sides == 0) break;
    const auto wider = join_within(input.x, free, share * diagonal, [&](std::int32_t a, std::int32_t b, double d) {
      return d <= std::min(free.reach[a], free.reach[b]);
    });
    std::vector<Corners> was = std::exchange(input.corners, renamed(input.corners, wider));
    FreeNodes left = find_free(input);
    if (left.n_sides >= free.n_sides) {
      input.corners = std::move(was);
      continue;
    }
    count(input, wider, joined);
    joined.gap = share * diagonal;
    free = std::move(left);
  }
  return joined;
}

}  // namespace st
