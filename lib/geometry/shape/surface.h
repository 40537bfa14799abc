// Parametric surfaces, evaluated without knowing what they are.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/vec.h"

namespace st {

/// Position and first derivatives at (u,v).
struct SurfacePoint {
  Vec3 x;  ///< model unit
  Vec3 du, dv;
};

/// SurfacePoint with second derivatives.
struct SurfacePoint2 {
  Vec3 x, du, dv, duu, duv, dvv;
};

/// Kind of surface, as stored in the face table.
enum class SurfaceType : unsigned char {
  kPlane = 0,
  kCylinder,
  kCone,
  kSphere,
  kTorus,
  kBezier,
  kBspline,
  kRevolution,
  kExtrusion,
  kOffset,
  kOther
};

/// Bounded parametric surface x(u,v) on [u_min,u_max]x[v_min,v_max] (the face's uv bounds; evaluation a little outside
/// is allowed). One object serves one thread: evaluators cache the last span.
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
  /// evaluate() at each of `uv`; `out` has as many places. Cheaper than single calls where the evaluators are own code.
  virtual void evaluate_batch(std::span<const Vec2> uv, std::span<SurfacePoint> out) const;
  /// The (u,v), not bounded, whose point is closest to `p`, for the types where a formula gives it (plane, cylinder,
  /// cone, sphere, torus) and for facets; u and v within half a period of the middle of the bounds. nullopt for other
  /// types and where every (u,v) of a circle is as close.
  virtual std::optional<Vec2> exact_foot(Vec3 p) const;
  /// What project_near() gives, of surfaces where Newton's method stalls (facets), from anywhere near the guess;
  /// nullopt for all others.
  virtual std::optional<Vec2> foot_near(Vec3 p, Vec2 guess) const;
  /// Parameters inside the bounds where the surface or its derivative may be only C0 (kinks), ascending.
  const std::vector<double>& u_breaks() const { return u_breaks_; }
  const std::vector<double>& v_breaks() const { return v_breaks_; }
  /// Parameters strictly inside the bounds where one polynomial piece ends and the next begins, ascending; repeated
  /// along the period. Where there are no pieces, the breaks.
  virtual std::vector<double> u_knots() const { return u_breaks_; }
  virtual std::vector<double> v_knots() const { return v_breaks_; }
  /// Another one of the same data, for any thread, at a fraction of the cost of making it; nullptr: there is no saving.
  virtual std::unique_ptr<Surface> copy() const { return nullptr; }
  /// Period of the parametrisation, 0 when there is none. The bounds of a face may be less than a period, never more.
  double u_period() const { return u_period_; }
  double v_period() const { return v_period_; }

 protected:
  double u_min_ = 0, u_max_ = 1, v_min_ = 0, v_max_ = 1;
  double u_period_ = 0, v_period_ = 0;
  SurfaceType type_ = SurfaceType::kOther;
  std::vector<double> u_breaks_, v_breaks_;
};

/// du x dv, normalised; at a singular point (pole, collapsed side) the limit found from a small step towards the middle
/// of the bounds; zero when that fails, too.
Vec3 surface_normal(const Surface& surface, Vec2 uv);

/// Principal curvatures (1/model unit), |k1| >= |k2|; zero where the surface is singular.
struct Curvature {
  double k1 = 0, k2 = 0;
};
Curvature principal_curvature(const SurfacePoint2& p);
/// Unit tangent along which the normal curvature is c.k2; zero where k1 and k2 are equal or the surface is singular.
Vec3 flattest_direction(const SurfacePoint2& p, const Curvature& c);

/// The step in (u,v) whose way u * du + v * dv in the tangent plane is nearest to `d`. nullopt where the squared sine
/// of the angle between du and dv is not above `singular`, or one of them is zero.
std::optional<Vec2> tangent_step(Vec3 du, Vec3 dv, Vec3 d, double singular = 0);

/// A side of the bounds that is a point in space: a pole, an apex, a collapsed side.
struct SingularSide {
  int side;  ///< 0: u_min, 1: u_max, 2: v_min, 3: v_max
  Vec3 x;
};
/// Sides none of whose samples is further than `tolerance` (model unit) from their middle, in the order of `side`.
std::vector<SingularSide> singular_sides(const Surface& surface, double tolerance);

/// Newton projection of `p` from the guess `uv`; stays within the bounds enlarged by 1 %. nullopt when it does not
/// converge in 20 steps.
std::optional<Vec2> project_near(const Surface& surface, Vec3 p, Vec2 guess);

}  // namespace st
