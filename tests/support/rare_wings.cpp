#include "rare_wings.h"

#include <BRepAlgoAPI_Section.hxx>
#include <BRepAlgoAPI_Splitter.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <TopTools_ListOfShape.hxx>
#include <cmath>
#include <gp_Ax2.hxx>
#include <vector>

#include "geometry/brep/compound.h"

namespace st::wing_models {

using occt::compound_of;

namespace {

TopoDS_Shape wing_of_four(const Foil& foil) {
  return loft(foil, {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(0, 4, 0), 1)});
}

/// At y = `y` and z = `z`, thickest where the list has its largest radius.
TopoDS_Shape pod(double x, double y, double z, double length, double radius) {
  return shifted(fuselage({{0, 0},
                           {0.1 * length, 0.6 * radius},
                           {0.3 * length, radius},
                           {0.6 * length, radius},
                           {0.85 * length, 0.6 * radius},
                           {length, 0}}),
                 gp_Vec(x, y, z));
}

/// The other half of what stands at y > 0.
TopoDS_Shape mirrored(const TopoDS_Shape& shape) {
  return moved(shape, [](gp_Trsf& t) { t.SetMirror(gp_Ax2(gp_Pnt(), gp::DY())); });
}

/// A rear wing, swept forward, ends on the front one.
TopoDS_Shape joined_wing() {
  return fuse(loft({}, {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(1.8, 3, 0), 0.5)}),
              loft({}, {straight(gp_Pnt(3.6, 0, 0.9), 0.7), straight(gp_Pnt(1.7, 2.7, 0), 0.4)}));
}

TopoDS_Shape gull_wing() {
  return loft({},
              {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(0.1, 1, 0.4), 0.9), straight(gp_Pnt(0.4, 3, 0.1), 0.5)});
}

TopoDS_Shape canards_and_v_tail() {
  const auto body = fuselage({{0, 0}, {0.5, 0.25}, {1.2, 0.4}, {4, 0.4}, {5.2, 0.25}, {6, 0}});
  const auto canard =
      loft({.thickness = 0.08}, {straight(gp_Pnt(1.5, 0, 0), 0.8, 15), straight(gp_Pnt(1.9, 1.5, 0.4), 0.4, 15)});
  const auto tail =
      loft({.thickness = 0.1}, {straight(gp_Pnt(4.2, 0, 0), 0.9, 45), straight(gp_Pnt(4.8, 1.1, 1.1), 0.5, 45)});
  return fuse_all({body, canard, mirrored(canard), tail, mirrored(tail)});
}

TopoDS_Shape keel_with_bulb() {
  return fuse(loft({.thickness = 0.1, .base = 0.008, .tail = Tail::kBlunt},
                   {straight(gp_Pnt(0, 0, 0), 0.8, 90), straight(gp_Pnt(0.4, 0, -2), 0.5, 90)}),
              pod(0, 0, -2, 1.5, 0.15));
}

/// Two blades whose tips are swept back and bent down.
TopoDS_Shape swept_tip_rotor() {
  std::vector<Frame> frames;
  for (int i = 0; i <= 18; ++i) {
    const double y = 0.1 + 0.05 * i, out = y > 0.8 ? (y - 0.8) / 0.2 : 0, bent = out * out;
    frames.push_back(straight(gp_Pnt(0.07 * bent, y, -0.02 * bent), 0.08 - 0.03 * bent, -12 * out, 4 - 4 * y));
  }
  const TopoDS_Shape blade = loft({.thickness = 0.1}, frames, false);
  return fuse_all({cylinder(gp_Pnt(0.04, 0, -0.05), gp::DZ(), 0.15, 0.1), blade,
                   shifted(turned(blade, gp::DZ(), M_PI), gp_Vec(0.08, 0, 0))});
}

/// A pylon from the core of an engine through its nacelle to the wing.
TopoDS_Shape engine_with_core() {
  const TopoDS_Shape nacelle = shifted(ring({.thickness = 0.1}, 0.35, 0.9), gp_Vec(-0.5, 2, -0.6));
  const TopoDS_Shape pylon =
      loft({.thickness = 0.06}, {straight(gp_Pnt(-0.3, 2, -0.6), 0.8, 90), straight(gp_Pnt(-0.3, 2, 0), 0.8, 90)});
  return fuse_all({wing_of_four({}), pylon, nacelle, pod(-0.4, 2, -0.6, 1.1, 0.15)});
}

/// Fairings of flap tracks: they reach out behind the trailing edge.
TopoDS_Shape flap_tracks() {
  TopoDS_Shape wing = wing_of_four(kBlunt);
  for (const double y : {0.8, 2.0, 3.1}) wing = fuse(wing, pod(0.6, y, -0.02, 0.6, 0.03));
  return wing;
}

/// Along a spiral about the z axis from radius 0.4 to 1.
Frame spiral(double turn, double z) {
  const auto middle = [=](double x) {
    const double r = 0.4 + 0.6 * x, angle = turn * x;
    return gp_Pnt(r * std::cos(angle), r * std::sin(angle), z);
  };
  return along_line(middle, 0.6);
}

/// Six blades between two discs.
TopoDS_Shape closed_impeller() {
  TopoDS_Shape all = cylinder(gp_Pnt(0, 0, -0.05), gp::DZ(), 1.02, 0.05);
  const TopoDS_Shape blade = loft({.thickness = 0.08}, {spiral(1, -0.02), spiral(1, 0.27)});
  for (int i = 0; i < 6; ++i) all = fuse(all, turned(blade, gp::DZ(), M_PI / 3 * i));
  const TopoDS_Shape shroud =
      cut(cylinder(gp_Pnt(0, 0, 0.25), gp::DZ(), 1.02, 0.05), cylinder(gp_Pnt(0, 0, 0.2), gp::DZ(), 0.35, 0.2));
  return fuse(all, shroud);
}

/// A turbine with upright blades, two struts to each.
TopoDS_Shape h_rotor() {
  const TopoDS_Shape blade =
      loft({.thickness = 0.18}, {straight(gp_Pnt(-0.05, 1, -1), 0.2, 90), straight(gp_Pnt(-0.05, 1, 1), 0.2, 90)});
  std::vector<TopoDS_Shape> all = {cylinder(gp_Pnt(0.02, 0, -1.2), gp::DZ(), 0.08, 2.4)};
  for (int i = 0; i < 3; ++i) {
    const double angle = 2 * M_PI * i / 3;
    all.push_back(turned(blade, gp::DZ(), angle));
    for (const double z : {-0.5, 0.5})
      all.push_back(
          turned(loft({.thickness = 0.15}, {straight(gp_Pnt(-0.03, 0, z), 0.1), straight(gp_Pnt(-0.03, 1, z), 0.1)}),
                 gp::DZ(), angle));
  }
  return fuse_all(all);
}

/// Plates around the profile, before its nose and behind its trailing edge.
TopoDS_Shape fenced_wing() {
  TopoDS_Shape wing = wing_of_four({});
  for (const double y : {1.2, 2.6}) wing = fuse(wing, box(-0.02, y, -0.1, 1.05, 0.006, 0.22));
  return wing;
}

/// The air between two walls around a wing.
TopoDS_Shape tunnel_wing() {
  return cut(box(-3, 0, -2, 8, 4, 4), loft({}, {straight(gp_Pnt(0, -1, 0), 1), straight(gp_Pnt(0, 5, 0), 1)}));
}

/// A winglet that carries another wing inward.
TopoDS_Shape c_wing() {
  return loft({}, {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(0.3, 3, 0), 0.6, 45),
                   straight(gp_Pnt(0.5, 3, 0.8), 0.4, 135), straight(gp_Pnt(0.6, 2.2, 0.8), 0.3, 180)});
}

/// Winglets up and down.
TopoDS_Shape scimitar_tips() {
  return fuse_all({loft({}, {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(0.5, 3, 0), 0.5)}),
                   loft({.thickness = 0.1},
                        {straight(gp_Pnt(0.5, 2.98, -0.02), 0.5, 82), straight(gp_Pnt(0.9, 3.08, 0.7), 0.2, 82)}),
                   loft({.thickness = 0.1},
                        {straight(gp_Pnt(0.55, 2.98, 0.01), 0.4, 98), straight(gp_Pnt(0.8, 3.06, -0.4), 0.15, 98)})});
}

/// The base of a wing, cut at random places, some a thousandth of the chord apart.
TopoDS_Shape random_base() {
  TopTools_ListOfShape wing, lines;
  wing.Append(wing_of_four(kBlunt));
  unsigned state = 7;
  const auto random = [&] { return (state = state * 1103515245 + 12345, (state >> 8 & 0xffff) / 65536.0); };
  const auto add = [&](double y) { lines.Append(line(gp_Pnt(1, y, -0.002), gp_Pnt(1, y, 0.002))); };
  for (int i = 0; i < 57; ++i) {
    const double y = 0.01 + 3.97 * random();
    add(y);
    if (i % 5 == 0) add(y + 0.001);
  }
  BRepAlgoAPI_Splitter splitter;
  splitter.SetArguments(wing);
  splitter.SetTools(lines);
  splitter.Build();
  return splitter.Shape();
}

/// Cut off at 80 % of its chord, not across.
TopoDS_Shape cut_tail() {
  return cut(wing_of_four({}), moved(box(0.8, -1, -1, 1, 6, 2),
                                     [](gp_Trsf& t) { t.SetRotation(gp_Ax1(gp_Pnt(0.8, 0, 0), gp::DY()), 0.2); }));
}

/// Its leading edge has bumps like a whale's flipper.
TopoDS_Shape tubercle_wing() {
  std::vector<Frame> frames;
  for (int i = 0; i <= 48; ++i) {
    const double x = -0.05 * std::cos(2 * M_PI * i / 8);
    frames.push_back(straight(gp_Pnt(x, 4.0 * i / 48, 0), 1 - x));
  }
  return loft({.thickness = 0.15}, frames, false);
}

TopoDS_Shape double_delta() {
  const auto f = [](double x, double y, double c) { return straight(gp_Pnt(x, y, 0), c); };
  return loft({.thickness = 0.05},
              {f(4.6, -2.6, 0.4), f(2.8, -0.8, 2.2), f(0, 0, 5), f(2.8, 0.8, 2.2), f(4.6, 2.6, 0.4)});
}

/// A tail between two fins on booms.
TopoDS_Shape twin_boom() {
  const TopoDS_Shape half =
      fuse(pod(0.3, 1, 0, 3.4, 0.08),
           loft({.thickness = 0.1}, {straight(gp_Pnt(3, 1, 0), 0.5, 90), straight(gp_Pnt(3.15, 1, 0.8), 0.3, 90)}));
  return fuse_all(
      {loft({}, {straight(gp_Pnt(0, -3, 0), 1), straight(gp_Pnt(0, 3, 0), 1)}), half, mirrored(half),
       loft({.thickness = 0.1}, {straight(gp_Pnt(3.08, -1, 0.4), 0.33), straight(gp_Pnt(3.08, 1, 0.4), 0.33)})});
}

/// A duct on four struts.
TopoDS_Shape duct_on_struts() {
  TopoDS_Shape all =
      fuse(ring({.thickness = 0.15, .base = 0.01, .tail = Tail::kBlunt}, 0.6, 0.5), pod(-0.2, 0, 0, 1, 0.15));
  const TopoDS_Shape strut = loft({.base = 0.02, .tail = Tail::kBlunt},
                                  {straight(gp_Pnt(0.15, 0, 0), 0.2, 90), straight(gp_Pnt(0.15, 0, 0.6), 0.2, 90)});
  for (int i = 0; i < 4; ++i) all = fuse(all, turned(strut, gp::DX(), M_PI / 2 * i));
  return all;
}

/// Its base has a kink, and tapers with the chord.
TopoDS_Shape forward_swept_wing() {
  return loft({.base = 0.008, .tail = Tail::kBlunt},
              {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(-0.35, 1.2, 0), 0.7), straight(gp_Pnt(-1, 3, 0.1), 0.45)});
}

/// A strip along the root is thicker and longer than the wing.
TopoDS_Shape root_strip_wing() {
  return loft({{{.thickness = 0.18}, straight(gp_Pnt(-0.08, 0, 0), 1.08)},
               {{.thickness = 0.14}, straight(gp_Pnt(-0.02, 0.05, 0), 1.02)},
               {{.thickness = 0.12}, straight(gp_Pnt(0, 0.12, 0), 1)},
               {{.thickness = 0.12}, straight(gp_Pnt(0, 4, 0), 1)}});
}

/// Wings whose noses run on into strakes along a body.
TopoDS_Shape ogive_strake() {
  const auto f = [](double x, double y) { return straight(gp_Pnt(x, y, 0), 5 - x); };
  const auto half =
      loft({.thickness = 0.04}, {f(0.8, 0), f(1.3, 0.35), f(2.3, 0.5), f(3, 0.7), f(3.4, 1), f(4.4, 2.2)});
  return fuse_all({fuselage({{0, 0}, {0.8, 0.25}, {1.5, 0.3}, {6, 0.3}}), half, mirrored(half)});
}

/// The air around a vane that leans and turns from wall to wall.
TopoDS_Shape bowed_vane_air() {
  std::vector<Frame> frames;
  for (int i = 0; i <= 6; ++i) {
    const double z = -0.1 + 0.1 * i, s = (z - 0.2) / 0.2;
    frames.push_back(straight(gp_Pnt(0, 0.05 * s * s, z), 1, 90, 10 * s));
  }
  const Foil foil{.thickness = 0.14, .base = 0.012, .camber = 0.06, .tail = Tail::kBlunt};
  return cut(box(-0.6, -0.6, 0, 2.2, 1.2, 0.4), loft(foil, frames, false));
}

/// A curved line about at 30 % of its chord cuts both sides.
TopoDS_Shape curved_cut_wing() {
  const TopoDS_Shape wing = wing_of_four({});
  const auto arc = GC_MakeArcOfCircle(gp_Pnt(0.3, -0.1, -1), gp_Pnt(0.36, 2, -1), gp_Pnt(0.28, 4.1, -1)).Value();
  const TopoDS_Shape wall = BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeEdge(arc).Edge(), gp_Vec(0, 0, 2)).Shape();
  TopTools_ListOfShape arguments, tools;
  arguments.Append(wing);
  tools.Append(BRepAlgoAPI_Section(wing, wall).Shape());
  BRepAlgoAPI_Splitter splitter;
  splitter.SetArguments(arguments);
  splitter.SetTools(tools);
  splitter.Build();
  return splitter.Shape();
}

/// Its tip is wider than the blade, then swept to a point that droops.
TopoDS_Shape paddle_blade() {
  const auto f = [](double x, double y, double c, double droop) {
    return straight(gp_Pnt(x, y, -droop), c, 0, 6 - 6 * y);
  };
  return loft({.thickness = 0.11},
              {f(0, 0.15, 0.08, 0), f(0, 0.8, 0.08, 0), f(-0.02, 0.84, 0.105, 0), f(-0.015, 0.9, 0.105, 0.002),
               f(0.03, 0.98, 0.06, 0.008), f(0.06, 1, 0.025, 0.012)});
}

/// Two blades that are loops from the hub to the hub.
TopoDS_Shape loop_propeller() {
  const auto middle = [](double s) {
    const double angle = 1.6 * (s - 0.5), r = 0.08 + 0.9 * std::sin(M_PI * s);
    return gp_Pnt(0.3 * (s - 0.5), r * std::sin(angle), r * std::cos(angle));
  };
  std::vector<Frame> frames;
  for (int i = 0; i <= 24; ++i) {
    const double s = i / 24.0;
    const gp_Pnt m = middle(s);
    const gp_Dir along = gp_Vec(middle(s - 1e-4), middle(s + 1e-4));
    const gp_Vec across = gp_Vec(along.Crossed(gp::DX())),
                 chord = 0.16 * (std::cos(0.6) * gp_Vec(across.Crossed(gp_Vec(along))) + std::sin(0.6) * across);
    const gp_Vec up = gp_Vec(along).Crossed(chord);
    frames.emplace_back([=](double x, double h) { return m.Translated((x - 0.5) * chord + h * up); });
  }
  const TopoDS_Shape loop = loft({.thickness = 0.1}, frames, false);
  return fuse_all({pod(-0.4, 0, 0, 0.9, 0.15), loop, turned(loop, gp::DX(), M_PI)});
}

/// Blunt up to half of the span, then sharp.
TopoDS_Shape half_blunt() {
  return fuse(loft({.base = 0.01, .tail = Tail::kBlunt}, {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(0, 2, 0), 1)}),
              loft({}, {straight(gp_Pnt(0, 2, 0), 1), straight(gp_Pnt(0, 4, 0), 1)}));
}

/// Two horns of ice along the nose.
TopoDS_Shape iced_wing() {
  const TopoDS_Shape ice = prism({{0.02, 0, 0.02},
                                  {-0.02, 0, 0.045},
                                  {-0.025, 0, 0.04},
                                  {-0.012, 0, 0},
                                  {-0.025, 0, -0.035},
                                  {-0.02, 0, -0.04},
                                  {0.02, 0, -0.02}},
                                 3);
  return fuse(wing_of_four({}), shifted(ice, gp_Vec(0, 0.5, 0)));
}

/// A swept wing with rime in three stretches of its nose, a smooth cap, a ridge, and a blunt block.
TopoDS_Shape rimed_wing() {
  const auto frame = [](double y) { return straight(gp_Pnt(0.3 * y, y, 0.05 * y), 1 - 0.1 * y, 3); };
  TopoDS_Shape wing = loft({.thickness = 0.12, .camber = 0.02}, {frame(0), frame(4)});
  const auto rime = [&](double from, double to, const std::vector<std::pair<double, double>>& outline) {
    std::vector<std::vector<gp_Pnt>> rings;
    for (const double y : {from, to}) {
      rings.emplace_back();
      for (const auto& [x, h] : outline) rings.back().push_back(frame(y)(x, h));
    }
    wing = fuse(wing, polygon_loft(rings));
  };
  rime(0.4, 1.2, {{0.015, 0.015}, {-0.01, 0.012}, {-0.015, 0}, {-0.01, -0.012}, {0.015, -0.015}});
  rime(1.5, 2.3, {{0.02, 0.02}, {-0.03, 0.012}, {0.02, -0.02}});
  rime(2.7, 3.6, {{0.02, 0.022}, {-0.04, 0.03}, {-0.04, -0.02}, {0.02, -0.018}});
  return wing;
}

/// Canards that hang down and are twisted, on a square body, below a tail of three fins.
TopoDS_Shape canards_and_y_tail() {
  const auto canard = loft({.thickness = 0.07, .camber = 0.01}, {straight(gp_Pnt(0.8, 0.1, 0), 0.7, -20, 2),
                                                                 straight(gp_Pnt(1.5, 1.3, -0.45), 0.25, -20, -2)});
  const auto fin =
      loft({.thickness = 0.08}, {straight(gp_Pnt(4.3, 0.1, 0.1), 0.8, 35), straight(gp_Pnt(4.9, 1.2, 0.9), 0.35, 35)});
  const auto keel =
      loft({.thickness = 0.1}, {straight(gp_Pnt(4.4, 0, 0), 0.7, -90), straight(gp_Pnt(4.7, 0, -0.9), 0.4, -90)});
  return fuse_all({box(0, -0.25, -0.25, 5.6, 0.5, 0.5), canard, mirrored(canard), fin, mirrored(fin), keel});
}

/// A tapered foil with pods at its middle, on its nose, and a longer one at each tip.
TopoDS_Shape foil_with_pods() {
  const auto foil = loft({.thickness = 0.09, .camber = 0.02},
                         {straight(gp_Pnt(0, 0, 0), 0.6, 6), straight(gp_Pnt(0.45, 2, 0.2), 0.2, 6)});
  return fuse_all({foil, mirrored(foil), pod(-0.4, 0, 0, 1.3, 0.1), pod(0, 1, 0.1, 0.8, 0.05),
                   pod(0, -1, 0.1, 0.8, 0.05), pod(0.2, 2, 0.2, 0.8, 0.06), pod(0.2, -2, 0.2, 0.8, 0.06)});
}

/// A swept strut and a foil of two tapered halves that hang down from a short thick bulb.
TopoDS_Shape drooped_foil() {
  const auto half =
      loft({.thickness = 0.12}, {straight(gp_Pnt(0, 0, 0), 0.5, -12), straight(gp_Pnt(0.35, 1.5, -0.32), 0.12, -12)});
  const auto strut =
      loft({.thickness = 0.12}, {straight(gp_Pnt(0.1, 0, 0), 0.4, 90), straight(gp_Pnt(-0.3, 0, 1.2), 0.6, 90)});
  return fuse_all({pod(-0.25, 0, 0, 1.1, 0.14), half, mirrored(half), strut});
}

TopoDS_Shape braced_wing() {
  const auto body = fuselage({{0, 0}, {0.4, 0.3}, {1.2, 0.47}, {2.5, 0.5}, {6, 0.5}, {8, 0.33}, {9.8, 0}});
  const auto wing = loft({}, {straight(gp_Pnt(2.8, 0, 0.3), 1), straight(gp_Pnt(3.1, 4, 0.3), 0.5)});
  const auto strut =
      loft({.thickness = 0.18}, {straight(gp_Pnt(3, 0, -0.4), 0.3), straight(gp_Pnt(3.1, 2, 0.3), 0.25)});
  return fuse_all({body, wing, mirrored(wing), strut, mirrored(strut)});
}

/// A slat along all of a swept wing, a flap along half of it.
TopoDS_Shape swept_elements() {
  const auto element = [](const Foil& foil, double x, double z, double chord, double twist, double to) {
    const auto frame = [&](double y) {
      return straight(gp_Pnt(0.3 * y + x * (1 - y / 6), y, z * (1 - y / 6)), chord * (1 - y / 6), 0, twist);
    };
    return loft(foil, {frame(0), frame(to)});
  };
  return compound_of({element({.thickness = 0.1}, -0.14, -0.09, 0.16, -25, 3), element(kBlunt, 0, 0, 1, 0, 3),
                      element(kBlunt, 0.985, -0.11, 0.3, 25, 1.5)});
}

/// Eight blades, swept back.
TopoDS_Shape propfan() {
  std::vector<Frame> frames;
  for (int i = 0; i <= 6; ++i) {
    const double s = i / 6.0, chord = 0.28 - 0.18 * s * s;
    frames.push_back(straight(gp_Pnt(-0.14 + 0.35 * s * s, 0.1 * s * s, 0.2 + 0.8 * s), chord, 90, 55 - 30 * s));
  }
  const TopoDS_Shape blade = loft({.thickness = 0.05, .camber = 0.02}, frames, false);
  TopoDS_Shape all = pod(-0.7, 0, 0, 1.8, 0.3);
  for (int i = 0; i < 8; ++i) all = fuse(all, turned(blade, gp::DX(), M_PI / 4 * i));
  return all;
}

/// A barrel for a shaft on two struts under a hull.
TopoDS_Shape shaft_brackets() {
  std::vector<TopoDS_Shape> all = {cut(box(-3, -1.5, 0, 7, 3, 0.4), box(-4, -5, 1, 1, 1, 1)),
                                   cylinder(gp_Pnt(-0.1, 0, -1), gp::DX(), 0.12, 0.6)};
  for (const double side : {-1.0, 1.0})
    all.push_back(
        loft({.thickness = 0.2, .base = 0.02, .tail = Tail::kBlunt},
             {straight(gp_Pnt(0, 0, -1), 0.35, side * 60), straight(gp_Pnt(0, side * 0.6, 0.1), 0.35, side * 60)}));
  return fuse_all(all);
}

/// In millimetres, far from the origin, and turned.
TopoDS_Shape far_wing() {
  const TopoDS_Shape wing = loft(kBlunt, {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(0.5, 3, 0), 0.6)});
  return shifted(
      turned(turned(moved(wing, [](gp_Trsf& t) { t.SetScale(gp_Pnt(), 1000); }), gp::DZ(), 0.7), gp::DY(), 1.1),
      gp_Vec(3e4, -2e4, 1e4));
}

/// Nine vanes with round trailing edges between a hub and a shroud.
TopoDS_Shape stator_row() {
  const Foil foil{.thickness = 0.12, .base = 0.02, .camber = 0.08, .tail = Tail::kRound};
  const TopoDS_Shape vane =
      loft(foil, {straight(gp_Pnt(-0.1, 0, 0.55), 0.2, 90, 20), straight(gp_Pnt(-0.1, 0, 1.05), 0.2, 90, 30)});
  std::vector<TopoDS_Shape> all = {
      cut(cylinder(gp_Pnt(-0.3, 0, 0), gp::DX(), 0.6, 0.6), cylinder(gp_Pnt(-0.4, 0, 0), gp::DX(), 0.5, 0.8)),
      cut(cylinder(gp_Pnt(-0.3, 0, 0), gp::DX(), 1.1, 0.6), cylinder(gp_Pnt(-0.4, 0, 0), gp::DX(), 1, 0.8))};
  for (int i = 0; i < 9; ++i) all.push_back(turned(vane, gp::DX(), 2 * M_PI * i / 9));
  return fuse_all(all);
}

/// Each side in eight strips along the span.
TopoDS_Shape strip_wing() {
  return loft({.base = 0.004,
               .tail = Tail::kBlunt,
               .cuts = {0.97, 0.8, 0.6, 0.4, 0.2, 0.05, 0.005, -0.005, -0.05, -0.2, -0.4, -0.6, -0.8, -0.97}},
              {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(0.8, 4, 0), 0.6)});
}

/// Rods stand out of the trailing edge.
TopoDS_Shape wing_with_rods() {
  TopoDS_Shape wing = wing_of_four({});
  for (const double y : {2.0, 2.5, 3.0, 3.4, 3.7})
    wing = fuse(wing, cylinder(gp_Pnt(0.97, y, 0), gp::DX(), 0.004, 0.13));
  return wing;
}

// --- machine parts ---

/// Two circles and their tangents, extruded.
TopoDS_Shape teardrop(double r0, double r1, double length, double height) {
  const double a = std::acos((r0 - r1) / length), c = std::cos(a), s = std::sin(a);
  const gp_Pnt p0(r0 * c, r0 * s, 0), p1(length + r1 * c, r1 * s, 0), q0(r0 * c, -r0 * s, 0),
      q1(length + r1 * c, -r1 * s, 0);
  BRepBuilderAPI_MakeWire wire;
  wire.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(p0, gp_Pnt(-r0, 0, 0), q0).Value()).Edge());
  wire.Add(line(q0, q1));
  wire.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(q1, gp_Pnt(length + r1, 0, 0), p1).Value()).Edge());
  wire.Add(line(p1, p0));
  return BRepPrimAPI_MakePrism(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), gp_Vec(0, 0, height)).Shape();
}

TopoDS_Shape cam() { return cut(teardrop(20, 8, 30, 15), cylinder(gp_Pnt(0, 0, -1), gp::DZ(), 8, 20)); }

/// Long, with eyes at both ends.
TopoDS_Shape lever() {
  TopoDS_Shape arm = teardrop(14, 6, 120, 10);
  for (const auto& [x, r] : {std::pair(0.0, 8.0), {120.0, 3.0}})
    arm = cut(arm, cylinder(gp_Pnt(x, 0, -1), gp::DZ(), r, 20));
  return arm;
}

TopoDS_Shape dovetail() {
  return fuse(box(-40, 0, -12, 80, 120, 12), prism({{-12, 0, 0}, {12, 0, 0}, {20, 0, 14}, {-20, 0, 14}}, 120));
}

TopoDS_Shape funnel() {
  const TopoDS_Face face = polygon({{0, 0, 50}, {40, 0, 10}, {80, 0, 8}, {80, 0, 6}, {39, 0, 8}});
  return BRepPrimAPI_MakeRevol(face, gp::OX()).Shape();
}

/// 1 to 20.
TopoDS_Shape shim() { return prism({{0, 0, 0}, {100, 0, 0}, {100, 0, 5.3}, {0, 0, 0.3}}, 40); }

TopoDS_Shape pulley() {
  return BRepPrimAPI_MakeRevol(
             polygon(
                 {{0, 0, 8}, {20, 0, 8}, {20, 0, 60}, {18, 0, 60}, {12, 0, 45}, {8, 0, 45}, {2, 0, 60}, {0, 0, 60}}),
             gp::OX())
      .Shape();
}

/// Radial plates on a disc, thinner outward.
TopoDS_Shape fan_disc() {
  TopoDS_Shape all = cylinder(gp_Pnt(0, 0, 0), gp::DZ(), 60, 3);
  const TopoDS_Shape plate = polygon_loft({{{10, -1.5, 2}, {10, 1.5, 2}, {58, 0.8, 2}, {58, -0.8, 2}},
                                           {{12, -1, 20}, {12, 1, 20}, {58, 0.4, 16}, {58, -0.4, 16}}});
  for (int i = 0; i < 10; ++i) all = fuse(all, turned(plate, gp::DZ(), M_PI / 5 * i));
  return all;
}

/// Curved, thinner to both ends.
TopoDS_Shape leaf_spring() {
  std::vector<gp_Pnt> upper, lower;
  for (int i = 0; i <= 10; ++i) {
    const double x = 20.0 * i - 100, z = 0.002 * x * x, h = 5 - 0.04 * std::abs(x);
    upper.emplace_back(x, 0, z + h);
    lower.insert(lower.begin(), gp_Pnt(x, 0, z));
  }
  upper.insert(upper.end(), lower.begin(), lower.end());
  return prism(upper, 30);
}

/// Two flutes around a core.
TopoDS_Shape drill() {
  std::vector<std::vector<gp_Pnt>> outlines;
  for (int i = 0; i <= 24; ++i) {
    const double a = 0.25 * i;
    std::vector<gp_Pnt> points;
    for (const auto& [r, angle] : {std::pair(5.0, 0.0), {5.0, 0.3}, {2.2, 1.2}, {2.0, 2.2}, {3.0, 2.8}})
      for (int k = 0; k < 1; ++k) points.emplace_back(r * std::cos(a + angle), r * std::sin(a + angle), 2.5 * i);
    for (const auto& [r, angle] : {std::pair(5.0, 0.0), {5.0, 0.3}, {2.2, 1.2}, {2.0, 2.2}, {3.0, 2.8}})
      points.emplace_back(-r * std::cos(a + angle), -r * std::sin(a + angle), 2.5 * i);
    outlines.push_back(points);
  }
  return polygon_loft(outlines);
}

/// A frame whose inner border is sharp.
TopoDS_Shape bezel() {
  return cut(box(0, 0, 0, 100, 80, 6), polygon_loft({{{10, 10, 0}, {90, 10, 0}, {90, 70, 0}, {10, 70, 0}},
                                                     {{25, 25, 6}, {75, 25, 6}, {75, 55, 6}, {25, 55, 6}}}));
}

/// The head of an axe.
TopoDS_Shape axe() {
  return cut(polygon_loft({{{0, 0, -10}, {0, 35, -10}, {0, 35, 10}, {0, 0, 10}},
                           {{60, 0, -10}, {60, 35, -10}, {60, 35, 10}, {60, 0, 10}},
                           {{140, -20, -0.3}, {140, 50, -0.3}, {140, 50, 0.3}, {140, -20, 0.3}}}),
             cylinder(gp_Pnt(25, -1, 0), gp::DY(), 7, 60));
}

}  // namespace

const Makers& rare_models() {
  static const Makers all{{"joined_wing", joined_wing},
                          {"gull_wing", gull_wing},
                          {"canards_and_v_tail", canards_and_v_tail},
                          {"keel_with_bulb", keel_with_bulb},
                          {"swept_tip_rotor", swept_tip_rotor},
                          {"engine_with_core", engine_with_core},
                          {"flap_tracks", flap_tracks},
                          {"closed_impeller", closed_impeller},
                          {"h_rotor", h_rotor},
                          {"fenced_wing", fenced_wing},
                          {"tunnel_wing", tunnel_wing},
                          {"c_wing", c_wing},
                          {"scimitar_tips", scimitar_tips},
                          {"random_base", random_base},
                          {"cut_tail", cut_tail},
                          {"tubercle_wing", tubercle_wing},
                          {"double_delta", double_delta},
                          {"twin_boom", twin_boom},
                          {"duct_on_struts", duct_on_struts},
                          {"loop_propeller", loop_propeller},
                          {"half_blunt", half_blunt},
                          {"forward_swept_wing", forward_swept_wing},
                          {"root_strip_wing", root_strip_wing},
                          {"ogive_strake", ogive_strake},
                          {"bowed_vane_air", bowed_vane_air},
                          {"curved_cut_wing", curved_cut_wing},
                          {"paddle_blade", paddle_blade},
                          {"iced_wing", iced_wing},
                          {"rimed_wing", rimed_wing},
                          {"canards_and_y_tail", canards_and_y_tail},
                          {"foil_with_pods", foil_with_pods},
                          {"drooped_foil", drooped_foil},
                          {"braced_wing", braced_wing},
                          {"swept_elements", swept_elements},
                          {"propfan", propfan},
                          {"shaft_brackets", shaft_brackets},
                          {"far_wing", far_wing},
                          {"stator_row", stator_row},
                          {"strip_wing", strip_wing},
                          {"wing_with_rods", wing_with_rods},
                          {"part_cam", cam},
                          {"part_lever", lever},
                          {"part_dovetail", dovetail},
                          {"part_funnel", funnel},
                          {"part_shim", shim},
                          {"part_pulley", pulley},
                          {"part_fan_disc", fan_disc},
                          {"part_leaf_spring", leaf_spring},
                          {"part_drill", drill},
                          {"part_bezel", bezel},
                          {"part_axe", axe}};
  return all;
}

}  // namespace st::wing_models
