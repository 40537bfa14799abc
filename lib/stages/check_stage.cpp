#include "stages/check_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/length.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/required_unit.h"
#include "base/threads.h"
#include "geometry/model/edge_faces.h"
#include "io/file/text_file.h"
#include "io/foreign/triangulation_reader.h"
#include "io/hdf5/artifact.h"
#include "io/hdf5/sizing_artifact.h"
#include "judge/cad_contacts.h"
#include "judge/walls_apart.h"
#include "mesh/pair_match.h"
#include "stages/check_cad.h"
#include "stages/check_json.h"
#include "stages/check_report.h"
#include "stages/check_thresholds.h"
#include "stages/field_on_mesh.h"
#include "stages/fitting_files.h"
#include "stages/foreign_mesh.h"
#include "stages/layers_check.h"
#include "stages/stored_model.h"
#include "stages/wing_table.h"

namespace st {

namespace {

/// What the user let st-import sew by, model unit; 0: its default, far below what is checked.
double sewing_tolerance(const GeometryArtifact& g) {
  const auto options = nlohmann::json::parse(g.header.options_json, nullptr, false);
  if (!options.is_object() || !options.contains("sew") || !options["sew"].is_string()) return 0;
  return resolve_length(parse_length(options["sew"].get<std::string>(), "--sew"),
                        {g.tables.reference_diagonal(), g.tables.unit_in_m}, "--sew");
}

/// The geometry with what the checks need of it.
struct CadSide {
  double sewing = 0;  // model unit
  Model model;
  std::vector<std::uint8_t> may_be_open, may_be_nonmanifold;

  CadSide(GeometryArtifact&& g, const std::string& path) : sewing(sewing_tolerance(g)), model(stored_model(g, path)) {
    const EdgeFaces faces_at(model.tables());
    for (EdgeId e = 0; e < model.tables().n_edges(); ++e) {
      may_be_open.push_back(faces_at[e].size() == 1);
      may_be_nonmanifold.push_back(faces_at[e].size() > 2);
    }
  }
  CadEdges edges() const { return {model.tables().edge_vertices, may_be_open, may_be_nonmanifold}; }
};

Check check_complete(const MeshArtifact& artifact) {
  Check c{"complete", "faces flagged as not meshed", {}, true, ""};
  if (!artifact.is_complete) c.defects.add({}), c.note = "merged with --allow-incomplete";
  if (artifact.mesh.triangles.empty()) c.defects.add({}), c.note = "no triangles";
  return c;
}

Check check_volume(const TopologyReport& topology, const MeshMeasure& measure, const std::string& unit) {
  Check c{"volume", "closed meshes of no or negative volume", {}, true, ""};
  const bool has_volume =  // faces between solids are walls of both
      topology.is_closed() && topology.n_cad_boundary_edges == 0 && topology.n_cad_nonmanifold_edges == 0;
  if (has_volume && !(measure.volume > 0)) c.defects.add({});
  c.note =
      has_volume ? fmt::format("{:.9g}{}", measure.volume, in_unit(unit, 3)) : "open, or faces between solids: none";
  return c;
}

/// Whether a group is named as far field: the outside is to be filled.
bool has_flow_domain(const SurfaceMesh& mesh) {
  const FaceLabels& labels = mesh.labels;
  for (std::size_t g = 0; g < labels.group_name.size(); ++g)
    if (role_of(labels, g) == "farfield") return true;
  return false;
}

/// Crossings, those apart where the CAD touches itself; how many of the others are the CAD's own. The fluid in a flow
/// domain is one body of the CAD, but the parts of its boundary are bodies that may touch.
void check_crossings_and_contacts(const SurfaceMesh& mesh, const CadSide* cad, Findings& f) {
  if (!cad) {
    f.crossings = check_crossings(mesh);
    return;
  }
  CadContacts contacts(cad->model, mesh);
  WallsApart walls(cad->model, mesh);
  const auto touches_itself = [&](const TrianglePair& pair) {
    if (contacts.touches(pair)) return true;
    f.n_model_crossings += contacts.crosses(pair);
    return false;
  };
  CadOfPairs pairs{touches_itself, [&](const TrianglePair& pair) { return walls.are_apart(pair); }};
  pairs.is_of_sheet = [&](const TrianglePair& pair) { return walls.are_of_body_and_sheet(pair); };
  if (!has_flow_domain(mesh)) pairs.is_one_body = [&](const TrianglePair& pair) { return walls.are_of_one_body(pair); };
  f.crossings = check_crossings(mesh, pairs);
  f.is_of_facets = !cad->model.facets().empty();
}

std::vector<Check> list_mesh_checks(const MeshArtifact& artifact, const CheckThresholds& allow, bool is_filled_outside,
                                    const Findings& f) {
  const std::string open = f.topology.n_cad_boundary_edges
                               ? fmt::format("{} more where the CAD is open", f.topology.n_cad_boundary_edges)
                               : "";
  const std::string nonmanifold =
      f.topology.n_cad_nonmanifold_edges
          ? fmt::format("{} more where the CAD is non-manifold", f.topology.n_cad_nonmanifold_edges)
          : "";
  const auto left_of = [&](std::int64_t n) { return std::max<std::int64_t>(0, allow.max_crossings - n); };
  return {
      check_complete(artifact),
      {"closed", "open edges", f.topology.boundary_edges, true, open},
      {"manifold", "edges with more than two triangles (non-manifold)", f.topology.nonmanifold_edges, true,
       nonmanifold},
      {"oriented", "edges whose two triangles face opposite ways", f.topology.misoriented_edges, true, ""},
      {"repeated-nodes", "triangles with the same node twice", f.topology.repeated_nodes, true, ""},
      {"zero-area", "triangles without area", f.shape.zero_area, true, ""},
      {"duplicate-triangles", "triangles that occur twice", f.topology.duplicate_triangles, true, ""},
      {"duplicate-nodes", "nodes at the same place as another node", f.shape.duplicate_nodes, true, ""},
      {"folds", "folds: neighbouring triangles turned back on each other", f.shape.folds, true, "", allow.max_folds},
      {"crossings", "crossing pairs of triangles", f.crossings.crossings, true, crossing_note(f), allow.max_crossings},
      {"overlaps", "neighbouring triangles that overlap or cross", f.crossings.overlapping_neighbours, true, "",
       left_of(f.crossings.crossings.count)},
      {"cad-contacts", "crossing or overlapping pairs of triangles where the CAD touches itself",
       f.crossings.cad_contacts, true, "",
       left_of(f.crossings.crossings.count + f.crossings.overlapping_neighbours.count)},
      {"walls", "crossing pairs of triangles of parts that the CAD keeps apart", f.crossings.walls, is_filled_outside,
       ""},
      {"pinched", "nodes where parts touch", f.topology.pinched_nodes, false, ""},
      {"contacts", "pairs of triangles where parts touch or cross", f.crossings.contacts, is_filled_outside,
       is_filled_outside ? "no volume mesh fills the flow domain around them (st-import --unite or --join)" : ""},
      check_volume(f.topology, f.measure, f.unit)};
}

/// The mesh as it is checked, what its file had that it has no more, and what it is checked against.
struct CheckedMesh {
  MeshArtifact artifact;
  Defects turned;                ///< edges of a foreign mesh whose triangles face opposite ways: association turns them
  std::unique_ptr<CadSide> cad;  ///< null: not given
  std::unique_ptr<SizeField> field;  ///< null: not given
  std::vector<WingRecord> wings;     ///< lifting surfaces that the sizes know
};

/// Jobs that do not depend on each other, the longest first; together they are a share of all checks.
void run_measures(std::vector<std::function<void()>> jobs, double share, Progress& progress) {
  for (auto& job : jobs)
    job = [&progress, work = std::move(job), part = share / static_cast<double>(jobs.size())] {
      work();
      progress.advance(part);
    };
  run_jobs(jobs);
}

/// Everything that is measured. What needs no table of the edges comes first, without one: it takes the most memory.
void measure(const CheckedMesh& checked, const TriangleCorners& corners, Progress& progress, Findings& f) {
  const SurfaceMesh& mesh = checked.artifact.mesh;
  const CadSide* cad = checked.cad.get();
  const SizeField* field = checked.field.get();
  std::vector<std::function<void()>> jobs;
  jobs.emplace_back([&] { check_crossings_and_contacts(mesh, cad, f); });
  if (cad)
    jobs.emplace_back([&] {
      DeviationSum deviation(cad->model, mesh);
      f.chords = estimate_chord_error(cad->model, mesh, &deviation);
      f.deviation = deviation.deviation();
    });
  if (!checked.wings.empty()) jobs.emplace_back([&] { f.wings = measure_wings(mesh, checked.wings); });
  jobs.emplace_back([&] { f.measure = measure_mesh(mesh); });
  run_measures(std::move(jobs), 0.5, progress);
  const EdgeTable edges = edges_of(mesh);
  jobs.clear();
  jobs.emplace_back([&] { f.quality = measure_quality(mesh, edges, corners); });
  if (field)
    jobs.emplace_back([&] {
      f.conformity = measure_conformity(
          mesh, edges, [&](Vec3 p, int& hint) { return field->local(p, hint); }, lengths_along(*field));
    });
  jobs.emplace_back([&] { f.shape = check_shape(mesh, edges); });
  jobs.emplace_back([&] { f.topology = check_topology(mesh, edges, cad ? cad->edges() : CadEdges{}); });
  run_measures(std::move(jobs), 0.3, progress);
  f.is_stretched = corners.is_stretched();
}

/// Nodes and triangles of periodic faces that are no images of each other.
Check check_pairs(const SurfaceMesh& mesh) {
  Check c{"pairs", "nodes and triangles of periodic faces without a partner", {}, true, ""};
  const double tolerance = pair_tolerance(mesh);
  for (const FacePair& p : mesh.merged.pairs) {
    const PairMatch match = match_pair(mesh, p, tolerance);
    for (const NodeId n : match.alone) c.defects.add({mesh.node_xyz[n], p.a, kNone});
    for (const TriangleId t : match.triangles_alone)
      c.defects.add({mesh.node_xyz[mesh.triangles[t].n[0]], mesh.triangle_face[t], kNone});
  }
  return c;
}

/// Nodes lie on entities that the geometry has. Throws Error(kInput).
void require_entities(const std::string& path, const SurfaceMesh& mesh, const ModelTables& t) {
  const std::int32_t n_entities[] = {t.n_vertices(), t.n_edges(), t.n_faces()};
  for (std::size_t n = 0; n < mesh.node_entity.size(); ++n) {
    const std::size_t dim = mesh.node_entity_dim[n];
    if (dim > 2 || mesh.node_entity[n] < 0 || mesh.node_entity[n] >= n_entities[dim])
      throw Error(ExitCode::kInput,
                  fmt::format("{}: node {} lies on an entity that the geometry does not have; the file "
                              "is damaged: make it again with st-merge",
                              path, n + 1));
  }
}

/// The face of the triangle whose middle is nearest.
FaceId nearest_face(const SurfaceMesh& mesh, Vec3 p) {
  FaceId face = kNone;
  double least = 0;
  for (TriangleId t = 0; t < mesh.n_triangles(); ++t) {
    const auto& n = mesh.triangles[t].n;
    const double d = distance(p, (mesh.node_xyz[n[0]] + mesh.node_xyz[n[1]] + mesh.node_xyz[n[2]]) / 3);
    if (face == kNone || d < least) face = mesh.triangle_face[t], least = d;
  }
  return face;
}

/// Edges of the file's triangles that face opposite ways; faces are those of the associated mesh.
Defects misoriented_edges(const std::string& path, const SurfaceMesh& associated) {
  const SurfaceMesh mesh = read_triangulation(path);
  Defects found = check_topology(mesh, edges_of(mesh)).misoriented_edges;
  for (DefectPlace& p : found.first) p.face_a = nearest_face(associated, p.xyz), p.face_b = kNone;
  return found;
}

void read_sizes(const CheckStageOptions& o, CheckedMesh& checked) {
  if (o.sizing.empty()) return;
  ArtifactHeader header;
  checked.field = open_sizing(o.sizing, &header);
  require_same_geometry(o.mesh, checked.artifact.header, o.sizing, header);
  checked.wings = read_asked_wings(o.sizing);
}

/// A mesh of this program with its geometry and sizes.
CheckedMesh read_own_mesh(const CheckStageOptions& o) {
  CheckedMesh result;
  result.artifact = read_mesh(o.mesh);
  std::optional<GeometryArtifact> geometry;
  if (!o.geometry.empty()) {
    geometry = read_geometry(o.geometry);
    require_same_geometry(o.mesh, result.artifact.header, o.geometry, geometry->header);
    part_as_meshed(result.artifact, *geometry);
  }
  run_jobs({[&] {  // reads no file: HDF5 is for one thread at a time
              if (!geometry) return;
              result.cad = std::make_unique<CadSide>(std::move(*geometry), o.geometry);
              require_entities(o.mesh, result.artifact.mesh, result.cad->model.tables());
            },
            [&] { read_sizes(o, result); }});
  return result;
}

/// A mesh of another program is associated to its geometry first.
CheckedMesh read_checked_mesh(const CheckStageOptions& o) {
  if (!is_foreign_mesh(o.mesh)) return read_own_mesh(o);
  CheckedMesh result;
  MeshArtifact& artifact = result.artifact;
  if (o.geometry.empty()) {
    if (!o.sizing.empty())
      throw Error(ExitCode::kUsage,
                  fmt::format("--sizing: {} is a mesh of another program, which also needs --geometry", o.mesh));
    artifact.mesh = read_triangulation(o.mesh);
    return result;
  }
  GeometryArtifact geometry = read_geometry(o.geometry);
  const std::string hash = geometry.header.content_hash;
  result.cad = std::make_unique<CadSide>(std::move(geometry), o.geometry);
  ForeignMesh foreign = read_foreign_mesh(o.mesh, result.cad->model, {});
  log_info(association_text(o.mesh, foreign.artifact.mesh, foreign.report));
  if (foreign.report.n_turned > 0) result.turned = misoriented_edges(o.mesh, foreign.artifact.mesh);
  artifact = std::move(foreign.artifact);
  artifact.header.geometry_hash = hash;
  read_sizes(o, result);
  return result;
}

/// How far lifting surfaces are from the CAD, in shares of the chord, where that was measured.
void add_deviations(std::span<const WingRecord> records, Findings& f) {
  for (std::size_t w = 0; f.deviation && w < f.wings.size(); ++w) {
    double chord = 0, most = 0;
    for (const WingRecord::Station& s : records[w].stations) chord = std::max(chord, s.chord);
    for (const FaceId face : records[w].faces)
      if (static_cast<std::size_t>(face) < f.deviation->faces.size())
        most = std::max(most, f.deviation->faces[face].max_distance);
    if (chord > 0 && !records[w].faces.empty()) f.wings[w].deviation = most / chord;
  }
}

/// Says where a mesh is coarser at lifting surfaces than was asked for.
void check_wings(Findings& f) {
  if (f.wings.empty()) return;
  Check c{"wing-sizes", "places on lifting surfaces coarser than 1.5 times what was asked for", {}, false, ""};
  for (const WingMiss& miss : find_misses(f.wings)) {
    if (c.defects.count == 0)
      c.note = fmt::format("the {} of the surface at edge {} has {} at {:.0f} % of the span, {} asked for", miss.what,
                           f.wings[miss.wing].first_edge + 1, length_text(miss.has, f.unit), 100 * miss.share,
                           length_text(miss.asked, f.unit));
    c.defects.add({miss.place, kNone, kNone});
  }
  f.checks.push_back(std::move(c));
}

/// What the measures mean.
void judge(const CheckStageOptions& o, const MeshArtifact& artifact, const TriangleCorners& corners, const CadSide* cad,
           Findings& f) {
  f.checks = list_mesh_checks(artifact, o.thresholds, has_flow_domain(artifact.mesh), f);
  if (!artifact.mesh.merged.pairs.empty()) f.checks.push_back(check_pairs(artifact.mesh));
  if (cad) {
    run_jobs({[&] {
                f.causes = find_shape_causes(cad->model, artifact.mesh, corners, f.quality,
                                             f.conformity ? &*f.conformity : nullptr, o.list_below_deg);
              },
              [&] { check_against_cad(artifact.mesh, cad->model.tables(), cad->sewing, o.area_tolerance, f); }});
  }
  check_thresholds(artifact.mesh, corners, o.thresholds, cad ? &cad->model.tables() : nullptr, f);
  check_wings(f);
  if (o.layers.empty()) return;
  const SurfaceMesh& mesh = artifact.mesh;
  for (Check& c : layers_checks(mesh, has_flow_domain(mesh), artifact.header.unit_in_m, parse_layers(o.layers)))
    f.checks.push_back(std::move(c));
}

}  // namespace

void CheckStageOptions::validate() const {
  const auto needs = [](bool is_asked, const std::string& given, const char* option, const char* input) {
    if (is_asked && given.empty())
      throw Error(ExitCode::kUsage, fmt::format("{}: needs {} FILE; give it, or leave the option out", option, input));
  };
  needs(thresholds.min_size_share.has_value(), sizing, "--min-size-share", "--sizing");
  needs(thresholds.max_free_sharp.has_value(), geometry, "--max-free-sharp", "--geometry");
  needs(!thresholds.max_deviation.empty(), geometry, "--max-deviation", "--geometry");
  needs(thresholds.max_normal_deviation_deg.has_value(), geometry, "--max-normal-deviation", "--geometry");
  if (!layers.empty()) parse_layers(layers);
}

StageSummary run_check(const CheckStageOptions& options, std::string* report) {
  options.validate();
  const Timer timer;
  Progress progress("checking", 1);
  progress.step("reading", 0);
  require_fitting({{options.mesh, "mesh"}, {options.geometry, "geometry"}, {options.sizing, "sizing"}});
  if (const std::string& bound = options.thresholds.max_deviation; !bound.empty())
    require_unit(parse_length(bound, "--max-deviation"), read_header(options.geometry).unit_in_m, "--max-deviation");
  const CheckedMesh checked = read_checked_mesh(options);
  const MeshArtifact& artifact = checked.artifact;
  const std::vector<Vec3> squeeze = squeeze_of_nodes(artifact.mesh, checked.field.get());
  const TriangleCorners corners(artifact.mesh, squeeze);
  Findings f;
  f.unit = artifact.header.unit;
  progress.step("measuring", 0.1);
  measure(checked, corners, progress, f);
  if (checked.turned.count > 0) f.topology.misoriented_edges = checked.turned;
  progress.step("causes", 0.9);
  add_deviations(checked.wings, f);
  judge(options, artifact, corners, checked.cad.get(), f);
  const double seconds = timer.seconds();
  std::string full;
  if (report || !options.reports.empty())
    full = check_report_json(options.mesh, artifact.mesh, f, seconds, ReportDetail::kFull) + "\n";
  for (const std::string& path : options.reports) write_text_file(path, full);
  if (report) *report = std::move(full);
  return {options.text == CheckText::kWhole ? check_report_text(options.mesh, artifact.mesh, f, seconds)
                                            : check_brief_text(options.mesh, artifact.mesh, f, seconds, options.text),
          check_report_json(options.mesh, artifact.mesh, f, seconds, ReportDetail::kSummary),
          f.passes() ? ExitCode::kOk : ExitCode::kIncomplete};
}

}  // namespace st
