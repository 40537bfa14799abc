#include "features/profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/boxes.h"
#include "base/sort_once.h"
#include "features/edge_places.h"
#include "geometry/shape/composite_surface.h"
#include "geometry/shape/projection.h"

namespace st {
namespace {

// Places along the chord, from the nose, and what a profile is like there. Thickness is over the largest one.
constexpr std::array<double, 11> kPlaces = {0.02, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.97};
constexpr double kThinnest = 0.01, kThickest = ProfileCutter::kThickestPart;  // largest thickness over the chord
constexpr double kSharpNose = 0.03, kFlatNose = 0.85;  // thickness at the first place: a plate has 1, a wedge 0.04
constexpr double kThickEnd = 0.6;                      // thickness at the last place, at most
constexpr double kFirstThickest = 0.1, kLastThickest = 0.8;
constexpr double kStraightSides = 0.01;  // of a wedge: its thickness over the way from its edge differs by less
constexpr std::size_t kFacetsPerBlock = 8, kBlocksPerBlock = 8;
constexpr double kRounding = 1e-9;  // of the distance of a box and its diagonal: of heights above a plane
constexpr double kThinFor = 5;      // largest over smallest distance from the edge at which a thin part is thin
constexpr double kThinStep = 1.05;  // between two distances that are tried
constexpr double kNearNose = 0.02;  // of the chord: faces so near may have the nose
constexpr double kBehind = 0.02;    // of the chord: nothing lies further behind the edge

/// Thickness across the chord at a place; nullopt unless the profile has two sides there.
template <class Segments>
std::optional<double> thickness_at(const Segments& segments, Vec3 trailing_edge, Vec3 forward, Vec3 across,
                                   double place) {
  std::vector<double> heights;
  for (const auto& s : segments) {
    const double a = dot(s.end[0] - trailing_edge, forward) - place, b = dot(s.end[1] - trailing_edge, forward) - place;
    if ((a < 0) == (b < 0)) continue;
    const double share = a / (a - b);
    heights.push_back(dot(s.end[0] + share * (s.end[1] - s.end[0]) - trailing_edge, across));
  }
  if (heights.size() != 2) return std::nullopt;
  return std::abs(heights[1] - heights[0]);
}

/// Whether the sides are straight from the edge to a corner near the other end: a wedge, cut off there.
bool is_wedge(const std::array<double, kPlaces.size()>& thickness) {
  const double slope = thickness[1] / (1 - kPlaces[1]);
  for (std::size_t i = 2; i < kPlaces.size(); ++i)
    if (std::abs(thickness[i] - slope * (1 - kPlaces[i])) > kStraightSides * thickness[1]) return false;
  return true;
}

/// How far apart the two sides of a cut are at distances from a point on it.
template <class Segment>
class Widths {
 public:
  /// `segments` outlive the object.
  Widths(const std::vector<Segment>& segments, Vec3 from) : segments_(segments) {
    for (const Segment& s : segments) away_.push_back({distance(s.end[0], from), distance(s.end[1], from)});
  }

  double furthest() const {
    double most = 0;
    for (const auto& [a, b] : away_) most = std::max({most, a, b});
    return most;
  }

  /// At each of these distances, which ascend; nullopt: it has not two sides there.
  std::vector<std::optional<double>> at(const std::vector<double>& ways) const {
    std::vector<Sides> sides(ways.size());
    for (std::size_t i = 0; i < away_.size(); ++i) {
      const auto [least, most] = std::minmax(away_[i][0], away_[i][1]);
      const auto first = std::upper_bound(ways.begin(), ways.end(), least);
      for (auto way = first; way != ways.end() && *way <= most; ++way) add(sides[way - ways.begin()], i);
    }
    std::vector<std::optional<double>> widths(ways.size());
    for (std::size_t k = 0; k < ways.size(); ++k)
      if (sides[k].n == 2)
        widths[k] = distance(place(sides[k].segment[0], ways[k]), place(sides[k].segment[1], ways[k]));
    return widths;
  }

 private:
  struct Sides {
    std::size_t n = 0;
    std::array<std::size_t, 2> segment{};
  };

  static void add(Sides& own, std::size_t segment) {
    if (own.n < own.segment.size()) own.segment[own.n] = segment;
    ++own.n;
  }

  Vec3 place(std::size_t i, double way) const {
    const double a = away_[i][0] - way, b = away_[i][1] - way;
    return segments_[i].end[0] + a / (a - b) * (segments_[i].end[1] - segments_[i].end[0]);
  }

  const std::vector<Segment>& segments_;
  std::vector<std::array<double, 2>> away_;  // of their ends
};

/// Rounding counts as near.
bool is_near(const Box3& box, Vec3 x, double reach) {
  constexpr double kClearly2 = 1.21, kAboveRounding2 = 1e-14;
  const double own2 = distance2(x, box);
  if (own2 > kClearly2 * reach * reach && own2 > kAboveRounding2 * norm2(box.hi - box.lo)) return false;  // most are
  const double most = reach + kRounding * (box.diagonal() + distance(box.center(), x));
  return own2 <= most * most;
}

/// Whether the plane may cross what is in a box.
bool may_cross(const Box3& box, Vec3 origin, Vec3 normal) {
  const Vec3 half = 0.5 * (box.hi - box.lo), way = box.center() - origin;
  const double across = std::abs(normal.x) * half.x + std::abs(normal.y) * half.y + std::abs(normal.z) * half.z;
  const double height = std::abs(dot(way, normal));
  return height <= across || height <= across + kRounding * (norm(way) + 2 * norm(half));
}

/// A patch in the plane ends within its bounds: beyond, its surface goes on as it may.
bool is_on(const Surface& surface, Vec2 uv) {
  if (const auto* composite = dynamic_cast<const CompositeSurface*>(&surface)) return composite->holds(uv);
  if (const auto* chart = dynamic_cast<const ChartSurface*>(&surface)) return chart->holds(uv);
  return uv.x >= surface.u_min() && uv.x <= surface.u_max() && uv.y >= surface.v_min() && uv.y <= surface.v_max();
}

}  // namespace

std::optional<Vec3> exact_nose(const Surface& surface, Vec3 trailing_edge, const Profile& profile, double reach,
                               std::optional<Vec2>& guess, SurfaceGrid* grid) {
  constexpr int kSteps = 12;
  constexpr double kLongest = 0.01, kDone = 1e-6;  // of the chord
  SurfaceFoot foot{{}, {}, std::numeric_limits<double>::infinity()};
  if (guess) foot = descend_from(surface, profile.nose, *guess);
  if (!(foot.distance <= reach))
    foot = grid ? closest_point(surface, profile.nose, *grid) : closest_point(surface, profile.nose);
  Vec2 uv = foot.uv;
  for (int i = 0; i < kSteps; ++i) {
    const SurfacePoint2 p = surface.evaluate2(uv);
    const Vec3 n = normalized(cross(p.du, p.dv)), way = p.x - trailing_edge;
    const Vec3 along = normalized(cross(n, profile.normal)), to_plane = profile.normal - dot(profile.normal, n) * n;
    const std::optional<Vec2> unit = tangent_step(p.du, p.dv, along);
    if (!unit || !(dot(to_plane, to_plane) > 0)) return std::nullopt;
    const Vec3 bend = unit->x * unit->x * p.duu + 2 * unit->x * unit->y * p.duv + unit->y * unit->y * p.dvv;
    const double turning = dot(way, bend) + 1;  // of the square of the distance: twice its second derivative, halved
    if (!(turning < 0)) return std::nullopt;
    const double most = kLongest * profile.chord;
    const Vec3 step = std::clamp(-dot(way, along) / turning, -most, most) * along -
                      dot(way, profile.normal) / dot(to_plane, to_plane) * to_plane;
    const std::optional<Vec2> in_uv = tangent_step(p.du, p.dv, step);
    if (!in_uv) return std::nullopt;
    uv = uv + *in_uv;
    if (norm(step) <= kDone * profile.chord) break;
  }
  const Vec3 x = surface.point(uv);
  guess = uv;
  return is_on(surface, uv) && distance(x, profile.nose) <= reach ? std::optional(x) : std::nullopt;
}

ProfileCutter::ProfileCutter(const Facets& facets, std::vector<CutPlace>* ends)
    : facets_(facets), ends_(ends), facets_of_(cells_of_nodes(facets.triangle, facets.xyz.size())) {
  std::vector<Box3> block((facets.triangle.size() + kFacetsPerBlock - 1) / kFacetsPerBlock);
  for (std::size_t i = 0; i < facets.triangle.size(); ++i)
    for (const std::int32_t n : facets.triangle[i]) block[i / kFacetsPerBlock].add(facets.xyz[n]);
  while (block.size() > 1) {
    std::vector<Box3> next((block.size() + kBlocksPerBlock - 1) / kBlocksPerBlock);
    for (std::size_t i = 0; i < block.size(); ++i) {
      next[i / kBlocksPerBlock].add(block[i].lo);
      next[i / kBlocksPerBlock].add(block[i].hi);
    }
    blocks_.push_back(std::exchange(block, std::move(next)));
  }
  blocks_.push_back(std::move(block));
}

std::optional<ProfileCutter::Segment> ProfileCutter::segment_of(std::int32_t facet, Vec3 origin, Vec3 normal) const {
  std::array<std::pair<std::int32_t, double>, 3> corner;  // node and height
  for (std::size_t k = 0; k < 3; ++k) {
    const std::int32_t n = facets_.triangle[facet][k];
    corner[k] = {n, dot(facets_.xyz[n] - origin, normal)};
  }
  const auto is_above = [](const std::pair<std::int32_t, double>& c) { return c.second >= 0; };
  if (is_above(corner[0]) == is_above(corner[1]) && is_above(corner[1]) == is_above(corner[2])) return std::nullopt;
  Segment s{{}, {}, facet};
  for (std::size_t k = 0, n = 0; k < 3; ++k) {
    const auto& [low, high] = std::minmax(corner[k], corner[(k + 1) % 3]);
    if (is_above(low) == is_above(high)) continue;
    const double share = low.second / (low.second - high.second);
    s.end[n] = facets_.xyz[low.first] + share * (facets_.xyz[high.first] - facets_.xyz[low.first]);
    s.side[n++] = {low.first, high.first};
  }
  return s;
}

/// The first one of those that are equally near.
std::optional<ProfileCutter::Segment> ProfileCutter::nearest_segment(Vec3 origin, Vec3 normal, double reach) const {
  NearestCrossing nearest{origin, normal, reach, std::nullopt};
  if (!facets_.triangle.empty()) search(blocks_.size() - 1, 0, nearest);
  return nearest.segment;
}

void ProfileCutter::search(std::size_t level, std::size_t block, NearestCrossing& nearest) const {
  const Box3& box = blocks_[level][block];
  if (!is_near(box, nearest.origin, nearest.distance) || !may_cross(box, nearest.origin, nearest.normal)) return;
  if (level > 0) {
    const std::size_t end = std::min(blocks_[level - 1].size(), (block + 1) * kBlocksPerBlock);
    for (std::size_t i = block * kBlocksPerBlock; i < end; ++i) search(level - 1, i, nearest);
    return;
  }
  const std::size_t end = std::min(facets_.triangle.size(), (block + 1) * kFacetsPerBlock);
  for (std::size_t i = block * kFacetsPerBlock; i < end; ++i) {
    const std::optional<Segment> s = segment_of(static_cast<std::int32_t>(i), nearest.origin, nearest.normal);
    if (!s) continue;
    const double d = segment_distance(nearest.origin, s->end[0], s->end[1]);
    if (d > nearest.distance || (nearest.segment && d == nearest.distance)) continue;
    nearest.distance = d;
    nearest.segment = s;
  }
}

std::vector<ProfileCutter::Segment> ProfileCutter::part_at(Vec3 origin, Vec3 normal, double reach,
                                                           std::vector<CutPlace>* ends) const {
  std::vector<Segment> part, todo;
  std::vector<bool> is_taken(facets_.triangle.size());
  if (const std::optional<Segment> first = nearest_segment(origin, normal, reach)) {
    is_taken[first->facet] = true;
    todo.push_back(*first);
  }
  while (!todo.empty()) {
    const Segment s = todo.back();
    todo.pop_back();
    part.push_back(s);
    for (std::size_t k = 0; k < 2; ++k) {
      auto [a, b] = s.side[k];
      if (facets_of_[b].size() < facets_of_[a].size())
        std::swap(a, b);  // those of both are the same, in the same order
      int n_facets = 0;
      for (const std::int32_t facet : facets_of_[a]) {
        if (std::ranges::count(facets_.triangle[facet], b) == 0) continue;
        ++n_facets;
        if (is_taken[facet]) continue;
        is_taken[facet] = true;
        if (const std::optional<Segment> next = segment_of(facet, origin, normal)) todo.push_back(*next);
      }
      if (ends && n_facets == 1) ends->push_back({facets_.face[s.facet], s.end[k]});
    }
  }
  return part;
}

CutPlace ProfileCutter::furthest_end(const std::vector<Segment>& part, Vec3 from) const {
  CutPlace best{facets_.face[part.front().facet], part.front().end[0]};
  for (const Segment& s : part)
    for (const Vec3& x : s.end)
      if (distance(x, from) > distance(best.x, from)) best = {facets_.face[s.facet], x};
  return best;
}

std::optional<Profile> ProfileCutter::cut(Vec3 trailing_edge, Vec3 normal, double reach) const {
  const std::vector<Segment> part = part_at(trailing_edge, normal, reach);
  return part.empty() ? std::nullopt : profile_of(part, trailing_edge, normal);
}

std::optional<Profile> ProfileCutter::profile_of(const std::vector<Segment>& part, Vec3 trailing_edge,
                                                 Vec3 normal) const {
  const CutPlace end_at_nose = furthest_end(part, trailing_edge);
  Profile profile{.normal = normal,
                  .nose = end_at_nose.x,
                  .nose_face = end_at_nose.face,
                  .chord = distance(end_at_nose.x, trailing_edge)};
  for (const Segment& s : part) {
    const FaceId face = facets_.face[s.facet];
    profile.faces.push_back(face);
    if (segment_distance(profile.nose, s.end[0], s.end[1]) <= kNearNose * profile.chord)
      profile.near_nose.push_back(face);
    if (s.end[0] == profile.nose || s.end[1] == profile.nose)
      profile.beside_nose.push_back({face, 0.5 * (s.end[0] + s.end[1])});
  }
  if (!(profile.chord > 0)) return std::nullopt;
  const Vec3 forward = (profile.nose - trailing_edge) / profile.chord, across = cross(normal, forward);
  for (const Segment& s : part)
    for (const Vec3& x : s.end)
      if (dot(x - trailing_edge, forward) < -kBehind * profile.chord) return std::nullopt;
  std::array<double, kPlaces.size()> thickness;
  for (std::size_t i = 0; i < kPlaces.size(); ++i) {
    const auto own = thickness_at(part, trailing_edge, forward, across, (1 - kPlaces[i]) * profile.chord);
    if (!own) return std::nullopt;
    thickness[i] = *own;
  }
  const auto thickest = std::max_element(thickness.begin(), thickness.end());
  const double at = kPlaces[static_cast<std::size_t>(thickest - thickness.begin())];
  profile.thickness = *thickest / profile.chord;
  const double nose = thickness.front() / *thickest, end = thickness.back() / *thickest;
  if (!(profile.thickness >= kThinnest && profile.thickness <= kThickest && at >= kFirstThickest &&
        at <= kLastThickest && nose >= kSharpNose && nose <= kFlatNose && end <= kThickEnd) ||
      is_wedge(thickness))
    return std::nullopt;
  sort_once(profile.faces);
  sort_once(profile.near_nose);
  return profile;
}

bool ProfileCutter::is_closed(const std::vector<Segment>& part) {
  std::vector<std::array<std::int32_t, 2>> sides;
  for (const Segment& s : part) sides.insert(sides.end(), std::begin(s.side), std::end(s.side));
  std::sort(sides.begin(), sides.end());
  for (std::size_t i = 0; i < sides.size(); i += 2)
    if (sides[i] != sides[i + 1]) return false;
  return true;
}

std::optional<RoundProfile> ProfileCutter::round_profile(Vec3 at, Vec3 normal, double reach) const {
  constexpr double kNear = 0.03;  // of the chord, from either end
  const std::vector<Segment> part = part_at(at, normal, reach);
  if (part.empty() || !is_closed(part)) return std::nullopt;
  std::array<CutPlace, 2> end;
  end[0] = furthest_end(part, furthest_end(part, at).x);
  end[1] = furthest_end(part, end[0].x);
  const double chord = distance(end[0].x, end[1].x);
  if (!(chord > 0)) return std::nullopt;
  std::array<double, 2> width;
  for (std::size_t k = 0; k < 2; ++k) {
    const Vec3 forward = (end[1 - k].x - end[k].x) / chord;
    const auto own = thickness_at(part, end[k].x, forward, cross(normal, forward), kNear * chord);
    if (!own || !(*own > 0)) return std::nullopt;
    width[k] = *own;
  }
  const std::size_t tail = width[1] < width[0] ? 1 : 0;
  const std::optional<Profile> own = profile_of(part, end[tail].x, normal);
  if (!own) return std::nullopt;
  return RoundProfile{*own, end[tail].x, end[tail].face, width[tail] / width[1 - tail]};
}

std::optional<ThinPart> ProfileCutter::whole(Vec3 at, Vec3 normal, double reach) const {
  const std::vector<Segment> part = part_at(at, normal, reach);
  if (part.empty()) return std::nullopt;
  const Vec3 a = furthest_end(part, furthest_end(part, at).x).x, b = furthest_end(part, a).x;
  const double way = distance(a, b);
  if (!(way > 0)) return std::nullopt;
  const Vec3 forward = (b - a) / way;
  const std::optional<double> width = thickness_at(part, a, forward, cross(normal, forward), 0.5 * way);
  return width ? std::optional(ThinPart{way, *width}) : std::nullopt;
}

bool WholeCut::is_covered() const { return !is_own && own_alone >= (1 - kBeforeNose) * whole; }

std::optional<WholeCut> ProfileCutter::whole_cut(Vec3 edge, Vec3 normal, double reach,
                                                 std::span<const std::uint8_t> is_own) const {
  const std::vector<Segment> part = part_at(edge, normal, reach);
  if (part.empty()) return std::nullopt;
  const CutPlace end = furthest_end(part, edge);
  const double furthest = distance(end.x, edge);
  WholeCut cut{.whole = furthest, .own_alone = furthest, .is_own = is_own[end.face] != 0};
  for (const Segment& s : part) {
    const FaceId face = facets_.face[s.facet];
    if (!is_own[face]) cut.others.push_back(face);
    for (const Vec3& x : s.end)
      if (is_own[face])
        cut.chord = std::max(cut.chord, distance(x, edge));
      else
        cut.own_alone = std::min(cut.own_alone, distance(x, edge));
  }
  sort_once(cut.others);
  if (!(furthest > 0)) return std::nullopt;
  const Vec3 forward = (end.x - edge) / furthest, across = cross(normal, forward);
  for (const double place : kPlaces)
    if (const auto own = thickness_at(part, edge, forward, across, place * furthest))
      cut.thickness = std::max(cut.thickness, *own / furthest);
  return cut;
}

FaceId ProfileCutter::nearest_face(Vec3 at, Vec3 normal, double reach) const {
  const std::optional<Segment> nearest = nearest_segment(at, normal, reach);
  return nearest ? facets_.face[nearest->facet] : kNone;
}

std::optional<ThinPart> ProfileCutter::thin_part(Vec3 edge, Vec3 normal, double reach, double thickest) const {
  const std::vector<Segment> part = part_at(edge, normal, reach);
  const Widths<Segment> widths(part, edge);
  const double furthest = widths.furthest();
  std::vector<double> ways;
  for (double way = reach; way < furthest; way *= kThinStep) ways.push_back(way);
  const std::vector<std::optional<double>> width = widths.at(ways);
  double begin = 0, end = 0;  // of the distances at which it is thin
  for (std::size_t k = 0; k < ways.size(); ++k) {
    const bool is_thin = width[k] && *width[k] <= thickest * ways[k];
    if (is_thin && begin == 0) begin = ways[k];
    if (is_thin) end = ways[k];
    if (!is_thin && end >= kThinFor * begin && begin > 0) break;
    if (!is_thin) begin = end = 0;
  }
  if (begin == 0 || end < kThinFor * begin) return std::nullopt;
  if (end * kThinStep >= furthest) end = furthest;
  const std::optional<double> middle = widths.at({0.5 * end}).front();
  return ThinPart{end, middle.value_or(0)};
}

}  // namespace st
