#include "late_wings.h"

#include <cmath>
#include <gp_Ax1.hxx>
#include <gp_Ax2.hxx>
#include <vector>

#include "geometry/brep/compound.h"

namespace st::wing_models {
namespace {

TopoDS_Shape mirrored(const TopoDS_Shape& shape) {
  return moved(shape, [](gp_Trsf& t) { t.SetMirror(gp_Ax2(gp_Pnt(), gp::DY())); });
}

/// Swept forward, on a body, with an extension of the leading edge from the nose on.
TopoDS_Shape forward_with_extension() {
  const auto f = [](double x, double y, double c) { return straight(gp_Pnt(x, y, 0), c); };
  const auto half = loft({.thickness = 0.05}, {f(2.2, 0, 2.8), f(2.7, 0.35, 2.3), f(3.6, 0.6, 1.35), f(2.9, 2.6, 0.8)});
  return fuse_all({fuselage({{0, 0}, {0.8, 0.25}, {1.8, 0.32}, {6, 0.3}}), half, mirrored(half)});
}

/// A foil under a strut, with a bulb where they meet and its tips bent down.
TopoDS_Shape foil_with_bulb_and_tips() {
  const auto foil = loft({.thickness = 0.1, .camber = 0.03},
                         {straight(gp_Pnt(0.1, -0.7, -0.12), 0.08, -40), straight(gp_Pnt(0.04, -0.5, 0), 0.16),
                          straight(gp_Pnt(0, 0, 0), 0.24), straight(gp_Pnt(0.04, 0.5, 0), 0.16),
                          straight(gp_Pnt(0.1, 0.7, -0.12), 0.08, 40)});
  const auto strut = loft({.thickness = 0.12, .base = 0.01, .tail = Tail::kBlunt},
                          {straight(gp_Pnt(0.02, 0, 0), 0.2, 90), straight(gp_Pnt(-0.02, 0, 1), 0.22, 90)});
  const auto bulb =
      shifted(fuselage({{0, 0}, {0.05, 0.025}, {0.15, 0.035}, {0.4, 0.02}, {0.5, 0}}), gp_Vec(-0.14, 0, 0));
  return fuse_all({foil, strut, bulb});
}

/// Cambered vanes with blunt trailing edges between two rings that are open at both ends.
TopoDS_Shape shrouded_stator() {
  const auto tube = [](double r, double wall) {
    return cut(cylinder(gp_Pnt(-0.2, 0, 0), gp::DX(), r + wall, 0.7), cylinder(gp_Pnt(-0.3, 0, 0), gp::DX(), r, 0.9));
  };
  const auto vane = loft({.thickness = 0.1, .base = 0.015, .camber = 0.12, .tail = Tail::kBlunt},
                         {straight(gp_Pnt(0, 0, 0.53), 0.3, 90, 20), straight(gp_Pnt(0, 0, 1.02), 0.3, 90, 35)});
  std::vector<TopoDS_Shape> all{tube(0.5, 0.05), tube(1, 0.05)};
  for (int i = 0; i < 7; ++i) all.push_back(turned(vane, gp::DX(), 2 * M_PI / 7 * i));
  return fuse_all(all);
}

/// A shaft with a thin blade at either end, one turned against the other.
TopoDS_Shape kayak_paddle() {
  std::vector<Frame> frames;
  for (int i = 0; i <= 12; ++i) {
    const double s = i / 12.0, w = 0.05 + 0.13 * std::sin(M_PI * (0.08 + 0.8 * s));
    frames.push_back(straight(gp_Pnt(-0.5 * w, 0.75 + 0.45 * s, 0.03 * s * s), w));
  }
  const TopoDS_Shape blade = loft({.thickness = 0.05, .camber = 0.06}, frames, false);
  return fuse_all({cylinder(gp_Pnt(0, -0.8, 0), gp::DY(), 0.015, 1.6), blade,
                   turned(turned(blade, gp::DZ(), M_PI), gp::DY(), M_PI / 3)});
}

/// A rotor's blade with two tabs behind its trailing edge, and its tip swept, turned about no axis of the model.
TopoDS_Shape blade_with_tabs() {
  const auto blade = loft({.thickness = 0.12}, {straight(gp_Pnt(0, 0, 0), 0.4, 0, 6), straight(gp_Pnt(0, 4.4, 0), 0.4),
                                                straight(gp_Pnt(0.25, 5, -0.08), 0.2)});
  const auto tab = [](double y) { return box(0.385, y, -0.004, 0.06, 0.5, 0.006); };
  return moved(fuse_all({blade, tab(2.6), tab(3.6)}),
               [](gp_Trsf& t) { t.SetRotation(gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(1, 2, 3)), 0.7); });
}

/// A mast with the profile of a wing, before a sail of two elements that is far thinner.
TopoDS_Shape wing_mast() {
  const auto mast = loft({.thickness = 0.35, .base = 0.06, .tail = Tail::kBlunt},
                         {straight(gp_Pnt(0, 0, 0), 0.3, 90), straight(gp_Pnt(0.1, 0, 4), 0.15, 90)});
  const auto sail = loft({.thickness = 0.02, .base = 0.004, .camber = 0.08, .tail = Tail::kBlunt},
                         {straight(gp_Pnt(0.33, 0, 0.2), 1.2, 90), straight(gp_Pnt(0.275, 0, 3.8), 0.5, 90)});
  return occt::compound_of({mast, sail});
}

/// A daggerboard like an S, its tip a point almost.
TopoDS_Shape curved_board() {
  std::vector<Frame> frames;
  for (int i = 0; i <= 16; ++i) {
    const double s = i / 16.0, c = 0.5 * std::sqrt(1.002 - s * s);
    frames.push_back(
        straight(gp_Pnt(-0.3 * c, 0.35 * std::sin(2 * M_PI * s), -2.4 * s), c, -90 + 40 * std::cos(2 * M_PI * s)));
  }
  return loft({.thickness = 0.11, .camber = 0.02}, frames, false);
}

/// A duct around a rotor whose blades do not touch it, and a tail behind on its rim.
TopoDS_Shape rotor_in_fin() {
  const auto fin = loft({.thickness = 0.14, .base = 0.006, .tail = Tail::kBlunt},
                        {straight(gp_Pnt(0, 0, -1), 2.2, 90), straight(gp_Pnt(0.6, 0, 2), 1.2, 90)});
  TopoDS_Shape all = cut(fin, cylinder(gp_Pnt(0.95, -1, 0), gp::DY(), 0.55, 2));
  const auto blade =
      loft({.thickness = 0.1}, {straight(gp_Pnt(0.9, 0, 0.02), 0.1, 90, 0), straight(gp_Pnt(0.9, 0, 0.5), 0.1, 90, 0)});
  std::vector<TopoDS_Shape> parts{cylinder(gp_Pnt(0.95, -0.08, 0), gp::DY(), 0.12, 0.16)};
  for (int i = 0; i < 5; ++i)
    parts.push_back(moved(shifted(turned(shifted(blade, gp_Vec(-0.95, 0, 0)), gp::DZ(), 1.0), gp_Vec(0.95, 0, 0)),
                          [&](gp_Trsf& t) { t.SetRotation(gp_Ax1(gp_Pnt(0.95, 0, 0), gp::DY()), 2 * M_PI / 5 * i); }));
  return occt::compound_of({all, fuse_all(parts)});
}

/// Its tip parts into two winglets, one up, one down, whose roots meet.
TopoDS_Shape forked_tip() {
  const auto wing = loft({}, {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(0.8, 3, 0), 0.5)});
  const auto up =
      loft({.thickness = 0.1}, {straight(gp_Pnt(0.75, 2.85, -0.01), 0.5, 20),
                                straight(gp_Pnt(0.95, 3.2, 0.15), 0.4, 45), straight(gp_Pnt(1.3, 3.4, 0.7), 0.15, 75)});
  const auto down = loft({.thickness = 0.1},
                         {straight(gp_Pnt(0.78, 2.9, 0.01), 0.48, -30), straight(gp_Pnt(1.15, 3.2, -0.35), 0.2, -60)});
  return fuse_all({wing, up, down});
}

/// A thin fin with a bevelled nose and tail, parallel sides between, on a body with a boat tail.
TopoDS_Shape bevelled_fins() {
  const auto fin = polygon_loft({{{2.9, -0.004, 0.1},
                                  {3, -0.02, 0.1},
                                  {3.4, -0.02, 0.1},
                                  {3.55, -0.002, 0.1},
                                  {3.55, 0.002, 0.1},
                                  {3.4, 0.02, 0.1},
                                  {3, 0.02, 0.1},
                                  {2.9, 0.004, 0.1}},
                                 {{3.2, -0.002, 0.6},
                                  {3.26, -0.01, 0.6},
                                  {3.45, -0.01, 0.6},
                                  {3.55, -0.002, 0.6},
                                  {3.55, 0.002, 0.6},
                                  {3.45, 0.01, 0.6},
                                  {3.26, 0.01, 0.6},
                                  {3.2, 0.002, 0.6}}});
  std::vector<TopoDS_Shape> all{fuselage({{0, 0}, {0.5, 0.12}, {1, 0.2}, {3.5, 0.2}, {3.8, 0.15}})};
  for (int i = 0; i < 4; ++i) all.push_back(turned(fin, gp::DX(), M_PI / 2 * i));
  return fuse_all(all);
}

/// A slat cut to a cove before a wing: the cut leaves a sliver above the tail, too, which runs out to a point.
TopoDS_Shape slat_with_cove() {
  const TopoDS_Shape wing = loft({}, {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(1.2, 3, 0), 0.6)});
  const auto slat = cut(
      loft({}, {straight(gp_Pnt(-0.03, 0.3, -0.03), 1, 0, -8), straight(gp_Pnt(1.05, 2.7, -0.02), 0.64, 0, -8)}),
      loft({.thickness = 0.16}, {straight(gp_Pnt(-0.01, -0.5, -0.02), 1.2), straight(gp_Pnt(1.38, 3.5, -0.02), 0.75)}));
  return occt::compound_of({wing, slat});
}

/// Three small ones beside a wing, each of which lacks one mark of a sliver: a wire, a spike that is not that small,
/// and a fin that is not slender.
TopoDS_Shape wing_with_small_ones() {
  return occt::compound_of(
      {loft({}, {straight(gp_Pnt(0, 0, 0), 1), straight(gp_Pnt(0, 3, 0), 1)}),
       loft({.thickness = 0.2}, {straight(gp_Pnt(0.3, 0.2, 0.5), 0.03), straight(gp_Pnt(0.3, 1.4, 0.5), 0.03)}),
       loft({}, {straight(gp_Pnt(0.3, 0, 1), 0.12), straight(gp_Pnt(0.4, 2.4, 1), 0.008)}),
       loft({}, {straight(gp_Pnt(0.3, 0, 1.5), 0.045), straight(gp_Pnt(0.33, 0.3, 1.5), 0.003)})});
}

}  // namespace

const Makers& late_models() {
  static const Makers all{{"forward_with_extension", forward_with_extension},
                          {"foil_with_bulb_and_tips", foil_with_bulb_and_tips},
                          {"shrouded_stator", shrouded_stator},
                          {"kayak_paddle", kayak_paddle},
                          {"blade_with_tabs", blade_with_tabs},
                          {"wing_mast", wing_mast},
                          {"curved_board", curved_board},
                          {"rotor_in_fin", rotor_in_fin},
                          {"forked_tip", forked_tip},
                          {"bevelled_fins", bevelled_fins},
                          {"slat_with_cove", slat_with_cove},
                          {"wing_with_small_ones", wing_with_small_ones}};
  return all;
}

}  // namespace st::wing_models
