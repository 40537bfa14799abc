#include "features/ridge_noses.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "features/front_noses.h"
#include "geometry/shape/projection.h"

namespace st {
namespace {

constexpr double kStep = 0.0025;   // of the chord
constexpr int kSteps = 20;         // to either side of a nose
constexpr double kMuchMore = 1.5;  // of the bend at the nose, at least: there the surface turned by 29 degrees
constexpr double kLeastBend = 20;  // of a ridge, over one by the chord: noses are hardly blunter
constexpr double kMostBend = 100;  // likewise: sharper ones lie within a few rows of a profile's end, or are kinks
constexpr double kRising = 1.15;   // of the curvature a step from the end of a face: the ridge is beyond that
constexpr double kAlong = 0.95;    // cosine between noses that follow each other and the chord, at least: 18 degrees
constexpr double kSharp = 30;      // as kLeastBend: of noses that run along the chord, as a strake's
constexpr double kJump = 6;        // of the step along the trailing edge: a nose swept by 80 degrees
constexpr int kHalvings = 6;       // of a step
constexpr double kDetour = 1.005;  // of the way along noses where none is moved: moved ones may make it as long
constexpr double kUnlike = 0.25;   // of the way by which noses beside one were moved: from their line to it
constexpr double kOff = 0.002;     // of the chord, from the surface: twice the length that rans asks for at noses

/// A place on a face.
struct Place {
  Vec2 uv;
  Vec3 x, normal;
  double curvature;
  Vec3 across;  // unit, along the direction in which the surface bends most
};

class RidgeMover {
 public:
  explicit RidgeMover(const Model& model) : model_(model) {}

  /// `is_along`: the noses there run along the chord. `start` becomes the nose on its surface. False: there is no nose.
  bool move(ChordStation& s, bool is_along, Vec3& start) {
    const FaceSurface& own = surface_of(s.nose_face);
    const std::optional<Place> nose = place_at(*own.surface, closest_point(*own.surface, s.nose).uv);
    if (!nose) return true;
    if (distance(nose->x, s.nose) > kOff * s.chord) start = s.nose = nose->x;  // it lay on a facet
    const double step = kStep * s.chord;
    std::vector<Place> way = walk(own, *nose, -nose->across, step);
    const std::size_t at = way.size();
    std::ranges::reverse(way);
    way.push_back(*nose);
    std::ranges::copy(walk(own, *nose, nose->across, step), std::back_inserter(way));
    const std::vector<double> bend = bends_along(way, step);
    const auto top = static_cast<std::size_t>(std::ranges::max_element(bend) - bend.begin());
    if (is_along && bend[at] < kSharp / s.chord) return false;
    const bool goes_on = (top == 0 && at == kSteps) || (top + 1 == way.size() && top - at == kSteps);
    if (goes_on || bend[top] < std::max(kMuchMore * bend[at], kLeastBend / s.chord)) return true;
    if (bend[top] > kMostBend / s.chord) return true;
    const Place ridge = climb(own, way[top], step);
    if (rises_to_end(own, ridge, step)) return false;
    s.nose = ridge.x;
    return true;
  }

 private:
  struct FaceSurface {
    std::unique_ptr<Surface> surface;
    LoopPolygons loops;
  };

  const FaceSurface& surface_of(FaceId f) {
    const auto [known, is_new] = known_.try_emplace(f);
    if (is_new) known->second = {model_.surface(f), loops_of(model_, f)};
    return known->second;
  }

  static std::optional<Place> place_at(const Surface& surface, Vec2 uv) {
    const SurfacePoint2 p = surface.evaluate2(uv);
    const Vec3 normal = normalized(cross(p.du, p.dv));
    const Curvature c = principal_curvature(p);
    const Vec3 across = cross(flattest_direction(p, c), normal);
    if (!(norm2(across) > 0)) return std::nullopt;
    return Place{uv, p.x, normal, std::abs(c.k1), normalized(across)};
  }

  /// `way` along the direction that bends most, as `ahead` does; nullopt: that is not on the face.
  static std::optional<Place> beside(const FaceSurface& own, const Place& from, Vec3 ahead, double way) {
    const SurfacePoint2 p = own.surface->evaluate2(from.uv);
    const std::optional<Vec2> uv = tangent_step(p.du, p.dv, std::copysign(way, dot(from.across, ahead)) * from.across);
    if (!uv || !own.loops.contains(from.uv + *uv)) return std::nullopt;
    return place_at(*own.surface, from.uv + *uv);
  }

  /// By that of the normal from the place before to the one after.
  static std::vector<double> bends_along(const std::vector<Place>& way, double step) {
    std::vector<double> bend;
    for (std::size_t i = 0; i < way.size(); ++i) {
      const std::size_t a = i > 0 ? i - 1 : i, b = std::min(i + 1, way.size() - 1);
      bend.push_back(a < b ? angle_between(way[a].normal, way[b].normal) / (static_cast<double>(b - a) * step) : 0);
    }
    return bend;
  }

  /// As far as the face goes.
  static std::vector<Place> walk(const FaceSurface& own, const Place& from, Vec3 ahead, double step) {
    std::vector<Place> way = {from};
    while (way.size() <= kSteps) {
      const std::optional<Place> next = beside(own, way.back(), ahead, step);
      if (!next) break;
      ahead = next->x - way.back().x;
      way.push_back(*next);
    }
    return {way.begin() + 1, way.end()};
  }

  /// Within a step to where the surface is most curved.
  static Place climb(const FaceSurface& own, Place at, double step) {
    for (int i = 0; i < kHalvings; ++i) {
      step *= 0.5;
      for (const double side : {-1.0, 1.0})
        if (const auto next = beside(own, at, side * at.across, step); next && next->curvature > at.curvature) {
          at = *next;
          break;
        }
    }
    return at;
  }

  /// Whether the face ends before the ridge: its curvature still rises there.
  static bool rises_to_end(const FaceSurface& own, const Place& at, double step) {
    const std::optional<Place> a = beside(own, at, -at.across, step), b = beside(own, at, at.across, step);
    return a.has_value() != b.has_value() && at.curvature > kRising * (a ? *a : *b).curvature;
  }

  const Model& model_;
  std::map<FaceId, FaceSurface> known_;
};

/// Leaves out noses beside the line of those on both sides that were moved: the ridge goes on along another face there.
/// They would have their lengths in a spot of their own.
void leave_out_unlike(std::span<const ChordStation> before, std::vector<ChordStation>& after) {
  std::vector<ChordStation> kept;
  for (std::size_t i = 0; i < after.size(); ++i) {
    const auto is_moved = [&](std::size_t k) { return after[k].is_measured && after[k].nose != before[k].nose; };
    if (i > 0 && i + 1 < after.size() && is_moved(i - 1) && is_moved(i + 1)) {
      const Vec3 a = after[i - 1].nose, b = after[i + 1].nose;
      const double way = 0.5 * (distance(a, before[i - 1].nose) + distance(b, before[i + 1].nose));
      if (segment_distance(after[i].nose, a, b) > kUnlike * way) continue;
    }
    kept.push_back(after[i]);
  }
  after = std::move(kept);
}

}  // namespace

bool jumps(const ChordStation& a, const ChordStation& b) {
  return distance(a.nose, b.nose) > kJump * distance(a.trailing, b.trailing);
}

void put_back_detours(std::span<const ChordStation> before, std::span<ChordStation> after) {
  std::size_t last = after.size();                  // that stayed
  double moved = 0, way_before = 0, way_after = 0;  // since then; the furthest, and lengths of the lines
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (!after[i].is_measured) {
      last = after.size();
      continue;
    }
    if (last < i) {
      way_before += distance(before[i - 1].nose, before[i].nose);
      way_after += distance(after[i - 1].nose, after[i].nose);
      moved = std::max(moved, distance(before[i].nose, after[i].nose));
    }
    if (after[i].nose != before[i].nose) continue;
    if (last + 2 < i && way_after > kDetour * way_before && moved * static_cast<double>(i - last) < way_before)
      for (std::size_t k = last; k < i; ++k) after[k].nose = before[k].nose;
    last = i;
    moved = way_before = way_after = 0;
  }
}

void put_on_ridges(const Model& model, LiftingSurface& wing) {
  RidgeMover mover(model);
  const LiftingSurface before = wing;
  const auto is_along_chord = [&](const ChordEdge& edge, std::size_t i) {
    const ChordStation& own = edge.stations[i];
    const auto beside = [&](auto begin, auto end) {
      const auto s = std::find_if(begin, end, [&](const ChordStation& other) {
        return other.is_measured && distance(other.nose, own.nose) > kStep * own.chord && !jumps(own, other);
      });
      return s == end ? own.nose : s->nose;
    };
    const auto k = static_cast<std::ptrdiff_t>(i);
    const Vec3 a = beside(edge.stations.rend() - k, edge.stations.rend()),
               b = beside(edge.stations.begin() + k + 1, edge.stations.end());
    const ChordStation* chord = own.nose == own.trailing ? before.nearest_station(own.nose) : &own;
    return chord && a != b && std::abs(dot(normalized(b - a), normalized(chord->trailing - chord->nose))) > kAlong;
  };
  const auto move_all = [&](const std::vector<ChordEdge>& from, std::vector<ChordEdge>& to) {
    for (std::size_t e = 0; e < from.size(); ++e) {
      std::vector<ChordStation> start = from[e].stations;
      for (std::size_t i = 0; i < from[e].stations.size(); ++i) {
        ChordStation& s = to[e].stations[i];
        if (!s.is_measured) continue;
        const bool is_alone = s.trailing == s.nose;
        const bool is_nose = mover.move(s, is_along_chord(from[e], i), start[i].nose);
        if (!is_alone) continue;  // what is before a trailing edge stays a nose
        s.is_measured = is_nose;
        s.trailing = s.nose;
      }
      put_back_detours(start, to[e].stations);
      leave_out_unlike(start, to[e].stations);
    }
  };
  if (wing.has_noses) move_all(before.trailing, wing.trailing);
  move_all(before.front, wing.front);
}

}  // namespace st
