#include "job_models.h"

#include <BRepAdaptor_Surface.hxx>
#include <BRepAlgoAPI_BooleanOperation.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRep_Tool.hxx>
#include <ShapeUpgrade_UnifySameDomain.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <cmath>
#include <functional>
#include <gp_Ax2.hxx>
#include <gp_Trsf.hxx>
#include <stdexcept>

#include "../aircraft/lifting_surface.h"
#include "../aircraft/splines.h"

namespace aircraft {
namespace {

constexpr double kDegree = M_PI / 180;
using Curves = std::vector<Handle(Geom_Curve)>;

TopTools_IndexedMapOfShape faces_of(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  return faces;
}

/// Names every face by what `name_of` says.
void name_faces(const TopoDS_Shape& shape, NameTable& names,
                const std::function<std::string(const TopoDS_Face&)>& name_of) {
  const auto faces = faces_of(shape);
  for (int i = 1; i <= faces.Extent(); ++i) names.set(TopoDS::Face(faces(i)), name_of(TopoDS::Face(faces(i))));
}

TopoDS_Shape do_boolean(BRepAlgoAPI_BooleanOperation& operation, const TopoDS_Shape& body,
                        const std::vector<TopoDS_Shape>& others) {
  TopTools_ListOfShape arguments, tools;
  arguments.Append(body);
  for (const TopoDS_Shape& other : others) tools.Append(other);
  operation.SetArguments(arguments);
  operation.SetTools(tools);
  operation.Build();
  if (operation.HasErrors()) throw std::runtime_error("the boolean operation failed");
  TopExp_Explorer solids(operation.Shape(), TopAbs_SOLID);
  return solids.More() ? solids.Current() : operation.Shape();
}

TopoDS_Shape unite(const TopoDS_Shape& body, const std::vector<TopoDS_Shape>& others) {
  BRepAlgoAPI_Fuse fuse;
  return do_boolean(fuse, body, others);
}

TopoDS_Shape subtract(const TopoDS_Shape& body, const std::vector<TopoDS_Shape>& others) {
  BRepAlgoAPI_Cut cut;
  return do_boolean(cut, body, others);
}

TopoDS_Shape cylinder(const gp_Pnt& at, const gp_Dir& along, double radius, double height) {
  return BRepPrimAPI_MakeCylinder(gp_Ax2(at, along), radius, height).Shape();
}

TopoDS_Shape box(const gp_Pnt& a, const gp_Pnt& b) { return BRepPrimAPI_MakeBox(a, b).Shape(); }

// -------------------------------------------------------------------------------- propeller

/// Blade along y, axis of rotation x: pitch of 0.42 m, skewed back, from inside the hub to the tip.
TopoDS_Shape make_blade(NameTable& names) {
  constexpr double kRoot = 0.02, kTip = 0.2, kPitch = 0.42;
  Panel panel;
  panel.parameters = linspace(kRoot, kTip, 13);
  for (double r : panel.parameters) {
    const double t = (r - kRoot) / (kTip - kRoot), turn = std::atan2(kPitch, 2 * M_PI * std::max(r, 0.045));
    Section s;
    s.chord = 0.052 + 0.24 * t * (1 - t) * (0.35 + 0.65 * t);
    s.thickness = 0.2 - 0.155 * std::pow(t, 0.6);
    s.camber = 0.025 * t;
    s.twist = M_PI / 2 - turn;  // chord against the plane of rotation
    s.trailing_edge = 0.02;
    const double skew = 0.03 * t * t - 0.01 * t;  // along the chord
    const double back = skew - 0.5 * s.chord;
    s.leading_edge = gp_Pnt(back * std::cos(s.twist), r, -back * std::sin(s.twist));
    panel.sections.push_back(s);
  }
  panel.span_splits = {kRoot, kTip};
  Patchwork patches(names);
  const PanelRims rims = add_panel(patches, panel, {}, "blade");
  patches.add_planar(rims.first, "blade_root");
  patches.add_planar(rims.last, "blade_tip");
  return patches.solid("blade");
}

/// A copy turned about x, its faces named as those of the original.
TopoDS_Shape turned(const TopoDS_Shape& shape, double angle, NameTable& names) {
  gp_Trsf turn;
  turn.SetRotation(gp::OX(), angle);
  const TopoDS_Shape copy = BRepBuilderAPI_Transform(shape, turn, /*Copy=*/true).Shape();
  const auto from = faces_of(shape), to = faces_of(copy);
  for (int i = 1; i <= to.Extent(); ++i) names.set(TopoDS::Face(to(i)), names.of(TopoDS::Face(from(i))));
  return copy;
}

TopoDS_Shape make_hub(NameTable& names) {
  constexpr double kRadius = 0.04, kFore = -0.05, kAft = 0.05, kCone = 0.06;
  std::vector<Ellipse> sections;
  const auto steps = linspace(0, 1, 17);
  for (double p : steps) {
    const double radius = p == 1 ? 0.0 : kRadius * std::cos(0.5 * M_PI * p);
    sections.push_back({kAft + kCone * std::sin(0.5 * M_PI * p), radius, radius, 0, 0});
  }
  Patchwork patches(names);
  const auto straight = linspace(kFore, kAft, 4);
  std::vector<Ellipse> tube;
  for (double x : straight) tube.push_back({x, kRadius, kRadius, 0, 0});
  Curves base;
  for (int i = 0; i < 4; ++i) {
    const double a = (45 + 90 * i) * kDegree, b = a + 90 * kDegree;
    patches.add(elliptic_sector(sections, CubicInterpolation(steps), a, b), "hub_cone");
    const auto side = elliptic_sector(tube, CubicInterpolation(straight), a, b);
    patches.add(side, "hub");
    base.push_back(side->VIso(kFore));
  }
  patches.add_planar(base, "hub_front");
  return patches.solid("hub");
}

// -------------------------------------------------------------------------------- hull

/// Point of the skin at t in [0, 1] from stem to transom and s in [0, 1] from keel to deck.
gp_Pnt hull_point(double t, double s) {
  constexpr double kLength = 120, kDraught = 7, kDepth = 11, kHalfBreadth = 9;
  const double level = 0.3 * s + 0.7 * s * s, upright = -kDraught + kDepth * level;
  const double bulb = std::exp(-std::pow((upright + 3.8) / 1.9, 2));
  const double stem = -4.5 * bulb - (upright > 0 ? 0.2 * upright * upright : 0.0);
  const double along = 0.05 * t + 0.95 * (1 - std::cos(0.5 * M_PI * t)), x = stem + (kLength - stem) * along;
  const double aft = smoothstep((along - 0.55) / 0.45);
  const double rise = 0.55 * kDepth * aft * aft;                                // of the keel, towards the transom
  const double roundness = 2 + 9 * smoothstep(along / 0.35) * (1 - 0.5 * aft);  // V-shaped at the stem, full midships
  const double section = 1 - std::pow(1 - level, roundness);
  const double outline = std::tanh(4.2 * along) * (1 - 0.25 * std::pow(along, 4));
  const double nose = (0.3 + 1.6 * bulb) * std::tanh(along / 0.012) * std::exp(-std::pow(along / 0.06, 2));
  return gp_Pnt(x, (kHalfBreadth * outline + nose) * section, upright + rise * (1 - level));
}

}  // namespace

TopoDS_Shape make_propeller(NameTable& names) {
  const TopoDS_Shape blade = make_blade(names);
  std::vector<TopoDS_Shape> blades = {blade};
  for (int i = 1; i < 4; ++i) blades.push_back(turned(blade, 90 * i * kDegree, names));
  return unite(make_hub(names), blades);
}

TopoDS_Shape make_hull(NameTable& names) {
  std::vector<std::vector<gp_Pnt>> rows;
  const auto t = linspace(0, 1, 49), s = linspace(0, 1, 25);
  for (double height : s) {
    rows.emplace_back();
    for (double station : t) rows.back().push_back(hull_point(station, height));
  }
  const auto surface = skin(rows, CubicInterpolation(t), CubicInterpolation(s));
  const Handle(Geom_Curve) end = surface->UIso(1);
  const gp_Pnt keel = end->Value(0), side = end->Value(1), deck(side.X(), 0, side.Z());
  Patchwork patches(names);
  patches.add(surface, "hull");
  patches.add_planar({end, line(side, deck), line(deck, keel)}, "transom");
  return patches.open_shell();
}

// -------------------------------------------------------------------------------- cascade

TopoDS_Shape make_cascade(NameTable& names) {
  constexpr double kChord = 0.08, kSpan = 0.1, kPitch = 0.06;
  Panel panel;
  panel.parameters = linspace(-0.1 * kSpan, 1.1 * kSpan, 7);
  for (double y : panel.parameters) {
    Section s;
    s.chord = kChord;
    s.thickness = 0.16 - 0.3 * (y / kSpan) * 0.1;
    s.camber = 0.14;
    s.trailing_edge = 0.02;
    s.twist = (22 - 6 * y / kSpan) * kDegree;
    s.leading_edge = gp_Pnt(0, y, 0.03);
    panel.sections.push_back(s);
  }
  panel.span_splits = {panel.parameters.front(), panel.parameters.back()};
  Patchwork vane(names);
  const PanelRims rims = add_panel(vane, panel, {}, "vane");
  vane.add_planar(rims.first, "vane_end");
  vane.add_planar(rims.last, "vane_end");

  // the passage: its sides follow the flow, half a pitch below and above
  const auto along = linspace(0, 1, 21);
  const auto flow_line = [](double x) {  // level at first, along the vane's mean line, then straight on
    const double c = std::clamp(x / kChord, 0.0, 1.0), beyond = std::max(0.0, x - kChord);
    return 0.03 + kChord * (0.14 * 4 * c * (1 - c) * 0.5 - 0.36 * c * c) - 0.75 * beyond;
  };
  std::vector<std::vector<gp_Pnt>> below(4), above(4);
  const auto heights = linspace(0, kSpan, 4);
  for (int j = 0; j < 4; ++j)
    for (double t : along) {
      const double x = -kChord + 3 * kChord * t, z = flow_line(x);
      below[j].push_back(gp_Pnt(x, heights[j], z - 0.5 * kPitch));
      above[j].push_back(gp_Pnt(x, heights[j], z + 0.5 * kPitch));
    }
  const CubicInterpolation u(along), v(heights);
  const auto low = skin(below, u, v), high = skin(above, u, v);
  Patchwork air(names);
  air.add(low, "periodic_low");
  air.add(high, "periodic_high");
  const auto across = [&](double t, double y) { return line(low->Value(t, y), high->Value(t, y)); };
  air.add_planar({low->VIso(0), across(1, 0), high->VIso(0), across(0, 0)}, "hub");
  air.add_planar({low->VIso(kSpan), across(1, kSpan), high->VIso(kSpan), across(0, kSpan)}, "shroud");
  for (double t : {0.0, 1.0})
    air.add_planar({low->UIso(t), across(t, kSpan), high->UIso(t), across(t, 0)}, t == 0 ? "inlet" : "outlet");
  return subtract(air.solid("passage"), {vane.solid("vane")});
}

// -------------------------------------------------------------------------------- machine parts

namespace {

TopoDS_Shape filleted(const TopoDS_Shape& shape, double radius, const std::function<bool(const gp_Pnt&)>& is_wanted) {
  BRepFilletAPI_MakeFillet fillet(shape);
  TopTools_IndexedMapOfShape edges;
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  for (int i = 1; i <= edges.Extent(); ++i) {
    double first = 0, last = 0;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(TopoDS::Edge(edges(i)), first, last);
    if (!curve.IsNull() && is_wanted(curve->Value(0.5 * (first + last)))) fillet.Add(radius, TopoDS::Edge(edges(i)));
  }
  fillet.Build();
  if (!fillet.IsDone()) throw std::runtime_error("the fillet failed");
  return fillet.Shape();
}

TopoDS_Shape unified(const TopoDS_Shape& shape) {
  ShapeUpgrade_UnifySameDomain unify(shape);
  unify.Build();
  return unify.Shape();
}

double radius_of(const TopoDS_Face& face) {
  const BRepAdaptor_Surface surface(face);
  return surface.GetType() == GeomAbs_Cylinder ? surface.Cylinder().Radius() : 0;
}

}  // namespace

TopoDS_Shape make_bracket(NameTable& names) {
  constexpr double kBore = 20, kHole = 5.5;
  const gp_Dir up(0, 0, 1), across(0, 1, 0);
  TopoDS_Shape body = box({-60, -35, 0}, {60, 35, 12});
  body = unite(body, {box({-32, -12, 12}, {32, 12, 70}), cylinder({0, -22, 70}, across, 34, 44)});
  body = unified(body);
  // the upright meets the base
  body = filleted(body, 6, [](const gp_Pnt& p) {
    return std::abs(p.Z() - 12) < 1e-6 && std::abs(p.X()) < 33 && std::abs(p.Y()) < 13;
  });
  // corners of the base
  body = filleted(body, 12, [](const gp_Pnt& p) {
    return std::abs(std::abs(p.X()) - 60) < 1e-6 && std::abs(std::abs(p.Y()) - 35) < 1e-6;
  });
  std::vector<TopoDS_Shape> holes = {cylinder({0, -30, 70}, across, kBore, 60)};
  for (double x : {-47.0, 47.0})
    for (double y : {-22.0, 22.0}) holes.push_back(cylinder({x, y, -1}, up, kHole, 20));
  holes.push_back(cylinder({0, 0, 85}, up, 3, 30));  // for oil
  body = subtract(body, holes);
  name_faces(body, names, [](const TopoDS_Face& face) -> std::string {
    const double r = radius_of(face);
    if (r == kBore) return "bore";
    if (r == kHole) return "bolt_holes";
    const BRepAdaptor_Surface surface(face);
    if (surface.GetType() == GeomAbs_Plane && std::abs(surface.Plane().Location().Z()) < 1e-9 &&
        std::abs(surface.Plane().Axis().Direction().Z()) > 0.9)
      return "foot";
    return r == 6 ? "fillets" : "body";
  });
  return body;
}

TopoDS_Shape make_tee(NameTable& names) {
  const gp_Dir along(1, 0, 0), up(0, 0, 1);
  TopoDS_Shape body = unite(cylinder({-90, 0, 0}, along, 25, 180), {cylinder({0, 0, 0}, up, 18, 80)});
  body = filleted(body, 5, [](const gp_Pnt& p) { return std::abs(p.X()) < 30 && p.Z() > 1 && p.Z() < 40; });
  body = unite(body, {cylinder({-90, 0, 0}, along, 42, 10), cylinder({80, 0, 0}, along, 42, 10),
                      cylinder({0, 0, 70}, up, 34, 10)});
  body = subtract(body, {cylinder({-91, 0, 0}, along, 20, 182), cylinder({0, 0, 0}, up, 14, 90)});
  name_faces(body, names, [](const TopoDS_Face&) { return std::string("tee"); });
  return body;
}

}  // namespace aircraft
