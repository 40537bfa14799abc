#include "stages/check_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/length.h"
#include "base/text.h"
#include "geometry/model/edge_angles.h"
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

std::optional<std::int64_t> Findings::genus() const {
  const bool is_manifold = topology.is_closed() && topology.n_cad_boundary_edges == 0 &&
                           topology.n_cad_nonmanifold_edges == 0 && topology.pinched_nodes.count == 0;
  return is_manifold ? std::optional(topology.genus) : std::nullopt;
}

std::vector<DeviationStats> Findings::deviation_by_group() const {
  std::vector<DeviationStats> groups(quality.groups.size());
  for (std::size_t i = 0; cad && i < cad->deviation.faces.size(); ++i)
    if (static_cast<std::size_t>(cad->face_group[i]) < groups.size())
      groups[cad->face_group[i]].add(cad->deviation.faces[i]);
  return groups;
}

std::string face_label(const SurfaceMesh& mesh, FaceId f) {
  const bool has_name = static_cast<std::size_t>(f) < mesh.labels.face_name.size() && !mesh.labels.face_name[f].empty();
  return has_name ? fmt::format("face {} \"{}\"", f + 1, mesh.labels.face_name[f]) : fmt::format("face {}", f + 1);
}

namespace {

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

/// A line for each group of triangles, aligned below a heading; none where there is one group.
std::string group_table(const SurfaceMesh& mesh, const Findings& f) {
  constexpr std::size_t kMostGroups = 30;
  const std::vector<QualityStats>& groups = f.quality.groups;
  if (groups.size() < 2) return "";
  const std::vector<DeviationStats> deviation = f.deviation_by_group();
  std::vector<TableRow> rows{{"group", "triangles", "mean quality", "least", "below 0.3", "angles, deg"}};
  if (f.conformity) rows[0].emplace_back("of the size asked");
  if (f.cad) rows[0].push_back("off the surface" + (f.unit.empty() ? "" : ", " + f.unit));
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
    if (f.cad) row.push_back(fmt::format("{:.3g}", deviation[g].max_distance));
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
      "  {:<20} {} quadrilaterals, {:.1f} % with angles within {:g} to {:g} deg, {} shorter ones; the other triangles: "
      "mean {:.4f}, 1st percentile {:.4f}; neighbours up to {:.2f} times as large, {} above {:g}\n",
      "rows", r.n_quads, 100 * r.good_share(), kLeastRowAngleDeg, kMostRowAngleDeg, r.n_continued, r.mean, r.p1,
      r.growth, r.n_grown, kMostRowGrowth);
}

std::string quality_lines(const SurfaceMesh& mesh, const QualityReport& q, bool is_stretched) {
  const std::string worst =
      q.model.worst.triangle == kNone ? "" : fmt::format(" in {}", face_label(mesh, q.model.worst.face));
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

/// ", edge 7 of 43 deg"
std::string beside_text(const CausePlace& p) {
  return p.beside == kNone ? "" : fmt::format(", edge {} of {:.3g} deg", p.beside + 1, p.beside_deg);
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
        places += fmt::format("{}{:.4g} at {}{}", places.empty() ? "" : "; ", p.value,
                              place_text(mesh, {p.xyz, p.face, kNone}), beside_text(p));
  if (list.n_smooth > 0)
    counts += fmt::format("; {} at edges that turn by {:g} deg at most", list.n_smooth, kSmoothEdgeDeg);
  return fmt::format("  {:<20} {} {}: {}; worst: {}\n", name, list.total(), what, counts, places);
}

std::string cause_lines(const SurfaceMesh& mesh, const ShapeCauses& c, bool has_sizes) {
  return cause_line(mesh, "sharp", fmt::format("with an angle below {:g} deg", c.angle_deg), c.sharp) +
         cause_line(mesh, "growth", fmt::format("between neighbours above {}", kLargeGrowth), c.growth) +
         (has_sizes ? cause_line(mesh, "lengths", fmt::format("more outside {} to {}", kConformityMin, kConformityMax),
                                 c.lengths)
                    : "");
}

/// What is beyond what a mesh of the CAD would be expected to be, though its sizes ask for it.
std::string said_of_sizes(const Findings& f) {
  constexpr double kWorthSaying = 0.01;
  std::string text;
  if (const std::int64_t n = f.count("below-sizes")) text += fmt::format(", {} below the sizes", counted(n, "face"));
  const auto add = [&](const char* what, const std::optional<double>& difference) {
    if (difference && std::fabs(*difference) > kWorthSaying)
      text += fmt::format(", {} {:.1f} % {} the CAD's", what, 100 * std::fabs(*difference),
                          *difference < 0 ? "below" : "above");
  };
  if (f.cad) add("area", f.cad->area_difference), add("volume", f.cad->volume_difference);
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

/// What is no fault of the mesh, for who reads the last line alone; empty: nothing.
std::string fault_of_model(const Findings& f) {
  if (!f.cad || f.cad->n_model_crossings == 0) return "";
  return fmt::format("{} of {} pairs of triangles cross where {}; ", f.cad->n_model_crossings,
                     f.crossings.crossings.count + f.crossings.overlapping_neighbours.count,
                     f.cad->is_of_facets ? "facets of the file do, so repair the file"
                                         : "the CAD crosses itself, so repair it in the CAD system");
}

std::string verdict_line(const std::string& path, const SurfaceMesh& mesh, const Findings& f, double seconds) {
  const std::string genus = f.genus() ? fmt::format(", genus {}", *f.genus()) : "";
  return fmt::format("{}: {}; {}, {}, {}{}, {:.1f} s", path, verdict(mesh, f), counted(f.n_triangles, "triangle"),
                     counted(f.topology.n_used_nodes, "node"), counted(f.topology.n_components, "part"), genus,
                     seconds);
}

}  // namespace

std::string crossing_note(const Findings& f) {
  if (!f.cad || f.cad->n_model_crossings == 0) return "";
  return fmt::format("{} crossing or overlapping where {}", f.cad->n_model_crossings,
                     f.cad->is_of_facets ? "facets of the file cross" : "the CAD crosses itself");
}

std::string verdict(const SurfaceMesh& mesh, const Findings& f) {
  std::string failed;
  for (const Check& c : f.checks) {
    if (!c.fails()) continue;
    const bool has_place = c.defects.first[0].face_a != kNone;
    failed += fmt::format("{}{} {}{}", failed.empty() ? "" : "; ", c.defects.count, c.what,
                          has_place ? ", first at " + place_text(mesh, c.defects.first[0]) : "");
  }
  return failed.empty() ? passed_as(f) : "FAILS: " + fault_of_model(f) + failed;
}

std::string length_text(double length, const std::string& unit) {
  return fmt::format("{:.3g}{}", length, in_unit(unit));
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
  if (f.cad) text += deviation_line(mesh, f.cad->deviation, f.unit);
  if (f.cad) text += cause_lines(mesh, f.cad->causes, f.conformity.has_value());
  return text + verdict_line(path, mesh, f, seconds);
}

/// The face of the body that the mesh leaves most; a far field has no shape to keep, and counts where nothing else is.
FaceId farthest_face(const SurfaceMesh& mesh, const Findings& f) {
  const std::vector<DeviationStats>& faces = f.cad->deviation.faces;
  const auto is_outside = [&](std::size_t i) {
    const auto g = static_cast<std::size_t>(f.cad->face_group[i]);
    return g < mesh.labels.group_name.size() && is_outer_role(role_of(mesh.labels, g));
  };
  FaceId farthest = kNone;
  double most = 0;
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (faces[i].max_distance > most && !is_outside(i)) most = faces[i].max_distance, farthest = static_cast<FaceId>(i);
  return farthest == kNone ? f.cad->deviation.worst_distance : farthest;
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
  if (q.worst.triangle != kNone) worst = " at " + place_text(mesh, {q.worst.place, q.worst.face, kNone});
  text += fmt::format("  {:<20} mean {:.4f}, least {:.4f}{}\n", f.is_stretched ? "stretched quality" : "quality",
                      q.mean, q.min, worst);
  text += fmt::format("  {:<20} {:.2f} to {:.2f} deg\n", "angles", q.min_angle_deg, q.max_angle_deg);
  text += fmt::format("  {:<20} {:.2f} from one triangle to its neighbour (99.9 %)\n", "growth", f.quality.jump_p999);
  if (f.conformity)
    text += fmt::format("  {:<20} {:.1f} % of edges within {} to {} of the requested length\n", "sizes",
                        100 * f.conformity->free.share(), kConformityMin, kConformityMax);
  if (f.cad) {
    const FaceId farthest = farthest_face(mesh, f);
    const double most = farthest == kNone ? 0 : f.cad->deviation.faces[farthest].max_distance;
    text += fmt::format("  {:<20} {} off the CAD at most{}\n", "deviation", length_text(most, f.unit),
                        in_face(mesh, farthest));
  }
  if (detail == CheckText::kWithWings) text += wing_lines(f.wings);
  if (!notes.empty())
    text += fmt::format("  {:<20} {}: see st-check -v, with --geometry and --sizing, or st-report\n", "notes",
                        fmt::join(notes, ", "));
  return text + verdict_line(path, mesh, f, seconds);
}

}  // namespace st
