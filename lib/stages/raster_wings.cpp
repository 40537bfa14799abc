#include "stages/raster_wings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/log.h"
#include "base/text.h"
#include "features/ridge_noses.h"
#include "geometry/model/edge_faces.h"
#include "stages/raster_options.h"
#include "stages/size_tally.h"

namespace st {
namespace {

constexpr std::size_t kMostUnused = 20;  // lines about trailing edges without a lifting surface

/// Where --lmin undoes --edge-size.
void warn_of_floor(const RasterStageOptions& o, const std::vector<LiftingSurface>& surfaces, const WingSizes& sizes,
                   const std::string& unit) {
  std::size_t n_raised = 0;
  std::optional<RaisedLength> most;
  for (const LiftingSurface& wing : surfaces) {
    const std::optional<RaisedLength> own = most_raised(wing, sizes);
    if (!own) continue;
    ++n_raised;
    note_raised(*own, most);
  }
  if (most)
    log_warning(fmt::format(
        "--lmin {} is larger than --edge-size {} on {} of {} lifting surfaces: {:.4g}{} instead of {:.4g}{} "
        "where it matters most; give a smaller --lmin, or leave it out",
        o.lmin, o.edge_size, n_raised, surfaces.size(), most->floor, unit, most->asked, unit));
}

/// Of a long face: its width. Model unit.
double face_width(const ModelTables& t, FaceId f) {
  double around = 0;
  for (const EdgeId e : t.edges_of(f)) around += t.edge_length[e];
  return around > 0 ? 2 * t.face_area[f] / around : 0;
}

/// Half of the least length at the noses of `wings`, of the default one at most, per face of theirs and narrow face
/// beside one; infinite for other faces.
std::vector<double> curvature_floors(const ModelTables& t, const std::vector<LiftingSurface>& wings,
                                     const WingSizes& sizes, std::span<const ChordLine> chords) {
  constexpr double kOfNose = 0.5;
  constexpr double kDefaultNose = 0.003;  // of the chord
  constexpr double kNarrow = 0.1;         // likewise
  constexpr double kNone = std::numeric_limits<double>::infinity();
  std::vector<double> floors(static_cast<std::size_t>(t.n_faces()), kNone);
  std::vector<double> own(wings.size(), kNone), chord(wings.size(), kNone);
  for (const ChordLine& line : chords) {
    const LiftingSurface& wing = wings[line.wing];
    if (wing.trailing.empty()) continue;
    const double length = length_along(wing, sizes, wing.trailing.front(), line.chord);
    own[line.wing] = std::min(own[line.wing], kOfNose * std::min(length, kDefaultNose * line.chord));
    chord[line.wing] = std::min(chord[line.wing], line.chord);
  }
  const EdgeFaces faces_at(t);
  for (std::size_t w = 0; w < wings.size(); ++w) {
    const auto is_own = [&](FaceId f) { return std::ranges::binary_search(wings[w].faces, f); };
    for (const FaceId wing_face : wings[w].faces)
      for (const EdgeId e : t.edges_of(wing_face))
        for (const FaceId f : faces_at[e])
          if (is_own(f) || face_width(t, f) < kNarrow * chord[w]) floors[f] = std::min(floors[f], own[w]);
  }
  return floors;
}

/// Curvature on and beside a lifting surface asks for no less than a share of what its nose gets: fillets and rounded
/// tips need no finer mesh than the nose does. Slots of flaps ask for what the nose gets at least, however small they
/// are beside the model. An lmin of a rule stays.
void set_floors(const ModelTables& t, const std::vector<LiftingSurface>& wings, const WingSizes& sizes,
                ModelLimits& limits) {
  const std::vector<double> floors = curvature_floors(t, wings, sizes, limits.chords);
  for (std::size_t f = 0; f < floors.size(); ++f)
    if (std::optional<SamplingLimits>& own = limits.face[f]; own && std::isfinite(floors[f]) && !own->has_own_min) {
      own->gap_floor = std::max(2 * floors[f], limits.min_length);
      own->min_length = std::clamp(floors[f], own->min_length, own->max_length);
    }
}

/// Boxes of all lifting surfaces; lowers the smallest length of `limits` to theirs.
void sample_wings(const RasterStageOptions& o, const Model& model, const std::vector<SizeRule>& rules,
                  std::span<const Strip> strips, double diagonal, double max_length, ModelLimits& limits,
                  RasterWings& wings) {
  const std::optional<LengthSpec> size = edge_size(o);
  if (!size || wings.aircraft.wings.empty()) return;
  std::vector<std::uint8_t> is_left_out = limits.edge_is_ruled;
  for (std::size_t e = 0; e < is_left_out.size(); ++e) is_left_out[e] |= !limits.edge[e];
  WingSizes sizes{*size, o.base_cells, {diagonal, model.tables().unit_in_m}, std::nullopt, o.cell_per_length};
  sizes.stretch = {o.max_aspect, max_length, radians(o.alpha_deg)};
  if (!o.lmin.empty()) sizes.least = parse_length(o.lmin, "--lmin");
  sizes.end_size = end_size(o);
  sizes.is_material_ahead = limits.is_material_ahead;
  sizes.given = find_floors(rules, false, model.tables(), wings.edges, limits);
  const std::string unit = in_unit(model.tables().unit);
  warn_of_floor(o, wings.aircraft.wings, sizes, unit);
  std::optional<RaisedLength> most;
  for (const LiftingSurface& wing : wings.aircraft.wings) {
    const std::optional<RaisedLength> own = raster_wing(model, wing, sizes, strips, is_left_out, wings.boxes);
    if (own) note_raised(*own, most);
    wings.records.push_back(record_wing(wing, sizes, is_left_out, strips));
  }
  if (most)
    log_warning(
        fmt::format("the lmin of a rule is larger than what --edge-size {} asks for: {:.4g}{} instead of {:.4g}{} "
                    "where it matters most; give a smaller lmin there, or leave it out",
                    o.edge_size, most->floor, unit, most->asked, unit));
  for (const RasterBox& box : wings.boxes) limits.min_length = std::min<double>(limits.min_length, box.length);
  if (!sizes.least) set_floors(model.tables(), wings.aircraft.wings, sizes, limits);
}

}  // namespace

GivenFloors find_floors(const std::vector<SizeRule>& rules, bool everywhere, const ModelTables& t,
                        std::span<const WingEdge> wing_edges, const ModelLimits& limits) {
  GivenFloors floors{std::vector<double>(t.n_faces(), 0), std::vector<double>(t.n_edges(), 0)};
  const auto set_edge = [&](EdgeId e) {
    if (limits.edge[e]) floors.edge[e] = limits.edge[e]->min_length;
  };
  const auto set_face = [&](FaceId f) {
    if (limits.face[f]) floors.face[f] = limits.face[f]->min_length;
    for (const EdgeId e : t.edges_of(f)) set_edge(e);
  };
  if (everywhere)
    for (FaceId f = 0; f < t.n_faces(); ++f) set_face(f);
  for (const SizeRule& rule : rules) {
    if (!rule.lmin) continue;
    const RuleTargets targets = find_targets(rule, t, wing_edges);
    for (const EdgeId e : targets.edges) set_edge(e);
    for (FaceId f = 0; f < t.n_faces(); ++f)
      if (rule.selection.empty() || std::binary_search(targets.faces.begin(), targets.faces.end(), f)) set_face(f);
  }
  return floors;
}

ModelLimits find_limits(const RasterStageOptions& o, const Model& model, const FaceRoles& roles,
                        std::span<const Strip> strips, const AskedLimits& asked, RasterWings& wings) {
  if (o.max_aspect > 1)
    for (LiftingSurface& wing : wings.aircraft.wings) put_on_ridges(model, wing);
  wings.aircraft.bodies = find_bodies(model, roles, wings.aircraft.wings);
  ModelLimits limits = model_limits(model.tables(), roles, asked.wall, asked.rules, wings.edges, wings.aircraft);
  sample_wings(o, model, asked.rules, strips, roles.reference_diagonal, asked.wall.max_length, limits, wings);
  return limits;
}

std::vector<std::uint8_t> edges_without_wing(const ModelTables& t, std::span<const DeclaredEdge> declared) {
  std::vector<std::uint8_t> is_excluded(static_cast<std::size_t>(t.n_edges()), 0);
  for (const DeclaredEdge& d : declared) is_excluded[d.edge] = d.meaning == EdgeMeaning::kNoTrailing;
  return is_excluded;
}

void report_wings(const RasterStageOptions& o, const RasterWings& wings, const std::string& unit) {
  const std::size_t n = wings.aircraft.wings.size();
  if (const std::string set = wing_options(o); n == 0 && !set.empty())
    log_report("  no lifting surface found: without effect are " + set);
  else if (n == 0)
    log_info("no lifting surface found: --edge-size has no effect");
  for (std::size_t i = 0; i < std::min(n, kMostGroups); ++i)
    log_report(wing_line(wings.aircraft.wings[i], o.edge_size, unit));
  if (n > kMostGroups) log_report(fmt::format("  and {} more lifting surfaces", n - kMostGroups));
  if (const std::string used = used_line(n, wings.unused); n > 0 && !used.empty())
    log_report(used + (asks_for_wings(o) ? "" : "; -v names them"));
}

void report_unused(const RasterStageOptions& o, const Model& model, const FaceRoles& roles, const RasterWings& wings) {
  const std::string& unit = model.tables().unit;
  for (const UnusedTrailing& u : wings.unused)
    if (u.is_declared) log_warning(declared_warning(u));
  const bool is_asked = asks_for_wings(o);
  for (const std::string& line : unused_lines(wings.unused, kMostUnused, unit))
    is_asked ? log_report(line) : log_info(line);
  if (!is_asked) return;
  for (const std::string& warning :
       {unused_warning(wings.unused, roles.reference_diagonal, unit), noseless_warning(wings.aircraft.wings),
        sheet_warning(find_sheet_edges(model, roles)),
        seam_warning(find_seams_of_blades(model, roles, wings.aircraft.wings))})
    if (!warning.empty()) log_warning(warning);
}

}  // namespace st
