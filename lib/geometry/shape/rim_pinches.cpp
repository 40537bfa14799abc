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

/// A straight side of the rim, and the points on it.
struct RimSide {
  Vec3 x[2];
  Vec2 p[2];
  double length = 0;
  std::vector<double> points;  // from x[0], ascending

  RimBoxes place(std::size_t i) const {
    const double share = points[i] / length;
    const Vec2 flat = (1 - share) * p[0] + share * p[1];
    RimBoxes boxes;
    boxes.flat.add(Vec3{flat.x, flat.y, 0});
    boxes.in_space.add((1 - share) * x[0] + share * x[1]);
    return boxes;
  }
  bool is_clear() const { return !is_pinched(p[1] - p[0], x[1] - x[0], kClear * kMostStretch); }
};

/// Points of a side from `begin` up to `end`.
struct RimPart {
  const RimSide* side;
  std::size_t begin, end;

  explicit RimPart(const RimSide& s) : RimPart(s, 0, s.points.size()) {}
  RimPart(const RimSide& s, std::size_t first, std::size_t last) : side(&s), begin(first), end(last) {}
  std::size_t size() const { return end - begin; }
  RimBoxes boxes() const {
    RimBoxes boxes = side->place(begin);
    if (size() > 1) boxes.add(side->place(end - 1));
    return boxes;
  }
  std::pair<RimPart, RimPart> halves() const {
    const std::size_t middle = begin + size() / 2;
    return {{*side, begin, middle}, {*side, middle, end}};
  }
};

bool pinch(RimPart a, RimPart b) {
  if (!may_pinch(a.boxes(), b.boxes())) return false;
  if (a.size() < b.size()) std::swap(a, b);
  if (a.size() == 1) return true;  // boxes of single points are exact
  const auto [first, second] = a.halves();
  return pinch(first, b) || pinch(second, b);
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
        if (left < side) sides_.push_back({{x[a], x[b]}, {p[a], p[b]}, side, {}});
        for (; left < side; left += step) sides_.back().points.push_back(left);
        left -= side;
      }
    }
    boxes_.emplace_back();
    for (const RimSide& s : sides_) boxes_[0].push_back(RimPart(s).boxes());
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
    if (level == 0) return (k != l || !sides_[k].is_clear()) && pinch(RimPart(sides_[k]), RimPart(sides_[l]));
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
