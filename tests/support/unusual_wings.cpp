#include "unusual_wings.h"

#include <BRepPrimAPI_MakeCone.hxx>
#include <cmath>
#include <gp_Ax2.hxx>
#include <vector>

#include "geometry/brep/compound.h"

namespace st::wing_models {

using occt::compound_of;

namespace {

/// Square to a path: `along` the span, `chord` from nose to tail with its length.
Frame square_to(gp_Pnt middle, gp_Vec along, gp_Vec chord) {
  const gp_Vec up = chord.Crossed(along.Normalized());
  return [=](double x, double h) { return middle.Translated((x - 0.5) * chord + h * up); };
}

TopoDS_Shape mirrored(const TopoDS_Shape& shape) {
  return moved(shape, [](gp_Trsf& t) { t.SetMirror(gp_Ax2(gp_Pnt(), gp::DY())); });
}

TopoDS_Shape cone(gp_Pnt at, gp_Dir along, double r0, double r1, double h) {
  return BRepPrimAPI_MakeCone(gp_Ax2(at, along), r0, r1, h).Shape();
}

/// Webs with sharp edges to both sides, in a square frame.
TopoDS_Shape grid_fin() {
  const std::vector<gp_Pnt> web = {{0, 0, 0},   {0.03, 0, 0.004},  {0.17, 0, 0.004},
                                   {0.2, 0, 0}, {0.17, 0, -0.004}, {0.03, 0, -0.004}};
  const TopoDS_Shape level = prism(web, 1);
  const TopoDS_Shape upright = turned(level, gp::DX(), M_PI / 2);
  std::vector<TopoDS_Shape> all;
  for (const double z : {0.0, 0.33, 0.67, 1.0}) all.push_back(shifted(level, gp_Vec(0, 0, z)));
  for (const double y : {0.0, 0.33, 0.67, 1.0}) all.push_back(shifted(upright, gp_Vec(0, y, 0)));
  return fuse_all(all);
}

/// Its camber, and so its trailing edge, goes down between 1.2 and 2.8 of the span.
TopoDS_Shape morphing_wing() {
  std::vector<Section> sections;
  for (int i = 0; i <= 20; ++i) {
    const double y = 0.2 * i, s = y < 0.8 || y > 3.2 ? 0 : 0.5 * (1 - std::cos(2 * M_PI * (y - 0.8) / 2.4));
    sections.push_back({{.base = 0.004, .tail = Tail::kBlunt}, [=](double x, double h) {
                          const double aft = std::max(0.0, x - 0.6);
                          return gp_Pnt(x, y, h - s * aft * aft);
                        }});
  }
  return loft(sections, false);
}

/// Two screws that turn against one another.
TopoDS_Shape contra_pair() {
  const auto blade = [](double x, double sign) {
    std::vector<Frame> frames;
    for (int i = 0; i <= 4; ++i) {
      const double r = 0.1 + 0.225 * i;
      frames.push_back(straight(gp_Pnt(x, 0, r), 0.16 - 0.02 * i, 90, sign * (60 - 8 * i)));
    }
    return loft({.thickness = 0.08, .camber = sign * 0.02}, frames, false);
  };
  std::vector<TopoDS_Shape> all = {fuselage({{-0.5, 0}, {-0.35, 0.12}, {-0.1, 0.18}, {0.6, 0.18}, {0.9, 0.1}, {1, 0}})};
  for (int i = 0; i < 3; ++i) {
    all.push_back(turned(blade(0, 1), gp::DX(), 2 * M_PI * i / 3));
    all.push_back(turned(blade(0.3, -1), gp::DX(), 2 * M_PI * i / 3 + 0.4));
  }
  return fuse_all(all);
}

/// Its base is 12 % of the chord at the root and 0.5 % at the tip.
TopoDS_Shape flat_back_blade() {
  std::vector<Section> sections;
  for (int i = 0; i <= 8; ++i) {
    const double s = i / 8.0;
    sections.push_back({{.thickness = 0.38 - 0.25 * std::min(1.0, 2 * s),
                         .base = 0.12 * (1 - s) * (1 - s) + 0.005,
                         .tail = Tail::kBlunt},
                        straight(gp_Pnt(0, 1 + 9 * s, 0), 1.1 - 0.8 * s, 0, 14 * (1 - s))});
  }
  return loft(sections, false);
}

/// Two foils and a strut meet in a bulb.
TopoDS_Shape foil_with_bulb() {
  const auto foil = loft({.thickness = 0.1}, {straight(gp_Pnt(0, 0, 0), 0.4), straight(gp_Pnt(0.2, 1.2, 0.2), 0.15)});
  const auto strut =
      loft({.thickness = 0.12}, {straight(gp_Pnt(0, 0, 0), 0.4, 90), straight(gp_Pnt(0, 0, 1.5), 0.4, 90)});
  const auto bulb = fuselage({{-0.4, 0}, {-0.3, 0.05}, {0, 0.09}, {0.4, 0.09}, {0.7, 0.04}, {0.8, 0}});
  return fuse_all({bulb, foil, mirrored(foil), strut});
}

/// Winglets on the bulb of a keel.
TopoDS_Shape winged_keel() {
  const auto keel =
      loft({.thickness = 0.12}, {straight(gp_Pnt(0, 0, 0), 1, 90), straight(gp_Pnt(0.3, 0, -1.5), 0.7, 90)});
  const auto bulb =
      shifted(fuselage({{-0.6, 0}, {-0.4, 0.1}, {0, 0.18}, {0.6, 0.18}, {1.2, 0.07}, {1.4, 0}}), gp_Vec(0.4, 0, -1.5));
  const auto wing =
      loft({.thickness = 0.12}, {straight(gp_Pnt(1, 0, -1.5), 0.4, -20), straight(gp_Pnt(1.25, 0.7, -1.75), 0.2, -20)});
  return fuse_all({keel, bulb, wing, mirrored(wing)});
}

/// Two hulls with a spade rudder each.
TopoDS_Shape catamaran() {
  const auto hull = fuselage({{0, 0}, {1, 0.3}, {3, 0.5}, {7, 0.5}, {10, 0.35}});
  const auto rudder = loft({.thickness = 0.15, .base = 0.01, .tail = Tail::kBlunt},
                           {straight(gp_Pnt(8.8, 0, 0), 0.6, 90), straight(gp_Pnt(8.9, 0, -1.4), 0.45, 90)});
  const auto one = shifted(fuse(hull, rudder), gp_Vec(0, 2, 0));
  return fuse_all({one, mirrored(one), box(3, -2, 0.2, 4, 4, 0.1)});
}

/// Three blades run around the shaft by 60 degrees, between two discs.
TopoDS_Shape helical_turbine() {
  std::vector<Frame> frames;
  for (int i = 0; i <= 12; ++i) {
    const double s = i / 12.0, a = M_PI / 3 * s;
    const gp_Vec out(std::cos(a), std::sin(a), 0), round(-std::sin(a), std::cos(a), 0);
    frames.push_back([=](double x, double h) {
      return gp_Pnt(out.X(), out.Y(), 2 * s).Translated(0.3 * ((x - 0.5) * round + h * out));
    });
  }
  const TopoDS_Shape blade = loft({.thickness = 0.18}, frames, false);
  std::vector<TopoDS_Shape> all = {cylinder(gp_Pnt(0, 0, -0.3), gp::DZ(), 0.08, 2.6)};
  for (const double z : {-0.05, 1.95}) all.push_back(cylinder(gp_Pnt(0, 0, z), gp::DZ(), 1.2, 0.1));
  for (int i = 0; i < 3; ++i) all.push_back(turned(blade, gp::DZ(), 2 * M_PI * i / 3));
  return fuse_all(all);
}

/// About the z axis, from radius r0 to 1: of a disc's blade at height `z`.
Frame curved(double r0, double turn, double z) {
  const auto middle = [=](double x) {
    const double r = r0 + (1 - r0) * x, angle = turn * (r - 0.4) / 0.6;
    return gp_Pnt(r * std::cos(angle), r * std::sin(angle), z);
  };
  return along_line(middle, 0.5);
}

/// Six blades, and six shorter ones between them.
TopoDS_Shape splitter_impeller() {
  TopoDS_Shape all = cylinder(gp_Pnt(0, 0, -0.05), gp::DZ(), 1.02, 0.05);
  all = fuse(all, cone(gp_Pnt(0, 0, -0.01), gp::DZ(), 0.35, 0.15, 0.5));
  const TopoDS_Shape full = loft({.thickness = 0.08}, {curved(0.42, 0.9, -0.02), curved(0.42, 0.9, 0.25)}),
                     part = loft({.thickness = 0.1}, {curved(0.65, 0.9, -0.02), curved(0.65, 0.9, 0.25)});
  for (int i = 0; i < 6; ++i) {
    all = fuse(all, turned(full, gp::DZ(), M_PI / 3 * i));
    all = fuse(all, turned(part, gp::DZ(), M_PI / 3 * (i + 0.5)));
  }
  return all;
}

/// A bow of cells that are thickest in their middle.
TopoDS_Shape cell_wing() {
  std::vector<Section> sections;
  for (int i = 0; i <= 40; ++i) {
    const double a = -1.1 + 2.2 * i / 40, c = 0.8 - 0.35 * (a / 1.1) * (a / 1.1);
    const gp_Vec out(0, std::sin(a), std::cos(a));
    sections.push_back({{.thickness = i % 2 ? 0.17 : 0.15},
                        [=](double x, double h) { return gp_Pnt(c * (x - 0.4), 0, 0).Translated((2 + c * h) * out); }});
  }
  return loft(sections, false);
}

/// Leading edges bend as an ogive.
TopoDS_Shape gothic_wing() {
  std::vector<Frame> frames;
  for (int i = -10; i <= 10; ++i) {
    const double s = i / 10.0, x = 3 * (1 - std::sqrt(1 - 0.96 * std::abs(s)));
    frames.push_back(straight(gp_Pnt(x, 1.2 * s, 0), 3 - x));
  }
  return loft({.thickness = 0.06}, frames);
}

/// A winglet behind a plane piece at 45 degrees.
TopoDS_Shape chamfer_winglet() {
  return loft(kBlunt, {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(0.5, 3, 0), 0.5, 22.5),
                       straight(gp_Pnt(0.6, 3.15, 0.15), 0.45, 67.5), straight(gp_Pnt(1, 3.15, 0.8), 0.2, 90)});
}

/// Sharp chines along the sides of a body, and deltas.
TopoDS_Shape chined_body() {
  std::vector<std::vector<gp_Pnt>> outlines;
  for (const auto& [x, b, h] : {std::tuple(0.0, 0.02, 0.01), {1.5, 0.4, 0.2}, {3.0, 0.6, 0.35}, {7.0, 0.6, 0.35}}) {
    std::vector<gp_Pnt> points;
    for (int i = 0; i < 8; ++i) {
      const double t = i < 4 ? 0.25 * i : 0.25 * (i - 4), y = b * (1 - 2 * t), z = h * (1 - (1 - 2 * t) * (1 - 2 * t));
      points.emplace_back(x, i < 4 ? y : -y, i < 4 ? z : -z);
    }
    outlines.push_back(points);
  }
  const auto delta = loft({.thickness = 0.04}, {straight(gp_Pnt(3.5, 0, 0), 3), straight(gp_Pnt(6, 2, 0), 0.4)});
  return fuse_all({polygon_loft(outlines), delta, mirrored(delta)});
}

/// Three fins of crescent shape under a board.
TopoDS_Shape board_with_fins() {
  std::vector<Frame> frames;
  for (int i = 0; i <= 8; ++i) {
    const double s = i / 8.0;
    frames.push_back(straight(gp_Pnt(0.6 * s * s + 0.1 * s, 0, 0.02 - s), 0.8 * (1 - s * s) + 0.12, 90));
  }
  const TopoDS_Shape fin = loft({.thickness = 0.1}, frames, false);
  return fuse_all(
      {box(-12, -2, 0, 14, 4, 0.5), fin, shifted(fin, gp_Vec(-2.5, 1.4, 0)), shifted(fin, gp_Vec(-2.5, -1.4, 0))});
}

/// Four fins carry a ring at the tail.
TopoDS_Shape torpedo() {
  const auto body = fuselage({{0, 0}, {0.2, 0.2}, {0.6, 0.26}, {4, 0.26}, {5, 0.1}, {5.2, 0}});
  const auto fin =
      loft({.thickness = 0.09}, {straight(gp_Pnt(4.3, 0, 0), 0.6, 90), straight(gp_Pnt(4.5, 0, 0.5), 0.35, 90)});
  std::vector<TopoDS_Shape> all = {body, shifted(ring({.thickness = 0.1}, 0.5, 0.45), gp_Vec(4.45, 0, 0))};
  for (int i = 0; i < 4; ++i) all.push_back(turned(fin, gp::DX(), M_PI / 2 * i + M_PI / 4));
  return fuse_all(all);
}

/// Half a tube between two straight halves.
TopoDS_Shape channel_wing() {
  std::vector<Frame> frames = {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(0, 1.3, 0), 1, -45)};
  for (int i = 1; i < 16; ++i) {
    const double a = M_PI * i / 16;
    frames.push_back(straight(gp_Pnt(0, 1.9 - 0.6 * std::cos(a), -0.6 * std::sin(a)), 1, 180.0 * i / 16 - 90));
  }
  frames.push_back(straight(gp_Pnt(0, 2.5, 0), 1, 45));
  frames.push_back(straight(gp_Pnt(0, 3.8, 0), 1));
  return loft({.thickness = 0.12}, frames);
}

/// A Joukowski profile: its sides touch at the tail.
TopoDS_Shape cusped_wing() {
  const auto thin = [](double y) { return [=](double x, double h) { return gp_Pnt(x, y, h * (1 - x) * 2); }; };
  return loft({.thickness = 0.12}, {Frame(thin(0)), Frame(thin(4))});
}

/// Two bows from the foot of a shaft to its head.
TopoDS_Shape egg_beater() {
  std::vector<Frame> frames;
  for (int i = 0; i <= 24; ++i) {
    const double s = -1 + i / 12.0, r = 0.03 + 0.9 * (1 - s * s), slope = -1.8 * s;
    const gp_Vec along = gp_Vec(slope, 0, 1).Normalized();
    frames.push_back(square_to(gp_Pnt(r, 0, s), along, gp_Vec(0, -0.15, 0)));
  }
  const TopoDS_Shape blade = loft({.thickness = 0.15}, frames, false);
  return fuse_all({cylinder(gp_Pnt(0, 0, -1.2), gp::DZ(), 0.12, 2.4), blade, turned(blade, gp::DZ(), M_PI)});
}

/// Four blades, wider than long, on a hub.
TopoDS_Shape wide_runner() {
  std::vector<Frame> frames;
  for (int i = 0; i <= 5; ++i) {
    const double r = 0.35 + 0.12 * i;
    frames.push_back(straight(gp_Pnt(-0.45, 0, r), 0.9, 90, 50 - 5 * i));
  }
  const TopoDS_Shape blade = loft({.thickness = 0.06}, frames, false);
  std::vector<TopoDS_Shape> all = {fuselage({{-1, 0}, {-0.8, 0.25}, {-0.3, 0.42}, {0.4, 0.42}, {0.9, 0.2}, {1.1, 0}})};
  for (int i = 0; i < 4; ++i) all.push_back(turned(blade, gp::DX(), M_PI / 2 * i));
  return fuse_all(all);
}

/// Eight teeth at the end of a nozzle.
TopoDS_Shape chevron_nozzle() {
  TopoDS_Shape all = ring({.thickness = 0.1, .base = 0.006, .tail = Tail::kBlunt}, 0.8, 2);
  const TopoDS_Shape notch = polygon_loft(
      {{{1.8, 0, 0.5}, {2.1, 0.2, 0.5}, {2.1, -0.2, 0.5}}, {{1.8, 0, 1.2}, {2.1, 0.3, 1.2}, {2.1, -0.3, 1.2}}});
  for (int i = 0; i < 8; ++i) all = cut(all, turned(notch, gp::DX(), M_PI / 4 * i));
  return all;
}

/// Sharp plates before the roots of a wing.
TopoDS_Shape strake_wing() {
  const auto body = fuselage({{0, 0}, {1, 0.35}, {2, 0.5}, {7, 0.5}, {8, 0.4}});
  const auto strake =
      polygon_loft({{{1.5, 0, 0}, {5, 0, 0.03}, {5, 0, -0.03}}, {{4, 1, 0}, {5, 1, 0.02}, {5, 1, -0.02}}});
  const auto wing = loft({.thickness = 0.05}, {straight(gp_Pnt(4, 0, 0), 2.5), straight(gp_Pnt(5.2, 2.5, 0), 1)});
  const auto half = fuse(strake, wing);
  return fuse_all({body, half, mirrored(half)});
}

/// Three elements upside down between two plates.
TopoDS_Shape race_wing() {
  const auto element = [](const Foil& foil, double x, double z, double chord, double twist) {
    return loft(foil, {straight(gp_Pnt(x, 0, z), chord, 0, twist), straight(gp_Pnt(x, 2, z), chord, 0, twist)});
  };
  return fuse_all(
      {element({.thickness = 0.12, .base = 0.006, .camber = -0.06, .tail = Tail::kBlunt}, 0, 0, 0.5, -4),
       element({.thickness = 0.1, .base = 0.01, .camber = -0.06, .tail = Tail::kBlunt}, 0.5, 0.09, 0.25, -25),
       box(-0.1, -0.01, -0.15, 1, 0.01, 0.5), box(-0.1, 2, -0.15, 1, 0.01, 0.5)});
}

/// Twelve blades with a ring at half of their length.
TopoDS_Shape fan_with_ring() {
  std::vector<Frame> frames;
  for (int i = 0; i <= 4; ++i) frames.push_back(straight(gp_Pnt(-0.1, 0, 0.25 + 0.1875 * i), 0.2, 90, 55 - 10 * i));
  const TopoDS_Shape blade = loft({.thickness = 0.06, .camber = 0.03}, frames, false);
  TopoDS_Shape all = fuselage({{-0.4, 0}, {-0.3, 0.2}, {-0.1, 0.3}, {0.3, 0.3}});
  for (int i = 0; i < 12; ++i) all = fuse(all, turned(blade, gp::DX(), M_PI / 6 * i));
  return fuse(
      all, cut(cylinder(gp_Pnt(-0.03, 0, 0), gp::DX(), 0.66, 0.06), cylinder(gp_Pnt(-0.1, 0, 0), gp::DX(), 0.64, 0.3)));
}

/// Its tail stands off the body by a gap, on a shaft.
TopoDS_Shape all_moving_tail() {
  const auto body = fuselage({{0, 0}, {0.6, 0.4}, {1.5, 0.5}, {6, 0.5}, {8, 0.3}});
  const auto tail = loft({.thickness = 0.06}, {straight(gp_Pnt(6.5, 0.55, 0), 1.2), straight(gp_Pnt(7.2, 2, 0), 0.6)});
  const auto half = fuse(tail, cylinder(gp_Pnt(7.3, 0, 0), gp::DY(), 0.025, 0.7));
  const auto wing = loft({}, {straight(gp_Pnt(2.5, 0, 0), 1.5), straight(gp_Pnt(3.2, 4, 0.2), 0.6)});
  return fuse_all({body, half, mirrored(half), wing, mirrored(wing)});
}

/// A foil like a V, whose tips stand out of the water.
TopoDS_Shape vee_foil() {
  return loft({.thickness = 0.08, .camber = 0.03},
              {straight(gp_Pnt(0.5, -1.5, 1.2), 0.3, -38), straight(gp_Pnt(0, 0, 0), 0.5),
               straight(gp_Pnt(0.5, 1.5, 1.2), 0.3, 38)});
}

/// Biplane with struts between its wings.
TopoDS_Shape biplane() {
  const auto lower = loft({}, {straight(gp_Pnt(0, -3, 0), 1), straight(gp_Pnt(0, 3, 0), 1)});
  std::vector<TopoDS_Shape> all = {lower, shifted(lower, gp_Vec(-0.4, 0, 1.2))};
  const auto strut =
      loft({.thickness = 0.25}, {straight(gp_Pnt(0.3, 0, 0), 0.12, 90), straight(gp_Pnt(-0.1, 0, 1.2), 0.12, 90)});
  for (const double y : {-2.0, 2.0}) all.push_back(shifted(strut, gp_Vec(0, y, 0)));
  return fuse_all(all);
}

// --- machine parts ---

/// A disc with slots like fir trees at its rim.
TopoDS_Shape turbine_disc() {
  TopoDS_Shape all =
      cut(fuse(cylinder(gp_Pnt(0, 0, -5), gp::DZ(), 100, 10), cylinder(gp_Pnt(0, 0, -15), gp::DZ(), 40, 30)),
          cylinder(gp_Pnt(0, 0, -20), gp::DZ(), 20, 40));
  for (int i = 0; i < 24; ++i)
    all = cut(all, turned(polygon_loft({{{85, -2, -9},
                                         {88, -4, -9},
                                         {91, -2, -9},
                                         {94, -5, -9},
                                         {104, -3, -9},
                                         {104, 3, -9},
                                         {94, 5, -9},
                                         {91, 2, -9},
                                         {88, 4, -9},
                                         {85, 2, -9}},
                                        {{85, -2, 9},
                                         {88, -4, 9},
                                         {91, -2, 9},
                                         {94, -5, 9},
                                         {104, -3, 9},
                                         {104, 3, 9},
                                         {94, 5, 9},
                                         {91, 2, 9},
                                         {88, 4, 9},
                                         {85, 2, 9}}}),
                          gp::DZ(), 2 * M_PI * i / 24));
  return all;
}

/// Slats with round edges, at 40 degrees in a frame.
TopoDS_Shape louvre_grille() {
  std::vector<TopoDS_Shape> all = {cut(box(-10, -10, -10, 40, 220, 170), box(-20, 0, 0, 80, 200, 150))};
  for (int i = 0; i < 6; ++i) {
    const TopoDS_Shape slat = fuse_all({box(-15, -5, -1, 30, 210, 2), cylinder(gp_Pnt(-15, -5, 0), gp::DY(), 1, 210),
                                        cylinder(gp_Pnt(15, -5, 0), gp::DY(), 1, 210)});
    all.push_back(shifted(turned(slat, gp::DY(), 0.7), gp_Vec(10, 0, 12 + 25 * i)));
  }
  return fuse_all(all);
}

/// A barrel with rings that are thin outside.
TopoDS_Shape cooling_fins() {
  TopoDS_Shape all = cylinder(gp_Pnt(0, 0, 0), gp::DZ(), 30, 100);
  for (int i = 0; i < 8; ++i)
    all = fuse_all({all, cone(gp_Pnt(0, 0, 10 + 11 * i), gp::DZ(), 55, 25, 3),
                    cone(gp_Pnt(0, 0, 10 + 11 * i), gp_Dir(0, 0, -1), 55, 25, 3)});
  return cut(all, cylinder(gp_Pnt(0, 0, -1), gp::DZ(), 22, 102));
}

/// A blade that is ground to an edge, and its handle.
TopoDS_Shape knife() {
  const auto blade = polygon_loft({{{0, 0, 0}, {0, 1.2, 25}, {0, -1.2, 25}},
                                   {{120, 0, 0}, {120, 1, 25}, {120, -1, 25}},
                                   {{170, 0, 20}, {170, 0.2, 26}, {170, -0.2, 26}}});
  return fuse(blade, box(-100, -8, 0, 105, 16, 26));
}

/// A nut with two ears.
TopoDS_Shape wing_nut() {
  const auto ear = common(cylinder(gp_Pnt(0, -3, 0), gp::DY(), 16, 6), box(-30, -2, -30, 60, 4, 60));
  return cut(fuse_all({cone(gp_Pnt(0, 0, 0), gp::DZ(), 10, 7, 12), shifted(ear, gp_Vec(15, 0, 14)),
                       shifted(ear, gp_Vec(-15, 0, 14))}),
             cylinder(gp_Pnt(0, 0, -5), gp::DZ(), 4, 30));
}

/// A cap of a propeller: a cone with a hexagon.
TopoDS_Shape propeller_nut() {
  std::vector<gp_Pnt> hexagon;
  for (int i = 0; i < 6; ++i) hexagon.emplace_back(12 * std::cos(M_PI / 3 * i), 0, 12 * std::sin(M_PI / 3 * i));
  return cut(fuse(turned(cone(gp_Pnt(0, 0, 10), gp::DZ(), 14, 1, 25), gp::DX(), -M_PI / 2), prism(hexagon, 12)),
             cylinder(gp_Pnt(0, -1, 0), gp::DY(), 5, 25));
}

/// A cup of spring steel.
TopoDS_Shape disc_spring() {
  return cut(cone(gp_Pnt(), gp::DZ(), 50, 20, 12),
             fuse(cone(gp_Pnt(0, 0, -2), gp::DZ(), 50, 20, 12), cylinder(gp_Pnt(0, 0, -5), gp::DZ(), 22, 30)));
}

TopoDS_Shape shovel() {
  const auto outer = common(ball(gp_Pnt(0, 0, 200), 200), box(-90, -60, -10, 180, 120, 40));
  return fuse(cut(outer, ball(gp_Pnt(4, 0, 205), 202.5)), cylinder(gp_Pnt(-300, 0, 22), gp::DX(), 8, 225));
}

/// Teeth on a bar, each a wedge.
TopoDS_Shape comb() {
  TopoDS_Shape all = box(0, 0, 0, 200, 20, 4);
  for (int i = 0; i < 16; ++i)
    all = fuse(all,
               polygon_loft({{{12.0 * i + 4, 0, 0}, {12.0 * i + 10, 0, 0}, {12.0 * i + 10, 0, 4}, {12.0 * i + 4, 0, 4}},
                             {{12.0 * i + 6.5, -40, 1.8},
                              {12.0 * i + 7.5, -40, 1.8},
                              {12.0 * i + 7.5, -40, 2.2},
                              {12.0 * i + 6.5, -40, 2.2}}}));
  return all;
}

/// A sealing profile with two lips, extruded.
TopoDS_Shape lip_profile() {
  return prism({{0, 0, 0},
                {20, 0, 0},
                {20, 0, 6},
                {14, 0, 6},
                {22, 0, 18},
                {21.6, 0, 18.2},
                {10, 0, 8},
                {-1.6, 0, 18.2},
                {-2, 0, 18},
                {6, 0, 6},
                {0, 0, 6}},
               200);
}

TopoDS_Shape circular_saw() {
  std::vector<std::vector<gp_Pnt>> outlines(2);
  for (int k = 0; k < 2; ++k)
    for (int i = 0; i < 36; ++i) {
      const double a = 2 * M_PI * i / 36;
      outlines[k].emplace_back(90 * std::cos(a), 90 * std::sin(a), 2.0 * k);
      outlines[k].emplace_back(102 * std::cos(a + 0.03), 102 * std::sin(a + 0.03), 2.0 * k);
    }
  return cut(polygon_loft(outlines), cylinder(gp_Pnt(0, 0, -1), gp::DZ(), 15, 5));
}

/// A handle that is oval and thinner to its end.
TopoDS_Shape door_handle() {
  return fuse(cylinder(gp_Pnt(0, 0, 0), gp::DZ(), 12, 45),
              loft({.thickness = 0.5, .base = 0.25, .tail = Tail::kRound},
                   {straight(gp_Pnt(-12, 0, 40), 24), straight(gp_Pnt(-8, 120, 40), 16)}));
}

/// Two wedges that meet at their edges, as scissors.
TopoDS_Shape scissors() {
  const auto blade = polygon_loft(
      {{{0, 0, 0}, {0, 14, 0}, {0, 14, 2.5}, {0, 4, 2.5}}, {{110, 0, 0}, {110, 4, 0}, {110, 4, 1}, {110, 1, 1}}});
  return fuse_all(
      {blade, shifted(turned(blade, gp::DX(), M_PI), gp_Vec(0, 8, 0)), cylinder(gp_Pnt(3, 5, -2.5), gp::DZ(), 3, 5)});
}

}  // namespace

const Makers& unusual_models() {
  static const Makers all{{"grid_fin", grid_fin},
                          {"morphing_wing", morphing_wing},
                          {"contra_pair", contra_pair},
                          {"flat_back_blade", flat_back_blade},
                          {"foil_with_bulb", foil_with_bulb},
                          {"winged_keel", winged_keel},
                          {"catamaran", catamaran},
                          {"helical_turbine", helical_turbine},
                          {"splitter_impeller", splitter_impeller},
                          {"cell_wing", cell_wing},
                          {"gothic_wing", gothic_wing},
                          {"chamfer_winglet", chamfer_winglet},
                          {"chined_body", chined_body},
                          {"board_with_fins", board_with_fins},
                          {"torpedo", torpedo},
                          {"channel_wing", channel_wing},
                          {"cusped_wing", cusped_wing},
                          {"egg_beater", egg_beater},
                          {"wide_runner", wide_runner},
                          {"chevron_nozzle", chevron_nozzle},
                          {"strake_wing", strake_wing},
                          {"race_wing", race_wing},
                          {"fan_with_ring", fan_with_ring},
                          {"all_moving_tail", all_moving_tail},
                          {"vee_foil", vee_foil},
                          {"biplane", biplane},
                          {"part_turbine_disc", turbine_disc},
                          {"part_louvre_grille", louvre_grille},
                          {"part_cooling_fins", cooling_fins},
                          {"part_knife", knife},
                          {"part_wing_nut", wing_nut},
                          {"part_propeller_nut", propeller_nut},
                          {"part_disc_spring", disc_spring},
                          {"part_shovel", shovel},
                          {"part_comb", comb},
                          {"part_lip_profile", lip_profile},
                          {"part_circular_saw", circular_saw},
                          {"part_door_handle", door_handle},
                          {"part_scissors", scissors}};
  return all;
}

}  // namespace st::wing_models
