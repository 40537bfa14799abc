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
#include "comm/communicator.h"
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
#include "stages/check_parts.h"
#include "stages/check_report.h"
#include "stages/check_shares.h"
#include "stages/check_thresholds.h"
#include "stages/field_on_mesh.h"
#include "stages/fitting_files.h"
#include "stages/foreign_mesh.h"
#include "stages/layers_check.h"
#include "stages/phase_times.h"
#include "stages/stored_model.h"
#include "stages/wing_table.h"
#include "stages/wing_triangles.h"

namespace st {

namespace {

Check check_complete(const MeshArtifact& artifact, std::int64_t n_triangles) {
  Check c{"complete", "faces flagged as not meshed", {}, true, ""};
  if (!artifact.is_complete) c.defects.add({}), c.note = "merged with --allow-incomplete";
  if (n_triangles == 0) c.defects.add({}), c.note = "no triangles";
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

/// Pairs of triangles that cross, and the components of the nodes.
struct FoundPairs {
  std::vector<TrianglePair> pairs;
  std::vector<std::int32_t> component;  ///< [n_nodes], or empty where there is no pair
  bool was_ended = false;
};

/// Crossings, those apart where the CAD touches itself; how many of the others are the CAD's own. The fluid in a flow
/// domain is one body of the CAD, but the parts of its boundary are bodies that may touch.
void report_crossings_and_contacts(const SurfaceMesh& mesh, const FoundPairs& found, const CadSide* cad, Findings& f) {
  if (!cad) {
    f.crossings = check_crossings(mesh, found.pairs, found.component, found.was_ended, {});
    return;
  }
  f.cad.emplace().is_of_facets = !cad->model.facets().empty();
  CadContacts contacts(cad->model, mesh);
  WallsApart walls(cad->model, mesh);
  const auto touches_itself = [&](const TrianglePair& pair) {
    if (contacts.touches(pair)) return true;
    f.cad->n_model_crossings += contacts.crosses(pair);
    return false;
  };
  CadOfPairs pairs{touches_itself, [&](const TrianglePair& pair) { return walls.are_apart(pair); }};
  pairs.is_of_sheet = [&](const TrianglePair& pair) { return walls.are_of_body_and_sheet(pair); };
  if (!has_flow_domain(mesh)) pairs.is_one_body = [&](const TrianglePair& pair) { return walls.are_of_one_body(pair); };
  f.crossings = check_crossings(mesh, found.pairs, found.component, found.was_ended, pairs);
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
      check_complete(artifact, f.n_triangles),
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
  for (std::size_t w = 0; f.cad && w < f.wings.size(); ++w) {
    double chord = 0, most = 0;
    for (const WingRecord::Station& s : records[w].stations) chord = std::max(chord, s.chord);
    for (const FaceId face : records[w].faces)
      if (static_cast<std::size_t>(face) < f.cad->deviation.faces.size())
        most = std::max(most, f.cad->deviation.faces[face].max_distance);
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

/// What the measures mean, and what needs the whole mesh. `parts`: of all of it, or of all shares; `mesh`: it, or its
/// nodes on edges and vertices, its labels and merged features; `find_causes`: null where they are found.
void judge(const CheckStageOptions& o, const CheckBasis& basis, const MeshArtifact& artifact, const CheckParts& parts,
           const std::function<void()>& find_causes, Findings& f) {
  const SurfaceMesh& mesh = artifact.mesh;
  f.checks = list_mesh_checks(artifact, o.thresholds, has_flow_domain(mesh), f);
  if (!mesh.merged.pairs.empty()) f.checks.push_back(check_pairs(mesh));
  if (const CadSide* cad = basis.cad) {
    std::vector<std::function<void()>> jobs{[&] {
      f.cad->chords = report_chords(cad->model, mesh, parts.chords);
      check_against_cad({mesh, basis.counts.faces, basis.face_place, parts.faces}, cad->model.tables(), cad->sewing,
                        o.area_tolerance, f);
    }};
    if (find_causes) jobs.push_back(find_causes);
    run_jobs(jobs);
  }
  check_thresholds(parts.bad, o.thresholds, basis.cad ? &basis.cad->model.tables() : nullptr, f);
  check_wings(f);
  if (o.layers.empty()) return;
  for (Check& c : layers_checks(mesh, has_flow_domain(mesh), artifact.header.unit_in_m, parse_layers(o.layers)))
    f.checks.push_back(std::move(c));
}

/// A mesh in memory, which is returned.
MeshArtifact check_whole(const CheckStageOptions& o, Progress& progress, Findings& f) {
  CheckedMesh checked = read_checked_mesh(o);
  const MeshArtifact& artifact = checked.artifact;
  const SurfaceMesh& mesh = artifact.mesh;
  f.unit = artifact.header.unit;
  const CadSide* cad = checked.cad.get();
  const std::vector<Vec3> squeeze = squeeze_of_nodes(mesh, checked.field.get());
  const TriangleCorners corners(mesh, squeeze);
  f.is_stretched = corners.is_stretched();
  progress.step("measuring", 0.1);
  const CheckBasis basis = CheckBasis::of(mesh, cad, checked.field.get(), o);
  std::vector<std::function<void()>> wings;
  if (!checked.wings.empty()) wings.emplace_back([&] { f.wings = measure_wings(mesh, checked.wings); });
  CheckParts parts = measure_share(basis, mesh, corners, OwnTriangles::all(mesh), wings, progress, 0.8);
  FoundPairs found{std::move(parts.pairs), {}, parts.was_ended};
  std::int32_t n_components = 0;
  if (!found.pairs.empty()) found.component = node_components(mesh.triangles, mesh.n_nodes(), n_components);
  report_crossings_and_contacts(mesh, found, cad, f);
  report_parts(basis, parts, mesh.labels, f);
  if (checked.turned.count > 0) f.topology.misoriented_edges = checked.turned;
  progress.step("causes", 0.9);
  add_deviations(checked.wings, f);
  judge(
      o, basis, artifact, parts,
      [&] {
        f.cad->causes = find_shape_causes(cad->model, mesh, corners, f.quality, f.conformity ? &*f.conformity : nullptr,
                                          o.list_below_deg);
      },
      f);
  return std::move(checked.artifact);
}

/// Collective. False: the mesh is to be checked as a whole, by the first rank.
bool check_in_shares(const CheckStageOptions& o, const Executor& ranks, Progress& progress, MeshArtifact& head,
                     Findings& f) {
  if (!is_worth_sharing(o, ranks)) return false;
  const SharedMesh shared(o);
  head = shared.file.head();
  if (!head.mesh.merged.pairs.empty() || (shared.field && shared.field->is_stretched())) return false;
  CheckBasis given;
  given.cad = shared.cad.get(), given.field = shared.field.get(), given.options = &o;
  std::optional<SharedFindings> found = measure_shares(given, shared.file, ranks, progress);
  if (!found) return false;
  if (!ranks.is_root()) return true;
  f.unit = head.header.unit;
  f.wings = measure_wings(shared.file, shared.wings);
  report_crossings_and_contacts(found->crossing.mesh, {found->pairs, found->component, found->was_ended}, given.cad, f);
  report_parts(found->basis, found->parts, head.mesh.labels, f);
  progress.step("causes", 0.9);
  add_deviations(shared.wings, f);
  head.mesh = std::move(found->edges.mesh);
  judge(o, found->basis, head, found->parts, {}, f);
  return true;
}

StageSummary check(const CheckStageOptions& options, const Executor& ranks, std::string* report) {
  options.validate();
  const Timer timer;
  Progress progress("checking", 1);
  progress.step("reading", 0);
  require_fitting({{options.mesh, "mesh"}, {options.geometry, "geometry"}, {options.sizing, "sizing"}});
  if (const std::string& bound = options.thresholds.max_deviation; !bound.empty())
    require_unit(parse_length(bound, "--max-deviation"), read_header(options.geometry).unit_in_m, "--max-deviation");
  Findings f;
  MeshArtifact artifact;
  const bool is_shared = check_in_shares(options, ranks, progress, artifact, f);
  if (!ranks.is_root()) return {};
  if (!is_shared) artifact = check_whole(options, progress, f);
  const double seconds = timer.seconds();
  std::string full;
  if (report || !options.reports.empty())
    full = check_report_json(options.mesh, artifact.mesh, f, seconds, ReportDetail::kFull) + "\n";
  for (const std::string& path : options.reports) write_text_file(path, full);
  if (report) *report = std::move(full);
  return {options.text == CheckText::kWhole ? check_report_text(options.mesh, artifact.mesh, f, seconds)
                                            : check_brief_text(options.mesh, artifact.mesh, f, seconds, options.text),
          check_report_json(options.mesh, artifact.mesh, f, seconds, ReportDetail::kSummary, processor_json()),
          f.passes() ? ExitCode::kOk : ExitCode::kIncomplete};
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
  return check(options, SerialExecutor(), report);
}

StageSummary run_check(const CheckStageOptions& options, const Communicator& ranks, std::string* report) {
  return check(options, ranks, report);
}

}  // namespace st
