#include "lifting_surface.h"

#include <Geom_BSplineCurve.hxx>
#include <cmath>

#include "splines.h"

namespace aircraft {
namespace {

/// Half thickness of the NACA four-digit family at chord fraction x = c * c; c changes sign at the leading edge and
/// gives the side its sign.
double half_thickness(const Section& s, double c) {
  const double x = c * c, side = c < 0 ? -1 : 1;
  const double closing = -0.1260 * x - 0.3516 * x * x + 0.2843 * x * x * x - 0.1036 * x * x * x * x;
  return 5 * s.thickness * (0.2969 * c + side * closing) + side * 0.5 * s.trailing_edge * x;
}

/// Rear-loaded mean line.
double mean_line(const Section& s, double x) { return s.camber * 4 * x * (1 - x) * (0.6 + 0.8 * x); }

/// Curve moved into the plane y = 0.
Handle(Geom_Curve) flattened(const Handle(Geom_Curve) & curve) {
  auto flat = Handle(Geom_BSplineCurve)::DownCast(curve->Copy());
  for (int i = 1; i <= flat->NbPoles(); ++i) flat->SetPole(i, gp_Pnt(flat->Pole(i).X(), 0, flat->Pole(i).Z()));
  return flat;
}

gp_Pnt start(const Handle(Geom_Curve) & c) { return c->Value(c->FirstParameter()); }
gp_Pnt end(const Handle(Geom_Curve) & c) { return c->Value(c->LastParameter()); }

}  // namespace

gp_Pnt profile_point(const Section& s, double p) {
  const double c = 1 - 2 * p, x = c * c;  // smooth at the nose, and no stationary point at the trailing edge
  const double chordwise = s.chord * x, normal = s.chord * (mean_line(s, x) + half_thickness(s, c));
  const double dx = chordwise * std::cos(s.twist) + normal * std::sin(s.twist),
               dn = normal * std::cos(s.twist) - chordwise * std::sin(s.twist);
  return gp_Pnt(s.leading_edge.X() + dx, s.leading_edge.Y() - dn * std::sin(s.roll),
                s.leading_edge.Z() + dn * std::cos(s.roll));
}

gp_Pnt lower_point(const Section& section, double chord_fraction) {
  return profile_point(section, 0.5 * (1 + std::sqrt(chord_fraction)));
}

std::vector<double> profile_parameters() { return linspace(0, 1, 49); }

std::vector<double> profile_splits(const std::vector<double>& chord_fractions) {
  std::vector<double> splits = {0.5};
  for (double f : chord_fractions) {
    const double p = 0.5 * (1 - std::sqrt(f));
    splits.insert(splits.begin(), p);
    splits.push_back(1 - p);
  }
  splits.insert(splits.begin(), 0);
  splits.push_back(1);
  return splits;
}

PanelRims add_panel(Patchwork& patches, const Panel& panel, const std::vector<double>& chord_fractions,
                    const std::string& name) {
  std::vector<std::vector<gp_Pnt>> rows;
  for (const Section& s : panel.sections) {
    rows.emplace_back();
    for (double p : profile_parameters()) rows.back().push_back(profile_point(s, p));
  }
  const auto surface = skin(rows, CubicInterpolation(profile_parameters()), CubicInterpolation(panel.parameters));
  const bool is_half = panel.half == Half::kUpperOnly;
  std::vector<double> around = profile_splits(chord_fractions);
  if (is_half) around.resize(around.size() / 2 + 1);

  PanelRims rims;
  const int n_around = int(around.size()) - 1, n_bays = int(panel.span_splits.size()) - 1;
  for (int j = 0; j < n_bays; ++j) {
    const std::array<double, 2> v = {panel.span_splits[j], panel.span_splits[j + 1]};
    Handle(Geom_Curve) upper_end, lower_end;
    for (int i = 0; i < n_around; ++i) {
      const auto patch = segment(surface, {around[i], around[i + 1]}, v);
      patches.add(patch, is_half ? name : name + (around[i] < 0.5 ? "_upper" : "_lower"));
      if (i == 0) upper_end = patch->UIso(around[i]);
      if (i == n_around - 1) lower_end = patch->UIso(around[i + 1]);
      if (j == 0) rims.first.push_back(patch->VIso(v[0]));
      if (j == n_bays - 1) rims.last.push_back(patch->VIso(v[1]));
    }
    const Handle(Geom_Curve) other_end = is_half ? flattened(upper_end) : lower_end;
    patches.add(ruled(upper_end, other_end), name + "_te");
    if (j == 0) rims.first.push_back(line(start(other_end), start(upper_end)));
    if (j == n_bays - 1) rims.last.push_back(line(end(other_end), end(upper_end)));
    if (!is_half) continue;
    rims.symmetry.push_back(lower_end);
    rims.symmetry.push_back(other_end);
    for (auto* rim : {&rims.first, &rims.last}) {
      if (rim == &rims.first ? j != 0 : j != n_bays - 1) continue;
      const auto at = rim == &rims.first ? start : end;
      rim->push_back(line(at(lower_end), at(other_end)));
      rims.symmetry.push_back(rim->back());
    }
  }
  return rims;
}

}  // namespace aircraft
