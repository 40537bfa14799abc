#include "geometry/shape/coarse_patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/lists_by_key.h"

namespace st {
namespace {

constexpr std::size_t kMostRing = 12;    // nodes: larger stars wait until their neighbours are gone
constexpr double kLeastCosine = 0.7;     // between a new triangle and the star in place of which it comes
constexpr double kLeastShape = 0.1;      // 1 for an equilateral triangle, 0 for a needle
constexpr double kLeastRimCosine = 0.8;  // between the two rim sides at a node that goes
constexpr std::int64_t kLeastLoop = 4;   // nodes that a loop keeps
constexpr std::size_t kFewGo = 50;       // a round in which fewer than one of so many triangles go is the last one

/// 4 sqrt(3) area / sum of squared sides.
double shape_of(Vec3 a, Vec3 b, Vec3 c, Vec3 area_normal) {
  const double sides = norm2(b - a) + norm2(c - b) + norm2(a - c);
  return sides > 0 ? 2 * std::sqrt(3.0) * norm(area_normal) / sides : 0;
}

/// The nodes around one, from any one where the ring is closed.
struct Ring {
  std::array<std::int32_t, kMostRing> node;
  std::size_t n = 0;
  bool is_closed = true;

  std::int32_t at(std::size_t i) const { return node[i % n]; }
  std::size_t n_sides() const { return is_closed ? n : n - 1; }
};

class Coarsening {
 public:
  Coarsening(std::span<const Vec3> x, std::span<const Corners> corners, const PatchTopology& topology)
      : x_(x), corners_(corners.begin(), corners.end()), loop_(x.size(), kNone), is_touched_(x.size(), 0) {
    active_.resize(x.size());
    std::iota(active_.begin(), active_.end(), 0);
    for (const auto& loop : topology.loops) {
      for (const std::int32_t n : loop) loop_[n] = static_cast<std::int32_t>(loop_size_.size());
      loop_size_.push_back(static_cast<std::int64_t>(loop.size()));
    }
  }

  CoarsePatch run(std::size_t most_triangles) {
    while (corners_.size() > most_triangles) {
      const std::size_t n_before = corners_.size();
      star_ = cells_of_nodes(corners_, x_.size());
      std::size_t n_left = n_before;
      for (const std::int32_t node : active_) {
        if (n_left <= most_triangles) break;
        if (!is_touched_[node]) n_left -= try_to_remove(node);
      }
      std::erase_if(corners_, [](const Corners& c) { return c[0] == kNone; });
      std::erase_if(active_, [&](std::int32_t node) { return std::exchange(is_touched_[node], 0) == kGone; });
      if (kFewGo * (n_before - corners_.size()) < n_before) break;
    }
    return finish();
  }

 private:
  static constexpr std::uint8_t kBeside = 1, kGone = 2;

  /// False where it is too large, or no fan.
  bool find_ring(std::int32_t node, Ring& ring) const {
    const auto triangles = star_[node];
    ring.n = 0;
    ring.is_closed = loop_[node] == kNone;
    if (triangles.size() + 1 > kMostRing || triangles.size() < 2) return false;
    std::array<std::pair<std::int32_t, std::int32_t>, kMostRing> side;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const Corners& c = corners_[triangles[i]];
      const int k = c[0] == node ? 0 : c[1] == node ? 1 : 2;
      side[i] = {c[(k + 1) % 3], c[(k + 2) % 3]};
    }
    std::size_t first = 0;
    const auto ends_at = [&](std::int32_t at) {
      return std::any_of(side.begin(), side.begin() + triangles.size(), [&](const auto& s) { return s.second == at; });
    };
    if (!ring.is_closed)
      while (first < triangles.size() && ends_at(side[first].first)) ++first;
    if (first == triangles.size()) return false;
    std::int32_t at = side[first].first;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      ring.node[ring.n++] = at;
      const auto next =
          std::find_if(side.begin(), side.begin() + triangles.size(), [&](const auto& s) { return s.first == at; });
      if (next == side.begin() + triangles.size()) return false;
      at = next->second;
    }
    if (!ring.is_closed) ring.node[ring.n++] = at;
    return true;
  }

  /// The number of triangles that went.
  std::size_t try_to_remove(std::int32_t node) {
    Ring ring;
    if (!find_ring(node, ring)) return 0;
    if (!ring.is_closed && !may_leave_rim(node, ring)) return 0;
    Vec3 mean{};
    for (std::size_t i = 0; i < ring.n_sides(); ++i)
      mean += cross(x_[ring.at(i)] - x_[node], x_[ring.at(i + 1)] - x_[node]);
    mean = normalized(mean);
    double best = kLeastShape;
    std::size_t into = ring.n;
    for (std::size_t i = 0; i < ring.n; i += ring.is_closed ? 1 : ring.n - 1) {
      if (is_touched_[ring.at(i)]) continue;
      const double worst = worst_of_fan(ring, i, mean);
      if (worst > best && has_only_these(node, ring, i)) best = worst, into = i;
    }
    if (into == ring.n) return 0;
    remove(node, ring, into);
    return ring.is_closed ? 2 : 1;
  }

  bool may_leave_rim(std::int32_t node, const Ring& ring) const {
    const Vec3 to = x_[node] - x_[ring.node[0]], on = x_[ring.node[ring.n - 1]] - x_[node];
    return ring.n > 2 && loop_size_[loop_[node]] > kLeastLoop && dot(to, on) > kLeastRimCosine * norm(to) * norm(on);
  }

  /// The lowest shape in the fan from ring node i; 0 where a triangle of it turns too far.
  double worst_of_fan(const Ring& ring, std::size_t i, Vec3 mean) const {
    double worst = 1;
    const Vec3 a = x_[ring.at(i)];
    for (std::size_t k = 0; k < ring.n_sides(); ++k) {
      if (ring.at(k) == ring.at(i) || ring.at(k + 1) == ring.at(i)) continue;
      const Vec3 b = x_[ring.at(k)], c = x_[ring.at(k + 1)], normal = cross(b - a, c - a);
      if (!(dot(normal, mean) > kLeastCosine * norm(normal))) return 0;
      worst = std::min(worst, shape_of(a, b, c, normal));
    }
    return worst;
  }

  /// The link condition: ring node i has sides to none of the ring but its two neighbours there.
  bool has_only_these(std::int32_t node, const Ring& ring, std::size_t i) const {
    const std::int32_t into = ring.at(i);
    for (const std::int32_t t : star_[into])
      for (const std::int32_t other : corners_[t]) {
        if (other == into || other == node) continue;
        for (std::size_t k = 0; k < ring.n; ++k) {
          const bool is_next = k == (i + 1) % ring.n || i == (k + 1) % ring.n;
          const bool is_end = !ring.is_closed && (k == 0 || k + 1 == ring.n);
          if (ring.at(k) == other && (!is_next || (is_end && ring.n > 2))) return false;
        }
      }
    return true;
  }

  void remove(std::int32_t node, const Ring& ring, std::size_t into) {
    for (const std::int32_t t : star_[node]) {
      Corners& c = corners_[t];
      if (std::find(c.begin(), c.end(), ring.at(into)) != c.end())
        c.fill(kNone);
      else
        std::replace(c.begin(), c.end(), node, ring.at(into));
    }
    result_.removed.push_back({node, static_cast<std::int32_t>(result_.ring.size()), static_cast<std::int32_t>(ring.n),
                               !ring.is_closed, !ring.is_closed && into != 0});
    for (std::size_t k = 0; k < ring.n; ++k) {
      result_.ring.push_back(ring.is_closed ? ring.at(into + k) : ring.node[k]);
      is_touched_[ring.at(k)] = kBeside;
    }
    is_touched_[node] = kGone;
    if (!ring.is_closed) --loop_size_[loop_[node]];
  }

  CoarsePatch finish() {
    std::vector<std::int32_t> number(x_.size(), kNone);
    for (const std::int32_t node : active_) {
      number[node] = static_cast<std::int32_t>(result_.node.size());
      result_.node.push_back(node);
      result_.x.push_back(x_[node]);
    }
    for (const Corners& c : corners_) result_.corners.push_back({number[c[0]], number[c[1]], number[c[2]]});
    return std::move(result_);
  }

  std::span<const Vec3> x_;
  std::vector<Corners> corners_;          // what is left, nodes of the fine patch
  std::vector<std::int32_t> loop_;        // of each node; kNone inside
  std::vector<std::int64_t> loop_size_;   // nodes that are left
  std::vector<std::uint8_t> is_touched_;  // in this round
  std::vector<std::int32_t> active_;      // nodes that are left, ascending
  ListsByKey<> star_;                     // triangles at each node when the round began
  CoarsePatch result_;
};

}  // namespace

CoarsePatch coarsen(std::span<const Vec3> x, std::span<const Corners> corners, const PatchTopology& topology,
                    std::size_t most_triangles) {
  return Coarsening(x, corners, topology).run(most_triangles);
}

}  // namespace st
