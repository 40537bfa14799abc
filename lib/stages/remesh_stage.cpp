#include "stages/remesh_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/log.h"
#include "io/artifact.h"
#include "io/sizing_artifact.h"
#include "stages/model_mesher.h"
#include "stages/patches_result.h"
#include "stages/remesher.h"

namespace st {
namespace {

void require_valid(const RemeshStageOptions& o) {
  if (!(o.too_long > 1)) throw Error(ExitCode::kUsage, fmt::format("--too-long {}: must be larger than 1", o.too_long));
  if (!(o.too_short > 0 && o.too_short < 1)) throw Error(ExitCode::kUsage, fmt::format("--too-short {}: not in (0, 1)", o.too_short));
}

/// Faces of the group that stays, [n_faces]; empty when none does.
std::vector<char> kept_faces(const RemeshStageOptions& o, const ModelTables& t) {
  if (o.keep.empty()) return {};
  const auto group = std::find(t.group_name.begin(), t.group_name.end(), o.keep);
  if (group == t.group_name.end())
    throw Error(ExitCode::kUsage, fmt::format("--keep '{}': the model has no such group; st-info {} lists them", o.keep, o.geometry));
  std::vector<char> keep;
  for (std::int32_t g : t.face_group) keep.push_back(g == group - t.group_name.begin());
  return keep;
}

nlohmann::json counts(const Remesher& r, const HoleMesh& mesh) {
  return {{"faces_redone", r.dirty_faces.size()},
          {"triangles_redone", r.n_marked_triangles},
          {"segments_redone", r.n_marked_segments},
          {"triangles_before", mesh.mesh.n_triangles()},
          {"faces", mesh.tables.n_faces()}};
}

StageSummary dry_run_summary(const Remesher& r, const HoleMesh& mesh) {
  StageSummary s;
  s.line = fmt::format("{} of {} triangles on {} of {} faces would be redone, and {} segments of edges; nothing written", r.n_marked_triangles,
                       mesh.mesh.n_triangles(), r.dirty_faces.size(), mesh.tables.n_faces(), r.n_marked_segments);
  nlohmann::json json = counts(r, mesh);
  json["tool"] = "st-remesh";
  s.json = json.dump();
  return s;
}

/// Nodes of edges that were done again keep no number but those at the ends.
void carry_previous(const EdgeMesh& before, EdgeMesh& after) {
  after.node_previous.assign(after.node_t.size(), kNone);
  for (std::size_t e = 0; e + 1 < after.edge_offsets.size(); ++e) {
    const std::int32_t a = before.edge_offsets[e], n = before.edge_offsets[e + 1] - a, b = after.edge_offsets[e], m = after.edge_offsets[e + 1] - b;
    if (n == 0 || m == 0) continue;
    const bool is_same = n == m && std::equal(before.node_t.begin() + a, before.node_t.begin() + a + n, after.node_t.begin() + b);
    for (std::int32_t i = 0; is_same && i < n; ++i) after.node_previous[b + i] = before.node_previous[a + i];
    after.node_previous[b] = before.node_previous[a];
    after.node_previous[b + m - 1] = before.node_previous[a + n - 1];
  }
}

/// Faces whose holes could not be filled are meshed again as wholes, in rounds as st-mesh does.
void redo_failed_faces(ModelMesher& mesher, Remesher& r) {
  if (r.failed_faces.empty()) {
    mesher.edges = std::move(r.edges);
    mesher.patches = std::move(r.patches);
    return;
  }
  const EdgeMesh before = r.edges;
  mesher.run_from(std::move(r.edges), std::move(r.patches), r.failed_faces);
  carry_previous(before, mesher.edges);
  for (FacePatch& p : mesher.patches) {
    p.inner_previous.resize(p.inner_xyz.size(), kNone);
    p.triangle_previous.resize(p.triangles.size(), kNone);
  }
}

/// Nodes that stay although all their triangles are new were asked for by the new sizes as well.
void renew_surrounded_nodes(const SurfaceMesh& old, const SizeField& field, ModelMesher& m) {
  std::vector<char> is_held(old.node_xyz.size(), 0);
  for (const FacePatch& p : m.patches)
    for (TriangleId t : p.triangle_previous)
      for (int k = 0; t != kNone && k < 3; ++k) is_held[old.triangles[t].n[k]] = 1;
  if (m.edges.node_request.empty()) m.edges.node_request = m.edges.node_size;
  int hint = 0;
  for (std::size_t i = 0; i < m.edges.node_t.size(); ++i)
    if (const NodeId n = m.edges.node_previous[i]; n != kNone && !is_held[n]) m.edges.node_request[i] = field.size(m.edges.node_xyz[i], hint);
}

}  // namespace

StageSummary run_remesh(const RemeshStageOptions& o, const Communicator& comm) {
  const Timer timer;
  require_valid(o);
  if (comm.is_root() && !o.dry_run) require_writable(o.output);
  const MeshArtifact old = read_mesh(o.mesh);
  if (!old.is_complete)
    throw Error(ExitCode::kInput, fmt::format("{}: incomplete, faces are missing; mesh all of them with st-mesh first", o.mesh));
  GeometryArtifact geometry = read_geometry(o.geometry);
  const MappedSizing sizing = map_sizing(o.sizing);
  require_same_geometry(o.mesh, old.header, o.geometry, geometry.header);
  require_same_geometry(o.geometry, geometry.header, o.sizing, sizing.header);
  const ArtifactHeader geometry_header = geometry.header;
  const Model model(std::move(geometry.tables), std::move(geometry.brep));
  const HoleMesh mesh(old.mesh, model.tables());
  RemesherOptions options;
  options.mark.too_long = o.too_long;
  options.mark.too_short = o.too_short;
  options.mark.keep_face = kept_faces(o, model.tables());
  Remesher remesher(model, mesh, *sizing.field, options, comm);
  remesher.analyse();
  if (o.dry_run) return dry_run_summary(remesher, mesh);
  const double load_seconds = timer.seconds();
  remesher.run();
  ModelMesher mesher(model, *sizing.field, sizing.face_weight, {}, comm);
  redo_failed_faces(mesher, remesher);
  if (!comm.is_root()) return {};
  renew_surrounded_nodes(old.mesh, *sizing.field, mesher);
  store_requests(*sizing.field, mesher);
  mesher.times.edges += remesher.seconds_edges;
  mesher.times.faces += remesher.seconds_faces;

  ArtifactHeader header;
  header.tool = "st-remesh";
  header.options_json = nlohmann::json{{"too_long", o.too_long}, {"too_short", o.too_short}, {"keep", o.keep}, {"faces_redone", remesher.dirty_faces.size()}}.dump();
  header.inputs = {{"mesh", std::filesystem::path(o.mesh).filename().string(), old.header.content_hash},
                   {"geometry", std::filesystem::path(o.geometry).filename().string(), geometry_header.content_hash},
                   {"sizing", std::filesystem::path(o.sizing).filename().string(), sizing.header.content_hash}};
  StageSummary summary = write_patches_result(o.output, model.tables(), geometry_header, header, mesher, {timer, load_seconds, comm.size()});
  nlohmann::json json = nlohmann::json::parse(summary.json);
  json.update(counts(remesher, mesh));
  json["holes_grown"] = remesher.n_grown;
  summary.json = json.dump();
  summary.line += fmt::format("; {} of {} triangles redone", remesher.n_marked_triangles, old.mesh.n_triangles());
  return summary;
}

}  // namespace st
