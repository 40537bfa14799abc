#include "stages/check_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/file/json_text.h"
#include "stages/text_table.h"
#include "stages/wing_table.h"

namespace st {

bool Findings::passes() const {
  return std::none_of(checks.begin(), checks.end(), [](const Check& c) { return c.fails(); });
}

std::int64_t Findings::count(const std::string& check) const {
  for (const Check& c : checks)
    if (c.name == check) return c.defects.count;
  return 0;
}

std::string face_label(const SurfaceMesh& mesh, FaceId f) {
  const bool has_name = static_cast<std::size_t>(f) < mesh.labels.face_name.size() && !mesh.labels.face_name[f].empty();
  return has_name ? fmt::format("face {} \"{}\"", f + 1, mesh.labels.face_name[f]) : fmt::format("face {}", f + 1);
}

namespace {

using nlohmann::json;

std::string place_text(const SurfaceMesh& mesh, const DefectPlace& p) {
  std::string text = fmt::format("({:.6g} {:.6g} {:.6g})", p.xyz.x, p.xyz.y, p.xyz.z);
  if (p.face_a != kNone) text += ", " + face_label(mesh, p.face_a);
  if (p.face_b != kNone && p.face_b != p.face_a) text += " and " + face_label(mesh, p.face_b);
  return text;
}

std::string check_line(const SurfaceMesh& mesh, const Check& c) {
  const std::string note = c.note.empty() ? "" : "  " + c.note;
  if (c.defects.count == 0) return fmt::format("  {:<20} ok{}\n", c.name, note);
  const std::string where =
      c.defects.first[0].face_a == kNone ? "" : ", first at " + place_text(mesh, c.defects.first[0]);
  return fmt::format("  {:<20} {} {} {}{}{}\n", c.name, c.fails() ? "FAILS" : "note:", c.defects.count, c.what, where,
                     note);
}

/// Deviation of the faces of each group.
std::vector<DeviationStats> deviation_by_group(const Findings& f) {
  std::vector<DeviationStats> groups(f.quality.groups.size());
  if (!f.deviation) return groups;
  for (std::size_t i = 0; i < f.deviation->faces.size(); ++i)
    if (static_cast<std::size_t>(f.face_group[i]) < groups.size()) groups[f.face_group[i]].add(f.deviation->faces[i]);
  return groups;
}

/// A line for each group of triangles, aligned below a heading; none where there is one group.
std::string group_table(const SurfaceMesh& mesh, const Findings& f) {
  constexpr std::size_t kMostGroups = 30;
  const std::vector<QualityStats>& groups = f.quality.groups;
  if (groups.size() < 2) return "";
  const std::vector<DeviationStats> deviation = deviation_by_group(f);
  std::vector<TableRow> rows{{"group", "triangles", "mean quality", "least", "below 0.3", "angles, deg"}};
  if (f.conformity) rows[0].emplace_back("of the size asked");
  if (f.deviation) rows[0].push_back("off the surface" + (f.unit.empty() ? "" : ", " + f.unit));
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const QualityStats& q = groups[g];
    if (q.n_triangles == 0) continue;
    TableRow row{g < mesh.labels.group_name.size() ? mesh.labels.group_name[g] : "",
                 std::to_string(q.n_triangles),
                 fmt::format("{:.3f}", q.mean),
                 fmt::format("{:.3f}", q.min),
                 std::to_string(q.n_below_03),
                 fmt::format("{:.1f} to {:.1f}", q.min_angle_deg, q.max_angle_deg)};
    if (f.conformity)
      row.push_back(g < f.conformity->groups.size() ? fmt::format("{:.1f} %", 100 * f.conformity->groups[g].share())
                                                    : "");
    if (f.deviation) row.push_back(fmt::format("{:.3g}", deviation[g].max_distance));
    rows.push_back(std::move(row));
  }
  const std::size_t n_more = rows.size() > kMostGroups + 1 ? rows.size() - kMostGroups - 1 : 0;
  rows.resize(rows.size() - n_more);
  std::string text;
  for (const std::string& line : aligned_columns(rows, rows[0].size() - 1)) text += line + "\n";
  return n_more ? text + fmt::format("  and {} more: see --json\n", n_more) : text;
}

std::string rows_line(const RowStats& r) {
  return fmt::format(
      "  {:<20} {} quadrilaterals, {:.1f} % with angles within {:g} to {:g} deg; the other triangles: mean {:.4f}, 1st "
      "percentile {:.4f}; neighbours up to {:.2f} times as large, {} above {:g}\n",
      "rows", r.n_quads, 100 * r.good_share(), kLeastRowAngleDeg, kMostRowAngleDeg, r.mean, r.p1, r.growth, r.n_grown,
      kMostRowGrowth);
}

std::string quality_lines(const SurfaceMesh& mesh, const QualityReport& q, bool is_stretched) {
  const std::string worst =
      q.model.worst == kNone ? "" : fmt::format(" in {}", face_label(mesh, mesh.triangle_face[q.model.worst]));
  return fmt::format(
             "  {:<20} mean {:.4f}, 1st percentile {:.4f}, least {:.4f}{}; {} below 0.3; angles {:.2f} to {:.2f} deg; "
             "growth "
             "{:.2f} (99.9 %)\n",
             is_stretched ? "stretched quality" : "quality", q.model.mean, q.model.p1, q.model.min, worst,
             q.model.n_below_03, q.model.min_angle_deg, q.model.max_angle_deg, q.jump_p999) +
         (is_stretched ? fmt::format("  {:<20} {} triangles with an angle above {:g} deg in space\n", "obtuse",
                                     q.model.n_above_150_deg, kLargeAngleDeg) +
                             rows_line(q.rows)
                       : "");
}

std::string conformity_lines(const ConformityReport& c) {
  std::int64_t n_forced = 0;
  for (const ForcedPlace& p : c.forced) n_forced += p.n_edges;
  const std::string forced = n_forced ? fmt::format(" (without {} edges in {} places that the CAD forces to be short)",
                                                    n_forced, c.forced.size())
                                      : "";
  return fmt::format(
      "  {:<20} {:.1f} % of edges within {} to {} of the requested length{}, {:.1f} % of those inside faces; mean "
      "{:.3f}, 1 % to 99 %: "
      "{:.2f} to {:.2f}\n",
      "sizes", 100 * c.free.share(), kConformityMin, kConformityMax, forced, 100 * c.inner.share(), c.model.mean(),
      c.p1, c.p99);
}

std::string in_face(const SurfaceMesh& mesh, FaceId f) { return f == kNone ? "" : " in " + face_label(mesh, f); }

std::string deviation_line(const SurfaceMesh& mesh, const SurfaceDeviation& d, const std::string& unit) {
  return fmt::format(
      "  {:<20} midpoints off the surface by {} at most{}, mean {}; normals by {:.1f} deg at most{}, mean {:.2f} deg\n",
      "deviation", length_text(d.model.max_distance, unit), in_face(mesh, d.worst_distance),
      length_text(d.model.mean_distance(), unit), d.model.max_angle_deg, in_face(mesh, d.worst_angle),
      d.model.mean_angle_deg());
}

/// The cause with what it means, where its name alone does not say it.
std::string cause_words(ShapeCause cause) {
  const std::string name = cause_name(cause);
  if (cause == ShapeCause::kSizeJump) return name + " (requested lengths change fast there)";
  return cause == ShapeCause::kFree ? name + " (no cause in CAD or sizes)" : name;
}

/// "  sharp  5 with an angle below 10 deg: 3 corner, 2 strip; worst: 4.5 at ..., ...": free places before those that
/// the CAD forces.
std::string cause_line(const SurfaceMesh& mesh, const std::string& name, const std::string& what,
                       const CauseList& list) {
  constexpr std::size_t kShown = 3;
  if (list.total() == 0) return fmt::format("  {:<20} none {}\n", name, what);
  std::string counts, places;
  std::size_t n_shown = 0;
  for (std::size_t k = 0; k < kNShapeCauses; ++k)
    if (list.count[k])
      counts +=
          fmt::format("{}{} {}", counts.empty() ? "" : ", ", list.count[k], cause_words(static_cast<ShapeCause>(k)));
  for (std::size_t k = kNShapeCauses; k-- > 0;)
    for (const CausePlace& p : list.worst[k])
      if (n_shown++ < kShown)
        places += fmt::format("{}{:.4g} at {}", places.empty() ? "" : "; ", p.value,
                              place_text(mesh, {p.xyz, p.face, kNone}));
  return fmt::format("  {:<20} {} {}: {}; worst: {}\n", name, list.total(), what, counts, places);
}

std::string cause_lines(const SurfaceMesh& mesh, const ShapeCauses& c, bool has_sizes) {
  return cause_line(mesh, "sharp", fmt::format("with an angle below {:g} deg", c.angle_deg), c.sharp) +
         cause_line(mesh, "growth", fmt::format("between neighbours above {}", kLargeGrowth), c.growth) +
         (has_sizes ? cause_line(mesh, "lengths", fmt::format("more outside {} to {}", kConformityMin, kConformityMax),
                                 c.lengths)
                    : "");
}

/// Handles of all parts together, where the number means something.
std::optional<std::int64_t> genus_of(const TopologyReport& t) {
  const bool is_manifold =
      t.is_closed() && t.n_cad_boundary_edges == 0 && t.n_cad_nonmanifold_edges == 0 && t.pinched_nodes.count == 0;
  return is_manifold ? std::optional(t.genus) : std::nullopt;
}

/// What is beyond what a mesh of the CAD would be expected to be, though its sizes ask for it.
std::string said_of_sizes(const Findings& f) {
  constexpr double kWorthSaying = 0.01;
  std::string text;
  if (const std::int64_t n = f.count("below-sizes"))
    text += fmt::format(", {} {} below the sizes", n, n == 1 ? "face" : "faces");
  const auto add = [&](const char* what, const std::optional<double>& difference) {
    if (difference && std::fabs(*difference) > kWorthSaying)
      text += fmt::format(", {} {:.1f} % {} the CAD's", what, 100 * std::fabs(*difference),
                          *difference < 0 ? "below" : "above");
  };
  add("area", f.area_difference);
  add("volume", f.volume_difference);
  return text;
}

/// Parts in contact are sound each for itself, but not one surface.
std::string passed_as(const Findings& f) {
  const std::int64_t n = f.crossings.contacts.count;
  if (n == 0) return "passes" + said_of_sizes(f);
  return fmt::format(
      "passes part by part, which touch or cross in {} pairs of triangles (st-import --join or --unite "
      "makes them one){}",
      n, said_of_sizes(f));
}

std::string verdict_line(const std::string& path, const SurfaceMesh& mesh, const Findings& f, double seconds) {
  std::string failed;
  for (const Check& c : f.checks) {
    if (!c.fails()) continue;
    const bool has_place = c.defects.first[0].face_a != kNone;
    failed += fmt::format("{}{} {}{}", failed.empty() ? "" : "; ", c.defects.count, c.what,
                          has_place ? ", first at " + place_text(mesh, c.defects.first[0]) : "");
  }
  const std::string verdict = failed.empty() ? passed_as(f) : "FAILS: " + failed;
  const std::string genus = genus_of(f.topology) ? fmt::format(", genus {}", *genus_of(f.topology)) : "";
  return fmt::format("{}: {}; {} triangles, {} nodes, {} {}{}, {:.1f} s", path, verdict, mesh.n_triangles(),
                     f.topology.n_used_nodes, f.topology.n_components, f.topology.n_components == 1 ? "part" : "parts",
                     genus, seconds);
}

// --- JSON ---

json xyz_json(Vec3 p) { return {p.x, p.y, p.z}; }

json check_json(const Check& c) {
  json places = json::array();
  for (const DefectPlace& p : c.defects.first) {
    json faces = json::array();
    for (const FaceId f : {p.face_a, p.face_b})
      if (f != kNone) faces.push_back(f + 1);
    places.push_back({{"xyz", xyz_json(p.xyz)}, {"faces", faces}});
  }
  return {{"count", c.defects.count}, {"allowed", c.allowed}, {"passes", !c.fails()}, {"first", places}};
}

json quality_json(const QualityStats& q, ReportDetail detail) {
  json j{{"triangles", q.n_triangles},
         {"mean", q.mean},
         {"p1", q.p1},
         {"min", q.min},
         {"below_0.3", q.n_below_03},
         {"min_angle_deg", q.min_angle_deg},
         {"max_angle_deg", q.max_angle_deg},
         {"above_150_deg", q.n_above_150_deg},
         {"below_20_deg", q.n_below_20_deg},
         {"below_10_deg", q.n_below_10_deg},
         {"below_5_deg", q.n_below_5_deg}};
  if (detail == ReportDetail::kFull) j["histogram"] = q.histogram, j["angle_histogram"] = q.angle_histogram;
  return j;
}

json rows_json(const RowStats& r) {
  return {{"quadrilaterals", r.n_quads},
          {"good_share", r.good_share()},
          {"others", r.n_others},
          {"others_mean", r.mean},
          {"others_p1", r.p1},
          {"growth_max", r.growth},
          {"growth_above_2.2", r.n_grown}};
}

json jump_json(const JumpStats& s, ReportDetail detail) {
  json j{{"pairs", s.n_pairs}, {"max", s.max}};
  if (detail == ReportDetail::kFull) j["histogram"] = s.histogram;
  return j;
}

json conformity_json(const ConformityStats& c, ReportDetail detail) {
  json j{{"edges", c.n_edges}, {"share", c.share()}, {"mean", c.mean()}, {"min", c.min}, {"max", c.max}};
  if (detail == ReportDetail::kFull) j["histogram"] = c.histogram;
  return j;
}

json deviation_json(const DeviationStats& d, ReportDetail detail) {
  json j{{"max", d.max_distance},
         {"mean", d.mean_distance()},
         {"normal_max_deg", d.max_angle_deg},
         {"normal_mean_deg", d.mean_angle_deg()}};
  if (detail == ReportDetail::kFull) {
    j["place"] = xyz_json(d.distance_place);
    j["normal_place"] = xyz_json(d.angle_place);
    j["normal_histogram"] = d.angle_histogram;
  }
  return j;
}

json forced_json(const ConformityReport& c) {
  json list = json::array();
  for (const ForcedPlace& p : c.forced) {
    json entry{{"edges", p.n_edges}, {"min_ratio", p.min_ratio}, {"xyz", xyz_json(p.xyz)}};
    entry["kind"] = p.kind == ForcedPlace::Kind::kStrip ? "strip" : "short edge";
    if (p.entity != kNone) entry[p.kind == ForcedPlace::Kind::kStrip ? "face" : "edge"] = p.entity + 1;
    list.push_back(entry);
  }
  return list;
}

json sizes_json(const ConformityReport& c, ReportDetail detail) {
  std::int64_t n_forced = 0;
  for (const ForcedPlace& p : c.forced) n_forced += p.n_edges;
  json j{{"all", conformity_json(c.model, ReportDetail::kFull)},
         {"free", conformity_json(c.free, detail)},
         {"inner", conformity_json(c.inner, detail)},
         {"forced_edges", n_forced},
         {"forced_places", c.forced.size()},
         {"p1", c.p1},
         {"p99", c.p99}};
  if (detail == ReportDetail::kFull) j["forced"] = forced_json(c);
  return j;
}

json cause_json(const SurfaceMesh& mesh, const CauseList& list) {
  json counts = json::object(), places = json::array();
  for (std::size_t k = 0; k < kNShapeCauses; ++k) {
    counts[cause_name(static_cast<ShapeCause>(k))] = list.count[k];
    for (const CausePlace& p : list.worst[k]) {
      json entry{{"cause", cause_name(p.cause)}, {"face", p.face + 1}, {"value", p.value}, {"xyz", xyz_json(p.xyz)}};
      entry["name"] =
          static_cast<std::size_t>(p.face) < mesh.labels.face_name.size() ? mesh.labels.face_name[p.face] : "";
      if (p.edge != kNone) entry["edge"] = p.edge + 1;
      if (p.vertex != kNone) entry["vertex"] = p.vertex + 1;
      places.push_back(entry);
    }
  }
  return {{"count", list.total()}, {"free", list.free()}, {"by_cause", counts}, {"worst", places}};
}

json causes_json(const SurfaceMesh& mesh, const ShapeCauses& c, bool has_sizes) {
  json j{{"below_deg", c.angle_deg}, {"sharp", cause_json(mesh, c.sharp)}, {"growth", cause_json(mesh, c.growth)}};
  if (has_sizes) j["lengths"] = cause_json(mesh, c.lengths);
  return j;
}

json groups_json(const SurfaceMesh& mesh, const Findings& f, ReportDetail detail) {
  json groups = json::array();
  const std::vector<DeviationStats> deviation = deviation_by_group(f);
  for (std::size_t g = 0; g < f.quality.groups.size(); ++g) {
    json entry{{"name", g < mesh.labels.group_name.size() ? mesh.labels.group_name[g] : ""},
               {"quality", quality_json(f.quality.groups[g], detail)},
               {"jumps", jump_json(f.quality.group_jumps[g], detail)}};
    if (f.conformity && g < f.conformity->groups.size())
      entry["sizes"] = conformity_json(f.conformity->groups[g], detail);
    if (f.deviation) entry["deviation"] = deviation_json(deviation[g], detail);
    groups.push_back(entry);
  }
  return groups;
}

/// Relative difference between the mesh's and the CAD's area of a face; none without a geometry or an area.
std::optional<double> area_error(const Findings& f, std::size_t face) {
  if (face >= f.cad_area.size() || !(f.cad_area[face] > 0)) return std::nullopt;
  return std::fabs(f.measure.face_area[face] - f.cad_area[face]) / f.cad_area[face];
}

json face_json(const SurfaceMesh& mesh, const Findings& f, std::size_t i, ReportDetail detail) {
  const QualityStats& q = f.quality.faces[i];
  json j{{"face", i + 1},
         {"name", i < mesh.labels.face_name.size() ? mesh.labels.face_name[i] : ""},
         {"triangles", q.n_triangles},
         {"area", f.measure.face_area[i]},
         {"mean", q.mean},
         {"min", q.min}};
  if (const auto error = area_error(f, i)) j["cad_area"] = f.cad_area[i], j["area_error"] = *error;
  if (f.chords && i < f.chords->distance.size()) j["chord_distance"] = f.chords->distance[i];
  if (f.conformity && i < f.conformity->faces.size()) j["size_share"] = f.conformity->faces[i].share();
  if (f.deviation && i < f.deviation->faces.size()) j["deviation"] = deviation_json(f.deviation->faces[i], detail);
  if (detail == ReportDetail::kSummary) return j;
  j["quality"] = quality_json(q, detail);
  j["jumps"] = jump_json(f.quality.face_jumps[i], detail);
  if (f.conformity && i < f.conformity->faces.size()) j["sizes"] = conformity_json(f.conformity->faces[i], detail);
  return j;
}

json faces_json(const SurfaceMesh& mesh, const Findings& f, ReportDetail detail) {
  json faces = json::array();
  for (std::size_t i = 0; i < f.quality.faces.size(); ++i) faces.push_back(face_json(mesh, f, i, detail));
  return faces;
}

/// Where the bins of the histograms lie: first value and width.
json bins_json() {
  return {{"quality", {0, 0.1}},
          {"angle_deg", {0, 10}},
          {"jump", {1, JumpStats::kBinWidth}},
          {"size_ratio", {0, ConformityStats::kBinWidth}},
          {"normal_deg", {0, DeviationStats::kBinDeg}}};
}

}  // namespace

std::string length_text(double length, const std::string& unit) {
  return fmt::format("{:.3g}{}{}", length, unit.empty() ? "" : " ", unit);
}

std::string check_report_text(const std::string& path, const SurfaceMesh& mesh, const Findings& f, double seconds) {
  std::string text;
  for (const bool fails : {true, false})
    for (const Check& c : f.checks)
      if (c.fails() == fails) text += check_line(mesh, c);
  text += group_table(mesh, f);
  text += wing_table(f.wings, f.is_stretched);
  text += quality_lines(mesh, f.quality, f.is_stretched);
  if (f.conformity) text += conformity_lines(*f.conformity);
  if (f.deviation) text += deviation_line(mesh, *f.deviation, f.unit);
  if (f.causes) text += cause_lines(mesh, *f.causes, f.conformity.has_value());
  return text + verdict_line(path, mesh, f, seconds);
}

std::string check_brief_text(const std::string& path, const SurfaceMesh& mesh, const Findings& f, double seconds,
                             CheckText detail) {
  std::string text;
  std::vector<std::string> notes;
  for (const Check& c : f.checks) {
    if (c.fails()) text += check_line(mesh, c);
    if (!c.fails() && c.defects.count > 0) notes.emplace_back(c.name);
  }
  const QualityStats& q = f.quality.model;
  std::string worst;
  if (q.worst != kNone) {
    const auto& n = mesh.triangles[q.worst].n;
    const Vec3 middle = (mesh.node_xyz[n[0]] + mesh.node_xyz[n[1]] + mesh.node_xyz[n[2]]) / 3;
    worst = " at " + place_text(mesh, {middle, mesh.triangle_face[q.worst], kNone});
  }
  text += fmt::format("  {:<20} mean {:.4f}, least {:.4f}{}\n", f.is_stretched ? "stretched quality" : "quality",
                      q.mean, q.min, worst);
  text += fmt::format("  {:<20} {:.2f} to {:.2f} deg\n", "angles", q.min_angle_deg, q.max_angle_deg);
  text += fmt::format("  {:<20} {:.2f} from one triangle to its neighbour (99.9 %)\n", "growth", f.quality.jump_p999);
  if (f.conformity)
    text += fmt::format("  {:<20} {:.1f} % of edges within {} to {} of the requested length\n", "sizes",
                        100 * f.conformity->free.share(), kConformityMin, kConformityMax);
  if (f.deviation)
    text +=
        fmt::format("  {:<20} {} off the CAD at most{}\n", "deviation",
                    length_text(f.deviation->model.max_distance, f.unit), in_face(mesh, f.deviation->worst_distance));
  if (detail == CheckText::kWithWings) text += wing_lines(f.wings);
  if (!notes.empty())
    text += fmt::format("  {:<20} {}: see st-check -v, with --geometry and --sizing, or st-report\n", "notes",
                        fmt::join(notes, ", "));
  return text + verdict_line(path, mesh, f, seconds);
}

std::string check_report_json(const std::string& path, const SurfaceMesh& mesh, const Findings& f, double seconds,
                              ReportDetail detail) {
  json checks = json::object(), failed = json::array();
  for (const Check& c : f.checks) {
    checks[c.name] = check_json(c);
    if (c.fails()) failed.push_back(c.name);
  }
  json j{{"mesh", path},
         {"passes", f.passes()},
         {"failed", failed},
         {"triangles", mesh.n_triangles()},
         {"nodes", f.topology.n_used_nodes},
         {"edges", f.topology.n_edges},
         {"components", f.topology.n_components},
         {"euler", f.topology.euler},
         {"genus", genus_of(f.topology) ? json(*genus_of(f.topology)) : json()},
         {"closed", f.topology.is_closed()},
         {"boundary_edges", f.topology.boundary_edges.count},
         {"cad_boundary_edges", f.topology.n_cad_boundary_edges},
         {"nonmanifold_edges", f.topology.nonmanifold_edges.count},
         {"cad_nonmanifold_edges", f.topology.n_cad_nonmanifold_edges},
         {"misoriented_edges", f.topology.misoriented_edges.count},
         {"duplicate_nodes", f.shape.duplicate_nodes.count},
         {"folds", f.shape.folds.count},
         {"crossings", f.crossings.crossings.count},
         {"area", f.measure.area},
         {"volume", f.measure.volume},
         {"area_difference", f.area_difference ? json(*f.area_difference) : json()},
         {"volume_difference", f.volume_difference ? json(*f.volume_difference) : json()},
         {"checks", checks},
         {"quality", quality_json(f.quality.model, ReportDetail::kFull)},
         {"jump_p999", f.quality.jump_p999},
         {"jump_max", f.quality.jump_max},
         {"groups", groups_json(mesh, f, detail)},
         {"faces", faces_json(mesh, f, detail)},
         {"seconds", seconds}};
  j["jumps"] = jump_json(f.quality.jumps, ReportDetail::kFull);
  if (f.is_stretched) j["rows"] = rows_json(f.quality.rows);
  if (f.conformity) j["sizes"] = sizes_json(*f.conformity, detail);
  if (f.deviation) j["deviation"] = deviation_json(f.deviation->model, ReportDetail::kFull);
  if (!f.wings.empty()) j["lifting_surfaces"] = wing_measures_json(f.wings);
  if (f.causes) j["causes"] = causes_json(mesh, *f.causes, f.conformity.has_value());
  if (detail == ReportDetail::kFull) j["bins"] = bins_json();
  return json_text(j, detail == ReportDetail::kFull ? 1 : -1);
}

}  // namespace st
