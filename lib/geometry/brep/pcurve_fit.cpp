#include "geometry/brep/pcurve_fit.h"

#include <Geom2dAPI_Interpolate.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TColgp_HArray1OfPnt2d.hxx>
#include <iterator>
#include <map>

namespace st::occt {
namespace {

double distance_at(const CurveRange& range, const Surface& surface, const Handle(Geom2d_Curve) & curve, double t) {
  const gp_Pnt2d uv = curve->Value(t);
  const gp_Pnt p = range.curve->Value(t);
  return distance(surface.point({uv.X(), uv.Y()}), Vec3{p.X(), p.Y(), p.Z()});
}

/// Parameters in the middle between two points where the curve is too far off.
std::vector<double> too_far(const CurveRange& range, const Surface& surface, const Handle(Geom2d_Curve) & curve,
                            const UvPoints& points, double target) {
  std::vector<double> found;
  for (auto p = points.begin(); std::next(p) != points.end(); ++p) {
    const double t = 0.5 * (p->first + std::next(p)->first);
    if (distance_at(range, surface, curve, t) > target) found.push_back(t);
  }
  return found;
}

}  // namespace

Handle(Geom2d_BSplineCurve) spline_through(const UvPoints& points, double tolerance) {
  const int n = static_cast<int>(points.size());
  Handle(TColgp_HArray1OfPnt2d) poles = new TColgp_HArray1OfPnt2d(1, n);
  Handle(TColStd_HArray1OfReal) parameters = new TColStd_HArray1OfReal(1, n);
  int i = 1;
  for (const auto& [t, uv] : points) {
    poles->SetValue(i, {uv.x, uv.y});
    parameters->SetValue(i++, t);
  }
  try {
    Geom2dAPI_Interpolate maker(poles, parameters, false, tolerance);
    maker.Perform();
    if (maker.IsDone()) return maker.Curve();
  } catch (const Standard_Failure&) {  // points that coincide
  }
  return {};
}

Handle(Geom2d_BSplineCurve) polygon_through(const UvPoints& points) {
  const int n = static_cast<int>(points.size());
  TColgp_Array1OfPnt2d poles(1, n);
  TColStd_Array1OfReal knots(1, n);
  TColStd_Array1OfInteger multiplicities(1, n);
  int i = 1;
  for (const auto& [t, uv] : points) {
    poles(i) = {uv.x, uv.y};
    knots(i) = t;
    multiplicities(i) = i == 1 || i == n ? 2 : 1;
    ++i;
  }
  return new Geom2d_BSplineCurve(poles, knots, multiplicities, 1);
}

Handle(Geom2d_Curve) fit_pcurve(const CurveRange& range, const Surface& surface,
                                const std::function<Vec2(double)>& guess, double target) {
  constexpr int kFirstPoints = 33, kMaxPoints = 1000, kRounds = 8;
  constexpr double kSamePoint = 1e-12;
  UvPoints points;
  const auto add = [&](double t) {
    const gp_Pnt p = range.curve->Value(t);
    const Vec3 x{p.X(), p.Y(), p.Z()};
    const Vec2 near = guess(t);
    auto uv = project_near(surface, x, near);
    if (!uv && distance(surface.point(near), x) <= target) uv = near;  // at a pole no direction is better
    if (uv) points[t] = *uv;
    return uv.has_value();
  };
  for (int k = 0; k < kFirstPoints; ++k)
    if (!add(range.t0 + (range.t1 - range.t0) * k / (kFirstPoints - 1))) return {};
  Handle(Geom2d_Curve) curve = polygon_through({*points.begin(), *points.rbegin()});
  bool is_straight = too_far(range, surface, curve, points, target).empty();
  for (const auto& [t, uv] : points) is_straight &= distance_at(range, surface, curve, t) <= target;
  if (is_straight) return curve;
  for (int round = 0; round < kRounds; ++round) {
    curve = spline_through(points, kSamePoint);
    if (curve.IsNull() || points.size() > kMaxPoints) return curve;
    const std::vector<double> finer = too_far(range, surface, curve, points, target);
    if (finer.empty()) break;
    for (double t : finer)
      if (!add(t)) return curve;
  }
  return curve;
}

}  // namespace st::occt
