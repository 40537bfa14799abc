#include "geometry/analytic.h"

#include <cmath>

namespace st {

LineCurve::LineCurve(Vec3 origin, Vec3 direction, double t_min, double t_max) : origin_(origin), direction_(direction) {
  t_min_ = t_min;
  t_max_ = t_max;
}

EllipseCurve::EllipseCurve(const Frame& frame, double a, double b, double t_min, double t_max) : frame_(frame), a_(a), b_(b) {
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

AxialSurface::AxialSurface(SurfaceType type, const Frame& frame, double radius, double second, double u_min, double u_max, double v_min,
                           double v_max)
    : frame_(frame), radius_(radius), second_(second) {
  type_ = type;
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
    case SurfaceType::kCylinder: return {radius_, 0, 0, v, 1, 0};
    case SurfaceType::kCone: return {radius_ + v * sin_, sin_, 0, v * cos_, cos_, 0};
    default: break;
  }
  const double s = std::sin(v), c = std::cos(v);
  if (type_ == SurfaceType::kSphere) return {radius_ * c, -radius_ * s, -radius_ * c, radius_ * s, radius_ * c, -radius_ * s};
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
  return {frame_.origin + p.f * e + p.g * frame_.z, p.f * e1, p.f1 * e + p.g1 * frame_.z, -p.f * e, p.f1 * e1, p.f2 * e + p.g2 * frame_.z};
}

}  // namespace st
