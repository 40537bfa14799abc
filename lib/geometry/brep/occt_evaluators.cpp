#include "geometry/brep/occt_evaluators.h"

#include <Geom2dAdaptor_Curve.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <GeomAdaptor_Curve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_Circle.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Ellipse.hxx>
#include <Geom_Line.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <Geom_TrimmedCurve.hxx>

#include "geometry/brep/kept_surfaces.h"
#include "geometry/shape/analytic.h"
#include "geometry/shape/bspline.h"

namespace st::occt {
namespace {

template <class T>
Vec3 vec(const T& p) {
  return {p.X(), p.Y(), p.Z()};
}

template <class Axes>
Frame frame(const Axes& a) {
  return {vec(a.Location()), vec(a.XDirection()), vec(a.YDirection()), vec(a.Direction())};
}

std::vector<double> flat(const TColStd_Array1OfReal& knots) { return std::vector<double>(knots.begin(), knots.end()); }

Pole pole(const gp_Pnt& p, double w) { return {{w * p.X(), w * p.Y(), w * p.Z(), w}}; }

/// Everything without an evaluator of our own.
class AdaptorCurve : public Curve {
 public:
  AdaptorCurve(const Handle(Geom_Curve) & c, double t_min, double t_max) : curve_(c) {
    t_min_ = t_min;
    t_max_ = t_max;
    if (c->IsPeriodic()) period_ = c->Period();
  }
  Vec3 point(double t) const override { return vec(curve_.Value(t)); }
  CurvePoint evaluate(double t) const override {
    gp_Pnt p;
    gp_Vec d1, d2;
    curve_.D2(t, p, d1, d2);
    return {vec(p), vec(d1), vec(d2)};
  }

 private:
  GeomAdaptor_Curve curve_;
};

class AdaptorCurve2d : public Curve2d {
 public:
  explicit AdaptorCurve2d(const Handle(Geom2d_Curve) & c) : curve_(c) {}
  Vec2 point(double t) const override {
    const gp_Pnt2d p = curve_.Value(t);
    return {p.X(), p.Y()};
  }

 private:
  Geom2dAdaptor_Curve curve_;
};

class LineCurve2d : public Curve2d {
 public:
  LineCurve2d(Vec2 origin, Vec2 direction) : origin_(origin), direction_(direction) {}
  Vec2 point(double t) const override { return origin_ + t * direction_; }

 private:
  Vec2 origin_, direction_;
};

class AdaptorSurface : public Surface {
 public:
  AdaptorSurface(const Handle(Geom_Surface) & s, SurfaceType type, const Box2& b) : surface_(s) {
    type_ = type;
    u_min_ = b.lo.x;
    u_max_ = b.hi.x;
    v_min_ = b.lo.y;
    v_max_ = b.hi.y;
    if (s->IsUPeriodic()) u_period_ = s->UPeriod();
    if (s->IsVPeriodic()) v_period_ = s->VPeriod();
    add_breaks(surface_.NbUIntervals(GeomAbs_C1), true);
    add_breaks(surface_.NbVIntervals(GeomAbs_C1), false);
  }
  Vec3 point(Vec2 uv) const override { return vec(surface_.Value(uv.x, uv.y)); }
  SurfacePoint evaluate(Vec2 uv) const override {
    gp_Pnt p;
    gp_Vec u, v;
    surface_.D1(uv.x, uv.y, p, u, v);
    return {vec(p), vec(u), vec(v)};
  }
  SurfacePoint2 evaluate2(Vec2 uv) const override {
    gp_Pnt p;
    gp_Vec u, v, uu, vv, uv2;
    surface_.D2(uv.x, uv.y, p, u, v, uu, vv, uv2);
    return {vec(p), vec(u), vec(v), vec(uu), vec(uv2), vec(vv)};
  }

 private:
  void add_breaks(int n_intervals, bool along_u) {
    if (n_intervals < 2) return;
    TColStd_Array1OfReal t(1, n_intervals + 1);
    if (along_u)
      surface_.UIntervals(t, GeomAbs_C1);
    else
      surface_.VIntervals(t, GeomAbs_C1);
    for (int i = 2; i <= n_intervals; ++i) (along_u ? u_breaks_ : v_breaks_).push_back(t(i));
  }
  GeomAdaptor_Surface surface_;
};

Handle(Geom_Surface) basis_surface(Handle(Geom_Surface) s) {
  while (const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(s)) s = trimmed->BasisSurface();
  return s;
}

Handle(Geom_Curve) basis_curve(Handle(Geom_Curve) c) {
  while (const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(c)) c = trimmed->BasisCurve();
  return c;
}

std::unique_ptr<Curve> bspline_curve(const Handle(Geom_BSplineCurve) & original, double t_min, double t_max) {
  Handle(Geom_BSplineCurve) c = original;
  const double period = c->IsPeriodic() ? c->Period() : 0;
  if (c->IsPeriodic()) {
    c = Handle(Geom_BSplineCurve)::DownCast(original->Copy());
    c->SetNotPeriodic();
  }
  std::vector<Pole> poles;
  const bool is_rational = c->IsRational();
  poles.reserve(c->NbPoles());
  for (int i = 1; i <= c->NbPoles(); ++i) poles.push_back(pole(c->Poles()(i), is_rational ? c->Weight(i) : 1.0));
  return std::make_unique<BsplineCurve>(KnotSpans(c->Degree(), flat(c->KnotSequence()), period), poles, is_rational,
                                        t_min, t_max);
}

SplineInput input_of(const Handle(Geom_BSplineSurface) & original) {
  Handle(Geom_BSplineSurface) s = original;
  if (s->IsUPeriodic() || s->IsVPeriodic()) s = Handle(Geom_BSplineSurface)::DownCast(original->Copy());
  const double u_period = s->IsUPeriodic() ? s->UPeriod() : 0, v_period = s->IsVPeriodic() ? s->VPeriod() : 0;
  if (s->IsUPeriodic()) s->SetUNotPeriodic();
  if (s->IsVPeriodic()) s->SetVNotPeriodic();
  // SetUNotPeriodic leaves a surface without weights with weights that are all zero (OpenCASCADE 7.6)
  const bool is_rational = original->IsURational() || original->IsVRational();
  SplineInput in{.u_degree = s->UDegree(),
                 .v_degree = s->VDegree(),
                 .u_period = u_period,
                 .v_period = v_period,
                 .u_flat = flat(s->UKnotSequence()),
                 .v_flat = flat(s->VKnotSequence()),
                 .poles = {},
                 .is_rational = is_rational};
  in.poles.reserve(static_cast<std::size_t>(s->NbUPoles()) * s->NbVPoles());
  const TColgp_Array2OfPnt& given = s->Poles();
  for (int i = 1; i <= s->NbUPoles(); ++i)
    for (int j = 1; j <= s->NbVPoles(); ++j) in.poles.push_back(pole(given(i, j), is_rational ? s->Weight(i, j) : 1.0));
  return in;
}

}  // namespace

SurfaceType surface_type(const Handle(Geom_Surface) & surface) {
  const Handle(Geom_Surface) s = basis_surface(surface);
  const std::pair<Handle(Standard_Type), SurfaceType> types[] = {
      {STANDARD_TYPE(Geom_Plane), SurfaceType::kPlane},
      {STANDARD_TYPE(Geom_CylindricalSurface), SurfaceType::kCylinder},
      {STANDARD_TYPE(Geom_ConicalSurface), SurfaceType::kCone},
      {STANDARD_TYPE(Geom_SphericalSurface), SurfaceType::kSphere},
      {STANDARD_TYPE(Geom_ToroidalSurface), SurfaceType::kTorus},
      {STANDARD_TYPE(Geom_BezierSurface), SurfaceType::kBezier},
      {STANDARD_TYPE(Geom_BSplineSurface), SurfaceType::kBspline},
      {STANDARD_TYPE(Geom_SurfaceOfRevolution), SurfaceType::kRevolution},
      {STANDARD_TYPE(Geom_SurfaceOfLinearExtrusion), SurfaceType::kExtrusion},
      {STANDARD_TYPE(Geom_OffsetSurface), SurfaceType::kOffset}};
  for (const auto& [type, kind] : types)
    if (s->IsKind(type)) return kind;
  return SurfaceType::kOther;
}

std::unique_ptr<Curve> make_curve(const Handle(Geom_Curve) & curve, double t_min, double t_max) {
  const Handle(Geom_Curve) c = basis_curve(curve);
  if (const auto line = Handle(Geom_Line)::DownCast(c))
    return std::make_unique<LineCurve>(vec(line->Lin().Location()), vec(line->Lin().Direction()), t_min, t_max);
  if (const auto circle = Handle(Geom_Circle)::DownCast(c))
    return std::make_unique<EllipseCurve>(frame(circle->Position()), circle->Radius(), circle->Radius(), t_min, t_max);
  if (const auto ellipse = Handle(Geom_Ellipse)::DownCast(c))
    return std::make_unique<EllipseCurve>(frame(ellipse->Position()), ellipse->MajorRadius(), ellipse->MinorRadius(),
                                          t_min, t_max);
  if (const auto bspline = Handle(Geom_BSplineCurve)::DownCast(c)) return bspline_curve(bspline, t_min, t_max);
  if (const auto bezier = Handle(Geom_BezierCurve)::DownCast(c))
    return bspline_curve(GeomConvert::CurveToBSplineCurve(bezier), t_min, t_max);
  return std::make_unique<AdaptorCurve>(c, t_min, t_max);
}

std::unique_ptr<Curve2d> make_curve2d(const Handle(Geom2d_Curve) & curve, double, double) {
  Handle(Geom2d_Curve) c = curve;
  while (const auto trimmed = Handle(Geom2d_TrimmedCurve)::DownCast(c)) c = trimmed->BasisCurve();
  if (const auto line = Handle(Geom2d_Line)::DownCast(c)) {
    const gp_Lin2d l = line->Lin2d();
    return std::make_unique<LineCurve2d>(Vec2{l.Location().X(), l.Location().Y()},
                                         Vec2{l.Direction().X(), l.Direction().Y()});
  }
  return std::make_unique<AdaptorCurve2d>(c);
}

std::unique_ptr<Surface> make_surface(const Handle(Geom_Surface) & surface) {
  Box2 b;
  surface->Bounds(b.lo.x, b.hi.x, b.lo.y, b.hi.y);
  return make_surface(surface, b);
}

std::unique_ptr<Surface> make_surface(const Handle(Geom_Surface) & surface, const Box2& b) {
  const Handle(Geom_Surface) s = basis_surface(surface);
  const auto axial = [&](SurfaceType type, const gp_Ax3& position, double radius, double second) {
    return std::make_unique<AxialSurface>(type, frame(position), radius, second, b.lo.x, b.hi.x, b.lo.y, b.hi.y);
  };
  if (const auto plane = Handle(Geom_Plane)::DownCast(s))
    return std::make_unique<PlaneSurface>(frame(plane->Position()), b.lo.x, b.hi.x, b.lo.y, b.hi.y);
  if (const auto cylinder = Handle(Geom_CylindricalSurface)::DownCast(s))
    return axial(SurfaceType::kCylinder, cylinder->Position(), cylinder->Radius(), 0);
  if (const auto cone = Handle(Geom_ConicalSurface)::DownCast(s))
    return axial(SurfaceType::kCone, cone->Position(), cone->RefRadius(), cone->SemiAngle());
  if (const auto sphere = Handle(Geom_SphericalSurface)::DownCast(s))
    return axial(SurfaceType::kSphere, sphere->Position(), sphere->Radius(), 0);
  if (const auto torus = Handle(Geom_ToroidalSurface)::DownCast(s))
    return axial(SurfaceType::kTorus, torus->Position(), torus->MajorRadius(), torus->MinorRadius());
  if (const auto bspline = Handle(Geom_BSplineSurface)::DownCast(s)) return surface_of(bspline, input_of(bspline), b);
  if (const auto bezier = Handle(Geom_BezierSurface)::DownCast(s))
    return surface_of(input_of(GeomConvert::SurfaceToBSplineSurface(bezier)), b);
  return std::make_unique<AdaptorSurface>(s, surface_type(s), b);
}

}  // namespace st::occt
