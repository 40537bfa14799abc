#include "geometry/shape/projection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/shape/bspline.h"
#include "geometry/shape/samples.h"
#include "geometry/shape/surface_forms.h"

namespace st {
namespace {

constexpr int kStarts = 6;     // samples from which the closest point is sought
constexpr int kMaxSteps = 50;  // Newton steps per start
constexpr int kMaxHalvings = 30;
constexpr double kSmallMove = 1e-13;  // of the parameter range: converged

/// A sample that is closer to the target than its neighbours.
struct Start {
  double distance2;
  std::size_t index;
  bool operator<(const Start& o) const { return distance2 != o.distance2 ? distance2 < o.distance2 : index < o.index; }
};

/// The closest first, at most kStarts.
/// The first sample where none is nearest: distances that are not finite.
void keep_closest(std::vector<Start>& starts) {
  if (starts.empty()) starts.push_back({std::numeric_limits<double>::infinity(), 0});
  std::sort(starts.begin(), starts.end());
  if (starts.size() > kStarts) starts.resize(kStarts);
}

/// The nearest place of a box that is not empty.
Vec2 nearest_in(const Box2& b, Vec2 p) { return {std::clamp(p.x, b.lo.x, b.hi.x), std::clamp(p.y, b.lo.y, b.hi.y)}; }

/// Newton step of half the squared distance, in the directions that are free: a parameter at its bound stays there when
/// the distance falls outwards. Where the distance is not convex the Gauss-Newton step, which always descends.
Vec2 free_step(const SurfacePoint2& p, Vec3 r, Vec2 uv, const Box2& b) {
  const Eigen::Vector2d slope = along_tangents(p.du, p.dv, r);
  const bool u_free = !(uv.x <= b.lo.x && slope.x() >= 0) && !(uv.x >= b.hi.x && slope.x() <= 0);
  const bool v_free = !(uv.y <= b.lo.y && slope.y() >= 0) && !(uv.y >= b.hi.y && slope.y() <= 0);
  const Eigen::Matrix2d gauss = first_form(p.du, p.dv), newton = gauss + second_form(p, r);
  const auto along = [&](int i) {
    const double bend = newton(i, i) > 1e-12 * gauss(i, i) ? newton(i, i) : gauss(i, i);
    return bend > 0 ? -slope(i) / bend : 0.0;
  };
  if (!u_free && !v_free) return {};
  if (!v_free) return {along(0), 0};
  if (!u_free) return {0, along(1)};
  const double least = 1e-12 * gauss(0, 0) * gauss(1, 1);
  for (const Eigen::Matrix2d& m : {newton, gauss})
    if (const auto back = solve(m, slope, least); back && m(0, 0) > 0) return to_vec2(-*back);
  return {along(0), along(1)};  // singular: each by itself
}

SurfaceFoot descend(const Surface& surface, Vec3 target, Vec2 uv, const Box2& b) {
  SurfacePoint2 p = surface.evaluate2(uv);
  double distance2 = norm2(p.x - target);
  const Vec2 range = b.hi - b.lo;
  for (int step = 0; step < kMaxSteps; ++step) {
    Vec2 move = free_step(p, p.x - target, uv, b);
    bool is_closer = false;
    for (int halving = 0; halving < kMaxHalvings && !is_closer; ++halving, move = 0.5 * move) {
      const Vec2 next = nearest_in(b, uv + move);
      const SurfacePoint2 q = surface.evaluate2(next);
      is_closer = norm2(q.x - target) < distance2;
      if (!is_closer && std::abs(move.x) <= kSmallMove * range.x && std::abs(move.y) <= kSmallMove * range.y) break;
      if (!is_closer) continue;
      move = next - uv;
      uv = next;
      p = q;
      distance2 = norm2(q.x - target);
      break;
    }
    if (!is_closer || (std::abs(move.x) <= kSmallMove * range.x && std::abs(move.y) <= kSmallMove * range.y)) break;
  }
  return {uv, p.x, std::sqrt(distance2)};
}

void sample(const Surface& surface, const Box2& b, SurfaceGrid& grid) {
  grid.u = sample_parameters(b.lo.x, b.hi.x, surface.u_knots());
  grid.v = sample_parameters(b.lo.y, b.hi.y, surface.v_knots());
  grid.x.resize(grid.u.size() * grid.v.size());
  std::vector<Vec2> row(grid.u.size());
  std::vector<Vec3> x(grid.u.size());
  for (std::size_t j = 0; j < grid.v.size(); ++j) {
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = {grid.u[i], grid.v[j]};
    point_batch(surface, row, x);
    for (std::size_t i = 0; i < row.size(); ++i) grid.x[i * grid.v.size() + j] = x[i];
  }
}

/// Grid samples no further from the target than their eight neighbours.
std::vector<Start> surface_starts(const SurfaceGrid& grid, Vec3 target) {
  const int n_u = static_cast<int>(grid.u.size()), n_v = static_cast<int>(grid.v.size());
  std::vector<double> distance2;
  distance2.reserve(grid.x.size());
  for (const Vec3& x : grid.x) distance2.push_back(norm2(x - target));
  std::vector<Start> starts;
  for (int i = 0; i < n_u; ++i)
    for (int j = 0; j < n_v; ++j) {
      const double own = distance2[i * n_v + j];
      bool is_least = (j == 0 || own <= distance2[i * n_v + j - 1]) &&
                      (j + 1 == n_v || own <= distance2[i * n_v + j + 1]);  // most end here
      for (int k = std::max(i - 1, 0); k <= std::min(i + 1, n_u - 1) && is_least; ++k)
        for (int l = std::max(j - 1, 0); l <= std::min(j + 1, n_v - 1); ++l) is_least &= own <= distance2[k * n_v + l];
      if (is_least) starts.push_back({own, static_cast<std::size_t>(i) * n_v + j});
    }
  keep_closest(starts);
  return starts;
}

Box2 bounds_of(const Surface& s) { return {{s.u_min(), s.v_min()}, {s.u_max(), s.v_max()}}; }

}  // namespace

SurfaceFoot descend_from(const Surface& surface, Vec3 target, Vec2 guess) {
  if (const auto own = surface.foot_near(target, guess)) {
    const Vec3 x = surface.point(*own);
    return {*own, x, distance(x, target)};
  }
  const Box2 b = bounds_of(surface);
  return descend(surface, target, nearest_in(b, guess), b);
}

std::optional<PointAbove> point_above(const Surface& surface, Vec3 p, Vec2 guess, double aside) {
  constexpr int kSteps = 3;          // each divides the way aside by ten and more
  constexpr double kRegular = 1e-4;  // squared sine between du and dv
  constexpr double kPole = 1e-12;    // squared, of the derivatives over the whole range
  const Box2 b = bounds_of(surface);
  const Vec2 range = b.hi - b.lo;
  Vec2 uv = guess;
  for (int step = 0; step < kSteps && nearest_in(b, uv) == uv; ++step) {
    const SurfacePoint s = surface.evaluate(uv);
    const Vec3 normal = cross(s.du, s.dv), way = p - s.x;
    const double n2 = norm2(normal), along = dot(way, normal);
    const double lu2 = norm2(s.du) * range.x * range.x, lv2 = norm2(s.dv) * range.y * range.y;
    if (!(n2 > kRegular * norm2(s.du) * norm2(s.dv)) || !(std::min(lu2, lv2) > kPole * std::max(lu2, lv2))) break;
    if (norm2(way) - along * along / n2 <= aside * aside)
      return PointAbove{p - along / n2 * normal, normal, std::fabs(along) / std::sqrt(n2)};
    const auto next = tangent_step(s.du, s.dv, way);
    if (!next) break;
    uv = uv + *next;
  }
  return std::nullopt;
}

SurfaceFoot closest_point(const Surface& surface, Vec3 target) {
  SurfaceGrid grid;
  return closest_point(surface, target, grid);
}

SurfaceFoot closest_point(const Surface& surface, Vec3 target, SurfaceGrid& grid) {
  const Box2 b = bounds_of(surface);
  if (const auto exact = surface.exact_foot(target); exact && nearest_in(b, *exact) == *exact) {
    const Vec3 x = surface.point(*exact);
    return {*exact, x, distance(x, target)};
  }
  if (grid.x.empty()) sample(surface, b, grid);
  std::optional<SurfaceFoot> best;
  for (const Start& start : surface_starts(grid, target)) {
    const Vec2 uv{grid.u[start.index / grid.v.size()], grid.v[start.index % grid.v.size()]};
    const SurfaceFoot foot = descend(surface, target, uv, b);
    if (!best || foot.distance < best->distance) best = foot;
  }
  return *best;
}

CurveFoot closest_point(const Curve& curve, Vec3 target) {
  const std::vector<double> t = sample_parameters(curve.t_min(), curve.t_max(), curve.knots());
  std::vector<double> distance2;
  for (const double s : t) distance2.push_back(norm2(curve.point(s) - target));
  std::vector<Start> starts;
  for (std::size_t i = 0; i < t.size(); ++i)
    if ((i == 0 || distance2[i] <= distance2[i - 1]) && (i + 1 == t.size() || distance2[i] <= distance2[i + 1]))
      starts.push_back({distance2[i], i});
  keep_closest(starts);
  CurveFoot best{t[starts[0].index], {}, std::sqrt(starts[0].distance2)};
  for (const Start& start : starts) {
    // the sample's neighbours bracket a local minimum: bisect the derivative of the distance, with Newton where it
    // stays inside
    double lo = t[start.index > 0 ? start.index - 1 : 0], hi = t[std::min(start.index + 1, t.size() - 1)],
           s = t[start.index];
    for (int step = 0; step < 2 * kMaxSteps && hi - lo > kSmallMove * (curve.t_max() - curve.t_min()); ++step) {
      const CurvePoint p = curve.evaluate(s);
      const Vec3 r = p.x - target;
      const double slope = dot(r, p.d1), bend = norm2(p.d1) + dot(r, p.d2);
      if (const double here = norm(r); here < best.distance) best = {s, {}, here};
      (slope > 0 ? hi : lo) = s;
      const double next = bend > 0 ? s - slope / bend : lo;
      const double middle = 0.5 * (lo + hi);
      if (std::abs(next - s) <= kSmallMove * (curve.t_max() - curve.t_min()) && bend > 0) break;
      s = next > lo && next < hi ? next : middle;
    }
    if (const double here = distance(curve.point(s), target); here < best.distance) best = {s, {}, here};
  }
  best.x = curve.point(best.t);
  for (const double end : {curve.t_min(), curve.t_max()})
    if (const Vec3 x = curve.point(end); distance(x, target) < best.distance) best = {end, x, distance(x, target)};
  return best;
}

std::optional<double> project_near(const Curve& curve, Vec3 target, double t) {
  if (const auto own = curve.foot_near(target, t)) return own;
  const double range = curve.t_max() - curve.t_min(), lo = curve.t_min() - 0.01 * range,
               hi = curve.t_max() + 0.01 * range;
  for (int step = 0; step < 20; ++step) {
    const CurvePoint p = curve.evaluate(t);
    const Vec3 r = p.x - target;
    const double gauss = norm2(p.d1), newton = gauss + dot(r, p.d2);
    if (!(gauss > 0)) return std::nullopt;
    const double next = std::clamp(t - dot(r, p.d1) / (newton > 1e-12 * gauss ? newton : gauss), lo, hi);
    const double move = std::abs(next - t);
    t = next;
    if (move * std::sqrt(gauss) <= 1e-12 * (norm(p.x) + std::sqrt(gauss) * range)) return t;
  }
  return std::nullopt;
}

}  // namespace st
