#include "geometry/shape/analytic.h"

#include <cmath>

namespace st {

LineCurve::LineCurve(Vec3 origin, Vec3 direction, double t_min, double t_max) : origin_(origin), direction_(direction) {
  t_min_ = t_min;
  t_max_ = t_max;
}

EllipseCurve::EllipseCurve(const Frame& frame, double a, double b, double t_min, double t_max)
    : frame_(frame), a_(a), b_(b) {
  period_ = 2 * kPi;
  t_min_ = t_min;
  t_max_ = t_max;
}

Vec3 EllipseCurve::point(double t) const {
  return frame_.origin + (a_ * std::cos(t)) * frame_.x + (b_ * std::sin(t)) * frame_.y;
}

CurvePoint EllipseCurve::evaluate(double t) const {
  const Vec3 c = (a_ * std::cos(t)) * frame_.x, s = (b_ * std::sin(t)) * frame_.y;
  return {frame_.origin + c + s, (-a_ * std::sin(t)) * frame_.x + (b_ * std::cos(t)) * frame_.y, -(c + s)};
}

PlaneSurface::PlaneSurface(const Frame& frame, double u_min, double u_max, double v_min, double v_max) : frame_(frame) {
  type_ = SurfaceType::kPlane;
  u_min_ = u_min;
  u_max_ = u_max;
  v_min_ = v_min;
  v_max_ = v_max;
}

AxialSurface::AxialSurface(SurfaceType type, const Frame& frame, double radius, double second, double u_min,
                           double u_max, double v_min, double v_max)
    : frame_(frame), radius_(radius), second_(second) {
  type_ = type;
  u_period_ = 2 * kPi;
  if (type == SurfaceType::kTorus) v_period_ = 2 * kPi;
  u_min_ = u_min;
  u_max_ = u_max;
  v_min_ = v_min;
  v_max_ = v_max;
  if (type == SurfaceType::kCone) {
    sin_ = std::sin(second);
    cos_ = std::cos(second);
  }
}

AxialSurface::Profile AxialSurface::profile(double v) const {
  switch (type_) {
    case SurfaceType::kCylinder:
      return {radius_, 0, 0, v, 1, 0};
    case SurfaceType::kCone:
      return {radius_ + v * sin_, sin_, 0, v * cos_, cos_, 0};
    default:
      break;
  }
  const double s = std::sin(v), c = std::cos(v);
  if (type_ == SurfaceType::kSphere)
    return {radius_ * c, -radius_ * s, -radius_ * c, radius_ * s, radius_ * c, -radius_ * s};
  return {radius_ + second_ * c, -second_ * s, -second_ * c, second_ * s, second_ * c, -second_ * s};
}

Vec3 AxialSurface::point(Vec2 uv) const {
  const Profile p = profile(uv.y);
  return frame_.origin + p.f * (std::cos(uv.x) * frame_.x + std::sin(uv.x) * frame_.y) + p.g * frame_.z;
}

SurfacePoint AxialSurface::evaluate(Vec2 uv) const {
  const Profile p = profile(uv.y);
  const double s = std::sin(uv.x), c = std::cos(uv.x);
  const Vec3 e = c * frame_.x + s * frame_.y, e1 = c * frame_.y - s * frame_.x;
  return {frame_.origin + p.f * e + p.g * frame_.z, p.f * e1, p.f1 * e + p.g1 * frame_.z};
}

SurfacePoint2 AxialSurface::evaluate2(Vec2 uv) const {
  const Profile p = profile(uv.y);
  const double s = std::sin(uv.x), c = std::cos(uv.x);
  const Vec3 e = c * frame_.x + s * frame_.y, e1 = c * frame_.y - s * frame_.x;
  return {frame_.origin + p.f * e + p.g * frame_.z,
          p.f * e1,
          p.f1 * e + p.g1 * frame_.z,
          -p.f * e,
          p.f1 * e1,
          p.f2 * e + p.g2 * frame_.z};
}

std::optional<Vec2> AxialSurface::exact_foot(Vec3 p) const {
  const Vec3 d = p - frame_.origin;
  const double x = dot(d, frame_.x), y = dot(d, frame_.y), z = dot(d, frame_.z), r = std::hypot(x, y);
  if (r == 0) return std::nullopt;
  // in the half plane of p: on the profile (f, g), or on the one across the axis (-f, g) when that is closer
  const auto near_middle = [](double a, double lo, double hi) {
    return a - 2 * kPi * std::round((a - 0.5 * (lo + hi)) / (2 * kPi));
  };
  const double u = std::atan2(y, x);
  std::optional<Vec2> best;
  double best_distance = 0;
  for (const double side : {1.0, -1.0}) {
    double v;
    switch (type_) {
      case SurfaceType::kCylinder:
        v = z;
        break;
      case SurfaceType::kCone:
        v = (side * r - radius_) * sin_ + z * cos_;
        break;
      case SurfaceType::kSphere:
        v = std::atan2(z, side * r);
        break;
      default:
        v = near_middle(std::atan2(z, side * r - radius_), v_min_, v_max_);
        break;
    }
    if (type_ == SurfaceType::kSphere && side < 0) continue;  // v in [-pi/2, pi/2] reaches every point
    const Profile q = profile(v);
    const double distance = std::hypot(q.f - side * r, q.g - z);
    if (best && distance >= best_distance) continue;
    best = Vec2{near_middle(side > 0 ? u : u + kPi, u_min_, u_max_), v};
    best_distance = distance;
  }
  return best;
}

}  // namespace st
