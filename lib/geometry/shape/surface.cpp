#include "geometry/shape/surface.h"

#include <algorithm>
#include <cmath>

#include "geometry/shape/samples.h"
#include "geometry/shape/surface_forms.h"

namespace st {
namespace {
// du x dv counts as singular below this sine of the angle between du and dv, or where one of them vanishes against the
// other.
constexpr double kSingular = 1e-7;

Vec3 regular_normal(const SurfacePoint& p, double scale2) {
  const Vec3 n = cross(p.du, p.dv);
  const double size = norm(n);
  return size > kSingular * kSingular * scale2 && size > kSingular * norm(p.du) * norm(p.dv) ? n / size : Vec3{};
}
}  // namespace

void Surface::evaluate_batch(std::span<const Vec2> uv, std::span<SurfacePoint> out) const {
  for (std::size_t i = 0; i < uv.size(); ++i) out[i] = evaluate(uv[i]);
}

std::optional<Vec2> Surface::exact_foot(Vec3) const { return std::nullopt; }

std::optional<Vec2> Surface::foot_near(Vec3, Vec2) const { return std::nullopt; }

Vec3 surface_normal(const Surface& surface, Vec2 uv) {
  const double mid_u = 0.5 * (surface.u_min() + surface.u_max()), mid_v = 0.5 * (surface.v_min() + surface.v_max());
  const double range_u = surface.u_max() - surface.u_min(), range_v = surface.v_max() - surface.v_min();
  const SurfacePoint p = surface.evaluate(uv);
  const double n2 = norm2(p.du) + norm2(p.dv);
  const Vec3 n = cross(p.du, p.dv);
  // at a pole one derivative vanishes: |du x dv| is tiny against the larger derivative, scaled to the parameter ranges
  const double lu = norm(p.du) * range_u, lv = norm(p.dv) * range_v;
  if (norm(n) > 0 && lu > 1e-6 * lv && lv > 1e-6 * lu && n2 > 0 && norm(n) > kSingular * norm(p.du) * norm(p.dv))
    return normalized(n);
  for (double step : {1e-5, 1e-4, 1e-3, 1e-2}) {
    const Vec2 q{uv.x + step * (mid_u - uv.x), uv.y + step * (mid_v - uv.y)};
    const SurfacePoint r = surface.evaluate(q);
    const Vec3 m = regular_normal(r, 0);
    if (norm2(m) > 0) return m;
  }
  return {};
}

Curvature principal_curvature(const SurfacePoint2& p) {
  const Vec3 n3 = cross(p.du, p.dv);
  const double area = norm(n3);
  const Eigen::Matrix2d first = first_form(p.du, p.dv);
  if (!(area > 0) || !(first.determinant() > 1e-20 * first(0, 0) * first(1, 1))) return {};
  const Eigen::Matrix2d second = second_form(p, n3 / area);
  const double mean = 0.5 * (first.inverse() * second).trace(), gauss = second.determinant() / first.determinant();
  const double root = std::sqrt(std::max(0.0, mean * mean - gauss));
  Curvature c{mean + root, mean - root};
  if (std::abs(c.k2) > std::abs(c.k1)) std::swap(c.k1, c.k2);
  return c;
}

// (W - k1)(W - k2) = 0 for the shape operator W: each column of W - k1 is a direction of k2.
Vec3 flattest_direction(const SurfacePoint2& p, const Curvature& c) {
  const Vec3 n = normalized(cross(p.du, p.dv));
  if (n == Vec3{} || c.k1 == c.k2) return {};
  const Eigen::Matrix2d shape = first_form(p.du, p.dv).inverse() * second_form(p, n);
  const Vec3 columns[2] = {(shape(0, 0) - c.k1) * p.du + shape(1, 0) * p.dv,
                           shape(0, 1) * p.du + (shape(1, 1) - c.k1) * p.dv};
  const double u2 = norm2(columns[0]) * norm2(p.dv), v2 = norm2(columns[1]) * norm2(p.du);
  return normalized(u2 >= v2 ? columns[0] : columns[1]);
}

std::optional<Vec2> tangent_step(Vec3 du, Vec3 dv, Vec3 d, double singular) {
  const Eigen::Matrix2d first = first_form(du, dv);
  const auto step = solve(first, along_tangents(du, dv, d), singular * first(0, 0) * first(1, 1));
  return step ? std::optional(to_vec2(*step)) : std::nullopt;
}

std::vector<SingularSide> singular_sides(const Surface& surface, double tolerance) {
  std::vector<SingularSide> singular;
  for (int side = 0; side < 4; ++side) {
    const bool along_v = side < 2;
    const double fixed = side == 0   ? surface.u_min()
                         : side == 1 ? surface.u_max()
                         : side == 2 ? surface.v_min()
                                     : surface.v_max();
    const double lo = along_v ? surface.v_min() : surface.u_min(), hi = along_v ? surface.v_max() : surface.u_max();
    const auto at = [&](double t) { return surface.point(along_v ? Vec2{fixed, t} : Vec2{t, fixed}); };
    const Vec3 middle = at(0.5 * (lo + hi));
    const std::vector<double> samples = sample_parameters(lo, hi, along_v ? surface.v_knots() : surface.u_knots());
    if (std::all_of(samples.begin(), samples.end(), [&](double t) { return distance(at(t), middle) <= tolerance; }))
      singular.push_back({side, middle});
  }
  return singular;
}

std::optional<Vec2> project_near(const Surface& surface, Vec3 target, Vec2 uv) {
  if (const auto own = surface.foot_near(target, uv)) return own;
  const double range_u = surface.u_max() - surface.u_min(), range_v = surface.v_max() - surface.v_min();
  const double lo_u = surface.u_min() - 0.01 * range_u, hi_u = surface.u_max() + 0.01 * range_u;
  const double lo_v = surface.v_min() - 0.01 * range_v, hi_v = surface.v_max() + 0.01 * range_v;
  for (int step = 0; step < 20; ++step) {
    const SurfacePoint2 p = surface.evaluate2(uv);
    const Vec3 r = p.x - target;
    const Eigen::Matrix2d gauss = first_form(p.du, p.dv);
    const Eigen::Vector2d slope = along_tangents(p.du, p.dv, r);
    auto back = solve<2>(gauss + second_form(p, r), slope, 1e-12 * gauss(0, 0) * gauss(1, 1));
    if (!back) back = solve(gauss, slope, 0);  // not convex here: Gauss-Newton
    if (!back) return std::nullopt;
    const Vec2 next{std::clamp(uv.x - back->x(), lo_u, hi_u), std::clamp(uv.y - back->y(), lo_v, hi_v)};
    const Vec2 move = next - uv;
    uv = next;
    if (norm(move.x * p.du + move.y * p.dv) <= 1e-12 * (norm(p.x) + norm(p.du) * range_u)) return uv;
  }
  return std::nullopt;
}

}  // namespace st
