#include "geometry/facet/split_sides.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/box_tree.h"
#include "base/ids.h"

namespace st {
namespace {

/// A node on a side, by its share of the way along it.
using NodeOnSide = std::pair<double, std::int32_t>;

/// Where node n lies on the line from a to b; negative: not there.
double share_on_line(std::span<const Vec3> x, std::int32_t n, std::int32_t a, std::int32_t b, double gap) {
  const Vec3 along = x[b] - x[a], to = x[n] - x[a];
  const double length = norm(along), share = dot(to, along) / (length * length);
  const bool is_inside = share * length > 2 * gap && (1 - share) * length > 2 * gap;
  return is_inside && norm(to - share * along) <= gap ? share : -1;
}

class SideSplitter {
 public:
  SideSplitter(FacetInput& input, double gap) : in_(input), gap_(gap) {}

  /// Each facet once, at one side.
  std::size_t run() {
    find_free_sides();
    std::size_t n_split = 0;
    const auto n_facets = static_cast<std::int32_t>(in_.corners.size());
    for (std::int32_t t = 0; t < n_facets; ++t)
      for (int k = 0; k < 3; ++k)
        if (is_free_[t][k] && split(t, k)) {
          ++n_split;
          break;
        }
    return n_split;
  }

 private:
  void find_free_sides() {
    std::vector<std::array<std::int32_t, 3>> sides;  // lower node, higher node, 3 * facet + side
    for (std::size_t t = 0; t < in_.corners.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(in_.corners[t][k], in_.corners[t][(k + 1) % 3]);
        sides.push_back({low, high, static_cast<std::int32_t>(3 * t + k)});
      }
    std::ranges::sort(sides);
    is_free_.assign(in_.corners.size(), {});
    partners_.assign(in_.x.size(), {});
    for (std::size_t i = 0, j; i < sides.size(); i = j) {
      const auto [low, high, side] = sides[i];
      for (j = i + 1; j < sides.size() && sides[j][0] == low && sides[j][1] == high;) ++j;
      if (j - i > 1) continue;
      is_free_[side / 3][side % 3] = true;
      partners_[low].push_back(high);
      partners_[high].push_back(low);
    }
    std::vector<Box3> boxes;
    for (std::size_t n = 0; n < partners_.size(); ++n) {
      if (partners_[n].empty()) continue;
      nodes_.push_back(static_cast<std::int32_t>(n));
      boxes.emplace_back().add(in_.x[n]);
    }
    tree_ = BoxTree(boxes);
  }

  double share_of(std::int32_t n, std::int32_t a, std::int32_t b) const { return share_on_line(in_.x, n, a, b, gap_); }

  /// Whether a free side leads from a node on the line from a to b along that line.
  bool runs_along(std::int32_t n, std::int32_t a, std::int32_t b) const {
    return std::ranges::any_of(partners_[n], [&](std::int32_t o) { return o == a || o == b || share_of(o, a, b) > 0; });
  }

  std::vector<NodeOnSide> nodes_on(std::int32_t a, std::int32_t b) const {
    Box3 box;
    box.add(in_.x[a]);
    box.add(in_.x[b]);
    std::vector<NodeOnSide> found;
    const auto matters = [&](std::int32_t at, double) { return meet(tree_.nodes()[at].box, box, gap_); };
    tree_.visit_near(0.5 * (in_.x[a] + in_.x[b]), matters, [&](std::int32_t item) {
      const std::int32_t n = nodes_[item];
      if (const double share = share_of(n, a, b); share > 0 && runs_along(n, a, b)) found.emplace_back(share, n);
    });
    std::ranges::sort(found);
    return found;
  }

  bool split(std::int32_t t, int k) {
    const std::int32_t a = in_.corners[t][k], b = in_.corners[t][(k + 1) % 3], apex = in_.corners[t][(k + 2) % 3];
    const std::vector<NodeOnSide> on_side = nodes_on(a, b);
    if (on_side.empty() || share_of(apex, a, b) > 0) return false;  // not a facet without area
    std::int32_t from = a;
    for (const auto& [share, n] : on_side) {
      in_.corners.push_back({from, n, apex});
      in_.part.push_back(in_.part[t]);
      from = n;
    }
    in_.corners[t] = {from, b, apex};
    return true;
  }

  FacetInput& in_;
  double gap_;
  std::vector<std::array<bool, 3>> is_free_;         // [n_triangles] before any was divided
  std::vector<std::vector<std::int32_t>> partners_;  // [n_nodes] other ends of their free sides
  std::vector<std::int32_t> nodes_;                  // of free sides
  BoxTree tree_;                                     // of these
};

}  // namespace

std::size_t split_sides_at_nodes(FacetInput& input, double gap) {
  constexpr int kSides = 3;  // of a facet, one at a time
  return sum_of_passes(kSides, [&] { return SideSplitter(input, gap).run(); });
}

bool ends_on_side(std::span<const Vec3> x, const Corners& a, const Corners& b, double gap) {
  const auto is_on = [&](std::int32_t n, const Corners& c) {
    for (int k = 0; k < 3; ++k)
      if (share_on_line(x, n, c[k], c[(k + 1) % 3], gap) > 0) return true;
    return false;
  };
  return std::ranges::any_of(a, [&](std::int32_t n) { return is_on(n, b); }) ||
         std::ranges::any_of(b, [&](std::int32_t n) { return is_on(n, a); });
}

}  // namespace st
