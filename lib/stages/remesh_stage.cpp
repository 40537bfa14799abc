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

namespace st {
namespace {

constexpr double kSizeChange = 0.1;   // relative: where the request changed by less the old mesh is good enough

void require_valid(const RemeshStageOptions& o) {
  if (!(o.too_long > 1)) throw Error(ExitCode::kUsage, fmt::format("--too-long {}: must be larger than 1", o.too_long));
  if (!(o.too_short > 0 && o.too_short < 1)) throw Error(ExitCode::kUsage, fmt::format("--too-short {}: not in (0, 1)", o.too_short));
}

/// Faces with a triangle edge that the changed sizes find too long or too short, ascending.
std::vector<FaceId> faces_to_redo(const SurfaceMesh& mesh, const SizeField& field, const RemeshStageOptions& o, std::int32_t n_faces) {
  int hint = 0;
  std::vector<double> wanted;
  wanted.reserve(mesh.node_xyz.size());
  for (Vec3 x : mesh.node_xyz) wanted.push_back(field.size(x, hint));
  std::vector<char> redo(n_faces, 0), present(n_faces, 0);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const FaceId f = mesh.triangle_face[i];
    present[f] = 1;
    for (int k = 0; k < 3 && !redo[f]; ++k) {
      const NodeId a = mesh.triangles[i].n[k], b = mesh.triangles[i].n[(k + 1) % 3];
      const double size = 0.5 * (wanted[a] + wanted[b]), before = 0.5 * (mesh.node_size[a] + mesh.node_size[b]);
      if (std::abs(size - before) <= kSizeChange * before) continue;
      const double ratio = distance(mesh.node_xyz[a], mesh.node_xyz[b]) / size;
      redo[f] = ratio > o.too_long || ratio < o.too_short;
    }
  }
  std::vector<FaceId> faces;
  for (FaceId f = 0; f < n_faces; ++f)
    if (redo[f] || !present[f]) faces.push_back(f);
  return faces;
}

/// The nodes on the CAD edges as the mesh has them.
EdgeMesh edge_mesh_of(const SurfaceMesh& mesh, const ModelTables& t, std::vector<NodeId>& vertex_node, std::vector<std::int32_t>& index_on_edge) {
  std::vector<std::vector<NodeId>> inner(t.n_edges());
  vertex_node.assign(t.n_vertices(), kNone);
  index_on_edge.assign(mesh.node_xyz.size(), 0);
  for (NodeId n = 0; n < static_cast<NodeId>(mesh.node_xyz.size()); ++n) {
    if (mesh.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kVertex)) vertex_node[mesh.node_entity[n]] = n;
    if (mesh.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kEdge)) inner[mesh.node_entity[n]].push_back(n);
  }
  EdgeMesh e;
  e.edge_offsets.push_back(0);
  const auto add = [&](double x, Vec3 p, double h) {
    e.node_t.push_back(x);
    e.node_xyz.push_back(p);
    e.node_size.push_back(h);
  };
  for (EdgeId i = 0; i < t.n_edges(); ++i) {
    const NodeId first = vertex_node[t.edge_vertices[2 * i]], last = vertex_node[t.edge_vertices[2 * i + 1]];
    if (!t.edge_is_degenerate[i] && first != kNone && last != kNone) {
      add(t.edge_range[2 * i], mesh.node_xyz[first], mesh.node_size[first]);
      for (std::size_t k = 0; k < inner[i].size(); ++k) {
        index_on_edge[inner[i][k]] = static_cast<std::int32_t>(k) + 1;
        add(mesh.node_t[inner[i][k]], mesh.node_xyz[inner[i][k]], mesh.node_size[inner[i][k]]);
      }
      add(t.edge_range[2 * i + 1], mesh.node_xyz[last], mesh.node_size[last]);
    }
    e.edge_offsets.push_back(static_cast<std::int32_t>(e.node_t.size()));
  }
  return e;
}

std::vector<FacePatch> patches_of(const SurfaceMesh& mesh, std::int32_t n_faces, const std::vector<std::int32_t>& index_on_edge) {
  std::vector<FacePatch> patches(n_faces);
  for (FaceId f = 0; f < n_faces; ++f) patches[f].face = f;
  std::vector<std::int32_t> number(mesh.node_xyz.size(), kNone);
  for (std::size_t begin = 0; begin < mesh.triangles.size();) {
    const FaceId f = mesh.triangle_face[begin];
    std::size_t end = begin;
    while (end < mesh.triangles.size() && mesh.triangle_face[end] == f) ++end;
    FacePatch& p = patches[f];
    std::vector<NodeId> boundary;
    for (std::size_t i = begin; i < end; ++i)
      for (NodeId n : mesh.triangles[i].n)
        if (mesh.node_entity_dim[n] != static_cast<std::uint8_t>(EntityDim::kFace)) boundary.push_back(n);
    std::sort(boundary.begin(), boundary.end());
    boundary.erase(std::unique(boundary.begin(), boundary.end()), boundary.end());
    for (NodeId n : boundary) {
      number[n] = p.n_boundary++;
      p.boundary_dim.push_back(mesh.node_entity_dim[n]);
      p.boundary_entity.push_back(mesh.node_entity[n]);
      p.boundary_index.push_back(index_on_edge[n]);
    }
    for (std::size_t i = begin; i < end; ++i) {
      Triangle t;
      for (int k = 0; k < 3; ++k) {
        const NodeId n = mesh.triangles[i].n[k];
        if (mesh.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kFace) && number[n] == kNone) {
          number[n] = p.n_boundary + static_cast<std::int32_t>(p.inner_xyz.size());
          p.inner_xyz.push_back(mesh.node_xyz[n]);
          p.inner_uv.push_back(mesh.corner_uv[3 * i + k]);
          p.inner_size.push_back(mesh.node_size[n]);
        }
        t.n[k] = number[n];
        p.corner_uv.push_back(mesh.corner_uv[3 * i + k]);
      }
      p.triangles.push_back(t);
    }
    for (NodeId n : boundary) number[n] = kNone;
    begin = end;
  }
  return patches;
}

StageSummary dry_run_summary(const SurfaceMesh& mesh, const std::vector<FaceId>& redo, std::int32_t n_faces) {
  std::vector<char> marked(n_faces, 0);
  for (FaceId f : redo) marked[f] = 1;
  const auto n = std::count_if(mesh.triangle_face.begin(), mesh.triangle_face.end(), [&](FaceId f) { return marked[f]; });
  StageSummary s;
  s.line = fmt::format("{} of {} faces would be redone, with {} of {} triangles; nothing written", redo.size(), n_faces, n, mesh.n_triangles());
  s.json = nlohmann::json{{"tool", "st-remesh"}, {"faces_redone", redo.size()}, {"triangles_redone", n}, {"triangles", mesh.n_triangles()}}.dump();
  return s;
}

}  // namespace

StageSummary run_remesh(const RemeshStageOptions& o, const Communicator& comm) {
  const Timer timer;
  require_valid(o);
  if (comm.is_root() && !o.dry_run) require_writable(o.output);
  const MeshArtifact old = read_mesh(o.mesh);
  GeometryArtifact geometry = read_geometry(o.geometry);
  const MappedSizing sizing = map_sizing(o.sizing);
  require_same_geometry(o.mesh, old.header, o.geometry, geometry.header);
  require_same_geometry(o.geometry, geometry.header, o.sizing, sizing.header);
  const ArtifactHeader geometry_header = geometry.header;
  const Model model(std::move(geometry.tables), std::move(geometry.brep));
  const std::vector<FaceId> redo = faces_to_redo(old.mesh, *sizing.field, o, model.tables().n_faces());
  if (o.dry_run) return dry_run_summary(old.mesh, redo, model.tables().n_faces());

  std::vector<NodeId> vertex_node;
  std::vector<std::int32_t> index_on_edge;
  EdgeMesh edges = edge_mesh_of(old.mesh, model.tables(), vertex_node, index_on_edge);
  ModelMesher mesher(model, *sizing.field, sizing.face_weight, {}, comm);
  const double load_seconds = timer.seconds();
  mesher.run_from(std::move(edges), patches_of(old.mesh, model.tables().n_faces(), index_on_edge), redo);
  if (!comm.is_root()) return {};

  ArtifactHeader header;
  header.tool = "st-remesh";
  header.options_json = nlohmann::json{{"too_long", o.too_long}, {"too_short", o.too_short}, {"faces_redone", redo.size()}}.dump();
  header.inputs = {{"mesh", std::filesystem::path(o.mesh).filename().string(), old.header.content_hash},
                   {"geometry", std::filesystem::path(o.geometry).filename().string(), geometry_header.content_hash},
                   {"sizing", std::filesystem::path(o.sizing).filename().string(), sizing.header.content_hash}};
  return write_patches_result(o.output, model.tables(), geometry_header, header, mesher, {timer, load_seconds, comm.size()});
}

}  // namespace st
