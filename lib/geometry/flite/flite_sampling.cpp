#include "geometry/flite/flite_sampling.h"

#include <array>
#include <cmath>
#include <functional>

#include "geometry/flite/flite_spline.h"

namespace st {
namespace {

constexpr int kLevels[] = {2, 3, 4, 5, 7, 9, 13, 17, 25, 33, 49, 65, 97, 129, 193, 257};
constexpr double kGradings[] = {1.0, 0.1, 0.02};  // spacing at the ends over spacing of as many equal parts
constexpr double kLargerPlane = 0.05;             // on every side
constexpr std::size_t kMaxGrid = 40000;

/// Fractions of a range: n points, the spacing of which grows smoothly from the ends, where its derivative vanishes.
struct Spacing {
  int n = 2;
  double grading = 1;
  double operator()(double s) const { return s - (1 - grading) * std::sin(2 * kPi * s) / (2 * kPi); }
  double at(int i) const { return i == 0 ? 0.0 : i == n - 1 ? 1.0 : (*this)(double(i) / (n - 1)); }
};

/// A point of a curve and its derivative, by the fraction of the range.
using Evaluate = std::function<std::pair<Vec3, Vec3>(double)>;

std::vector<Vec3> points_at(const Evaluate& curve, const Spacing& spacing) {
  std::vector<Vec3> points;
  for (int i = 0; i < spacing.n; ++i) points.push_back(curve(spacing.at(i)).first);
  return points;
}

/// Largest distance of the Ferguson curve from the tangent of the curve at the same fraction; stops above `enough`.
double deviation(const Evaluate& curve, const Spacing& spacing, const std::vector<Vec3>& points, double enough) {
  const auto ferguson = ferguson_curve(points);
  double worst = 0;
  for (int i = 0; i + 1 < spacing.n && worst <= enough; ++i)
    for (const double part : {0.25, 0.5, 0.75}) {
      const auto [x, d] = curve(spacing((i + part) / (spacing.n - 1)));
      const Vec3 off = ferguson->point(i + part) - x, along = normalized(d);
      worst = std::max(worst, norm(off - dot(off, along) * along));
    }
  return worst;
}

/// The first spacing, from `level` on, with which all curves are within the tolerance; the last one where none is.
Spacing find_spacing(const std::vector<Evaluate>& curves, double tolerance) {
  Spacing spacing;
  for (const int n : kLevels)
    for (const double grading : kGradings) {
      spacing = {n, grading};
      if (n < 5 && grading != 1) continue;
      bool is_close = true;
      for (const Evaluate& curve : curves)
        if (is_close) is_close = deviation(curve, spacing, points_at(curve, spacing), tolerance) <= tolerance;
      if (is_close) return spacing;
    }
  return spacing;
}

/// A grid of points on a surface and how it comes about.
class GridSampler {
 public:
  GridSampler(const Surface& surface, double tolerance) : surface_(surface), tolerance_(tolerance) {}

  SampledSurface sample() {
    if (surface_.is_planar()) return plane();
    u_ = find_spacing(iso_curves(true), 0.5 * tolerance_);
    v_ = find_spacing(iso_curves(false), 0.5 * tolerance_);
    SampledSurface grid = make_grid();
    while (grid.deviation > tolerance_ && finer()) grid = make_grid();
    return grid;
  }

 private:
  double u(double s) const { return surface_.u_min() + s * (surface_.u_max() - surface_.u_min()); }
  double v(double s) const { return surface_.v_min() + s * (surface_.v_max() - surface_.v_min()); }

  SampledSurface plane() const {
    SampledSurface grid;
    for (const double y : {-kLargerPlane, 1 + kLargerPlane})
      for (const double x : {-kLargerPlane, 1 + kLargerPlane}) grid.points.push_back(surface_.point({u(x), v(y)}));
    return grid;
  }

  std::vector<Evaluate> iso_curves(bool along_u) const {
    std::vector<Evaluate> curves;
    for (const double at : {0.0, 0.13, 0.31, 0.5, 0.69, 0.87, 1.0})
      curves.push_back([this, along_u, at](double s) {
        const SurfacePoint p = surface_.evaluate(along_u ? Vec2{u(s), v(at)} : Vec2{u(at), v(s)});
        return std::pair(p.x, along_u ? p.du : p.dv);
      });
    return curves;
  }

  bool finer() {
    bool is_finer = false;
    for (Spacing* spacing : {&u_, &v_})
      for (const int n : kLevels)
        if (n > spacing->n && spacing->n > 2) {
          spacing->n = n;
          is_finer = true;
          break;
        }
    return is_finer && static_cast<std::size_t>(u_.n) * v_.n <= kMaxGrid;
  }

  SampledSurface make_grid() const {
    SampledSurface grid;
    grid.n_u = u_.n, grid.n_v = v_.n;
    for (int j = 0; j < v_.n; ++j)
      for (int i = 0; i < u_.n; ++i) grid.points.push_back(surface_.point({u(u_.at(i)), v(v_.at(j))}));
    const auto ferguson = ferguson_surface(u_.n, v_.n, grid.points);
    for (int j = 0; j + 1 < v_.n; ++j)
      for (int i = 0; i + 1 < u_.n; ++i)
        for (const Vec2 part : {Vec2{0.5, 0.5}, Vec2{0.25, 0.75}})
          grid.deviation = std::max(grid.deviation, off_plane(*ferguson, i + part.x, j + part.y));
    return grid;
  }

  /// Distance of a point of the Ferguson surface from the tangent plane at the same fractions.
  double off_plane(const Surface& ferguson, double i, double j) const {
    const Vec2 uv{u(u_(i / (u_.n - 1))), v(v_(j / (v_.n - 1)))};
    const Vec3 off = ferguson.point({i, j}) - surface_.point(uv), normal = surface_normal(surface_, uv);
    return norm2(normal) > 0 ? std::fabs(dot(off, normal)) : norm(off);
  }

  const Surface& surface_;
  double tolerance_;
  Spacing u_, v_;
};

}  // namespace

SampledCurve sample_curve(const Curve& curve, double t0, double t1, Vec3 start, Vec3 end, double tolerance) {
  const Vec3 off_start = start - curve.point(t0), off_end = end - curve.point(t1);
  const Evaluate bent = [&](double s) {
    const CurvePoint p = curve.evaluate(t0 + s * (t1 - t0));
    return std::pair(p.x + (1 - s) * off_start + s * off_end, (t1 - t0) * p.d1 + off_end - off_start);
  };
  const Spacing spacing = find_spacing({bent}, tolerance);
  SampledCurve result{points_at(bent, spacing), 0};
  result.points.front() = start;
  result.points.back() = end;
  result.deviation = deviation(bent, spacing, result.points, 1e300);
  return result;
}

SampledSurface sample_surface(const Surface& surface, double tolerance) {
  return GridSampler(surface, tolerance).sample();
}

}  // namespace st
