// Closed-form surfaces and curves, cheap enough to be inlined by nothing and still be fast.
#pragma once

#include "geometry/shape/curve.h"
#include "geometry/shape/surface.h"

namespace st {

/// Right- or left-handed orthonormal frame.
struct Frame {
  Vec3 origin, x, y, z;
};

class LineCurve : public Curve {
 public:
  LineCurve(Vec3 origin, Vec3 direction, double t_min, double t_max);
  Vec3 point(double t) const override { return origin_ + t * direction_; }
  CurvePoint evaluate(double t) const override { return {point(t), direction_, {}}; }

 private:
  Vec3 origin_, direction_;
};

/// origin + a cos t x + b sin t y.
class EllipseCurve : public Curve {
 public:
  EllipseCurve(const Frame& frame, double a, double b, double t_min, double t_max);
  Vec3 point(double t) const override;
  CurvePoint evaluate(double t) const override;

 private:
  Frame frame_;
  double a_, b_;
};

/// origin + u x + v y.
class PlaneSurface : public Surface {
 public:
  PlaneSurface(const Frame& frame, double u_min, double u_max, double v_min, double v_max);
  Vec3 point(Vec2 uv) const override { return frame_.origin + uv.x * frame_.x + uv.y * frame_.y; }
  SurfacePoint evaluate(Vec2 uv) const override { return {point(uv), frame_.x, frame_.y}; }
  SurfacePoint2 evaluate2(Vec2 uv) const override { return {point(uv), frame_.x, frame_.y, {}, {}, {}}; }
  std::optional<Vec2> exact_foot(Vec3 p) const override {
    return Vec2{dot(p - frame_.origin, frame_.x), dot(p - frame_.origin, frame_.y)};
  }

 private:
  Frame frame_;
};

/// Cylinder, cone, sphere and torus: origin + f(v) (cos u x + sin u y) + g(v) z.
///   cylinder f = R, g = v · cone f = R + v sin a, g = v cos a · sphere f = R cos v, g = R sin v · torus f = R + r cos
///   v, g = r sin v
class AxialSurface : public Surface {
 public:
  /// `second`: half angle of a cone (radians), minor radius of a torus, unused otherwise.
  AxialSurface(SurfaceType type, const Frame& frame, double radius, double second, double u_min, double u_max,
               double v_min, double v_max);
  Vec3 point(Vec2 uv) const override;
  SurfacePoint evaluate(Vec2 uv) const override;
  SurfacePoint2 evaluate2(Vec2 uv) const override;
  std::optional<Vec2> exact_foot(Vec3 p) const override;

 private:
  struct Profile {
    double f, f1, f2, g, g1, g2;
  };
  Profile profile(double v) const;
  Frame frame_;
  double radius_, second_, sin_ = 0, cos_ = 1;
};

}  // namespace st
