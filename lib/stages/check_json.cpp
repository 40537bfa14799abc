#include "stages/check_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/file/json_text.h"
#include "stages/wing_table.h"

namespace st {
namespace {

using nlohmann::json;

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
  return {{"quadrilaterals", r.n_quads}, {"good_share", r.good_share()}, {"continued", r.n_continued},
          {"others", r.n_others},        {"others_mean", r.mean},        {"others_p1", r.p1},
          {"growth_max", r.growth},      {"growth_above_2.2", r.n_grown}};
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
      if (p.beside != kNone) entry["beside"] = {{"edge", p.beside + 1}, {"normals_deg", p.beside_deg}};
      places.push_back(entry);
    }
  }
  return {{"count", list.total()}, {"free", list.free()}, {"by_cause", counts}, {"worst", places}};
}

json causes_json(const SurfaceMesh& mesh, const ShapeCauses& c, bool has_sizes) {
  json j{{"below_deg", c.angle_deg}, {"sharp", cause_json(mesh, c.sharp)}, {"growth", cause_json(mesh, c.growth)}};
  j["sharp"]["at_smooth_edges"] = c.sharp.n_smooth;
  if (has_sizes) j["lengths"] = cause_json(mesh, c.lengths);
  return j;
}

json groups_json(const SurfaceMesh& mesh, const Findings& f, ReportDetail detail) {
  json groups = json::array();
  const std::vector<DeviationStats> deviation = f.deviation_by_group();
  for (std::size_t g = 0; g < f.quality.groups.size(); ++g) {
    json entry{{"name", g < mesh.labels.group_name.size() ? mesh.labels.group_name[g] : ""},
               {"quality", quality_json(f.quality.groups[g], detail)},
               {"jumps", jump_json(f.quality.group_jumps[g], detail)}};
    if (f.conformity && g < f.conformity->groups.size())
      entry["sizes"] = conformity_json(f.conformity->groups[g], detail);
    if (f.cad) entry["deviation"] = deviation_json(deviation[g], detail);
    groups.push_back(entry);
  }
  return groups;
}

/// Relative difference between the mesh's and the CAD's area of a face; none without a geometry or an area.
std::optional<double> area_error(const Findings& f, std::size_t face) {
  if (!f.cad || face >= f.cad->face_area.size() || !(f.cad->face_area[face] > 0)) return std::nullopt;
  return std::fabs(f.measure.face_area[face] - f.cad->face_area[face]) / f.cad->face_area[face];
}

json face_json(const SurfaceMesh& mesh, const Findings& f, std::size_t i, ReportDetail detail) {
  const QualityStats& q = f.quality.faces[i];
  json j{{"face", i + 1},
         {"name", i < mesh.labels.face_name.size() ? mesh.labels.face_name[i] : ""},
         {"triangles", q.n_triangles},
         {"area", f.measure.face_area[i]},
         {"mean", q.mean},
         {"min", q.min}};
  if (const auto error = area_error(f, i)) j["cad_area"] = f.cad->face_area[i], j["area_error"] = *error;
  if (f.cad && i < f.cad->chords.distance.size()) j["chord_distance"] = f.cad->chords.distance[i];
  if (f.conformity && i < f.conformity->faces.size()) j["size_share"] = f.conformity->faces[i].share();
  if (f.cad && i < f.cad->deviation.faces.size()) j["deviation"] = deviation_json(f.cad->deviation.faces[i], detail);
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

std::string check_report_json(const std::string& path, const SurfaceMesh& mesh, const Findings& f, double seconds,
                              ReportDetail detail, const nlohmann::json& processor) {
  json checks = json::object(), failed = json::array();
  for (const Check& c : f.checks) {
    checks[c.name] = check_json(c);
    if (c.fails()) failed.push_back(c.name);
  }
  json j{{"mesh", path},
         {"passes", f.passes()},
         {"verdict", verdict(mesh, f)},
         {"failed", failed},
         {"triangles", f.n_triangles},
         {"nodes", f.topology.n_used_nodes},
         {"edges", f.topology.n_edges},
         {"components", f.topology.n_components},
         {"euler", f.topology.euler},
         {"genus", f.genus() ? json(*f.genus()) : json()},
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
         {"area_difference", f.cad && f.cad->area_difference ? json(*f.cad->area_difference) : json()},
         {"volume_difference", f.cad && f.cad->volume_difference ? json(*f.cad->volume_difference) : json()},
         {"checks", checks},
         {"quality", quality_json(f.quality.model, ReportDetail::kFull)},
         {"jump_p999", f.quality.jump_p999},
         {"jump_max", f.quality.jump_max},
         {"groups", groups_json(mesh, f, detail)},
         {"faces", faces_json(mesh, f, detail)},
         {"seconds", seconds}};
  if (!processor.is_null()) j["processor_seconds"] = processor;
  j["jumps"] = jump_json(f.quality.jumps, ReportDetail::kFull);
  if (f.is_stretched) j["rows"] = rows_json(f.quality.rows);
  if (f.conformity) j["sizes"] = sizes_json(*f.conformity, detail);
  if (f.cad) j["deviation"] = deviation_json(f.cad->deviation.model, ReportDetail::kFull);
  if (!f.wings.empty()) j["lifting_surfaces"] = wing_measures_json(f.wings);
  if (f.cad) j["causes"] = causes_json(mesh, f.cad->causes, f.conformity.has_value());
  if (detail == ReportDetail::kFull) j["bins"] = bins_json();
  return json_text(j, detail == ReportDetail::kFull ? 1 : -1);
}

}  // namespace st
