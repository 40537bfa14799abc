// Parametric surfaces, evaluated without knowing what they are.
#pragma once

#include <optional>
#include <vector>

#include "base/vec.h"

namespace st {

/// Position and first derivatives at (u,v).
struct SurfacePoint {
  Vec3 x;        ///< model unit
  Vec3 du, dv;
};

/// SurfacePoint with second derivatives.
struct SurfacePoint2 {
  Vec3 x, du, dv, duu, duv, dvv;
};

/// Kind of surface, as stored in the face table.
enum class SurfaceType : unsigned char { kPlane = 0, kCylinder, kCone, kSphere, kTorus, kBezier, kBspline, kRevolution, kExtrusion, kOffset, kOther };

/// Bounded parametric surface x(u,v) on [u_min,u_max]x[v_min,v_max] (the face's uv bounds; evaluation a little outside is
/// allowed). One object serves one thread: evaluators cache the last span.
class Surface {
 public:
  virtual ~Surface() = default;
  double u_min() const { return u_min_; }
  double u_max() const { return u_max_; }
  double v_min() const { return v_min_; }
  double v_max() const { return v_max_; }
  SurfaceType type() const { return type_; }
  bool is_planar() const { return type_ == SurfaceType::kPlane; }
  virtual Vec3 point(Vec2 uv) const = 0;
  /// Position and first derivatives.
  virtual SurfacePoint evaluate(Vec2 uv) const = 0;
  /// Position, first and second derivatives.
  virtual SurfacePoint2 evaluate2(Vec2 uv) const = 0;
  /// Parameters inside the bounds where the surface or its derivative may be only C0 (kinks), ascending.
  const std::vector<double>& u_breaks() const { return u_breaks_; }
  const std::vector<double>& v_breaks() const { return v_breaks_; }

 protected:
  double u_min_ = 0, u_max_ = 1, v_min_ = 0, v_max_ = 1;
  SurfaceType type_ = SurfaceType::kOther;
  std::vector<double> u_breaks_, v_breaks_;
};

/// du x dv, normalised; at a singular point (pole, collapsed side) the limit found from a small step towards the middle of
/// the bounds; zero when that fails, too.
Vec3 surface_normal(const Surface& surface, Vec2 uv);

/// Principal curvatures (1/model unit), |k1| >= |k2|; zero where the surface is singular.
struct Curvature {
  double k1 = 0, k2 = 0;
};
Curvature principal_curvature(const SurfacePoint2& p);

/// Newton projection of `p` from the guess `uv`; stays within the bounds enlarged by 1 %. nullopt when it does not converge in 20 steps.
std::optional<Vec2> project_near(const Surface& surface, Vec3 p, Vec2 guess);

}  // namespace st
