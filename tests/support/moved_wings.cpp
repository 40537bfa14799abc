#include "support/moved_wings.h"

#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <cmath>

namespace st::test {
namespace {

/// Half thickness of NACA 0012 with a closed trailing edge, of the chord.
double half_thickness(double x) {
  return 0.6 * (0.2969 * std::sqrt(x) - 0.126 * x - 0.3516 * x * x + 0.2843 * x * x * x - 0.1036 * x * x * x * x);
}

/// One side of the section at y, from the nose to the tail, turned by `angle` (radians) about the quarter chord.
TopoDS_Edge side(double y, double angle, double sign) {
  constexpr int kPoints = 25;
  constexpr double kChord = 60;
  const Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, kPoints);
  for (int i = 0; i < kPoints; ++i) {
    const double share = 1.0 * i / (kPoints - 1), at = share * share;
    const double x = kChord * (at - 0.25), z = i == 0 || i + 1 == kPoints ? 0 : sign * kChord * half_thickness(at);
    points->SetValue(i + 1,
                     gp_Pnt(x * std::cos(angle) + z * std::sin(angle), y, z * std::cos(angle) - x * std::sin(angle)));
  }
  GeomAPI_Interpolate fit(points, false, 1e-9);
  fit.Perform();
  return BRepBuilderAPI_MakeEdge(fit.Curve()).Edge();
}

TopoDS_Wire section(double y, double angle) {
  return BRepBuilderAPI_MakeWire(side(y, angle, 1), side(y, angle, -1)).Wire();
}

TopoDS_Edge line(gp_Pnt a, gp_Pnt b) { return BRepBuilderAPI_MakeEdge(a, b).Edge(); }

/// A piece of the wing with a flap, from y to y + span.
TopoDS_Shape flapped_piece(double flap_deg, double y, double span) {
  constexpr double kNose = 4, kHinge = 42, kFlap = 18, kHalfHinge = 2, kHalfTail = 0.25;
  const double c = std::cos(flap_deg * M_PI / 180), s = std::sin(flap_deg * M_PI / 180);
  const auto tail = [&](double z) { return gp_Pnt(kHinge + kFlap * c + z * s, y, z * c - kFlap * s); };
  const gp_Pnt top(kNose, y, kNose), bottom(kNose, y, -kNose), upper(kHinge, y, kHalfHinge),
      lower(kHinge, y, -kHalfHinge);
  BRepBuilderAPI_MakeWire wire(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(top, gp_Pnt(0, y, 0), bottom).Value()).Edge(),
                               line(bottom, lower), line(lower, tail(-kHalfTail)),
                               line(tail(-kHalfTail), tail(kHalfTail)));
  wire.Add(line(tail(kHalfTail), upper));
  wire.Add(line(upper, top));
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), gp_Vec(0, span, 0)).Shape();
}

}  // namespace

TopoDS_Shape twisted_wing(double twist_deg) {
  BRepOffsetAPI_ThruSections thru(true, true, 1e-6);
  thru.CheckCompatibility(false);
  thru.AddWire(section(0, 0));
  thru.AddWire(section(100, twist_deg * M_PI / 180));
  thru.Build();
  return thru.Shape();
}

TopoDS_Shape flapped_wing(double flap_deg) { return flapped_piece(flap_deg, 0, 40); }

TopoDS_Shape part_flapped_wing(double flap_deg) {
  const TopoDS_Shape inner = BRepAlgoAPI_Fuse(flapped_piece(0, 0, 12), flapped_piece(flap_deg, 12, 16)).Shape();
  return BRepAlgoAPI_Fuse(inner, flapped_piece(0, 28, 12)).Shape();
}

}  // namespace st::test
