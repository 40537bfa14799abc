#include "geometry/facet/short_sides.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/lists_by_key.h"
#include "base/sort_once.h"

namespace st {
namespace {

using NodePair = std::pair<std::int32_t, std::int32_t>;

constexpr int kMostPasses = 50;     // a side goes only where none beside it went in the same pass
constexpr double kOfHeight = 1e-3;  // over the longest side: below, the normal of a facet is rounding

/// One pass over all short sides: those that are not beside one another.
class ShortSides {
 public:
  ShortSides(FacetInput& input, double gap) : in_(input), gap_(gap) {}

  std::size_t join() {
    std::vector<NodePair> sides;
    for (const Corners& c : in_.corners)
      for (int k = 0; k < 3; ++k)
        if (is_short(c[k], c[(k + 1) % 3])) sides.push_back(std::minmax(c[k], c[(k + 1) % 3]));
    if (sides.empty()) return 0;
    sort_once(sides);
    facets_ = cells_of_nodes(in_.corners, in_.x.size());
    is_touched_.assign(in_.x.size(), 0);
    std::size_t n = 0;
    for (const auto& [a, b] : sides) {
      if (is_touched_[a] || is_touched_[b] || !stays_a_surface(a, b)) continue;
      for (const std::int32_t node : {a, b})
        for (const std::int32_t beside : neighbours_of(node)) is_touched_[beside] = 1;
      for (const std::int32_t t : facets_[b]) std::ranges::replace(in_.corners[t], b, a);
      ++n;
    }
    drop_facets_without_three_nodes();
    return n;
  }

 private:
  bool is_short(std::int32_t a, std::int32_t b) const {
    double largest = 0;
    for (const Vec3 x : {in_.x[a], in_.x[b]})
      largest = std::max({largest, std::abs(x.x), std::abs(x.y), std::abs(x.z)});
    return distance(in_.x[a], in_.x[b]) <= std::min(gap_, kSinglePrecision * largest);
  }

  /// And itself, ascending.
  std::vector<std::int32_t> neighbours_of(std::int32_t node) const {
    std::vector<std::int32_t> nodes;
    for (const std::int32_t t : facets_[node]) nodes.insert(nodes.end(), in_.corners[t].begin(), in_.corners[t].end());
    sort_once(nodes);
    return nodes;
  }

  bool stays_a_surface(std::int32_t a, std::int32_t b) const {
    std::vector<std::int32_t> opposite{a, b}, common;
    for (const std::int32_t t : facets_[a]) {
      const Corners& c = in_.corners[t];
      if (std::ranges::count(c, b) > 0) opposite.insert(opposite.end(), c.begin(), c.end());
    }
    sort_once(opposite);
    std::ranges::set_intersection(neighbours_of(a), neighbours_of(b), std::back_inserter(common));
    return common == opposite && !lie_on_each_other(a, b) && !cuts_an_end_open(a, b);
  }

  /// Whether a facet across the end of a body would go, as at the point of a wing's tip behind which both skins meet:
  /// these would have a side in common that begins inside of the body. A base between both goes, however narrow.
  bool cuts_an_end_open(std::int32_t a, std::int32_t b) const {
    return std::ranges::any_of(facets_[a], [&](std::int32_t t) {
      const Corners& c = in_.corners[t];
      if (std::ranges::count(c, b) == 0) return false;
      const Vec3 normal = area_normal(in_.x, c);
      double longest = 0;
      for (int k = 0; k < 3; ++k) longest = std::max(longest, distance(in_.x[c[k]], in_.x[c[(k + 1) % 3]]));
      if (norm(normal) < kOfHeight * longest * longest) return false;
      const std::int32_t end = c[0] + c[1] + c[2] - a - b;
      const Vec3 first = normal_beside(a, end, t), second = normal_beside(b, end, t);
      return dot(first, second) < kKnife && dot(normalized(normal), normalized(first + second)) < -kKnife;
    });
  }

  /// Of the other facet at a side of facet t.
  Vec3 normal_beside(std::int32_t a, std::int32_t b, std::int32_t t) const {
    for (const std::int32_t other : facets_[a])
      if (other != t && std::ranges::count(in_.corners[other], b) > 0)
        return normalized(area_normal(in_.x, in_.corners[other]));
    return {};
  }

  /// Whether two facets would, as the last two of a tetrahedron.
  bool lie_on_each_other(std::int32_t a, std::int32_t b) const {
    const auto others = [&](std::int32_t node) {
      std::vector<NodePair> sides;
      for (const std::int32_t t : facets_[node]) {
        const Corners& c = in_.corners[t];
        const auto k = std::ranges::find(c, node) - c.begin();
        sides.push_back(std::minmax(c[(k + 1) % 3], c[(k + 2) % 3]));
      }
      sort_once(sides);
      return sides;
    };
    std::vector<NodePair> common;
    std::ranges::set_intersection(others(a), others(b), std::back_inserter(common));
    return !common.empty();
  }

  void drop_facets_without_three_nodes() {
    in_.keep([&](std::size_t t) {
      const Corners& c = in_.corners[t];
      return c[0] != c[1] && c[1] != c[2] && c[2] != c[0];
    });
  }

  FacetInput& in_;
  double gap_;
  ListsByKey<> facets_;                   // of nodes, when the pass began
  std::vector<std::uint8_t> is_touched_;  // nodes beside a side that went
};

}  // namespace

std::size_t join_ends_of_short_sides(FacetInput& input, double gap) {
  return sum_of_passes(kMostPasses, [&] { return ShortSides(input, gap).join(); });
}

}  // namespace st
