#include "parts.h"

#include <BRepPrimAPI_MakeBox.hxx>
#include <BRep_Tool.hxx>
#include <Geom_BSplineCurve.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <algorithm>
#include <cmath>

#include "lifting_surface.h"
#include "splines.h"

namespace aircraft {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr double kFuselageRadius = 2.0;
constexpr double kFuselageLength = 36.0;

// -------------------------------------------------------------------------------- bodies of ellipses

/// A body of elliptic cross-sections and how it is divided into patches.
struct EllipticBody {
  std::vector<Ellipse> sections;
  std::vector<double> parameters;  ///< of the sections
  std::vector<double> splits;      ///< parameters of the patch boundaries, first and last included
  std::vector<double> angles_deg;  ///< of the patch boundaries, from the top
};

/// Curves in which a half body meets its symmetry plane and its ends.
struct Rims {
  std::vector<Handle(Geom_Curve)> symmetry, first, last;
};

void append(std::vector<Handle(Geom_Curve)>& to, const std::vector<Handle(Geom_Curve)>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// Adds the patches of a body; `name_at` gives the group for the middle parameter of a patch.
Rims add_body(Patchwork& patches, const EllipticBody& body, const std::function<std::string(double)>& name_at) {
  const CubicInterpolation v(body.parameters);
  Rims rims;
  const int n_sectors = int(body.angles_deg.size()) - 1, n_rings = int(body.splits.size()) - 1;
  for (int i = 0; i < n_sectors; ++i) {
    const double a = body.angles_deg[i] * kDegree, b = body.angles_deg[i + 1] * kDegree;
    const auto sector = elliptic_sector(body.sections, v, a, b);
    for (int j = 0; j < n_rings; ++j) {
      const auto patch = segment(sector, {a, b}, {body.splits[j], body.splits[j + 1]});
      patches.add(patch, name_at(0.5 * (body.splits[j] + body.splits[j + 1])));
      if (i == 0) rims.symmetry.push_back(patch->UIso(a));
      if (i == n_sectors - 1) rims.symmetry.push_back(patch->UIso(b));
    }
    rims.first.push_back(sector->VIso(body.splits.front()));
    rims.last.push_back(sector->VIso(body.splits.back()));
  }
  return rims;
}

Rims add_body(Patchwork& patches, const EllipticBody& body, const std::string& name) {
  return add_body(patches, body, [&](double) { return name; });
}

/// Body with a rounded pole at both ends: t runs from 0 to 1 along the axis, `size` scales with the elliptic envelope
/// of the given flatness (2: ellipsoid; more: fuller).
EllipticBody closed_body(double x_begin, double x_end, double flatness, const std::function<Ellipse(double x)>& shape) {
  EllipticBody body;
  body.parameters = linspace(0, 1, 25);
  for (double p : body.parameters) {
    const double c = std::cos(M_PI * p);
    const double envelope = p == 0 || p == 1 ? 0.0 : std::sqrt(1 - std::pow(std::abs(c), flatness));
    const double x = x_begin + (x_end - x_begin) * 0.5 * (1 - c);
    Ellipse e = shape(x);
    e.x = x;
    e.half_width *= envelope;
    e.half_height *= envelope;
    body.sections.push_back(e);
  }
  return body;
}

// -------------------------------------------------------------------------------- fuselage

EllipticBody fuselage_nose(double length) {
  EllipticBody nose;
  nose.parameters = linspace(0, 1, 17);
  for (double p : nose.parameters) {
    const double phi = 0.5 * M_PI * p, x = p == 1 ? length : length * (1 - std::cos(phi));
    const double r = p == 0 ? 0 : p == 1 ? kFuselageRadius : kFuselageRadius * std::sin(phi), ahead = 1 - x / length;
    nose.sections.push_back({x, r, r, 0, -0.5 * ahead * ahead});
  }
  nose.splits = {0, 0.35, 0.62, 1};
  return nose;
}

EllipticBody fuselage_cabin(double begin, double end) {
  EllipticBody cabin;
  cabin.parameters = linspace(begin, end, 4);
  for (double x : cabin.parameters) cabin.sections.push_back({x, kFuselageRadius, kFuselageRadius, 0, 0});
  cabin.splits = {begin, 9.0, 11.6, 14.6, 17.6, 20.8, end};
  return cabin;
}

EllipticBody fuselage_tail(double begin) {
  constexpr double kEndRadius = 0.2, kUpsweep = 0.95;
  EllipticBody tail;
  tail.parameters = linspace(begin, kFuselageLength, 14);
  for (double x : tail.parameters) {
    const double t = (x - begin) / (kFuselageLength - begin),
                 r = kEndRadius + (kFuselageRadius - kEndRadius) * (1 - t * t);
    tail.sections.push_back({x, r, r, 0, kUpsweep * t * t});
  }
  tail.splits = {begin, 25.5, 27.8, 30.0, 33.0, kFuselageLength};
  return tail;
}

Part make_fuselage(NameTable& names) {
  constexpr double kNoseLength = 6.4, kTailBegin = 23.2;
  Patchwork patches(names);
  std::vector<Handle(Geom_Curve)> symmetry, base;
  for (EllipticBody body :
       {fuselage_nose(kNoseLength), fuselage_cabin(kNoseLength, kTailBegin), fuselage_tail(kTailBegin)}) {
    body.angles_deg = {0, 42, 85, 180};
    if (body.sections.front().x < kTailBegin) body.angles_deg = {0, 42, 85, 132, 180};
    const Rims rims = add_body(patches, body, "fuselage");
    append(symmetry, rims.symmetry);
    base = rims.last;
  }
  const Handle(Geom_Curve) diameter =
      line(base.front()->Value(base.front()->FirstParameter()), base.back()->Value(base.back()->LastParameter()));
  base.push_back(diameter);
  symmetry.push_back(diameter);
  patches.add_planar(base, "fuselage_base");
  patches.add_planar(symmetry, "symmetry");
  return {"fuselage", patches.solid("fuselage")};
}

/// Fairing between wing and fuselage.
Part make_belly_fairing(NameTable& names) {
  EllipticBody body = closed_body(9.8, 23.4, 5, [](double) { return Ellipse{0, 2.15, 1.4, 0, -0.9}; });
  body.splits = {0, 0.22, 0.4, 0.6, 0.78, 1};
  body.angles_deg = {0, 78, 128, 180};
  Patchwork patches(names);
  patches.add_planar(add_body(patches, body, "belly_fairing").symmetry, "symmetry");
  return {"belly fairing", patches.solid("belly fairing")};
}

// -------------------------------------------------------------------------------- wing

namespace wing {
constexpr double kRootY = 0.4, kKinkY = 6.2, kTipY = 16.0, kWingletLength = 2.6;
constexpr double kWingletCant = 72 * kDegree;

double lerp(double a, double b, double t) { return a + (b - a) * t; }

/// The wing of a variant.
class Planform {
 public:
  explicit Planform(const Shape& shape) : dihedral_(shape.dihedral_deg * kDegree), aft_(shape.aft_per_span) {}

  /// Section of the planar part.
  Section main_section(double y) const {
    const double inner = std::min(y, kKinkY) / kKinkY, outer = std::max(0.0, y - kKinkY) / (kTipY - kKinkY);
    Section s;
    s.leading_edge = gp_Pnt(12.0 + aft_ * y, y, -1.15 + std::tan(dihedral_) * y);
    s.chord = lerp(lerp(8.0, 4.4, inner), 1.7, outer);
    s.twist = kDegree * lerp(lerp(3.5, 1.0, inner), -1.0, outer);
    s.thickness = lerp(lerp(0.14, 0.115, inner), 0.1, outer);
    s.camber = 0.016;
    return s;
  }

  /// Section at the distance `d` along the winglet, which bends up from the tip.
  Section winglet_section(double d) const {
    Section s = main_section(kTipY);
    double y = kTipY, z = s.leading_edge.Z(), bend = 0;
    const int n_steps = 200;
    for (int i = 0; i < n_steps; ++i) {  // integrate the path by midpoints
      bend = (kWingletCant - dihedral_) * smoothstep(d * (i + 0.5) / n_steps / 1.5);
      y += std::cos(dihedral_ + bend) / std::cos(dihedral_) * d / n_steps;
      z += std::sin(dihedral_ + bend) / std::cos(dihedral_) * d / n_steps;
    }
    s.leading_edge = gp_Pnt(s.leading_edge.X() + aft_ * d + 0.06 * d * d, y, z);
    s.chord -= 0.2755 * d + 0.02 * d * d;
    s.roll = (kWingletCant - dihedral_) * smoothstep(d / 1.5);
    return s;
  }

  Panel inboard_panel() const {
    Panel panel;
    panel.parameters = linspace(kRootY, kKinkY, 6);
    for (double y : panel.parameters) panel.sections.push_back(main_section(y));
    panel.span_splits = {kRootY, 3.0, 4.7, kKinkY};
    return panel;
  }

  Panel outboard_panel() const {
    Panel panel;
    panel.parameters = linspace(kKinkY, kTipY, 10);
    for (double y : panel.parameters) panel.sections.push_back(main_section(y));
    for (double d : linspace(0, kWingletLength, 14)) {
      if (d == 0) continue;
      panel.parameters.push_back(kTipY + d);
      panel.sections.push_back(winglet_section(d));
    }
    panel.span_splits = {kKinkY, 8.2, 10.2, 12.2, 14.2, 15.9, 17.5, kTipY + kWingletLength};
    return panel;
  }

  /// A flap of 22 % of the chord, whose nose is just below and ahead of the trailing edge, turned down by `angle`.
  Panel flap_panel(double angle) const {
    Panel panel;
    panel.parameters = linspace(kFlapBegin, kFlapEnd, 5);
    for (double y : panel.parameters) {
      const Section wing = main_section(y);
      const gp_Pnt edge = lower_point(wing, 1.0);
      Section s;
      s.leading_edge = gp_Pnt(edge.X() - 0.01 * wing.chord, y, edge.Z() - 0.035 * wing.chord);
      s.chord = 0.22 * wing.chord;
      s.thickness = 0.12;
      s.twist = wing.twist - angle;
      panel.sections.push_back(s);
    }
    panel.span_splits = {kFlapBegin, 9.9, kFlapEnd};
    return panel;
  }

 private:
  static constexpr double kFlapBegin = 7.2, kFlapEnd = 12.6;
  double dihedral_, aft_;
};
}  // namespace wing

Part make_wing(const wing::Planform& planform, NameTable& names) {
  Patchwork patches(names);
  const std::vector<double> chord_splits = {0.18, 0.65};
  const PanelRims inboard = add_panel(patches, planform.inboard_panel(), chord_splits, "wing");
  const PanelRims outboard = add_panel(patches, planform.outboard_panel(), chord_splits, "wing");
  patches.add_planar(inboard.first, "wing_root");
  patches.add_planar(outboard.last, "wing_tip");
  return {"wing", patches.solid("wing")};
}

Part make_flap(const wing::Planform& planform, double angle, NameTable& names) {
  Patchwork patches(names);
  const PanelRims rims = add_panel(patches, planform.flap_panel(angle), {0.2, 0.65}, "flap");
  patches.add_planar(rims.first, "flap_end");
  patches.add_planar(rims.last, "flap_end");
  return {"flap", patches.solid("flap")};
}

/// Slender pod below the trailing edge at span y.
Part make_flap_fairing(const wing::Planform& planform, NameTable& names, double y) {
  const Section s = planform.main_section(y);
  const double c = s.chord, x0 = s.leading_edge.X(), z_front = lower_point(s, 0.5).Z() + 0.03 * c,
               z_te = lower_point(s, 1.0).Z();
  EllipticBody body = closed_body(x0 + 0.5 * c, x0 + 1.22 * c, 2, [&](double x) {
    const double t = (x - x0 - 0.5 * c) / (0.5 * c);
    return Ellipse{0, 0.03 * c, 0.05 * c, y, z_front + t * (z_te - 0.085 * c - z_front)};
  });
  body.splits = {0, 0.62, 1};
  body.angles_deg = {-50, 50, 180, 310};
  Patchwork patches(names);
  add_body(patches, body, "flap_fairing");
  return {"flap fairing", patches.solid("flap fairing")};
}

// -------------------------------------------------------------------------------- engine

constexpr double kEngineX = 11.4, kEngineY = 5.75, kEngineRadius = 1.03;

/// An engine as large as `scale` times the inner one, at another place: x of that one is `shift` + `scale` * x.
struct Engine {
  double y, scale, shift = 0;
  Section wing;  ///< the wing's section there

  Engine(const wing::Planform& planform, double at, double size) : y(at), scale(size), wing(planform.main_section(at)) {
    const double nose = 12.0 + 0.52 * kEngineY;  // of the wing above the inner engine of the bundled example
    shift = wing.leading_edge.X() - nose * scale;
  }
  double x_of(double x) const { return shift + scale * x; }
  double radius() const { return kEngineRadius * scale; }
  double axis_z() const { return wing.leading_edge.Z() - 1.75 * scale; }
};

/// Through-flow nacelle: a ring with the section of an aerofoil.
Part make_nacelle(const Engine& engine, NameTable& names) {
  Section profile;
  profile.chord = 3.7 * engine.scale;
  profile.thickness = 0.09;
  EllipticBody body;
  body.parameters = profile_parameters();
  for (double p : body.parameters) {
    const gp_Pnt q = profile_point(profile, p);
    const double r = engine.radius() + q.Z();
    body.sections.push_back({engine.x_of(kEngineX) + q.X(), r, r, engine.y, engine.axis_z()});
  }
  body.splits = profile_splits({0.12, 0.6});
  body.angles_deg = {-45, 45, 135, 225, 315};
  Patchwork patches(names);
  const Rims rims = add_body(patches, body, [](double p) { return p < 0.5 ? "nacelle_outer" : "nacelle_inner"; });
  for (std::size_t i = 0; i < rims.first.size(); ++i) patches.add(ruled(rims.first[i], rims.last[i]), "nacelle_te");
  return {"nacelle", patches.solid("nacelle")};
}

/// Pylon: starts inside the wall of the nacelle, leaves it before its trailing edge and ends inside the wing.
Part make_pylon(const Engine& engine, NameTable& names) {
  const double k = engine.scale, begin = kEngineX + 0.85, end = 18.4;
  const double wall = engine.axis_z() + engine.radius(), wing_z = engine.wing.leading_edge.Z() - 0.01 * k;
  EllipticBody body = closed_body(engine.x_of(begin), engine.x_of(end), 6, [&](double place) {
    const double x = (place - engine.shift) / k, ramp = wall + 0.08 * k + 0.3 * k * (x - kEngineX - 0.85);
    const double gap = ramp - wing_z, top = 0.5 * (ramp + wing_z - std::sqrt(gap * gap + 0.15 * k * 0.15 * k));
    const double bottom = wall + (wing_z - 0.06 * k - wall) * smoothstep((x - 13.4) / (18.4 - 13.4));
    return Ellipse{0, 0.2 * k, 0.5 * (top - bottom), engine.y, 0.5 * (top + bottom)};
  });
  body.splits = {0, 0.4, 0.62, 1};
  body.angles_deg = {0, 90, 180, 270, 360};
  Patchwork patches(names);
  add_body(patches, body, "pylon");
  return {"pylon", patches.solid("pylon")};
}

// -------------------------------------------------------------------------------- tail

/// Nose of the tailplane where it meets the symmetry plane, and how it rises.
struct TailPlace {
  double x = 30.9, z = 0.85, root_y = 0.2, rise = 0.1;  ///< rise: per span
};

Part make_horizontal_tail(const TailPlace& place, NameTable& names) {
  constexpr double kTipY = 6.3;
  Panel panel;
  panel.parameters = linspace(place.root_y, kTipY, 5);
  for (double y : panel.parameters) {
    Section s;
    s.leading_edge = gp_Pnt(place.x + 0.6 * y, y, place.z + place.rise * y);
    s.chord = 4.2 - 0.43 * y;
    s.twist = -1.5 * kDegree;
    s.thickness = 0.1;
    panel.sections.push_back(s);
  }
  panel.span_splits = {place.root_y, 2.5, 4.4, kTipY};
  Patchwork patches(names);
  const PanelRims rims = add_panel(patches, panel, {0.2, 0.65}, "htail");
  patches.add_planar(rims.first, "htail_root");
  patches.add_planar(rims.last, "htail_tip");
  return {"horizontal tail", patches.solid("horizontal tail")};
}

/// One side of a V.
Part make_v_tail(NameTable& names) {
  constexpr double kCant = 38 * kDegree, kLength = 6.5;
  Panel panel;
  panel.parameters = linspace(0, kLength, 5);
  for (double d : panel.parameters) {
    Section s;
    s.leading_edge = gp_Pnt(29.9 + 0.6 * d, 0.3 + std::cos(kCant) * d, 0.7 + std::sin(kCant) * d);
    s.chord = 4.6 - 0.45 * d;
    s.thickness = 0.1;
    s.roll = kCant;
    panel.sections.push_back(s);
  }
  panel.span_splits = {0, 2.6, 4.6, kLength};
  Patchwork patches(names);
  const PanelRims rims = add_panel(patches, panel, {0.2, 0.65}, "v_tail");
  patches.add_planar(rims.first, "v_tail_root");
  patches.add_planar(rims.last, "v_tail_tip");
  return {"V tail", patches.solid("V tail")};
}

/// The half of the vertical tail beyond the symmetry plane.
Part make_vertical_tail(NameTable& names) {
  constexpr double kRootZ = 1.1, kTipZ = 7.9;
  Panel panel;
  panel.half = Half::kUpperOnly;
  panel.parameters = linspace(kRootZ, kTipZ, 5);
  for (double z : panel.parameters) {
    Section s;
    s.leading_edge = gp_Pnt(28.2 + 0.75 * (z - kRootZ), 0, z);
    s.chord = 5.9 - 0.57 * (z - kRootZ);
    s.thickness = 0.1;
    s.roll = -90 * kDegree;
    panel.sections.push_back(s);
  }
  panel.span_splits = {kRootZ, 3.4, 5.6, kTipZ};
  Patchwork patches(names);
  const PanelRims rims = add_panel(patches, panel, {0.2, 0.65}, "vtail");
  patches.add_planar(rims.first, "vtail_root");
  patches.add_planar(rims.last, "vtail_tip");
  patches.add_planar(rims.symmetry, "symmetry");
  return {"vertical tail", patches.solid("vertical tail")};
}

}  // namespace

namespace {
void add_tail(Tail tail, std::vector<Part>& parts, NameTable& names) {
  // roots on the other side of the symmetry plane: the air cuts them
  constexpr TailPlace kTop{32.2, 7.8, -0.4, 0}, kMiddle{31.0, 4.3, -0.4, 0.05};
  if (tail == Tail::kNone) return;
  if (tail == Tail::kV) return parts.push_back(make_v_tail(names));
  parts.push_back(make_horizontal_tail(tail == Tail::kT ? kTop : tail == Tail::kCross ? kMiddle : TailPlace(), names));
  parts.push_back(make_vertical_tail(names));
}
}  // namespace

std::vector<Part> make_parts(const Shape& shape, NameTable& names) {
  const wing::Planform planform(shape);
  std::vector<Part> parts = {make_fuselage(names), make_belly_fairing(names), make_wing(planform, names)};
  const Engine engines[] = {{planform, kEngineY, 1}, {planform, 9.95, 0.72}};
  for (int i = 0; i < shape.n_engines; ++i) {
    parts.push_back(make_nacelle(engines[i], names));
    parts.push_back(make_pylon(engines[i], names));
  }
  add_tail(shape.tail, parts, names);
  for (double y : {3.7, 8.7, 11.2, 13.3}) parts.push_back(make_flap_fairing(planform, names, y));
  if (shape.flaps_deg > 0) parts.push_back(make_flap(planform, shape.flaps_deg * kDegree, names));
  return parts;
}

TopoDS_Solid make_far_field(NameTable& names) {
  constexpr double kReach = 10 * kFuselageLength;
  const TopoDS_Solid box =
      BRepPrimAPI_MakeBox(gp_Pnt(-kReach, 0, -kReach), gp_Pnt(kFuselageLength + kReach, kReach, kReach)).Solid();
  for (TopExp_Explorer it(box, TopAbs_FACE); it.More(); it.Next()) {
    const TopoDS_Face& face = TopoDS::Face(it.Current());
    bool is_symmetry = true;
    for (TopExp_Explorer corner(face, TopAbs_VERTEX); corner.More(); corner.Next())
      is_symmetry &= BRep_Tool::Pnt(TopoDS::Vertex(corner.Current())).Y() == 0;
    names.set(face, is_symmetry ? "symmetry" : "farfield");
  }
  return box;
}

}  // namespace aircraft
