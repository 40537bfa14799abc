#include "geometry/surface.h"

#include <algorithm>
#include <cmath>

namespace st {
namespace {
// du x dv counts as singular below this sine of the angle between du and dv, or where one of them vanishes against the other.
constexpr double kSingular = 1e-7;

Vec3 regular_normal(const SurfacePoint& p, double scale2) {
  const Vec3 n = cross(p.du, p.dv);
  const double size = norm(n);
  return size > kSingular * kSingular * scale2 && size > kSingular * norm(p.du) * norm(p.dv) ? n / size : Vec3{};
}
}  // namespace

Vec3 surface_normal(const Surface& surface, Vec2 uv) {
  const double mid_u = 0.5 * (surface.u_min() + surface.u_max()), mid_v = 0.5 * (surface.v_min() + surface.v_max());
  const double range_u = surface.u_max() - surface.u_min(), range_v = surface.v_max() - surface.v_min();
  const SurfacePoint p = surface.evaluate(uv);
  const double n2 = norm2(p.du) + norm2(p.dv);
  const Vec3 n = cross(p.du, p.dv);
  // at a pole one derivative vanishes: |du x dv| is tiny against the larger derivative, scaled to the parameter ranges
  const double lu = norm(p.du) * range_u, lv = norm(p.dv) * range_v;
  if (norm(n) > 0 && lu > 1e-6 * lv && lv > 1e-6 * lu && n2 > 0 && norm(n) > kSingular * norm(p.du) * norm(p.dv)) return normalized(n);
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
  const double e = norm2(p.du), f = dot(p.du, p.dv), g = norm2(p.dv);
  const double det = e * g - f * f;
  if (!(area > 0) || !(det > 1e-20 * e * g) || !(det > 0)) return {};
  const Vec3 n = n3 / area;
  const double l = dot(p.duu, n), m = dot(p.duv, n), k = dot(p.dvv, n);
  const double mean = (e * k - 2 * f * m + g * l) / (2 * det);
  const double gauss = (l * k - m * m) / det;
  const double root = std::sqrt(std::max(0.0, mean * mean - gauss));
  Curvature c{mean + root, mean - root};
  if (std::abs(c.k2) > std::abs(c.k1)) std::swap(c.k1, c.k2);
  return c;
}

std::optional<Vec2> project_near(const Surface& surface, Vec3 target, Vec2 uv) {
  const double range_u = surface.u_max() - surface.u_min(), range_v = surface.v_max() - surface.v_min();
  const double lo_u = surface.u_min() - 0.01 * range_u, hi_u = surface.u_max() + 0.01 * range_u;
  const double lo_v = surface.v_min() - 0.01 * range_v, hi_v = surface.v_max() + 0.01 * range_v;
  for (int step = 0; step < 20; ++step) {
    const SurfacePoint2 p = surface.evaluate2(uv);
    const Vec3 r = p.x - target;
    const double fu = dot(r, p.du), fv = dot(r, p.dv);
    double a = norm2(p.du) + dot(r, p.duu), b = dot(p.du, p.dv) + dot(r, p.duv), c = norm2(p.dv) + dot(r, p.dvv);
    if (!(a * c - b * b > 1e-12 * norm2(p.du) * norm2(p.dv))) {  // not convex here: Gauss-Newton
      a = norm2(p.du);
      b = dot(p.du, p.dv);
      c = norm2(p.dv);
    }
    const double det = a * c - b * b;
    if (!(det > 0)) return std::nullopt;
    const Vec2 next{std::clamp(uv.x - (c * fu - b * fv) / det, lo_u, hi_u), std::clamp(uv.y - (a * fv - b * fu) / det, lo_v, hi_v)};
    const Vec2 move = next - uv;
    uv = next;
    if (norm(move.x * p.du + move.y * p.dv) <= 1e-12 * (norm(p.x) + norm(p.du) * range_u)) return uv;
  }
  return std::nullopt;
}

}  // namespace st
