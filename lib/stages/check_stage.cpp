#include "stages/check_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "base/log.h"
#include "geometry/model.h"
#include "io/artifact.h"
#include "io/sizing_artifact.h"
#include "mesh/checks.h"
#include "mesh/quality.h"
#include "stages/chord_error.h"

namespace st {

namespace {

using nlohmann::json;

/// One line of the report: what was looked for, what was found.
struct Check {
  std::string name;  ///< "closed", "folds" ...
  std::string what;  ///< what is counted: "open edges"
  Defects defects;
  bool decides = true;  ///< the mesh fails when something was found
  std::string note;     ///< added to the line, found or not

  bool fails() const { return decides && defects.count > 0; }
};

/// The geometry with what the checks need of it.
struct CadSide {
  Model model;
  std::vector<std::uint8_t> may_be_open, may_be_nonmanifold;

  explicit CadSide(GeometryArtifact&& g) : model(std::move(g.tables), std::move(g.brep)) {
    std::vector<std::int32_t> offsets;
    std::vector<FaceId> faces;
    model.tables().edge_faces(offsets, faces);
    for (EdgeId e = 0; e < model.tables().n_edges(); ++e) {
      may_be_open.push_back(offsets[e + 1] - offsets[e] == 1);
      may_be_nonmanifold.push_back(offsets[e + 1] - offsets[e] > 2);
    }
  }
  CadEdges edges() const { return {model.tables().edge_vertices, may_be_open, may_be_nonmanifold}; }
};

/// Everything that was measured.
struct Findings {
  TopologyReport topology;
  ShapeReport shape;
  CrossingReport crossings;
  MeshMeasure measure;
  QualityReport quality;
  std::optional<ConformityReport> conformity;
  std::optional<ChordError> chords;
  std::vector<Check> checks;

  bool passes() const {
    return std::none_of(checks.begin(), checks.end(), [](const Check& c) { return c.fails(); });
  }
};

std::string face_label(const SurfaceMesh& mesh, FaceId f) {
  const bool has_name = static_cast<std::size_t>(f) < mesh.face_name.size() && !mesh.face_name[f].empty();
  return has_name ? fmt::format("face {} \"{}\"", f + 1, mesh.face_name[f]) : fmt::format("face {}", f + 1);
}

std::string place_text(const SurfaceMesh& mesh, const DefectPlace& p) {
  std::string text = fmt::format("({:.6g} {:.6g} {:.6g})", p.xyz.x, p.xyz.y, p.xyz.z);
  if (p.face_a != kNone) text += ", " + face_label(mesh, p.face_a);
  if (p.face_b != kNone && p.face_b != p.face_a) text += " and " + face_label(mesh, p.face_b);
  return text;
}

/// Middle of the first triangle of each face.
std::vector<Vec3> face_places(const SurfaceMesh& mesh, std::size_t n_faces) {
  std::vector<Vec3> place(n_faces);
  for (TriangleId t = static_cast<TriangleId>(mesh.n_triangles()) - 1; t >= 0; --t) {
    const auto& n = mesh.triangles[t].n;
    if (static_cast<std::size_t>(mesh.triangle_face[t]) < n_faces)
      place[mesh.triangle_face[t]] = (mesh.node_xyz[n[0]] + mesh.node_xyz[n[1]] + mesh.node_xyz[n[2]]) / 3;
  }
  return place;
}

Check check_complete(const MeshArtifact& artifact) {
  Check c{"complete", "faces flagged as not meshed", {}, true, ""};
  if (!artifact.is_complete) c.defects.add({}), c.note = "merged with --allow-incomplete";
  if (artifact.mesh.triangles.empty()) c.defects.add({}), c.note = "no triangles";
  return c;
}

/// Faces of the CAD without a triangle; faces of no area need none.
Check check_faces(const SurfaceMesh& mesh, const MeshMeasure& measure, const ModelTables& tables) {
  constexpr double kNoArea = 1e-12;  // of the model's area
  Check c{"faces", "CAD faces without a triangle", {}, true, ""};
  double total = 0;
  for (const double a : tables.face_area) total += a;
  std::vector<std::uint8_t> has_triangle(tables.n_faces(), 0);
  for (const FaceId f : mesh.triangle_face) has_triangle[f] = 1;
  for (FaceId f = 0; f < tables.n_faces(); ++f)
    if (!has_triangle[f] && tables.face_area[f] > kNoArea * total) c.defects.add({tables.face_box[f].center(), f, kNone});
  c.note = fmt::format("mesh area / CAD area {:.6f}", total > 0 ? measure.area / total : 0.0);
  return c;
}

/// Faces whose mesh area differs from the CAD's by more than the tolerance and what chords explain together.
Check check_areas(const SurfaceMesh& mesh, const MeshMeasure& measure, const ModelTables& tables, const ChordError& chords,
                  double tolerance) {
  Check c{"areas", "faces whose area differs from the CAD's", {}, true, ""};
  const std::vector<Vec3> place = face_places(mesh, tables.n_faces());
  double largest = 0;
  FaceId worst = kNone;
  for (FaceId f = 0; f < tables.n_faces(); ++f) {
    const double cad = tables.face_area[f], difference = std::fabs(measure.face_area[f] - cad);
    if (difference > tolerance * cad + chords.area[f] && measure.face_area[f] > 0) c.defects.add({place[f], f, kNone});
    if (cad > 0 && difference / cad > largest) largest = difference / cad, worst = f;
  }
  if (worst != kNone)
    c.note = fmt::format("largest difference {:.3g} % ({}; chords explain {:.3g} %)", 100 * largest, face_label(mesh, worst),
                         100 * chords.area[worst] / tables.face_area[worst]);
  return c;
}

/// Largest tolerance of a face, its edges and its vertices, model unit.
double cad_tolerance(const ModelTables& tables, FaceId f) {
  double tolerance = tables.face_tolerance[f];
  for (std::int32_t l = tables.face_loop_offsets[f]; l < tables.face_loop_offsets[f + 1]; ++l)
    for (std::int32_t k = tables.loop_coedge_offsets[l]; k < tables.loop_coedge_offsets[l + 1]; ++k) {
      const EdgeId e = tables.coedge_edge[k];
      const VertexId a = tables.edge_vertices[2 * e], b = tables.edge_vertices[2 * e + 1];
      tolerance = std::max({tolerance, tables.edge_tolerance[e], tables.vertex_tolerance[a], tables.vertex_tolerance[b]});
    }
  return tolerance;
}

/// Faces with a node off the surface by more than the CAD's own tolerances there explain.
Check check_on_surface(const ModelTables& tables, const ChordError& chords) {
  Check c{"on-surface", "faces with nodes off the surface by more than twice the CAD's tolerance", {}, false, ""};
  const double rounding = 1e-9 * tables.box().diagonal();
  FaceId worst = kNone;
  for (FaceId f = 0; f < tables.n_faces(); ++f) {
    if (chords.node_distance[f] > 2 * cad_tolerance(tables, f) + rounding) c.defects.add({chords.node_place[f], f, kNone});
    if (worst == kNone || chords.node_distance[f] > chords.node_distance[worst]) worst = f;
  }
  if (worst != kNone)
    c.note = fmt::format("largest distance {:.3g} (CAD tolerance there {:.3g})", chords.node_distance[worst], cad_tolerance(tables, worst));
  return c;
}

Check check_volume(const TopologyReport& topology, const MeshMeasure& measure) {
  Check c{"volume", "closed meshes of no or negative volume", {}, true, ""};
  const bool has_volume = topology.is_closed() && topology.n_cad_boundary_edges == 0;
  if (has_volume && !(measure.volume > 0)) c.defects.add({});
  c.note = has_volume ? fmt::format("{:.9g}", measure.volume) : "open: none";
  return c;
}

void run_mesh_checks(const MeshArtifact& artifact, const CadSide* cad, Findings& f) {
  const SurfaceMesh& mesh = artifact.mesh;
  f.topology = check_topology(mesh, cad ? cad->edges() : CadEdges{});
  f.shape = check_shape(mesh);
  f.crossings = check_crossings(mesh);
  f.measure = measure_mesh(mesh);
  f.quality = measure_quality(mesh);
  const std::string open =
      f.topology.n_cad_boundary_edges ? fmt::format("{} more where the CAD is open", f.topology.n_cad_boundary_edges) : "";
  const std::string nonmanifold =
      f.topology.n_cad_nonmanifold_edges ? fmt::format("{} more where the CAD is non-manifold", f.topology.n_cad_nonmanifold_edges) : "";
  f.checks = {check_complete(artifact),
              {"closed", "open edges", f.topology.boundary_edges, true, open},
              {"manifold", "non-manifold edges", f.topology.nonmanifold_edges, true, nonmanifold},
              {"oriented", "misoriented edges", f.topology.misoriented_edges, true, ""},
              {"repeated-nodes", "triangles that name a node twice", f.topology.repeated_nodes, true, ""},
              {"zero-area", "triangles without area", f.shape.zero_area, true, ""},
              {"duplicate-triangles", "triangles present twice", f.topology.duplicate_triangles, true, ""},
              {"duplicate-nodes", "nodes at the place of another", f.shape.duplicate_nodes, true, ""},
              {"folds", "folds", f.shape.folds, true, ""},
              {"crossings", "crossing pairs of triangles", f.crossings.crossings, true, ""},
              {"overlaps", "neighbours that lie on or cross each other", f.crossings.overlapping_neighbours, true, ""},
              {"pinched", "nodes where parts touch", f.topology.pinched_nodes, false, ""},
              {"contacts", "pairs of triangles where parts touch or cross", f.crossings.contacts, false, ""},
              check_volume(f.topology, f.measure)};
}

void run_cad_checks(const SurfaceMesh& mesh, const CadSide& cad, double area_tolerance, Findings& f) {
  f.measure.face_area.resize(cad.model.tables().n_faces(), 0);
  f.chords = estimate_chord_error(cad.model, mesh);
  f.checks.push_back(check_faces(mesh, f.measure, cad.model.tables()));
  f.checks.push_back(check_areas(mesh, f.measure, cad.model.tables(), *f.chords, area_tolerance));
  f.checks.push_back(check_on_surface(cad.model.tables(), *f.chords));
}

// --- report ----------------------------------------------------------------------------------------------------------------------------

std::string check_line(const SurfaceMesh& mesh, const Check& c) {
  const std::string note = c.note.empty() ? "" : "  " + c.note;
  if (c.defects.count == 0) return fmt::format("  {:<20} ok{}\n", c.name, note);
  const std::string where = c.defects.first[0].face_a == kNone ? "" : ", first at " + place_text(mesh, c.defects.first[0]);
  return fmt::format("  {:<20} {} {} {}{}{}\n", c.name, c.fails() ? "FAILS" : "note:", c.defects.count, c.what, where, note);
}

std::string quality_lines(const SurfaceMesh& mesh, const QualityReport& q) {
  const std::string worst = q.model.worst == kNone ? "" : fmt::format(" in {}", face_label(mesh, mesh.triangle_face[q.model.worst]));
  return fmt::format(
      "  {:<20} mean {:.4f}, 1st percentile {:.4f}, least {:.4f}{}; {} below 0.3; angles {:.2f} to {:.2f} deg; growth {:.2f} (99.9 %)\n",
      "quality", q.model.mean, q.model.p1, q.model.min, worst, q.model.n_below_03, q.model.min_angle_deg, q.model.max_angle_deg,
      q.jump_p999);
}

std::string conformity_line(const ConformityReport& c) {
  return fmt::format(
      "  {:<20} {:.1f} % of all edges within {} to {} of the requested length, {:.1f} % of those inside faces; mean {:.3f}, 1 % to 99 %: "
      "{:.2f} to {:.2f}\n",
      "sizes", 100 * c.model.share(), kConformityMin, kConformityMax, 100 * c.inner.share(), c.model.mean(), c.p1, c.p99);
}

/// Handles of all parts together, where the number means something.
std::optional<std::int64_t> genus_of(const TopologyReport& t) {
  const bool is_manifold = t.is_closed() && t.n_cad_boundary_edges == 0 && t.n_cad_nonmanifold_edges == 0 && t.pinched_nodes.count == 0;
  return is_manifold ? std::optional(t.genus) : std::nullopt;
}

std::string verdict_line(const CheckStageOptions& options, const SurfaceMesh& mesh, const Findings& f, double seconds) {
  std::string failed;
  for (const Check& c : f.checks) {
    if (!c.fails()) continue;
    const bool has_place = c.defects.first[0].face_a != kNone;
    failed += fmt::format("{}{} {}{}", failed.empty() ? "" : "; ", c.defects.count, c.what,
                          has_place ? ", first at " + place_text(mesh, c.defects.first[0]) : "");
  }
  const std::string verdict = failed.empty() ? "passes" : "FAILS: " + failed;
  const std::string genus = genus_of(f.topology) ? fmt::format(", genus {}", *genus_of(f.topology)) : "";
  return fmt::format("{}: {}; {} triangles, {} nodes, {} {}{}, {:.1f} s", options.mesh, verdict, mesh.n_triangles(),
                     f.topology.n_used_nodes, f.topology.n_components, f.topology.n_components == 1 ? "part" : "parts", genus, seconds);
}

std::string report_text(const CheckStageOptions& options, const SurfaceMesh& mesh, const Findings& f, double seconds) {
  std::string text;
  for (const Check& c : f.checks) text += check_line(mesh, c);
  text += quality_lines(mesh, f.quality);
  if (f.conformity) text += conformity_line(*f.conformity);
  return text + verdict_line(options, mesh, f, seconds);
}

json check_json(const Check& c) {
  json places = json::array();
  for (const DefectPlace& p : c.defects.first) {
    json faces = json::array();
    for (const FaceId f : {p.face_a, p.face_b})
      if (f != kNone) faces.push_back(f + 1);
    places.push_back({{"xyz", {p.xyz.x, p.xyz.y, p.xyz.z}}, {"faces", faces}});
  }
  return {{"count", c.defects.count}, {"passes", !c.fails()}, {"first", places}};
}

json quality_json(const QualityStats& q) {
  return {{"triangles", q.n_triangles},
          {"mean", q.mean},
          {"p1", q.p1},
          {"min", q.min},
          {"below_0.3", q.n_below_03},
          {"histogram", q.histogram},
          {"min_angle_deg", q.min_angle_deg},
          {"max_angle_deg", q.max_angle_deg},
          {"below_20_deg", q.n_below_20_deg},
          {"below_5_deg", q.n_below_5_deg}};
}

json conformity_json(const ConformityStats& c) {
  return {{"edges", c.n_edges}, {"share", c.share()}, {"mean", c.mean()}, {"min", c.min}, {"max", c.max}};
}

json groups_json(const SurfaceMesh& mesh, const Findings& f) {
  json groups = json::array();
  for (std::size_t g = 0; g < f.quality.groups.size(); ++g) {
    json entry{{"name", g < mesh.group_name.size() ? mesh.group_name[g] : ""}, {"quality", quality_json(f.quality.groups[g])}};
    if (f.conformity && g < f.conformity->groups.size()) entry["sizes"] = conformity_json(f.conformity->groups[g]);
    groups.push_back(entry);
  }
  return groups;
}

json faces_json(const SurfaceMesh& mesh, const Findings& f) {
  json faces = json::array();
  for (std::size_t i = 0; i < f.quality.faces.size(); ++i) {
    const QualityStats& q = f.quality.faces[i];
    json entry{{"face", i + 1},
               {"name", i < mesh.face_name.size() ? mesh.face_name[i] : ""},
               {"triangles", q.n_triangles},
               {"area", f.measure.face_area[i]},
               {"mean", q.mean},
               {"min", q.min}};
    if (f.chords && i < f.chords->distance.size()) entry["chord_distance"] = f.chords->distance[i];
    if (f.conformity && i < f.conformity->faces.size()) entry["size_share"] = f.conformity->faces[i].share();
    faces.push_back(entry);
  }
  return faces;
}

json report_json(const CheckStageOptions& options, const SurfaceMesh& mesh, const Findings& f, double seconds) {
  json checks = json::object(), failed = json::array();
  for (const Check& c : f.checks) {
    checks[c.name] = check_json(c);
    if (c.fails()) failed.push_back(c.name);
  }
  json j{{"mesh", options.mesh},
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
         {"checks", checks},
         {"quality", quality_json(f.quality.model)},
         {"jump_p999", f.quality.jump_p999},
         {"jump_max", f.quality.jump_max},
         {"groups", groups_json(mesh, f)},
         {"faces", faces_json(mesh, f)},
         {"seconds", seconds}};
  if (f.conformity)
    j["sizes"] = {{"all", conformity_json(f.conformity->model)},
                  {"inner", conformity_json(f.conformity->inner)},
                  {"p1", f.conformity->p1},
                  {"p99", f.conformity->p99}};
  return j;
}

std::unique_ptr<CadSide> read_cad(const CheckStageOptions& options, const ArtifactHeader& mesh_header) {
  if (options.geometry.empty()) return nullptr;
  GeometryArtifact geometry = read_geometry(options.geometry);
  require_same_geometry(options.mesh, mesh_header, options.geometry, geometry.header);
  return std::make_unique<CadSide>(std::move(geometry));
}

std::unique_ptr<SizeField> read_sizes(const CheckStageOptions& options, const ArtifactHeader& mesh_header) {
  if (options.sizing.empty()) return nullptr;
  ArtifactHeader header;
  std::unique_ptr<SizeField> field = open_sizing(options.sizing, &header);
  require_same_geometry(options.mesh, mesh_header, options.sizing, header);
  return field;
}

}  // namespace

StageSummary run_check(const CheckStageOptions& options) {
  const Timer timer;
  const MeshArtifact artifact = read_mesh(options.mesh);
  const std::unique_ptr<CadSide> cad = read_cad(options, artifact.header);
  const std::unique_ptr<SizeField> field = read_sizes(options, artifact.header);

  Findings f;
  run_mesh_checks(artifact, cad.get(), f);
  if (cad) run_cad_checks(artifact.mesh, *cad, options.area_tolerance, f);
  if (field) f.conformity = measure_conformity(artifact.mesh, [&, hint = 0](Vec3 p) mutable { return field->size(p, hint); });

  const double seconds = timer.seconds();
  return {report_text(options, artifact.mesh, f, seconds), report_json(options, artifact.mesh, f, seconds).dump(),
          f.passes() ? ExitCode::kOk : ExitCode::kIncomplete};
}

}  // namespace st
