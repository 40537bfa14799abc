#include "geometry/shape/rim_pinches.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "geometry/shape/flatten.h"

namespace st {
namespace {

constexpr double kCompared = 2000;  // points of the whole rim
constexpr double kClear = 0.999;    // of kMostStretch: rounding never makes points of a straight side pinch below

bool is_pinched(Vec2 flat, Vec3 in_space, double most_stretch = kMostStretch) {
  return most_stretch * most_stretch * dot(flat, flat) < norm2(in_space);
}

/// Around points of the rim.
struct RimBoxes {
  Box3 flat, in_space;

  void add(const RimBoxes& other) {
    flat.add(other.flat);
    in_space.add(other.in_space);
  }
};

/// False where no two points in the boxes can pinch: they are far apart in the plane, or all is near in space. So most
/// pairs need no look at their points.
bool may_pinch(const RimBoxes& a, const RimBoxes& b) {
  const auto gap = [](double lo_a, double hi_a, double lo_b, double hi_b) {
    return std::max({0.0, lo_b - hi_a, lo_a - hi_b});
  };
  const Vec2 apart{gap(a.flat.lo.x, a.flat.hi.x, b.flat.lo.x, b.flat.hi.x),
                   gap(a.flat.lo.y, a.flat.hi.y, b.flat.lo.y, b.flat.hi.y)};
  Box3 both = a.in_space;
  both.add(b.in_space);
  return is_pinched(apart, both.hi - both.lo);
}

struct RimPoint {
  Vec2 p;
  Vec3 x;
};

/// A straight side of the rim, and the points on it.
struct RimSide {
  RimPoint ends[2];
  double length = 0;
  std::vector<double> points = {};  // from the first end, ascending

  RimPoint point(std::size_t i) const {
    const double share = points[i] / length;
    return {(1 - share) * ends[0].p + share * ends[1].p, (1 - share) * ends[0].x + share * ends[1].x};
  }
  RimBoxes boxes() const {
    RimBoxes boxes;
    for (const RimPoint& q : {point(0), point(points.size() - 1)}) {
      boxes.flat.add(Vec3{q.p.x, q.p.y, 0});
      boxes.in_space.add(q.x);
    }
    return boxes;
  }
  bool is_clear() const { return !is_pinched(ends[1].p - ends[0].p, ends[1].x - ends[0].x, kClear * kMostStretch); }

  /// Whether no place of the side pinches with q, rounded as well: the squared distance in space that the one in the
  /// plane allows exceeds what it is. The difference is a parabola along the side.
  bool is_clear_of(const RimPoint& q) const {
    constexpr double kScale = kClear * kClear * kMostStretch * kMostStretch, kRounded = 1e-12;
    const Vec2 side = ends[1].p - ends[0].p, way = q.p - ends[0].p;
    const Vec3 side_in_space = ends[1].x - ends[0].x, way_in_space = q.x - ends[0].x;
    const double at0 = kScale * dot(way, way) - norm2(way_in_space),
                 slope = kScale * dot(way, side) - dot(way_in_space, side_in_space),
                 bend = kScale * dot(side, side) - norm2(side_in_space),
                 least = kRounded * kScale * (dot(way, way) + dot(side, side));
    const auto is_clear_at = [&](double share) { return at0 + share * (share * bend - 2 * slope) > least; };
    return bend > 0 ? is_clear_at(std::clamp(slope / bend, 0.0, 1.0)) : is_clear_at(0) && is_clear_at(1);
  }
};

bool pinch(const RimSide& a, const RimSide& b) {
  if (a.points.size() > b.points.size()) return pinch(b, a);
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    const RimPoint q = a.point(i);
    if (b.is_clear_of(q)) continue;
    for (std::size_t j = 0; j < b.points.size(); ++j)
      if (const RimPoint r = b.point(j); is_pinched(q.p - r.p, q.x - r.x)) return true;
  }
  return false;
}

class Rim {
 public:
  Rim(std::span<const Vec3> x, const PatchTopology& topology, std::span<const Vec2> p) {
    double length = 0;
    for (const double l : topology.loop_length) length += l;
    const double step = length / kCompared;
    for (const auto& loop : topology.loops) {
      double left = 0;  // to the next point
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::int32_t a = loop[i], b = loop[(i + 1) % loop.size()];
        const double side = distance(x[a], x[b]);
        if (left < side) sides_.push_back({{{p[a], x[a]}, {p[b], x[b]}}, side});
        for (; left < side; left += step) sides_.back().points.push_back(left);
        left -= side;
      }
    }
    boxes_.emplace_back();
    for (const RimSide& s : sides_) boxes_[0].push_back(s.boxes());
    while (boxes_.back().size() > 1) {
      std::vector<RimBoxes> pairs;
      for (std::size_t i = 0; i < boxes_.back().size(); ++i)
        i % 2 == 0 ? pairs.push_back(boxes_.back()[i]) : pairs.back().add(boxes_.back()[i]);
      boxes_.push_back(std::move(pairs));
    }
  }

  bool pinches() const { return pinches(boxes_.size() - 1, 0, 0); }

 private:
  /// Whether a point of sides k pinches with one of sides l <= k.
  bool pinches(std::size_t level, std::size_t k, std::size_t l) const {
    if (k >= boxes_[level].size() || !may_pinch(boxes_[level][k], boxes_[level][l])) return false;
    if (level == 0) return (k != l || !sides_[k].is_clear()) && pinch(sides_[k], sides_[l]);
    for (std::size_t i = 2 * k; i < 2 * k + 2; ++i)
      for (std::size_t j = 2 * l; j < std::min(i + 1, 2 * l + 2); ++j)
        if (pinches(level - 1, i, j)) return true;
    return false;
  }

  std::vector<RimSide> sides_;                // that have points
  std::vector<std::vector<RimBoxes>> boxes_;  // by level: of each side, of pairs, of pairs of these ...
};

}  // namespace

bool rim_pinches(std::span<const Vec3> x, const PatchTopology& topology, std::span<const Vec2> p) {
  return Rim(x, topology, p).pinches();
}

}  // namespace st
