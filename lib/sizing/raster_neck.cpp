#include "sizing/raster_neck.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "base/box_tree.h"
#include "sizing/line_stretch.h"

namespace st {
namespace {

constexpr double kWidthsPerLength = 2;  // of the triangles: right-angled ones have an angle of 27 degrees
constexpr double kResolved = 0.17;      // of the smallest length: narrower necks are not worth resolving
constexpr double kMostWidth = 0.36;     // of the largest length: across wider ones no angle is below 20 degrees
constexpr double kFacing = 0.9;         // cosine, of the way across and what is square to a side
constexpr double kTaper = 0.05;         // width over length; towards a point triangles are as flat at any size
constexpr double kMostTaper = 0.3;      // more is a corner
constexpr double kStep = 0.25;          // of the largest length: from one place to the next where nothing is near,
constexpr double kSides = 3;            // or so many sides, which are shorter where edges turn
constexpr double kWidens = 0.01;        // width over length: less is a neck of one width
constexpr int kMostPieces = 2000;       // of one side

constexpr double kNothing = std::numeric_limits<double>::infinity();

/// Along the loops.
struct Place {
  Vec3 x;
  CoedgeId coedge = kNone;
  double width = 0;      // kNothing where no side faces it
  bool is_flat = false;  // triangles stay flat at the length that may be asked for
  bool has_box = false, asks = has_box;
};

/// The way across a face from a place on a side.
struct Way {
  Vec3 across;
  double width = 0, taper = 0;
};

class Necks {
 public:
  Necks(std::span<const SpaceSide> sides, const SamplingLimits& limits,
        const std::function<bool(CoedgeId, CoedgeId)>& counts)
      : sides_(sides), limits_(limits), counts_(counts), tree_(tree_of(sides)) {}

  void add_boxes(std::int32_t cause, std::vector<RasterBox>& boxes) const {
    std::vector<Place> places;
    std::vector<RasterBox> own;
    double at = 0;
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const SpaceSide& side = sides_[i];
      const double step = std::min(kStep * limits_.max_length, kSides * side.length);
      if (i == 0 || side.coedge != sides_[i - 1].coedge) at = 0.5 * std::min(side.length, step);
      for (int n = 0; at < side.length && n < kMostPieces; ++n) {
        const std::optional<Way> way = way_from(i, at);
        const double length = way ? length_of(*way) : 0;
        places.push_back({side.a + at * side.along, side.coedge, way ? way->width : kNothing,
                          way && is_flat(way->width, length), length > 0});
        if (length > 0) own.push_back(box_of(side, at, *way, length, cause));
        at += length > 0 ? length : step;
      }
      at = std::max(at - side.length, 0.0);
    }
    drop_beside_flat(places);
    auto box = own.begin();
    for (const Place& place : places) {
      if (place.asks) boxes.push_back(*box);
      box += place.has_box;
    }
  }

 private:
  /// To the nearest side that faces this one.
  std::optional<Way> way_from(std::size_t i, double at) const {
    const SpaceSide& side = sides_[i];
    const Vec3 x = side.a + at * side.along;
    double nearest2 = std::pow(kMostWidth * limits_.max_length, 2);
    std::optional<Way> way;
    tree_.visit_near(
        x, [&](std::int32_t node, double d2) { return d2 < nearest2 && is_ahead(node, d2, x, side.inward); },
        [&](std::int32_t k) {
          const SpaceSide& other = sides_[k];
          if (dot(side.inward, other.inward) > -kFacing) return;
          const Vec3 across = other.nearest_to(x) - x;
          const double d2 = norm2(across), facing = kFacing * std::sqrt(d2);
          if (!(d2 < nearest2) || !(d2 > 0) || dot(across, side.inward) < facing || -dot(across, other.inward) < facing)
            return;
          nearest2 = d2;
          way.reset();
          if (counts_(side.coedge, other.coedge))
            way = Way{across, std::sqrt(d2), norm(cross(side.along, other.along))};
        });
    return way;
  }

  /// Whether a box reaches into the cone about the way across.
  bool is_ahead(std::int32_t node, double d2, Vec3 x, Vec3 inward) const {
    const Box3& box = tree_.nodes()[node].box;
    const Vec3 furthest{inward.x > 0 ? box.hi.x : box.lo.x, inward.y > 0 ? box.hi.y : box.lo.y,
                        inward.z > 0 ? box.hi.z : box.lo.z};
    const double ahead = dot(furthest - x, inward);
    return ahead > 0 && ahead * ahead >= kFacing * kFacing * d2;
  }

  /// 0: none is asked for.
  double length_of(const Way& way) const {
    const double least_width = kResolved * limits_.min_length;
    if (!(way.width > least_width) || way.taper > kMostTaper) return 0;
    const double least = way.taper > kTaper ? limits_.min_length : kWidthsPerLength * least_width;
    return std::max(kWidthsPerLength * way.width, least);
  }

  bool is_flat(double width, double length) const {
    return width <= kResolved * limits_.min_length || width < kMostWidth * length;
  }

  /// From places that are too narrow nothing is asked for as far as the width grows: triangles there are flat at any
  /// length, and the more the smaller it is.
  void drop_beside_flat(std::vector<Place>& places) const {
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!places[i].is_flat) continue;
      places[i].asks = false;
      for (const std::ptrdiff_t way : {1, -1})
        for (auto last = static_cast<std::ptrdiff_t>(i), next = last + way;
             next >= 0 && next < std::ssize(places) && widens(places[last], places[next]); last = next, next += way)
          places[next].asks = false;
    }
  }
  static bool widens(const Place& from, const Place& to) {
    return to.coedge == from.coedge && to.width < kNothing && to.width > from.width + kWidens * distance(from.x, to.x);
  }

  RasterBox box_of(const SpaceSide& side, double at, const Way& way, double length, std::int32_t cause) const {
    const Vec3 x = side.a + at * side.along;
    const auto point_at = [&](double share) { return side.a + share * side.length * side.along; };
    return {x + 0.5 * way.across,
            static_cast<float>(0.5 * limits_.cell_per_length * length),
            static_cast<float>(length),
            cause,
            {},
            stretch_along(point_at, 0.5, side.length, length, {limits_.max_aspect, limits_.max_length, limits_.alpha}),
            reach_of(0.5 * std::min(length, side.length) * side.along, 0.5 * way.across)};
  }

  std::span<const SpaceSide> sides_;
  const SamplingLimits& limits_;
  const std::function<bool(CoedgeId, CoedgeId)>& counts_;
  BoxTree tree_;
};

}  // namespace

void raster_necks(std::span<const SpaceSide> sides, const SamplingLimits& limits, std::int32_t cause,
                  const std::function<bool(CoedgeId a, CoedgeId b)>& counts, std::vector<RasterBox>& boxes) {
  if (!sides.empty()) Necks(sides, limits, counts).add_boxes(cause, boxes);
}

}  // namespace st
