// Wings, blades and sails of many kinds, and machine parts that look like wings:
//
//   wing_models                      the names
//   wing_models NAME OUT.brep
//   length
//
// x is along the flow, y to the side, z up. wing_shapes_test.py says what is to be found in each.
#include <BRepAdaptor_Curve.hxx>
#include <BRepAlgoAPI_Splitter.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepTools.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <Geom_BSplineCurve.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/brep/compound.h"
#include "late_wings.h"
#include "random_wings.h"
#include "rare_wings.h"
#include "unusual_wings.h"
#include "wing_sections.h"

namespace {

using namespace st::wing_models;
using st::occt::compound_of;

// --- wings ---

/// Span 5, chord 1.
TopoDS_Shape rectangle(const Foil& foil) {
  return loft(foil, {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(0, 5, 0), 1)});
}

/// The base of a rectangular wing, and that alone, in pieces along the span.
TopoDS_Shape base_in_pieces(int n) {
  TopTools_ListOfShape wing, lines;
  wing.Append(rectangle(kBlunt));
  for (int i = 1; i < n; ++i) {
    const double y = 5.0 * i / n, h = 0.5 * kBlunt.base;
    lines.Append(line(gp_Pnt(1, y, -h), gp_Pnt(1, y, h)));
  }
  if (n == 1) return wing.First();
  BRepAlgoAPI_Splitter splitter;
  splitter.SetArguments(wing);
  splitter.SetTools(lines);
  splitter.Build();
  return splitter.Shape();
}

/// From the root of the front wing around the tip to that of the rear one.
TopoDS_Shape box_wing() {
  std::vector<Section> sections = {{{}, straight(gp_Pnt(0, 0, 0), 1)}};
  const auto corner = [&](double x, double y, double z, double from_deg) {
    for (int i = 0; i <= 5; ++i) {
      const double share = i / 5.0, angle = (from_deg + 90 * share) * M_PI / 180;
      const gp_Pnt nose(x + 0.1 * share, y + 0.2 * std::sin(angle), z - 0.2 * std::cos(angle));
      sections.push_back({{}, straight(nose, 0.7, from_deg + 90 * share)});
    }
  };
  corner(1, 2.8, 0.2, 0);
  corner(1.5, 2.8, 1, 90);
  sections.push_back({{}, straight(gp_Pnt(2.6, 0, 1.2), 0.8, 180)});
  return loft(sections);
}

TopoDS_Shape blended_winglet() {
  std::vector<Frame> frames;
  const auto main = [](double y) { return straight(gp_Pnt(0.3 * y, y, 0), 1.2 - 0.15 * y); };
  for (const double y : {0.0, 0.8, 1.5, 2.1, 2.6, 3.0, 3.3, 3.5, 3.65, 3.78, 3.9}) frames.push_back(main(y));
  for (int i = 0; i <= 8; ++i) {
    const double angle = 90 * i / 8.0, a = angle * M_PI / 180;
    frames.push_back(straight(gp_Pnt(1.2 + 0.15 * i / 8, 4 + 0.5 * std::sin(a), 0.5 - 0.5 * std::cos(a)), 0.6, angle));
  }
  for (const double z : {0.6, 0.7, 0.82, 0.95, 1.1, 1.3})
    frames.push_back(straight(gp_Pnt(1.35 + 0.625 * (z - 0.5), 4.5, z), 0.6 - 0.3125 * (z - 0.5), 90));
  return loft(kBlunt, frames, false);
}

/// A crank at y = 1.5, and a tip rounded about its chord.
TopoDS_Shape kinked_wing() {
  const Frame tip = straight(gp_Pnt(2.6, 4, 0), 0.6);
  const TopoDS_Shape wing = loft({}, {straight(gp_Pnt(0, 0, 0), 2), straight(gp_Pnt(1, 1.5, 0), 1.2), tip});
  const Section end{{}, tip};
  const TopoDS_Wire whole = outline({{.cuts = {0}}, tip});
  BRepBuilderAPI_MakeWire half;
  half.Add(TopoDS::Edge(TopExp_Explorer(whole, TopAbs_EDGE).Current()));
  half.Add(line(at(end, 0, 1), at(end, 1, 1)));
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(half.Wire()).Face();
  return fuse(wing, BRepPrimAPI_MakeRevol(face, gp_Ax1(tip(0, 0), gp::DX())).Shape());
}

TopoDS_Shape elliptic_wing() {
  std::vector<Frame> frames;
  for (int i = -8; i <= 8; ++i) {
    const double y = 2.97 * std::sin(M_PI / 2 * i / 8), chord = std::sqrt(1 - y * y / 9);
    frames.push_back(straight(gp_Pnt(0.25 - 0.25 * chord, y, 0), chord));
  }
  return loft(kBlunt, frames, false);
}

TopoDS_Shape flying_wing() {
  return loft({.thickness = 0.14, .camber = 0.02},
              {straight(gp_Pnt(2.9, -4, -0.5), 0.5), straight(gp_Pnt(2.2, -3.2, 0), 0.9), straight(gp_Pnt(0, 0, 0), 2),
               straight(gp_Pnt(2.2, 3.2, 0), 0.9), straight(gp_Pnt(2.9, 4, -0.5), 0.5)});
}

/// Strut above a foil of chord 1; `from`: nose of the strut.
TopoDS_Shape hydrofoil(double from) {
  return fuse(loft({}, {straight(gp_Pnt(0, -2, 0), 1), straight(gp_Pnt(0, 2, 0), 1)}),
              loft({}, {straight(gp_Pnt(from, 0, 0), 0.8, 90), straight(gp_Pnt(from, 0, 2), 0.8, 90)}));
}

TopoDS_Shape t_tail() {
  const TopoDS_Shape fin = loft({}, {straight(gp_Pnt(0, 0, 0), 1.5, 90), straight(gp_Pnt(1.5, 0, 3), 1, 90)});
  return fuse(fin, loft({.thickness = 0.1}, {straight(gp_Pnt(2.3, -2, 3), 0.5), straight(gp_Pnt(1.7, 0, 3), 1),
                                             straight(gp_Pnt(2.3, 2, 3), 0.5)}));
}

TopoDS_Shape rudder() {
  const TopoDS_Shape blade = loft({.thickness = 0.18, .base = 0.01, .tail = Tail::kBlunt},
                                  {straight(gp_Pnt(0, 0, 0), 1, 90), straight(gp_Pnt(0, 0, 2), 1, 90)});
  BRepFilletAPI_MakeFillet fillet(blade);
  for (TopExp_Explorer e(blade, TopAbs_EDGE); e.More(); e.Next()) {
    const BRepAdaptor_Curve curve(TopoDS::Edge(e.Current()));
    const gp_Pnt a = curve.Value(curve.FirstParameter()), b = curve.Value(curve.LastParameter());
    const gp_Pnt m = curve.Value(0.5 * (curve.FirstParameter() + curve.LastParameter()));
    if (std::abs(a.Z() - b.Z()) < 1e-6 && m.X() < 0.9) fillet.Add(0.004, TopoDS::Edge(e.Current()));
  }
  return fillet.Shape();
}

/// Tapered, swept and twisted.
TopoDS_Shape twisted_wing() {
  std::vector<Frame> frames;
  for (int i = 0; i <= 6; ++i) {
    const double share = i / 6.0;
    frames.push_back(straight(gp_Pnt(1.5 * share, 4 * share, 0), 1.5 - 0.8 * share, 0, 12 * share));
  }
  return loft(kBlunt, frames, false);
}

/// A double wedge of planes.
TopoDS_Shape diamond_wing() { return prism({{0, 0, 0}, {0.5, 0, 0.04}, {1, 0, 0}, {0.5, 0, -0.04}}, 4); }

TopoDS_Shape two_elements() {
  const TopoDS_Shape main = loft(kBlunt, {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(0, 4, 0), 1)});
  const auto flap = [](double y) { return straight(gp_Pnt(0.98, y, -0.08), 0.35, 0, 20); };
  return compound_of({main, loft(kBlunt, {flap(0), flap(4)})});
}

TopoDS_Shape aircraft() {
  const auto body = fuselage({{0, 0}, {0.4, 0.3}, {1.2, 0.47}, {2.5, 0.5}, {6, 0.5}, {8, 0.33}, {9, 0.2}, {9.8, 0}});
  const TopoDS_Shape wing =
      loft({}, {straight(gp_Pnt(5, -5, 0), 0.6), straight(gp_Pnt(3, 0, 0), 1.6), straight(gp_Pnt(5, 5, 0), 0.6)});
  const TopoDS_Shape tail =
      loft({.thickness = 0.1},
           {straight(gp_Pnt(8.8, -2, 0), 0.4), straight(gp_Pnt(8.2, 0, 0), 0.8), straight(gp_Pnt(8.8, 2, 0), 0.4)});
  const TopoDS_Shape fin =
      loft({.thickness = 0.1}, {straight(gp_Pnt(8, 0, 0), 0.9, 90), straight(gp_Pnt(8.9, 0, 2), 0.5, 90)});
  const TopoDS_Shape pylon =
      loft({.thickness = 0.1}, {straight(gp_Pnt(3.4, 2, -0.5), 1.2, 90), straight(gp_Pnt(3.4, 2, 0), 1.2, 90)});
  const TopoDS_Shape nacelle = shifted(ring({.thickness = 0.12}, 0.4, 1.2), gp_Vec(2.9, 2, -0.88));
  return fuse_all({body, wing, tail, fin, pylon, nacelle});
}

TopoDS_Shape canard_and_delta() {
  const auto body = fuselage({{0, 0}, {0.5, 0.25}, {1.2, 0.42}, {2, 0.5}, {5, 0.5}, {9.5, 0.5}});
  const TopoDS_Shape wing = loft({.thickness = 0.04}, {straight(gp_Pnt(8.5, -3, 0), 0.5), straight(gp_Pnt(4, 0, 0), 5),
                                                       straight(gp_Pnt(8.5, 3, 0), 0.5)});
  const TopoDS_Shape canard = loft(
      {.thickness = 0.06},
      {straight(gp_Pnt(2.6, -1.5, 0.1), 0.4), straight(gp_Pnt(2, 0, 0.1), 1), straight(gp_Pnt(2.6, 1.5, 0.1), 0.4)});
  const TopoDS_Shape fin =
      loft({.thickness = 0.06}, {straight(gp_Pnt(7.5, 0, 0), 1.5, 90), straight(gp_Pnt(8.6, 0, 2), 0.6, 90)});
  return fuse_all({body, wing, canard, fin});
}

/// A wing on a fuselage, and the corner between them filled with a rolling ball.
TopoDS_Shape wing_with_fairing() {
  const TopoDS_Shape both = fuse(cylinder(gp_Pnt(-3, 0, 0), gp::DX(), 1, 8),
                                 loft({.base = 0.01, .tail = Tail::kBlunt, .cuts = {0}},
                                      {straight(gp_Pnt(0, 0, 0), 2), straight(gp_Pnt(0.5, 5, 0), 1)}));
  BRepFilletAPI_MakeFillet fillet(both);
  for (TopExp_Explorer e(both, TopAbs_EDGE); e.More(); e.Next()) {
    const BRepAdaptor_Curve curve(TopoDS::Edge(e.Current()));
    const gp_Pnt m = curve.Value(0.5 * (curve.FirstParameter() + curve.LastParameter()));
    if (std::abs(std::hypot(m.Y(), m.Z()) - 1) < 1e-4 && m.Y() > 0.5 && m.X() > 0.05 && m.X() < 1.95)
      fillet.Add(0.1, TopoDS::Edge(e.Current()));
  }
  return fillet.Shape();
}

// --- blades ---

/// Blades from a hub of radius 0.25 to 0.95, and a duct of radius 1 around them.
TopoDS_Shape ducted_fan() {
  const TopoDS_Shape hub = fuselage({{-0.6, 0}, {-0.4, 0.18}, {0, 0.25}, {0.3, 0.25}, {0.6, 0.15}, {0.9, 0}});
  std::vector<Frame> frames;
  for (int i = 0; i <= 4; ++i) {
    const double share = i / 4.0;
    frames.push_back(straight(gp_Pnt(-0.15, 0, 0.15 + 0.8 * share), 0.3, 90, 60 - 40 * share));
  }
  const TopoDS_Shape blade =
      loft({.thickness = 0.1, .base = 0.01, .camber = 0.03, .tail = Tail::kBlunt}, frames, false);
  TopoDS_Shape fan = hub;
  for (int i = 0; i < 5; ++i) fan = fuse(fan, turned(blade, gp::DX(), 2 * M_PI * i / 5));
  return compound_of(
      {shifted(ring({.thickness = 0.15, .base = 0.01, .tail = Tail::kBlunt}, 1.1, 1), gp_Vec(-0.5, 0, 0)), fan});
}

/// Along a spiral about the z axis.
Frame spiral(double r0, double r1, double turn, double z) {
  const auto middle = [=](double x) {
    const double r = r0 + (r1 - r0) * x, angle = turn * x;
    return gp_Pnt(r * std::cos(angle), r * std::sin(angle), z);
  };
  return [=](double x, double h) {
    const gp_Vec along(middle(x - 1e-4), middle(x + 1e-4));
    return middle(x).Translated(h * (r1 - r0) * gp_Vec(0, 0, 1).Crossed(along.Normalized()));
  };
}

TopoDS_Shape impeller() {
  const Foil foil{.thickness = 0.06, .base = 0.01, .tail = Tail::kBlunt};
  TopoDS_Shape all = cylinder(gp_Pnt(0, 0, -0.1), gp::DZ(), 1.05, 0.15);
  all = fuse(all, cylinder(gp_Pnt(0, 0, 0), gp::DZ(), 0.2, 0.3));
  const TopoDS_Shape blade = loft(foil, {spiral(0.35, 1, 0.9, 0), spiral(0.4, 1, 0.9, 0.35)}),
                     splitter = loft(foil, {spiral(0.65, 1, 0.4, 0), spiral(0.68, 1, 0.4, 0.35)});
  for (int i = 0; i < 6; ++i) {
    all = fuse(all, turned(blade, gp::DZ(), M_PI / 3 * i));
    all = fuse(all, turned(splitter, gp::DZ(), M_PI / 3 * (i + 0.5) + 0.5));
  }
  return all;
}

const Foil kTurbine{.thickness = 0.16, .base = 0.02, .camber = 0.12, .tail = Tail::kRound};

Foil with_cuts(Foil foil, std::vector<double> cuts) {
  foil.cuts = std::move(cuts);
  return foil;
}

/// Length 1, chord 0.5, turned by 40 degrees.
TopoDS_Shape turbine_blade(const Foil& foil) {
  std::vector<Frame> frames;
  for (int i = 0; i <= 4; ++i) frames.push_back(straight(gp_Pnt(0, 0, i / 4.0), 0.5, 90, 10 * i));
  return loft(foil, frames, false);
}

constexpr int kAround = 40;  // points of a round section: 0 at the tail, a quarter on the upper side, half at the nose

/// One smooth closed curve, round at the tail as well, cut at these of its points, the first one on.
TopoDS_Wire round_outline(const Section& s, const std::vector<int>& cuts) {
  Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, kAround);
  for (int k = 0; k < kAround; ++k) {
    const double angle = 2 * M_PI * (k + cuts.front()) / kAround, x = 0.5 * (1 + std::cos(angle));
    const bool is_tail = (k + cuts.front()) % kAround == 0;
    points->SetValue(k + 1, is_tail ? s.frame(1 + 0.5 * s.foil.base, 0) : at(s, x, std::sin(angle) >= 0 ? 1 : -1));
  }
  GeomAPI_Interpolate fit(points, true, 1e-9);
  fit.Perform();
  const Handle(Geom_BSplineCurve) curve = fit.Curve();
  BRepBuilderAPI_MakeWire wire;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const auto parameter = [&](std::size_t k) {
      return k == cuts.size() ? curve->LastParameter() : curve->Knot(cuts[k] - cuts.front() + 1);
    };
    wire.Add(BRepBuilderAPI_MakeEdge(curve, parameter(i), parameter(i + 1)).Edge());
  }
  return wire.Wire();
}

TopoDS_Shape round_loft(const Foil& foil, const std::vector<Frame>& frames, const std::vector<int>& cuts) {
  BRepOffsetAPI_ThruSections thru(true, false, 1e-6);
  thru.CheckCompatibility(false);
  for (const Frame& frame : frames) thru.AddWire(round_outline({foil, frame}, cuts));
  thru.Build();
  return thru.Shape();
}

/// Length 1, chord 0.5, turned by 40 degrees, round at both ends.
TopoDS_Shape round_blade(const std::vector<int>& cuts) {
  std::vector<Frame> frames;
  for (int i = 0; i <= 4; ++i) frames.push_back(straight(gp_Pnt(0, 0, i / 4.0), 0.5, 90, 10 * i));
  return round_loft(kTurbine, frames, cuts);
}

/// Span 4, chord 1 to 0.5, its tail round and inside the face.
TopoDS_Shape round_hydrofoil() {
  return round_loft({.thickness = 0.12, .base = 0.01},
                    {straight(gp_Pnt(0, -2, 0), 0.5), straight(gp_Pnt(0, -1, 0), 0.75), straight(gp_Pnt(0, 0, 0), 1),
                     straight(gp_Pnt(0, 1, 0), 0.75), straight(gp_Pnt(0, 2, 0), 0.5)},
                    {10});
}

/// Height 2, chord 1: one curve, extruded.
TopoDS_Shape round_strut() {
  const Section root{{.thickness = 0.2, .base = 0.02}, straight(gp_Pnt(0, 0, 0), 1, 90)};
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(round_outline(root, {10})).Face(), gp_Vec(0, 0, 2)).Shape();
}

/// The same turned about the x axis, its tail inside the face.
TopoDS_Shape round_ring() {
  const Section section{{.thickness = 0.12, .base = 0.01}, straight(gp_Pnt(0, 0, 1.5), 1)};
  return BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeFace(round_outline(section, {10})).Face(), gp::OX()).Shape();
}

/// Three blades with round tails inside their faces, from a hub of radius 0.2 to 1.
TopoDS_Shape round_propeller() {
  std::vector<Frame> frames;
  for (int i = 0; i <= 5; ++i) {
    const double share = i / 5.0;
    const double chord = 0.25 + 0.1 * std::sin(M_PI * share);
    frames.push_back(straight(gp_Pnt(-0.5 * chord, 0, 0.1 + 0.9 * share), chord, 90, 65 - 45 * share));
  }
  const TopoDS_Shape blade = round_loft({.thickness = 0.1, .base = 0.01, .camber = 0.03}, frames, {10});
  TopoDS_Shape all = fuselage({{-0.5, 0}, {-0.3, 0.15}, {0, 0.2}, {0.3, 0.2}, {0.6, 0.12}, {0.8, 0}});
  for (int i = 0; i < 3; ++i) all = fuse(all, turned(blade, gp::DX(), 2 * M_PI * i / 3));
  return all;
}

/// A tenth of it, before the wing of an aircraft.
TopoDS_Shape small_round_propeller() {
  const TopoDS_Shape fan = moved(round_propeller(), [](gp_Trsf& t) { t.SetScale(gp_Pnt(), 0.12); });
  return compound_of({aircraft(), shifted(fan, gp_Vec(3.2, -2, 0))});
}

/// The base of a rudder without corners: its long edges are rounded.
TopoDS_Shape round_rudder() {
  const TopoDS_Shape blade = loft({.thickness = 0.18, .base = 0.02, .tail = Tail::kBlunt},
                                  {straight(gp_Pnt(0, 0, 0), 1, 90), straight(gp_Pnt(0, 0, 2), 1, 90)});
  BRepFilletAPI_MakeFillet fillet(blade);
  for (TopExp_Explorer e(blade, TopAbs_EDGE); e.More(); e.Next()) {
    const BRepAdaptor_Curve curve(TopoDS::Edge(e.Current()));
    const gp_Pnt a = curve.Value(curve.FirstParameter()), b = curve.Value(curve.LastParameter());
    if (std::abs(a.Z() - b.Z()) > 1) fillet.Add(0.006, TopoDS::Edge(e.Current()));
  }
  return fillet.Shape();
}

/// Alike at both ends, so that it may be a blade for flow from either side.
TopoDS_Shape oval_blade() {
  BRepOffsetAPI_ThruSections thru(true, false, 1e-6);
  for (int i = 0; i <= 4; ++i) {
    const Frame frame = straight(gp_Pnt(0, 0, i / 4.0), 0.5, 90, 10 * i);
    Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, kAround);
    for (int k = 0; k < kAround; ++k) {
      const double angle = 2 * M_PI * (k + 10) / kAround;
      points->SetValue(k + 1, frame(0.5 + 0.5 * std::cos(angle), 0.05 * std::sin(angle)));
    }
    GeomAPI_Interpolate fit(points, true, 1e-9);
    fit.Perform();
    thru.AddWire(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(fit.Curve()).Edge()).Wire());
  }
  thru.Build();
  return thru.Shape();
}

TopoDS_Shape vanes() {
  const TopoDS_Shape vane = loft(kTurbine, {straight(gp_Pnt(0, 0, -0.05), 1, 90), straight(gp_Pnt(0, 0, 1.05), 1, 90)});
  TopoDS_Shape all = fuse(box(-0.3, -0.4, -0.1, 1.6, 2.2, 0.1), vane);
  for (int i = 1; i < 3; ++i) all = fuse(all, shifted(vane, gp_Vec(0, 0.7 * i, 0)));
  return fuse(all, box(-0.3, -0.4, 1, 1.6, 2.2, 0.1));
}

/// Four fins of height 0.4 on a body of radius 0.3.
TopoDS_Shape rocket_fins() {
  const Foil foil{.thickness = 0.05, .base = 0.01, .tail = Tail::kBlunt};
  const TopoDS_Shape fin = loft(foil, {straight(gp_Pnt(4, 0, 0), 1.2, 90), straight(gp_Pnt(4.6, 0, 0.7), 0.5, 90)});
  TopoDS_Shape all = fuselage({{0, 0}, {0.5, 0.2}, {1.2, 0.3}, {3, 0.3}, {5.4, 0.3}});
  for (int i = 0; i < 4; ++i) all = fuse(all, turned(fin, gp::DX(), M_PI / 2 * i));
  return all;
}

/// No thickness.
TopoDS_Shape sail() {
  BRepOffsetAPI_ThruSections thru(false, false, 1e-6);
  for (int i = 0; i <= 3; ++i) {
    const double z = i, chord = 1 - 0.2 * i;
    Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, 5);
    for (int k = 0; k < 5; ++k)
      points->SetValue(k + 1, gp_Pnt(0.1 * z + chord * k / 4, 0.1 * chord * std::sin(M_PI * k / 4), z));
    GeomAPI_Interpolate fit(points, false, 1e-9);
    fit.Perform();
    thru.AddWire(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(fit.Curve()).Edge()).Wire());
  }
  thru.Build();
  return thru.Shape();
}

/// A cambered sheet between square rims, `thickness` over the chord, which is 1 to 0.5 along a span of 3.
TopoDS_Shape plate_sail(double thickness) {
  constexpr int kPoints = 17;
  BRepOffsetAPI_ThruSections thru(true, false, 1e-6);
  for (int i = 0; i <= 3; ++i) {
    const Frame frame = straight(gp_Pnt(0.1 * i, i, 0), i < 3 ? 1 - 0.15 * i : 0.5);
    std::vector<TopoDS_Edge> sides;
    for (const double side : {-1.0, 1.0}) {
      Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, kPoints);
      for (int k = 0; k < kPoints; ++k) {
        const double x = k / (kPoints - 1.0), slope = std::atan(0.4 * (1 - 2 * x)), h = 0.5 * side * thickness;
        points->SetValue(k + 1, frame(x - h * std::sin(slope), 0.4 * x * (1 - x) + h * std::cos(slope)));
      }
      GeomAPI_Interpolate fit(points, false, 1e-9);
      fit.Perform();
      sides.push_back(BRepBuilderAPI_MakeEdge(fit.Curve()).Edge());
    }
    const auto end = [&](int side, double x) {
      const double slope = std::atan(0.4 * (1 - 2 * x)), h = 0.5 * side * thickness;
      return frame(x - h * std::sin(slope), h * std::cos(slope));
    };
    BRepBuilderAPI_MakeWire wire(sides[0]);
    wire.Add(line(end(-1, 1), end(1, 1)));
    wire.Add(sides[1]);
    wire.Add(line(end(1, 0), end(-1, 0)));
    thru.AddWire(wire.Wire());
  }
  thru.Build();
  return thru.Shape();
}

// --- slots, holes and steps in wings ---

/// Span 4, chord 1.
TopoDS_Shape wing_of_four(const Foil& foil) {
  return loft(foil, {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(0, 4, 0), 1)});
}

/// A slot of 1.5 % of the chord through both skins, along the span from y = `from`.
TopoDS_Shape slotted_wing(double from, double to) {
  return cut(wing_of_four(kBlunt), box(0.72, from, -1, 0.015, to - from, 2));
}

/// Open at the trailing edge: 1.5 % of the chord wide, beside a flap.
TopoDS_Shape open_slot() {
  TopoDS_Shape wing = wing_of_four({});
  for (const double y : {1.2, 2.8}) wing = cut(wing, box(0.7, y, -1, 0.5, 0.015, 2));
  return wing;
}

TopoDS_Shape three_elements() {
  const auto element = [](const Foil& foil, gp_Pnt nose, double chord, double twist) {
    const auto frame = [&](double y) { return straight(nose.Translated(gp_Vec(0, y, 0)), chord, 0, twist); };
    return loft(foil, {frame(0), frame(4)});
  };
  return compound_of(
      {element({.thickness = 0.1}, gp_Pnt(-0.14, 0, -0.09), 0.16, -25), element(kBlunt, gp_Pnt(0, 0, 0), 1, 0),
       element({.thickness = 0.1, .base = 0.006, .tail = Tail::kBlunt}, gp_Pnt(0.985, 0, -0.11), 0.3, 25)});
}

/// From x = 0.75 on and between y = 1.5 and 2.8 a piece is cut out, and put back with gaps of 1 % of the chord around.
TopoDS_Shape gapped_aileron() {
  const TopoDS_Shape wing = wing_of_four({});
  return compound_of({cut(wing, box(0.75, 1.5, -1, 0.5, 1.3, 2)), common(wing, box(0.76, 1.51, -1, 0.5, 1.28, 2))});
}

/// Four teeth of 0.05 along the leading edge.
TopoDS_Shape sawtooth_wing() {
  std::vector<TopoDS_Shape> all;
  for (int i = 0; i < 4; ++i) {
    const double y = i;
    all.push_back(loft({}, {straight(gp_Pnt(-0.05, y, 0), 1.05), straight(gp_Pnt(0, y + 1, 0), 1)}));
  }
  return fuse_all(all);
}

/// Holes of 4 % of the chord, 3 % before the trailing edge.
TopoDS_Shape pierced_wing() {
  TopoDS_Shape wing = wing_of_four({});
  for (const double y : {1.0, 2.0, 3.1}) wing = cut(wing, cylinder(gp_Pnt(0.95, y, -1), gp::DZ(), 0.02, 2));
  return wing;
}

/// A spoiler stands on the upper side.
TopoDS_Shape spoiler_wing() {
  const TopoDS_Shape plate = moved(box(0.7, 1.2, 0, 0.12, 1, 0.008),
                                   [](gp_Trsf& t) { t.SetRotation(gp_Ax1(gp_Pnt(0.7, 0, 0.02), gp::DY()), -0.5); });
  return fuse(wing_of_four({}), shifted(plate, gp_Vec(0, 0, 0.03)));
}

/// The upper skin steps down by 0.4 % of the chord at x = 0.7, as before a spoiler.
TopoDS_Shape stepped_wing() { return cut(wing_of_four(kBlunt), box(0.7, 1.2, 0.025, 0.12, 1, 1)); }

/// A store on a pylon.
TopoDS_Shape wing_with_pod() {
  const TopoDS_Shape pod =
      shifted(fuselage({{0, 0}, {0.1, 0.05}, {0.3, 0.08}, {0.7, 0.08}, {0.9, 0.05}, {1, 0}}), gp_Vec(-0.1, 2, -0.28));
  const TopoDS_Shape pylon =
      loft({.thickness = 0.08}, {straight(gp_Pnt(0.15, 2, -0.25), 0.5, 90), straight(gp_Pnt(0.15, 2, 0), 0.5, 90)});
  return fuse_all({wing_of_four({}), pylon, pod});
}

/// With a kink in both edges and another one in the dihedral.
TopoDS_Shape cranked_canard() {
  const auto body = fuselage({{0, 0}, {0.5, 0.25}, {1.2, 0.42}, {2, 0.5}, {5, 0.5}, {6, 0}});
  const auto frame = [](double y) {
    const double out = std::abs(y), x = out < 1 ? 1.5 + 0.7 * out : 2.2 + 0.2 * (out - 1);
    return straight(gp_Pnt(x, y, out < 1 ? 0 : 0.2 * (out - 1)), out < 1 ? 1.4 - 0.7 * out : 0.7 - 0.3 * (out - 1));
  };
  return fuse(body, loft({.thickness = 0.06}, {frame(-2), frame(-1), frame(0), frame(1), frame(2)}));
}

/// Cut along the nose and 1 and 3 % of the chord behind it, on both sides.
TopoDS_Shape split_nose() {
  return loft({.cuts = {0.03, 0.01, 0, -0.01, -0.03}},
              {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(0.8, 4, 0), 0.6)});
}

/// A slot with parallel walls from the lower side to the upper one behind the nose: a fixed slat.
TopoDS_Shape fixed_slat() {
  const TopoDS_Shape slot = moved(box(0.1, 0.8, -1, 0.015, 2.4, 2),
                                  [](gp_Trsf& t) { t.SetRotation(gp_Ax1(gp_Pnt(0.1, 0, 0), gp::DY()), 0.9); });
  return cut(wing_of_four({}), slot);
}

/// A cove under the nose of a flap: the lower skin before it is taken away.
TopoDS_Shape cove_wing() { return cut(wing_of_four(kBlunt), box(0.75, 0.9, -1, 0.12, 2.2, 1.005)); }

// --- trailing edges that are no line ---

/// Span 4, chord 1, with the profile's tail stretched by 0.1 at every second section: sharp flanks of 34 degrees.
TopoDS_Shape serrated_wing() {
  constexpr int kTeeth = 12;
  std::vector<Frame> frames;
  for (int i = 0; i <= 2 * kTeeth; ++i)
    frames.push_back(straight(gp_Pnt(0, 4.0 * i / (2 * kTeeth), 0), i % 2 ? 1.1 : 1));
  return loft({}, frames);
}

/// The same outline cut from a blunt wing: flanks have bases whose width grows to the notches.
TopoDS_Shape serrated_by_cuts(double depth) {
  constexpr int kTeeth = 12;
  constexpr double kPitch = 4.0 / kTeeth;
  TopoDS_Shape wing = loft(kBlunt, {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(0, 4, 0), 1)});
  for (int i = 0; i < kTeeth; ++i) {
    const double y = kPitch * (i + 0.5);
    BRepBuilderAPI_MakePolygon wire(gp_Pnt(1.1, y - 0.5 * kPitch, -1), gp_Pnt(1.1, y + 0.5 * kPitch, -1),
                                    gp_Pnt(1 - depth, y, -1), true);
    wing = cut(wing, BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), gp_Vec(0, 0, 2)).Shape());
  }
  return wing;
}

/// Five waves along a smooth trailing edge.
TopoDS_Shape wavy_wing() {
  std::vector<Frame> frames;
  for (int i = 0; i <= 40; ++i)
    frames.push_back(straight(gp_Pnt(0, 0.1 * i, 0), 1 + 0.06 * std::sin(2 * M_PI * i / 8)));
  return loft({}, frames, false);
}

/// Its leading edge steps forward at half of the span: a dogtooth.
TopoDS_Shape dogtooth_wing() {
  return fuse(loft({}, {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(0.5, 2, 0), 0.8)}),
              loft({}, {straight(gp_Pnt(0.4, 2, 0), 0.9), straight(gp_Pnt(0.9, 4, 0), 0.6)}));
}

/// Rectangular notches in the trailing edge, as around the tracks of flaps.
TopoDS_Shape notched_wing() {
  TopoDS_Shape wing = loft(kBlunt, {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(0, 4, 0), 1)});
  for (const double y : {0.8, 1.5, 2.9}) wing = cut(wing, box(0.85, y, -1, 0.3, 0.12, 2));
  return wing;
}

/// A strip of 1.5 % of the chord stands below the trailing edge.
TopoDS_Shape gurney_wing() {
  const TopoDS_Shape wing = loft(kBlunt, {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(0, 4, 0), 1)});
  return fuse(wing, box(0.996, 0, -0.017, 0.004, 4, 0.018));
}

/// Two blades of radius 0.15 and chord 0.03 on a hub.
TopoDS_Shape small_fan() {
  std::vector<Frame> frames;
  for (int i = 0; i <= 4; ++i) frames.push_back(straight(gp_Pnt(-0.015, 0, 0.01 + 0.035 * i), 0.03, 90, 60 - 10 * i));
  const TopoDS_Shape blade = loft({.thickness = 0.1}, frames, false);
  const TopoDS_Shape hub = fuselage({{-0.06, 0}, {-0.04, 0.02}, {0, 0.025}, {0.04, 0.02}, {0.06, 0}});
  return fuse_all({hub, blade, turned(blade, gp::DX(), M_PI)});
}

/// Before the wing of an aircraft that is 10 long.
TopoDS_Shape small_propeller() { return compound_of({aircraft(), shifted(small_fan(), gp_Vec(3.2, -2, 0))}); }

/// Behind a hull without any other wing.
TopoDS_Shape hull_with_screw() {
  return compound_of({fuselage({{0, 0}, {0.4, 0.3}, {1.2, 0.47}, {2.5, 0.5}, {6, 0.5}, {8, 0.33}, {9, 0.2}, {9.8, 0}}),
                      shifted(small_fan(), gp_Vec(10, 0, 0))});
}

/// Ten small fins of length 0.03 on a wing.
TopoDS_Shape vortex_generators() {
  TopoDS_Shape wing = loft(kBlunt, {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(0, 4, 0), 1)});
  for (int i = 0; i < 10; ++i) {
    const TopoDS_Shape fin = loft(
        {.thickness = 0.08}, {straight(gp_Pnt(0.2, 0, 0.04), 0.03, 90), straight(gp_Pnt(0.21, 0, 0.075), 0.02, 90)});
    wing = fuse(
        wing,
        shifted(moved(fin, [&](gp_Trsf& t) { t.SetRotation(gp_Ax1(gp_Pnt(0.2, 0, 0), gp::DZ()), i % 2 ? 0.3 : -0.3); }),
                gp_Vec(0, 0.4 * i + 0.2, 0)));
  }
  return wing;
}

/// A sharp wing with a winglet, all edges of both cut at ten planes, each piece turned a little.
TopoDS_Shape split_winglet() {
  TopTools_ListOfShape wing, planes;
  wing.Append(fuse(loft({}, {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(0.6, 4, 0), 0.5)}),
                   loft({}, {straight(gp_Pnt(0.6, 3.99, -0.01), 0.5, 80), straight(gp_Pnt(0.9, 4.1, 0.8), 0.25, 80)})));
  for (int i = 1; i < 10; ++i)
    planes.Append(
        BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(0, 0.41 * i, 0), gp_Dir(0.02 * i, 1, 0.1)), -9, 9, -9, 9).Face());
  for (int i = 1; i < 5; ++i)
    planes.Append(BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(0, 4, 0.15 * i), gp_Dir(0.1, 0, 1)), -9, 9, -9, 9).Face());
  BRepAlgoAPI_Splitter splitter;
  splitter.SetArguments(wing);
  splitter.SetTools(planes);
  splitter.Build();
  return splitter.Shape();
}

// --- machine parts ---

TopoDS_Shape wedge_bracket() {
  const TopoDS_Shape wedge = prism({{0, 0, 0}, {60, 0, 0}, {60, 0, 14}}, 80);
  return cut(fuse(wedge, box(60, 0, -20, 6, 80, 60)), cylinder(gp_Pnt(55, 40, 25), gp::DX(), 5, 20));
}

/// All four edges below 45 degrees.
TopoDS_Shape chamfered_plate() {
  const double a = 60, b = 40, h = 5;
  BRepOffsetAPI_ThruSections thru(true, true);
  for (const auto& [inset, z] : {std::pair(0.0, 0.0), std::pair(h, h)}) {
    BRepBuilderAPI_MakePolygon wire(gp_Pnt(inset, inset, z), gp_Pnt(a - inset, inset, z),
                                    gp_Pnt(a - inset, b - inset, z), gp_Pnt(inset, b - inset, z), true);
    thru.AddWire(wire.Wire());
  }
  thru.Build();
  return cut(thru.Shape(), cylinder(gp_Pnt(30, 20, -1), gp::DZ(), 4, 20));
}

/// A chisel: one end of a plate is sharp.
TopoDS_Shape chisel() { return prism({{0, 0, 0}, {60, 0, 0}, {60, 0, 4}, {8, 0, 4}}, 50); }

/// Slanted slats whose ends are upright.
TopoDS_Shape louvre() {
  TopoDS_Shape all = cut(box(0, 0, 0, 40, 100, 120), box(-1, 6, 6, 50, 88, 108));
  for (int i = 0; i < 6; ++i)
    all = fuse(all, shifted(prism({{2, 0, 0}, {38, 0, 25}, {38, 0, 28}, {2, 0, 3}}, 96), gp_Vec(0, 2, 8 + 15 * i)));
  return all;
}

TopoDS_Shape heat_sink() {
  TopoDS_Shape all = box(0, 0, 0, 60, 80, 6);
  for (int i = 0; i < 6; ++i)
    all = fuse(all, shifted(prism({{0, 0, 0}, {3, 0, 0}, {1.9, 0, 30}, {1.1, 0, 30}}, 80), gp_Vec(5 + 9 * i, 0, 6)));
  return all;
}

/// A ridge of three turns on a bolt: a triangle along a spiral.
TopoDS_Shape thread() {
  BRepOffsetAPI_ThruSections thru(true, false, 1e-4);
  for (int i = 0; i <= 72; ++i) {
    const double angle = M_PI / 12 * i, z = 3 * angle / (2 * M_PI);
    const auto point = [&](double r, double dz) { return gp_Pnt(r * std::cos(angle), r * std::sin(angle), z + dz); };
    thru.AddWire(BRepBuilderAPI_MakePolygon(point(10, -1), point(12, 0), point(10, 1), true).Wire());
  }
  thru.Build();
  return compound_of({cylinder(gp_Pnt(0, 0, -3), gp::DZ(), 9.5, 24), thru.Shape()});
}

TopoDS_Shape gear() {
  std::vector<gp_Pnt> points;
  for (int i = 0; i < 24; ++i) {
    const double angle = M_PI / 12 * i, r = i % 2 ? 30 : 42;
    points.emplace_back(r * std::cos(angle), 0, r * std::sin(angle));
  }
  return cut(prism(points, 50), cylinder(gp_Pnt(0, -1, 0), gp::DY(), 10, 60));
}

/// A bowl with a sharp rim, and a handle.
TopoDS_Shape spoon() {
  const TopoDS_Shape bowl =
      common(cut(ball(gp_Pnt(0, 0, 0), 30), ball(gp_Pnt(0, 0, 3), 30)), box(-40, -40, -40, 80, 80, 41.5));
  return fuse(bowl, box(25, -4, -4, 80, 8, 3));
}

TopoDS_Shape lens() { return common(ball(gp_Pnt(0, 0, -40), 50), ball(gp_Pnt(0, 0, 40), 50)); }

/// A disc with radial ribs that end in a ridge.
TopoDS_Shape cover_plate() {
  TopoDS_Shape all = cut(cylinder(gp_Pnt(0, 0, -4), gp::DZ(), 60, 4.5), cylinder(gp_Pnt(0, 0, -5), gp::DZ(), 15, 10));
  const TopoDS_Shape rib = shifted(prism({{-3, 0, 0}, {3, 0, 0}, {0, 0, 7}}, 35), gp_Vec(0, 20, 0));
  for (int i = 0; i < 8; ++i) all = fuse(all, turned(rib, gp::DZ(), M_PI / 4 * i));
  return all;
}

/// A gusset between two plates, thinner outward.
TopoDS_Shape tapered_rib() {
  BRepOffsetAPI_ThruSections thru(true, true);
  thru.AddWire(
      BRepBuilderAPI_MakePolygon(gp_Pnt(0, -3, 0), gp_Pnt(60, -3, 0), gp_Pnt(60, 3, 0), gp_Pnt(0, 3, 0), true).Wire());
  thru.AddWire(
      BRepBuilderAPI_MakePolygon(gp_Pnt(0, -1, 50), gp_Pnt(5, -1, 50), gp_Pnt(5, 1, 50), gp_Pnt(0, 1, 50), true)
          .Wire());
  thru.Build();
  return fuse_all({thru.Shape(), box(-5, -30, -5, 80, 60, 5), box(-5, -30, -5, 5, 60, 70)});
}

/// A bar whose section is a flat oval, alike at both ends, of one spline.
TopoDS_Shape oval_bar() {
  Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, 24);
  for (int k = 0; k < 24; ++k)
    points->SetValue(k + 1, gp_Pnt(20 * std::cos(M_PI * k / 12), 5 * std::sin(M_PI * k / 12), 0));
  GeomAPI_Interpolate fit(points, true, 1e-9);
  fit.Perform();
  const TopoDS_Wire wire = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(fit.Curve()).Edge()).Wire();
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire).Face(), gp_Vec(0, 0, 120)).Shape();
}

/// A plate with triangular teeth, ground to an edge on one side.
TopoDS_Shape saw() {
  constexpr int kTeeth = 8;
  TopoDS_Shape blade = prism({{0, 0, 0}, {100, 0, 0}, {100, 0, 2}, {95, 0, 2}, {0, 0, 2}}, 160);
  for (int i = 0; i < kTeeth; ++i) {
    BRepBuilderAPI_MakePolygon wire(gp_Pnt(101, 20.0 * i, -1), gp_Pnt(101, 20.0 * (i + 1), -1),
                                    gp_Pnt(88, 20.0 * i + 10, -1), true);
    blade = cut(blade, BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), gp_Vec(0, 3, 5)).Shape());
  }
  return blade;
}

/// A ring with a sharp lip.
TopoDS_Shape seal() {
  const TopoDS_Face face = polygon({{0, 0, 40}, {12, 0, 40}, {12, 0, 46}, {8, 0, 46}});
  return BRepPrimAPI_MakeRevol(face, gp::OX()).Shape();
}

/// The air around a vane of chord 1 between hub and shroud, without roles.
TopoDS_Shape vane_passage() {
  return cut(box(-0.5, -0.4, 0, 2, 0.8, 0.4),
             loft(kBlunt, {straight(gp_Pnt(0, 0, -0.1), 1, 90), straight(gp_Pnt(0, 0, 0.5), 1, 90)}));
}

/// A wedge whose thick end is cut off across, and whose thin one is steeper.
TopoDS_Shape door_stop() {
  return cut(prism({{0, 0, 0}, {100, 0, 0}, {100, 0, 25}, {10, 0, 4}}, 35),
             cylinder(gp_Pnt(80, 17, -1), gp::DZ(), 5, 50));
}

/// A strip with a barb at its end.
TopoDS_Shape snap_hook() {
  return fuse(box(0, 0, 0, 40, 12, 3), prism({{40, 0, 0}, {52, 0, 1.2}, {40, 0, 7}, {38, 0, 3}, {38, 0, 0}}, 12));
}

/// A wedge with a thick back, twisted.
TopoDS_Shape plow() {
  return polygon_loft(
      {{{0, 0, 0}, {45, 0, 12.5}, {50, 0, 12.5}, {50, 0, 0}}, {{20, 60, 0}, {65, 60, 30}, {70, 60, 30}, {70, 60, 0}}});
}

/// A fin with a sharp nose and a base.
TopoDS_Shape wedge_wing() {
  const auto outline_at = [](double x, double y, double chord) {
    std::vector<gp_Pnt> points;
    for (const auto& [dx, z] : {std::pair(0.0, 0.0), {0.35, 0.04}, {1.0, 0.012}, {1.0, -0.012}, {0.35, -0.04}})
      points.emplace_back(x + chord * dx, y, chord * z);
    return points;
  };
  return polygon_loft({outline_at(0, 0, 1.2), outline_at(0.7, 1.2, 0.5)});
}

/// With a hole of a wing's profile, a tenth of its chord deep.
TopoDS_Shape hole_plate() {
  return cut(box(-0.5, -0.5, 0, 2, 1, 0.1),
             loft(kBlunt, {straight(gp_Pnt(0, 0, -0.1), 1, 90), straight(gp_Pnt(0, 0, 0.2), 1, 90)}));
}

/// Round at both ends.
const Makers& round_models() {
  static const Makers all{{"blade_of_one", [] { return round_blade({10}); }},
                          {"blade_of_one_at_tail", [] { return round_blade({0}); }},
                          {"blade_of_one_at_nose", [] { return round_blade({20}); }},
                          {"blade_of_halves",
                           [] {
                             return round_blade({10, 30});
                           }},
                          {"blade_of_splines",
                           [] {
                             return round_blade({0, 20});
                           }},
                          {"oval_blade", oval_blade},
                          {"round_hydrofoil", round_hydrofoil},
                          {"round_propeller", round_propeller},
                          {"small_round_propeller", small_round_propeller},
                          {"round_strut", round_strut},
                          {"round_ring", round_ring},
                          {"round_rudder", round_rudder}};
  return all;
}

/// Trailing edges that are no line, and small parts of large models.
const Makers& rough_models() {
  static const Makers all{{"serrated_wing", serrated_wing},
                          {"serrated_by_cuts", [] { return serrated_by_cuts(0.1); }},
                          {"serrated_shallow", [] { return serrated_by_cuts(0.02); }},
                          {"wavy_wing", wavy_wing},
                          {"dogtooth_wing", dogtooth_wing},
                          {"notched_wing", notched_wing},
                          {"gurney_wing", gurney_wing},
                          {"small_propeller", small_propeller},
                          {"hull_with_screw", hull_with_screw},
                          {"vortex_generators", vortex_generators},
                          {"split_winglet", split_winglet}};
  return all;
}

/// Slots, holes and steps in wings.
const Makers& cut_models() {
  static const Makers all{{"inner_slot", [] { return slotted_wing(1, 3); }},
                          {"tip_slot", [] { return slotted_wing(2, 5); }},
                          {"open_slot", open_slot},
                          {"three_elements", three_elements},
                          {"gapped_aileron", gapped_aileron},
                          {"sawtooth_wing", sawtooth_wing},
                          {"pierced_wing", pierced_wing},
                          {"spoiler_wing", spoiler_wing},
                          {"stepped_wing", stepped_wing},
                          {"wing_with_pod", wing_with_pod},
                          {"cranked_canard", cranked_canard},
                          {"split_nose", split_nose},
                          {"fixed_slat", fixed_slat},
                          {"cove_wing", cove_wing}};
  return all;
}

const Makers& parts() {
  static const Makers all{{"part_bracket", wedge_bracket},
                          {"part_plate", chamfered_plate},
                          {"part_chisel", chisel},
                          {"part_louvre", louvre},
                          {"part_heat_sink", heat_sink},
                          {"part_thread", thread},
                          {"part_gear", gear},
                          {"part_spoon", spoon},
                          {"part_lens", lens},
                          {"part_cover", cover_plate},
                          {"part_rib", tapered_rib},
                          {"part_oval_bar", oval_bar},
                          {"part_saw", saw},
                          {"part_door_stop", door_stop},
                          {"part_snap_hook", snap_hook},
                          {"part_plow", plow},
                          {"part_hole_plate", hole_plate},
                          {"part_seal", seal}};
  return all;
}

const Makers& wings() {
  static const Foil lips{.thickness = 0.1, .base = 0.005, .camber = 0.02, .tail = Tail::kBlunt};
  static const Makers all{
      {"blunt_1", [] { return base_in_pieces(1); }},
      {"blunt_3", [] { return base_in_pieces(3); }},
      {"blunt_40", [] { return base_in_pieces(40); }},
      {"blunt_200", [] { return base_in_pieces(200); }},
      {"base_in_halves", [] { return rectangle({.base = 0.004, .tail = Tail::kBlunt, .base_pieces = 2}); }},
      {"ring_wing", [] { return ring({}, 1.5, 1); }},
      {"ducted_fan", ducted_fan},
      {"impeller", impeller},
      {"hydrofoil", [] { return hydrofoil(0.1); }},
      {"hydrofoil_joined", [] { return hydrofoil(0.2); }},
      {"t_tail", t_tail},
      {"box_wing", box_wing},
      {"rudder", rudder},
      {"two_elements", two_elements},
      {"twisted_wing", twisted_wing},
      {"diamond_wing", diamond_wing},
      {"winglet", blended_winglet},
      {"nacelle", [] { return ring(lips, 0.8, 2); }},
      {"nacelle_c", [] { return ring(lips, 0.8, 2, 5 * M_PI / 3); }},
      {"kinked_wing", kinked_wing},
      {"elliptic_wing", elliptic_wing},
      {"aircraft", aircraft},
      {"wing_with_fairing", wing_with_fairing},
      {"blade_of_four",
       [] {
         return turbine_blade(with_cuts(kTurbine, {0.05, -0.05}));
       }},
      {"blade_of_two", [] { return turbine_blade(with_cuts(kTurbine, {0})); }},
      {"delta_with_edge",
       [] {
         return loft({.thickness = 0.06, .cuts = {0}},
                     {straight(gp_Pnt(0, 0, 0), 4), straight(gp_Pnt(3.8, 2, 0), 0.2)});
       }},
      {"vanes", vanes},
      {"vane_passage", vane_passage},
      {"rocket_fins", rocket_fins},
      {"wedge_wing", wedge_wing},
      {"sail", sail},
      {"plate_sail", [] { return plate_sail(0.006); }},
      {"thick_plate_sail", [] { return plate_sail(0.02); }},
      {"flying_wing", flying_wing},
      {"canard_and_delta", canard_and_delta},
      {"delta", [] {
         return loft({.thickness = 0.06}, {straight(gp_Pnt(0, 0, 0), 4), straight(gp_Pnt(3.8, 2, 0), 0.2)});
       }}};
  return all;
}

Makers models() {
  Makers all = wings();
  for (const Makers* more :
       {&round_models(), &rough_models(), &cut_models(), &rare_models(), &unusual_models(), &late_models(), &parts()})
    all.insert(more->begin(), more->end());
  return all;
}

void write(const TopoDS_Shape& shape, const std::string& path) {
  if (shape.IsNull() || !TopExp_Explorer(shape, TopAbs_FACE).More()) throw std::runtime_error("nothing made");
  if (!BRepTools::Write(shape, path.c_str())) throw std::runtime_error("cannot write " + path);
}

void run(const std::vector<std::string>& a) {
  if (a.empty())
    for (const auto& [name, maker] : models()) std::puts(name.c_str());
  else if (a.size() == 2 && models().contains(a[0]))
    write(models().at(a[0])(), a[1]);
  else if (a.size() == 3 && a[0] == "random_wing")
    write(random_wing(static_cast<unsigned>(std::stoul(a[1]))), a[2]);
  else
    throw std::runtime_error("usage: wing_models [NAME OUT.brep | random_wing NUMBER OUT.brep]");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run({argv + 1, argv + argc});
    return 0;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "wing_models: %s\n", e.what());
  } catch (const Standard_Failure& e) {
    std::fprintf(stderr, "wing_models: OpenCASCADE failed: %s\n", e.GetMessageString());
  }
  return 1;
}
