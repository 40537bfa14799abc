#include "features/profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace st {
namespace {

// Places along the chord, from the nose, and what a profile is like there. Thickness is over the largest one.
constexpr std::array<double, 11> kPlaces = {0.02, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.97};
constexpr double kThinnest = 0.01, kThickest = 0.35;   // largest thickness over the chord
constexpr double kSharpNose = 0.15, kFlatNose = 0.85;  // thickness at the first place: a wedge has 0.06, a plate 1
constexpr double kThickEnd = 0.5;                      // thickness at the last place, at most
constexpr double kFirstThickest = 0.1, kLastThickest = 0.8;
constexpr double kBehind = 0.02;  // of the chord: nothing lies further behind the edge

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

}  // namespace

ProfileCutter::ProfileCutter(const Facets& facets) : facets_(facets) {}

std::vector<ProfileCutter::Segment> ProfileCutter::all_segments(Vec3 origin, Vec3 normal) const {
  std::vector<double> height;
  height.reserve(facets_.xyz.size());
  for (const Vec3& x : facets_.xyz) height.push_back(dot(x - origin, normal));
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < facets_.triangle.size(); ++i) {
    const auto& t = facets_.triangle[i];
    const bool above[3] = {height[t[0]] >= 0, height[t[1]] >= 0, height[t[2]] >= 0};
    if (above[0] == above[1] && above[1] == above[2]) continue;
    Segment s{{}, {}, facets_.face[i]};
    for (std::size_t k = 0, n = 0; k < 3; ++k) {
      const std::int32_t a = std::min(t[k], t[(k + 1) % 3]), b = std::max(t[k], t[(k + 1) % 3]);
      if ((height[a] >= 0) == (height[b] >= 0)) continue;
      const double share = height[a] / (height[a] - height[b]);
      s.end[n] = facets_.xyz[a] + share * (facets_.xyz[b] - facets_.xyz[a]);
      s.side[n++] = (static_cast<std::uint64_t>(a) << 32) | static_cast<std::uint64_t>(b);
    }
    segments.push_back(s);
  }
  return segments;
}

std::vector<ProfileCutter::Segment> ProfileCutter::part_at(Vec3 origin, double reach,
                                                           std::vector<Segment> segments) const {
  std::vector<std::pair<std::uint64_t, std::size_t>> of_side;
  std::size_t first = segments.size();
  double nearest = reach;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    for (const std::uint64_t side : segments[i].side) of_side.emplace_back(side, i);
    const double d = segment_distance(origin, segments[i].end[0], segments[i].end[1]);
    if (d > nearest || (first < segments.size() && d == nearest)) continue;
    nearest = d;
    first = i;
  }
  std::vector<Segment> part;
  if (first == segments.size()) return part;
  std::sort(of_side.begin(), of_side.end());
  std::vector<bool> is_taken(segments.size(), false);
  std::vector<std::size_t> todo{first};
  is_taken[first] = true;
  while (!todo.empty()) {
    const Segment& s = segments[todo.back()];
    todo.pop_back();
    part.push_back(s);
    for (const std::uint64_t side : s.side)
      for (auto next = std::lower_bound(of_side.begin(), of_side.end(), std::pair(side, std::size_t{0}));
           next != of_side.end() && next->first == side; ++next)
        if (!is_taken[next->second]) {
          is_taken[next->second] = true;
          todo.push_back(next->second);
        }
  }
  return part;
}

std::optional<Profile> ProfileCutter::cut(Vec3 trailing_edge, Vec3 normal, double reach) const {
  const std::vector<Segment> part = part_at(trailing_edge, reach, all_segments(trailing_edge, normal));
  Profile profile;
  for (const Segment& s : part) {
    profile.faces.push_back(s.face);
    for (const Vec3& x : s.end) {
      if (distance(x, trailing_edge) <= profile.chord) continue;
      profile.chord = distance(x, trailing_edge);
      profile.nose = x;
      profile.nose_face = s.face;
    }
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
        at <= kLastThickest && nose >= kSharpNose && nose <= kFlatNose && end <= kThickEnd))
    return std::nullopt;
  std::sort(profile.faces.begin(), profile.faces.end());
  profile.faces.erase(std::unique(profile.faces.begin(), profile.faces.end()), profile.faces.end());
  return profile;
}

}  // namespace st
