#include "stages/import_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <tuple>

#include "base/child_process.h"
#include "base/hash.h"
#include "base/length.h"
#include "base/log.h"
#include "base/text.h"
#include "base/threads.h"
#include "features/wing_edges.h"
#include "geometry/facet/facet_gaps.h"
#include "geometry/facet/split_sides.h"
#include "geometry/import/facet_import.h"
#include "geometry/import/import.h"
#include "geometry/model/joined_tables.h"
#include "io/file/json_text.h"
#include "io/file/temporary_file.h"
#include "io/file/text_file.h"
#include "io/foreign/triangulation_reader.h"
#include "io/hdf5/artifact.h"
#include "io/toml/groups_file.h"
#include "mesh/crossing.h"
#include "stages/cad_view.h"
#include "stages/compose.h"
#include "stages/group_suggestion.h"
#include "stages/phase_times.h"

namespace st {
namespace {

constexpr int kFindingsShown = 10;

std::string file_hash(const std::string& path) {
  const std::string bytes = read_text_file(path);
  return hash_hex(bytes.data(), bytes.size());
}

nlohmann::json finding_json(const ImportFinding& f) {
  return {{"what", f.what()},
          {"entity", f.entity},
          {"xyz", {f.xyz.x, f.xyz.y, f.xyz.z}},
          {"size", f.size},
          {"repair", f.is_repair}};
}

/// Groups with their roles and numbers of faces, table by table, the main one first.
nlohmann::json tables_json(const ModelTables& t) {
  nlohmann::json tables = nlohmann::json::array();
  const auto add = [&](const std::string& name, const auto& of) {
    nlohmann::json entries = nlohmann::json::array();
    for (std::size_t g = 0; g < of.group_name.size(); ++g)
      entries.push_back({{"name", of.group_name[g]},
                         {"role", of.group_role[g]},
                         {"faces", std::count(of.face_group.begin(), of.face_group.end(), g)}});
    tables.push_back({{"table", name}, {"groups", entries}});
  };
  add("main", t.labels);
  for (const GroupTable& table : t.labels.tables) add(table.name, table);
  const auto add_entities = [&](const std::vector<EntityGroup>& groups, const char* kind) {
    for (const EntityGroup& g : groups) {
      const std::string name = g.table.empty() ? "main" : g.table;
      auto it = std::find_if(tables.begin(), tables.end(),
                             [&](const nlohmann::json& table) { return table["table"] == name; });
      if (it == tables.end()) {
        nlohmann::json table = {{"table", name}, {"groups", nlohmann::json::array()}};
        it = tables.insert(tables.end(), std::move(table));
      }
      (*it)["groups"].push_back({{"name", g.name}, {kind, g.ids.size()}});
    }
  };
  add_entities(t.labels.edge_groups, "edges");
  add_entities(t.labels.vertex_groups, "vertices");
  return tables;
}

nlohmann::json air_json(const AirFaces& air) {
  if (air.n_farfield == 0) return nullptr;
  return {{"farfield", air.n_farfield},
          {"symmetry", air.n_symmetry},
          {"interface", air.n_interface},
          {"replaced", air.is_replaced},
          {"recognised_by", air.is_by_shape ? "shape" : "names"}};
}

nlohmann::json report(const std::string& model, const ImportResult& r) {
  const ModelTables& t = r.tables;
  const Box3 box = t.box();
  nlohmann::json findings = nlohmann::json::array(), repairs = nlohmann::json::array();
  for (const ImportFinding& f : r.findings) (f.is_repair ? repairs : findings).push_back(finding_json(f));
  return {{"tool", "st-import"},
          {"model", model},
          {"format", r.format},
          {"closed", r.is_closed},
          {"unit", t.unit},
          {"solids", t.n_solids},
          {"shells", t.n_shells},
          {"faces", t.n_faces()},
          {"edges", t.n_edges()},
          {"vertices", t.n_vertices()},
          {"groups", t.labels.group_name.size()},
          {"parts", t.labels.part_path.size()},
          {"tables", tables_json(t)},
          {"free_edges", r.edge_uses.n_free},
          {"nonmanifold_edges", r.edge_uses.n_nonmanifold},
          {"repairs", repairs},
          {"findings", findings},
          {"flow_domain", air_json(r.air)},
          {"area", r.area},
          {"volume", r.volume},
          {"box", {box.lo.x, box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z}}};
}

Model model_of(const ImportResult& r) { return r.facets.empty() ? Model(r.tables, r.brep) : Model(r.tables, r.facets); }

/// Says what the shape suggests; the file's text.
std::string suggest(const ImportStageOptions& o, const ImportResult& r) {
  const std::vector<SuggestedGroup> groups = suggest_groups_of(model_of(r));
  log_report(fmt::format("  {}: {}", o.suggest_groups, groups_in_words(groups, r.tables)));
  return groups_file_text(groups, r.tables, std::filesystem::path(o.model).filename().string());
}

/// Trailing and leading edges that st-raster would find, listed by --check.
nlohmann::json list_wing_edges(const ImportResult& r) {
  const Model model = model_of(r);
  const ModelTables& t = model.tables();
  const std::vector<WingEdge> edges = wing_edges_to_see(model);
  nlohmann::json list = nlohmann::json::array();
  for (const WingEdge& w : edges)
    list.push_back({{"edge", w.edge + 1},
                    {"name", t.edge_name[w.edge]},
                    {"kind", name_of(w.kind)},
                    {"xyz", {w.middle.x, w.middle.y, w.middle.z}},
                    {"length", w.length},
                    {"angle", degrees(w.angle)},
                    {"size", w.size}});
  if (!edges.empty()) log_report(fmt::format("  {} trailing and leading edges:", edges.size()));
  for (std::size_t i = 0; i < edges.size() && i < kFindingsShown; ++i) {
    const WingEdge& w = edges[i];
    log_report(fmt::format(
        "  {}, {} at ({:.6g}, {:.6g}, {:.6g}), length {:.4g}{}, angle {:.3g} deg{}", t.edge_label(w.edge),
        name_of(w.kind), w.middle.x, w.middle.y, w.middle.z, w.length, in_unit(r.tables.unit), degrees(w.angle),
        w.size > 0 ? fmt::format(", {} {:.4g}{}", w.kind == WingEdgeKind::kLeading ? "radius" : "width", w.size,
                                 in_unit(r.tables.unit))
                   : ""));
  }
  if (edges.size() > kFindingsShown)
    log_report(fmt::format("  ... and {} more: see --json", edges.size() - kFindingsShown));
  return list;
}

/// Repairs are never silent: their kinds and numbers, in the order of the first of each.
std::string repairs_in_words(const ImportResult& r) {
  std::vector<std::pair<std::string, int>> kinds;
  for (const ImportFinding& f : r.findings) {
    if (!f.is_repair) continue;
    if (f.kind == FindingKind::kCapped || f.kind == FindingKind::kMirrored) continue;  // asked for, and said elsewhere
    const std::string kind = f.kind == FindingKind::kOther ? f.what() : name_of(f.kind);
    const auto known = std::find_if(kinds.begin(), kinds.end(), [&](const auto& k) { return k.first == kind; });
    known == kinds.end() ? kinds.emplace_back(kind, 1), void() : void(++known->second);
  }
  std::string text;
  for (const auto& [kind, n] : kinds)
    text += (text.empty() ? "" : "; ") + kind + (n > 1 ? fmt::format(" ({} times)", n) : "");
  return text;
}

/// All pairs of parts that cross, by name.
void say_crossing_parts(const ImportStageOptions& o, const ImportResult& r) {
  constexpr std::size_t kPairs = 100;
  std::vector<std::string> crossing;
  for (const ImportFinding& f : r.findings)
    if (f.kind == FindingKind::kOverlap)
      crossing.push_back(fmt::format("{} at ({:.6g}, {:.6g}, {:.6g})", f.detail, f.xyz.x, f.xyz.y, f.xyz.z));
  const char* remedy = o.import.unite ? "repair them in the CAD system" : "--unite makes them one body";
  if (crossing.size() == 1)
    return log_warning(fmt::format("{}: two parts cross: {}; {}", o.model, crossing[0], remedy));
  if (!crossing.empty()) log_warning(fmt::format("{}: {} pairs of parts cross; {}:", o.model, crossing.size(), remedy));
  for (std::size_t k = 0; k < std::min(crossing.size(), kPairs); ++k) log_report("  " + crossing[k]);
  if (crossing.size() > kPairs) log_report(fmt::format("  ... and {} more: see --json", crossing.size() - kPairs));
}

/// Parts that cross, and what could not be joined or united.
void say_bodies(const ImportStageOptions& o, const ImportResult& r) {
  say_crossing_parts(o, r);
  for (const ImportFinding& f : r.findings) {
    if (f.kind == FindingKind::kNotUnited)
      log_warning(fmt::format("{}: {} stay apart, they could not be united: {}", o.model, f.entity, f.detail));
    if (f.kind == FindingKind::kNoImprint) log_warning(fmt::format("{}: {} {}", o.model, f.entity, f.what()));
    if (f.kind == FindingKind::kTouchingApart) log_warning(fmt::format("{}: {}", o.model, f.what()));
    if (f.kind == FindingKind::kTouching)
      log_warning(fmt::format("{}: {}; --join gives them common faces, --unite makes them one", o.model, f.what()));
  }
}

/// Faces that cross each other or themselves: no size makes their mesh valid there.
void say_crossing_faces(const ImportStageOptions& o, const ImportResult& r) {
  constexpr std::size_t kNamed = 3;
  std::vector<std::string> names;
  for (const ImportFinding& f : r.findings) {
    if (f.kind == FindingKind::kCrossingFaces) names.push_back(f.detail);
    if (f.kind == FindingKind::kSelfCrossingFace) names.push_back(f.entity + " itself");
    if (f.kind == FindingKind::kPinchedFace) names.push_back(f.entity + " itself, in a point");
    if (f.kind == FindingKind::kFoldedFace) names.push_back(f.entity + " itself, in a fold");
  }
  if (names.empty()) return;
  std::string text;
  for (std::size_t k = 0; k < std::min(names.size(), kNamed); ++k) text += (k > 0 ? ", " : "") + names[k];
  log_warning(fmt::format(
      "{}: the CAD crosses itself in {} {}: {}{}; triangles will cross there, so repair it in the CAD system", o.model,
      names.size(), names.size() == 1 ? "place" : "places", text, names.size() > kNamed ? " ..." : ""));
}

/// What is not as the CAD means it, and no later stage can mend.
constexpr FindingKind kFaults[] = {FindingKind::kLeftOutFace,  FindingKind::kStrayHole,    FindingKind::kFarCurve,
                                   FindingKind::kMissingFile,  FindingKind::kUndoneRepair, FindingKind::kKinkedFace,
                                   FindingKind::kMergedSliver, FindingKind::kUnread};

/// For the verdict: kinds and numbers of those that are no repairs; empty where there is none.
std::string faults_in_words(const ImportResult& r) {
  std::string text;
  for (const FindingKind kind : kFaults) {
    const auto n = std::count_if(r.findings.begin(), r.findings.end(),
                                 [&](const ImportFinding& f) { return f.kind == kind && !f.is_repair; });
    if (n > 0)
      text +=
          fmt::format("{}{}{}", text.empty() ? "" : "; ", name_of(kind), n > 1 ? fmt::format(" ({} times)", n) : "");
  }
  return text;
}

void say_faults(const ImportStageOptions& o, const ImportResult& r) {
  constexpr std::size_t kNamed = 3;
  for (const FindingKind kind : kFaults) {
    std::size_t n = 0;
    for (const ImportFinding& f : r.findings)
      if (f.kind == kind && ++n <= kNamed)
        log_warning(fmt::format("{}: {}{}{}", o.model, f.entity, f.entity.empty() ? "" : ": ", f.what()));
    if (n > kNamed) log_warning(fmt::format("{}: {}: {} more", o.model, name_of(kind), n - kNamed));
  }
}

/// Edges that end away from their vertices, as some fillets' do: no mesh with lengths like that way follows the CAD.
void say_open_vertices(const ImportStageOptions& o, const ImportResult& r) {
  constexpr double kSeen = 1e-4;  // of the reference diagonal: finer lengths are rare
  const ImportFinding* worst = nullptr;
  std::size_t n = 0;
  for (const ImportFinding& f : r.findings) {
    if (f.kind != FindingKind::kOpenVertex || f.size <= kSeen * r.tables.reference_diagonal()) continue;
    ++n;
    if (!worst || f.size > worst->size) worst = &f;
  }
  if (worst)
    log_warning(fmt::format(
        "{}: edges end away from {}, by up to {:.3g}{} at {} ({:.6g}, {:.6g}, {:.6g}); st-check fails meshes whose "
        "lengths there are about as small: repair the CAD there, or ask for longer ones",
        o.model, n == 1 ? "their vertex" : fmt::format("{} vertices", n), worst->size, in_unit(r.tables.unit),
        worst->entity, worst->xyz.x, worst->xyz.y, worst->xyz.z));
}

/// How far the half that --mirror makes is from what was there.
void say_mirror(const ImportResult& r) {
  for (const ImportFinding& f : r.findings)
    if (f.kind == FindingKind::kMirrored)
      log_report(fmt::format("  {}{} at ({:.6g}, {:.6g}, {:.6g})", f.what(), in_unit(r.tables.unit), f.xyz.x, f.xyz.y,
                             f.xyz.z));
}

/// What --cap closed, and what it could not.
void say_openings(const ImportStageOptions& o, const ImportResult& r) {
  for (const ImportFinding& f : r.findings) {
    if (f.kind == FindingKind::kCapped)
      log_report(fmt::format("  {}: {}{}", f.entity, f.what(), in_unit(r.tables.unit, 2)));
    if (f.kind == FindingKind::kOpeningLeft)
      log_warning(fmt::format("{}: {}, at ({:.6g}, {:.6g}, {:.6g})", o.model, f.what(), f.xyz.x, f.xyz.y, f.xyz.z));
  }
  if (o.import.cap && std::ranges::none_of(r.findings, [](const ImportFinding& f) {
        return f.kind == FindingKind::kCapped || f.kind == FindingKind::kOpeningLeft;
      }))
    log_report("  --cap: there is no opening");
}

/// The largest extent of what is neither far field nor symmetry plane, m.
double extent_in_metres(const ModelTables& t) {
  Box3 box;
  for (FaceId f = 0; f < t.n_faces(); ++f)
    if (!is_outer_role(t.labels.group_role[t.labels.face_group[f]])) box.add(t.face_box[f]);
  if (box.is_empty()) return 0;
  const Vec3 size = box.hi - box.lo;
  return *t.unit_in_m * std::max({size.x, size.y, size.z});
}

/// A wrong unit is seen by the size that results.
void say_unit(const ImportStageOptions& o, const ImportResult& r) {
  constexpr double kShortestModel = 1e-4;  // m
  constexpr double kLongestModel = 500;    // m
  if (!r.tables.unit_in_m) return;
  const double size = extent_in_metres(r.tables);
  const std::string source =
      r.has_assumed_unit
          ? fmt::format("the file names no unit, so --unit takes its numbers as {0}: the model is {1:.4g} m long",
                        r.tables.unit, size)
          : fmt::format("by the unit that the file names the model is {:.4g} m long", size);
  if (size > 0 && (size < kShortestModel || size > kLongestModel))
    log_warning(fmt::format("{}: {}; {}", o.model, source,
                            r.has_assumed_unit ? "give the unit in which the file was written"
                                               : "if that is wrong, export it again in the right unit"));
  else if (r.has_assumed_unit)
    log_report(fmt::format("  {}", source));
}

/// Whether the file has its own air, and how to say otherwise.
void say_air(const ImportStageOptions& o, const ImportResult& r) {
  const AirFaces& air = r.air;
  if (air.is_replaced)
    log_report(fmt::format("  the air of the file is replaced: {}, and gone", air.in_words()));
  else if (air.n_farfield > 0)
    log_report(fmt::format("  the file has its own air: {}; lengths in % refer to the rest, diagonal {:.4g}{}",
                           air.in_words(), r.tables.reference_diagonal(),
                           air.is_by_shape && o.import.air.flow_domain == AirOptions().flow_domain
                               ? "; --flow-domain no takes all faces as walls, a groups file names them"
                               : ""));
  else if (!air.doubt.empty())
    log_report(fmt::format("  all faces are walls: what is inside {}; --flow-domain yes takes what is around it as air",
                           air.doubt));
}

/// The first findings as text, where they are asked for; the rest is counted.
void say(const ImportStageOptions& o, const ImportResult& r) {
  const std::string& model = o.model;
  if (!r.is_closed && r.edge_uses.n_free == 0 && r.edge_uses.n_contradictory > 0)
    log_warning(fmt::format("{}: the model encloses no volume: faces disagree at {} edges which side is outside", model,
                            r.edge_uses.n_contradictory));
  else if (!r.is_closed && r.edge_uses.n_free == 0)
    log_warning(fmt::format("{}: the model encloses no volume, because its faces form no shell", model));
  else if (!r.is_closed)
    log_warning(fmt::format("{}: the model is open: {} free edges; the mesh will have open boundaries there{}", model,
                            r.edge_uses.n_free,
                            !r.facets.empty() ? ""
                            : o.import.cap    ? " (--sew joins edges further apart)"
                                              : " (--sew joins edges further apart, --cap closes openings in planes)"));
  if (const std::string repairs = repairs_in_words(r); !repairs.empty())
    log_warning(
        fmt::format("{}: repaired: {}{}", model, repairs, o.import.check_only ? "" : "; -v lists places and sizes"));
  say_unit(o, r);
  say_air(o, r);
  say_bodies(o, r);
  say_crossing_faces(o, r);
  say_faults(o, r);
  say_open_vertices(o, r);
  say_mirror(r);
  say_openings(o, r);
  const auto say_line = o.import.check_only ? log_report : log_info;
  const std::size_t n = r.findings.size(), shown = std::min<std::size_t>(n, kFindingsShown);
  for (std::size_t i = 0; i < shown; ++i) {
    const ImportFinding& f = r.findings[i];
    say_line(fmt::format("  {}{}{} at ({:.6g}, {:.6g}, {:.6g}), size {:.4g}{}", f.is_repair ? "repaired: " : "",
                         f.what(), f.entity.empty() ? "" : ": " + f.entity, f.xyz.x, f.xyz.y, f.xyz.z, f.size,
                         in_unit(r.tables.unit)));
  }
  if (n > shown) say_line(fmt::format("  ... and {} more: see --json", n - shown));
}

/// "box 37.8 x 18.9 x 4.1 m, area 520 m^2, volume 402 m^3".
std::string extent(const ImportResult& r) {
  const Box3 box = r.tables.box();
  const std::string& unit = r.tables.unit;
  std::string text = fmt::format("box {:.6g} x {:.6g} x {:.6g}{}, area {:.6g}{}", box.hi.x - box.lo.x,
                                 box.hi.y - box.lo.y, box.hi.z - box.lo.z, in_unit(unit), r.area, in_unit(unit, 2));
  if (!r.is_closed || r.volume == 0) return text;
  if (!r.tables.volume) text += " (faces between solids once)";
  return text + fmt::format(", volume {:.6g}{}", r.volume, in_unit(unit, 3));
}

/// Processor time for a file: whole ones take about 0.2 s per megabyte.
double time_limit(const ImportStageOptions& o) {
  constexpr double kSeconds = 30, kSecondsPerByte = 5e-6;
  if (o.time_limit) return *o.time_limit;
  std::error_code unreadable;
  const auto bytes = std::filesystem::file_size(o.model, unreadable);
  return unreadable ? kSeconds : kSeconds + kSecondsPerByte * static_cast<double>(bytes);
}

/// As artifacts have it: number and input; empty where the faces have the numbers of the file.
std::vector<std::int32_t> previous_faces(const std::vector<std::int32_t>& file_faces) {
  std::vector<std::int32_t> previous;
  bool is_other = false;
  for (std::size_t f = 0; f < file_faces.size(); ++f) {
    previous.insert(previous.end(), {file_faces[f], 0});
    is_other = is_other || file_faces[f] != static_cast<std::int32_t>(f);
  }
  return is_other ? previous : std::vector<std::int32_t>();
}

/// Where facets cross each other no size makes the mesh valid. Those that end on a side of another one do not.
void report_crossing(const std::string& path, const SurfaceMesh& mesh, std::vector<TrianglePair> pairs, bool was_ended,
                     ImportResult& r) {
  Box3 box;
  for (const Vec3 x : mesh.node_xyz) box.add(x);
  const auto corners = [&](TriangleId t) -> Corners {
    const auto& n = mesh.triangles[t].n;
    return {n[0], n[1], n[2]};
  };
  std::erase_if(pairs, [&](const TrianglePair& p) {
    return ends_on_side(mesh.node_xyz, corners(p.a), corners(p.b), kFacetGap * box.diagonal());
  });
  if (pairs.empty()) return;
  const Vec3 x = mesh.node_xyz[mesh.triangles[pairs[0].a].n[0]];
  const std::string n_pairs = fmt::format("{}{} pairs", pairs.size(), was_ended ? " or more" : "");
  r.findings.push_back({FindingKind::kCrossingFacets, "", x, 0, false, n_pairs});
  log_warning(
      fmt::format("{}: {}, the first one near ({:.6g}, {:.6g}, {:.6g}); triangles will cross there, so repair "
                  "the file",
                  path, r.findings.back().what(), x.x, x.y, x.z));
}

ImportResult import_triangles(const std::string& path, const ImportOptions& options) {
  SurfaceMesh mesh = read_triangulation(path);
  mesh.corner_uv = {};  // that of a file is not used
  FacetInput facets{mesh.node_xyz, {}, mesh.triangle_face, mesh.labels.face_name};
  facets.corners.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) facets.corners.push_back({t.n[0], t.n[1], t.n[2]});
  ImportResult r;
  std::vector<TrianglePair> pairs;
  bool was_ended = false;
  const auto find_pairs = [&] { pairs = find_crossing_triangles(mesh.node_xyz, mesh.triangles, was_ended); };
  if (options.smooth.empty()) {
    run_jobs({[&] { r = import_facets(facets, options, path); }, find_pairs});
  } else {  // facets that were smoothed cross elsewhere
    r = import_facets(facets, options, path);
    mesh.node_xyz = std::move(facets.x);
    mesh.triangles.clear();
    for (const Corners& c : facets.corners) mesh.triangles.push_back({{c[0], c[1], c[2]}});
    find_pairs();
  }
  report_crossing(path, mesh, std::move(pairs), was_ended, r);
  return r;
}

/// Of whatever the file holds.
ImportResult import_file(const ImportStageOptions& o, const GroupsFile& groups) {
  ImportOptions options = o.import;
  options.groups = groups.rules;
  o.kFeatureAngle.require(o.feature_angle);
  if (!triangulation_format(o.model).empty()) {
    options.feature_deg = o.feature_angle.value_or(options.feature_deg);
    return import_triangles(o.model, options);
  }
  for (const auto& [option, is_given] :
       {std::pair{"--feature-angle", o.feature_angle.has_value()}, std::pair{"--smooth", !options.smooth.empty()}})
    if (is_given)
      throw Error(ExitCode::kUsage,
                  fmt::format("{}: {} is for facets (STL), and this is no file of them", o.model, option));
  return import_model(o.model, options);
}

void require_composable(const ImportStageOptions& o) {
  if (o.import.check_only)
    throw Error(ExitCode::kUsage, "--composite joins faces of what is written, and --check writes nothing");
  if (!o.import.air.mirror.empty())
    throw Error(ExitCode::kUsage, "--composite joins faces across the plane of --mirror; give one of them");
}

/// What --composite asks for.
std::string composite_word(const ImportStageOptions& o) {
  if (!o.composite.empty()) return o.composite;
  return o.import.check_only || !o.import.air.mirror.empty() || !triangulation_format(o.model).empty() ? "none"
                                                                                                       : "harm";
}

/// For the artifact: what is not as it is without options.
nlohmann::json options_json(const ImportStageOptions& o) {
  const ImportOptions& i = o.import;
  nlohmann::json used{{"unit", i.unit}, {"small", i.small}};
  const std::pair<const char*, const std::string&> texts[] = {
      {"sew", i.sew},       {"symmetry", i.air.symmetry}, {"mirror", i.air.mirror},
      {"smooth", i.smooth}, {"farfield", i.air.farfield}, {"replace_farfield", i.air.replace_farfield}};
  for (const auto& [name, text] : texts)
    if (!text.empty()) used[name] = text;
  if (i.air.flow_domain != AirOptions().flow_domain) used["flow_domain"] = i.air.flow_domain;
  for (const auto& [name, given] : {std::pair{"unite", i.unite}, {"join", i.join_touching}, {"cap", i.cap}})
    if (given) used[name] = true;
  if (o.feature_angle) used["feature_angle"] = *o.feature_angle;
  if (!o.groups.empty()) used["groups"] = std::filesystem::path(o.groups).filename().string();
  return used;
}

/// Unless it was asked for, nothing is said where no faces are joined.
void join_faces(const ImportStageOptions& o, const std::string& word, GeometryArtifact& g, StageSummary& s,
                nlohmann::json& used, nlohmann::json& json) {
  const std::string said = compose(g, word == "harm");
  if (o.composite.empty() && g.composites.empty()) return;
  s.line += "; " + said;
  used["composite"] = word;
  const EntityCounts left = count_left(g.tables);
  json["joined"] = {{"faces", left.faces}, {"edges", left.edges}, {"vertices", left.vertices}};
}

StageSummary import_here(const ImportStageOptions& o, const GroupsFile& groups) {
  const Timer timer;
  const std::string composite = composite_word(o);
  const bool is_composed = asks_for_composites(composite, o.model);
  if (is_composed) require_composable(o);
  ImportResult r = import_file(o, groups);
  say(o, r);
  nlohmann::json json = report(o.model, r);
  if (o.import.check_only) json["wing_edges"] = list_wing_edges(r);
  if (!o.suggest_groups.empty()) json["suggested_groups"] = suggest(o, r);
  if (!o.groups.empty()) log_report(fmt::format("  {}: {}", o.groups, groups_in_words(r.tables.labels)));
  const ModelTables& t = r.tables;
  StageSummary s;
  s.line =
      fmt::format("{}: {}, {}, {}, {}, {}, {}", o.import.check_only ? o.model : o.output, counted(t.n_faces(), "face"),
                  counted(t.n_edges(), "edge"),
                  r.is_closed ? "closed" : fmt::format("open ({})", counted(r.edge_uses.n_free, "free edge")),
                  extent(r), counted(r.findings.size() - r.n_repairs(), "finding"), counted(r.n_repairs(), "repair"));
  if (const std::string faults = faults_in_words(r); !faults.empty()) s.line += "; " + faults;
  if (!o.import.check_only) {
    GeometryArtifact g;
    g.header.schema = "geometry";
    g.header.tool = "st-import";
    g.header.tool_version = ST_VERSION;
    nlohmann::json used = options_json(o);
    g.header.unit = t.unit;
    g.header.unit_in_m = t.unit_in_m;
    g.header.inputs = {{"cad", std::filesystem::path(o.model).filename().string(), file_hash(o.model)}};
    if (!o.groups.empty())
      g.header.inputs.push_back({"groups", std::filesystem::path(o.groups).filename().string(), groups.hash});
    g.findings = r.findings;
    g.previous_faces = previous_faces(r.file_faces);
    g.is_closed = r.is_closed;
    g.mirror = std::move(r.mirror);
    g.tables = std::move(r.tables);
    std::tie(g.brep, g.facets) = std::tuple(std::move(r.brep), std::move(r.facets));
    if (is_composed) join_faces(o, composite, g, s, used, json);
    g.header.options_json = json_text(used);
    json["hash"] = write_geometry(o.output, g);
    json["output"] = o.output;
  }
  json["seconds"] = timer.seconds();
  json["processor_seconds"] = processor_json();
  s.line += fmt::format(", {:.2f} s", timer.seconds());
  s.json = json_text(json);
  return s;
}

/// Removes, at the end of its scope, what a child left that was ended while it wrote `output`.
struct LeftTemporaries {
  std::string output;
  ~LeftTemporaries() {
    if (!output.empty()) remove_left_temporaries(output);
  }
};

}  // namespace

// OpenCASCADE may crash, hang or eat the memory on a damaged file: everything is done in a child, this process keeps
// the last word.
StageSummary run_import(const ImportStageOptions& o) {
  if (!o.import.check_only) require_writable(o.output);
  if (!o.suggest_groups.empty()) {
    if (!o.groups.empty())
      throw Error(ExitCode::kUsage, "--suggest-groups and --groups: give one of them; suggestions are made without");
    require_writable(o.suggest_groups);
  }
  const GroupsFile groups = o.groups.empty() ? GroupsFile() : read_groups(o.groups);
  const auto work = [&] {
    const StageSummary s = import_here(o, groups);
    return s.line + '\n' + s.json;
  };
  const LeftTemporaries left{o.import.check_only ? "" : o.output};
  const std::string folder = std::filesystem::absolute(o.output).parent_path().string();
  const std::string both = run_in_child(work, {time_limit(o), o.import.check_only ? "" : folder}, o.model);
  const std::size_t line_end = both.find('\n');
  if (!o.suggest_groups.empty())
    write_text_file(o.suggest_groups,
                    nlohmann::json::parse(both.substr(line_end + 1))["suggested_groups"].get<std::string>());
  return {both.substr(0, line_end), both.substr(line_end + 1), ExitCode::kOk};
}

}  // namespace st
