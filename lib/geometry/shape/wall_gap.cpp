#include "geometry/shape/wall_gap.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace st {
namespace {

constexpr int kApproaches = 8;      // projections from one surface to the other and back
constexpr int kLeaps = 3;           // to where the tilt of the surfaces says that they touch
constexpr double kTouching = 0.05;  // of the first distance: surfaces that leaps bring as close as this touch
constexpr double kMeeting = 0.5;    // of the first distance: surfaces that come as close as this are taken to meet
constexpr double kLeeway = 0.5;     // of the gap: what both chords may take of it
constexpr double kMostFactor = 0.7;

using Weights = std::array<double, 3>;

template <class V>
V mean(const std::array<V, 3>& at, const Weights& w) {
  return w[0] * at[0] + w[1] * at[1] + w[2] * at[2];
}

Vec3 normal_of(const std::array<Vec3, 3>& x) { return cross(x[1] - x[0], x[2] - x[0]); }

double longest_side(const std::array<Vec3, 3>& x) {
  return std::max({distance(x[0], x[1]), distance(x[1], x[2]), distance(x[2], x[0])});
}

/// Barycentric coordinates of the foot of `p` in the triangle's plane.
Weights weights_of(const std::array<Vec3, 3>& x, Vec3 p) {
  const Vec3 n = normal_of(x);
  const double area2 = norm2(n);
  if (area2 == 0) return {1.0 / 3, 1.0 / 3, 1.0 / 3};
  const double w1 = dot(cross(p - x[0], x[2] - x[0]), n) / area2, w2 = dot(cross(x[1] - x[0], p - x[0]), n) / area2;
  return {1 - w1 - w2, w1, w2};
}

/// Where sides of one triangle go through the other.
void add_piercings(const std::array<Vec3, 3>& sides, const std::array<Vec3, 3>& x, std::vector<Vec3>& found) {
  constexpr double kSlack = 1e-9;
  const Vec3 n = normal_of(x);
  for (int k = 0; k < 3; ++k) {
    const Vec3 p = sides[k], q = sides[(k + 1) % 3];
    const double dp = dot(p - x[0], n), dq = dot(q - x[0], n);
    if (dp == dq || (dp < 0) == (dq < 0)) continue;
    const Vec3 at = p + dp / (dp - dq) * (q - p);
    const Weights w = weights_of(x, at);
    if (std::min({w[0], w[1], w[2]}) >= -kSlack) found.push_back(at);
  }
}

/// The middle of what both triangles have in common.
Vec3 crossing_place(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) {
  std::vector<Vec3> found;
  add_piercings(a, b, found);
  add_piercings(b, a, found);
  if (found.empty()) return (a[0] + a[1] + a[2] + b[0] + b[1] + b[2]) / 6;
  Vec3 sum{0, 0, 0};
  for (const Vec3 p : found) sum = sum + p;
  return sum / static_cast<double>(found.size());
}

/// How far the surface leaves the triangle, at its centre and at the middles of its sides.
double sag(const Surface& surface, const WallTriangle& t) {
  const Vec3 n = normal_of(t.x);
  const double length = norm(n);
  if (length == 0) return 0;
  double most = 0;
  for (const Weights& w :
       {Weights{1.0 / 3, 1.0 / 3, 1.0 / 3}, Weights{.5, .5, 0}, Weights{0, .5, .5}, Weights{.5, 0, .5}})
    most = std::max(most, std::abs(dot(surface.point(mean(t.uv, w)) - mean(t.x, w), n)) / length);
  return most;
}

/// The way from `on_a` to where surfaces that touch as a ball and a plane do meet: their gap falls with the distance
/// squared, their tilt with the distance. Zero where they are not tilted.
Vec3 way_to_contact(Vec3 on_a, Vec3 on_b, Vec3 normal_b) {
  const Vec3 across = normalized(on_b - on_a), n = dot(normal_b, across) < 0 ? -normal_b : normal_b;
  const Vec3 tilt = n - dot(n, across) * across;
  return norm2(tilt) > 0 ? 2 * distance(on_a, on_b) * dot(n, across) / norm2(tilt) * tilt : Vec3{};
}

/// A place on both surfaces, nearly: feet of each other.
struct Feet {
  Vec2 uv_a, uv_b;
  Vec3 on_a, on_b;
};

/// Projections come closer only slowly where surfaces touch: leaps there. Whether the gap closes on the way, within
/// `reach` of the place.
bool touch(const Surface& a, const Surface& b, Feet feet, Vec3 place, double reach, double closed) {
  for (int k = 0; k < kLeaps; ++k) {
    const Vec3 way = way_to_contact(feet.on_a, feet.on_b, surface_normal(b, feet.uv_b));
    if (way == Vec3{} || !(norm(way) <= reach)) return false;
    const auto foot_a = project_near(a, feet.on_a + way, feet.uv_a);
    if (!foot_a) return false;
    feet.on_a = a.point(feet.uv_a = *foot_a);
    const auto foot_b = project_near(b, feet.on_a, feet.uv_b);
    if (!foot_b || distance(feet.on_a, place) > reach) return false;
    feet.on_b = b.point(feet.uv_b = *foot_b);
    if (distance(feet.on_a, feet.on_b) <= closed) return true;
  }
  return false;
}

}  // namespace

std::optional<WallGap> measure_gap(const Surface& a, const WallTriangle& of_a, const Surface& b,
                                   const WallTriangle& of_b, double tolerance) {
  const Vec3 place = crossing_place(of_a.x, of_b.x);
  const double reach = std::max(longest_side(of_a.x), longest_side(of_b.x));
  Vec2 uv_a = mean(of_a.uv, weights_of(of_a.x, place)), uv_b = mean(of_b.uv, weights_of(of_b.x, place));
  Vec3 on_a = a.point(uv_a), on_b;
  double first = 0, gap = 0;
  for (int k = 0; k < kApproaches; ++k) {
    const auto foot_b = project_near(b, on_a, uv_b);
    if (!foot_b) return std::nullopt;
    on_b = b.point(uv_b = *foot_b);
    const auto foot_a = project_near(a, on_b, uv_a);
    if (!foot_a) return std::nullopt;
    on_a = a.point(uv_a = *foot_a);
    gap = distance(on_a, on_b);
    if (k == 0) first = gap;
    if (gap <= tolerance || gap < kMeeting * first) return WallGap{};
    if (distance(on_a, place) > reach) break;
  }
  if (touch(a, b, {uv_a, uv_b, on_a, on_b}, place, reach, std::max(tolerance, kTouching * first))) return WallGap{};
  const double chords = sag(a, of_a) + sag(b, of_b);
  const double factor = chords > 0 ? std::sqrt(kLeeway * first / chords) : 1.0;
  return WallGap{true, std::min(kMostFactor, factor)};
}

}  // namespace st
