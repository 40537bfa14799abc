#include "stages/merge_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.h"
#include "base/limits.h"
#include "base/log.h"
#include "base/memory.h"
#include "base/progress.h"
#include "base/threads.h"
#include "io/export/export.h"
#include "io/file/json_text.h"
#include "io/file/temporary_file.h"
#include "io/hdf5/artifact.h"
#include "mesh/checks.h"
#include "mesh/edge_segments.h"
#include "mesh/merge.h"
#include "stages/mesh_export.h"

namespace st {

namespace {

/// Faces without a patch, 1-based, the first of them by number: "3, 17, 20 and 5 more".
std::string list_faces(std::span<const FaceId> faces) {
  constexpr std::size_t kShown = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(faces.size(), kShown); ++i)
    text += (i ? ", " : "") + std::to_string(faces[i] + 1);
  return faces.size() > kShown ? fmt::format("{} and {} more", text, faces.size() - kShown) : text;
}

std::vector<FaceId> find_missing_faces(const PatchesArtifact& patches) {
  std::vector<std::uint8_t> is_meshed(patches.labels.face_name.size(), 0);
  for (const FacePatch& p : patches.patches)
    if (p.face >= 0 && static_cast<std::size_t>(p.face) < is_meshed.size()) is_meshed[p.face] = 1;
  for (const FaceId f : closed_faces(patches.merged, patches.edges, patches.edge_vertices)) is_meshed[f] = 1;
  std::vector<FaceId> missing;
  for (std::size_t f = 0; f < is_meshed.size(); ++f)
    if (!is_meshed[f]) missing.push_back(static_cast<FaceId>(f));
  return missing;
}

/// The nodes of edges of two parts; an edge that both have must have the same nodes in both.
EdgeMesh unite_edges(const EdgeMesh& a, const EdgeMesh& b, const std::string& path_a, const std::string& path_b) {
  if (a.n_edges() != b.n_edges())
    throw Error(
        ExitCode::kMismatch,
        fmt::format("{} and {} differ in their number of edges; mesh both on the same geometry", path_a, path_b));
  EdgeMesh both;
  for (EdgeId e = 0; e < a.n_edges(); ++e) {
    const bool in_a = a.n_nodes(e) > 0, in_b = b.n_nodes(e) > 0;
    if (in_a && in_b && !has_same_nodes(a, b, e))
      throw Error(
          ExitCode::kMismatch,
          fmt::format(
              "edge {} has different nodes in {} and in {}; mesh the second part with --edges and the first patches",
              e + 1, path_b, path_a));
    const EdgeMesh& from = in_a ? a : b;
    both.append(from, e);
    for (const std::int32_t i : from.nodes(e)) both.node_request.push_back(from.requests()[i]);
  }
  return both;
}

/// Parts of one model that were meshed apart, as one.
void add_part(PatchesArtifact& all, PatchesArtifact part, const std::string& path_all, const std::string& path) {
  require_same_geometry(path_all, all.header, path, part.header);
  if (!(all.merged == part.merged))
    throw Error(ExitCode::kMismatch,
                fmt::format("{} and {} merge different small features of the CAD; mesh the second part with --edges {}",
                            path_all, path, path_all));
  all.edges = unite_edges(all.edges, part.edges, path_all, path);
  for (FacePatch& p : part.patches) {
    const auto same =
        std::find_if(all.patches.begin(), all.patches.end(), [&](const FacePatch& q) { return q.face == p.face; });
    if (same != all.patches.end())
      throw Error(
          ExitCode::kMismatch,
          fmt::format("face {} is in {} and in an earlier patches file; mesh each face once", p.face + 1, path));
    all.patches.push_back(std::move(p));
  }
  all.is_complete = find_missing_faces(all).empty();
}

PatchesArtifact read_parts(const std::vector<std::string>& paths, std::vector<InputRef>& inputs) {
  if (paths.empty()) throw Error(ExitCode::kUsage, "no patches given; name the artifact of st-mesh");
  PatchesArtifact all = read_patches(paths[0]);
  const auto note_input = [&](const std::string& path, const ArtifactHeader& header) {
    inputs.push_back({"patches", std::filesystem::path(path).filename().string(), header.content_hash});
  };
  note_input(paths[0], all.header);
  for (std::size_t i = 1; i < paths.size(); ++i) {
    PatchesArtifact part = read_patches(paths[i]);
    note_input(paths[i], part.header);
    add_part(all, std::move(part), paths[0], paths[i]);
  }
  return all;
}

void require_complete(const PatchesArtifact& patches, const MergeStageOptions& options) {
  if (patches.is_complete || options.allow_incomplete) return;
  const std::vector<FaceId> missing = find_missing_faces(patches);
  const auto hole =
      std::find_if(patches.failures.begin(), patches.failures.end(), [](const FaceFailure& f) { return !f.is_closed; });
  const std::string cause =
      hole == patches.failures.end() ? "" : fmt::format(" (face {}: {})", hole->face + 1, hole->cause);
  throw Error(
      ExitCode::kIncomplete,
      fmt::format(
          "{}: incomplete, {} faces have no complete mesh{}{}{}; mesh them, or merge the rest with --allow-incomplete",
          options.patches[0], missing.size(), missing.empty() ? "" : ": ", list_faces(missing), cause));
}

/// Everything that could stop the outputs is found before the work, so that none is left without the others.
void require_outputs(const MergeStageOptions& options) {
  require_writable(options.output);
  for (const std::string& path : options.exports) {
    require_export_format(path, {});
    require_writable(path);
  }
}

void warn_of_changes(const OrientationReport& report) {
  if (!report.turned_faces.empty())
    log_warning(fmt::format("{} faces were turned to agree with their neighbours: {}", report.turned_faces.size(),
                            list_faces(report.turned_faces)));
  if (report.turned_components)
    log_warning(fmt::format("{} parts were inside out and are turned: faces {}", report.turned_components,
                            list_faces(report.inside_out_faces)));
  if (report.n_one_sided)
    log_warning(
        fmt::format("{} parts are one-sided (like a Moebius strip) and cannot be oriented", report.n_one_sided));
}

MeshArtifact make_artifact(PatchesArtifact& patches, const MergeStageOptions& options, std::vector<InputRef> inputs,
                           OrientationReport& report) {
  MeshArtifact artifact;
  artifact.header.schema = "mesh";
  artifact.header.tool = "st-merge";
  artifact.header.tool_version = ST_VERSION;
  artifact.header.options_json = json_text(nlohmann::json{{"allow_incomplete", options.allow_incomplete}});
  artifact.header.unit = patches.header.unit;
  artifact.header.unit_in_m = patches.header.unit_in_m;
  artifact.header.geometry_hash = patches.header.geometry_hash;
  artifact.header.inputs = std::move(inputs);
  artifact.is_complete = patches.is_complete;
  artifact.mesh = merge_patches(
      {patches.edges, patches.vertex_xyz, patches.edge_vertices, patches.patches, patches.labels.face_group}, report);
  artifact.mesh.labels = std::move(patches.labels);
  artifact.mesh.merged = std::move(patches.merged);
  add_segments(artifact.mesh, patches.edges, patches.edge_vertices);
  return artifact;
}

StageSummary summarize(const MergeStageOptions& options, const MeshArtifact& artifact, const std::string& hash,
                       const TopologyReport& topology, const OrientationReport& orientation, double seconds) {
  const SurfaceMesh& mesh = artifact.mesh;
  const MeshMeasure measure = measure_mesh(mesh);
  const nlohmann::json json{{"output", options.output},
                            {"hash", hash},
                            {"triangles", mesh.n_triangles()},
                            {"nodes", mesh.n_nodes()},
                            {"components", topology.n_components},
                            {"closed", topology.is_closed()},
                            {"complete", artifact.is_complete},
                            {"boundary_edges", topology.boundary_edges.count},
                            {"nonmanifold_edges", topology.nonmanifold_edges.count},
                            {"misoriented_edges", topology.misoriented_edges.count},
                            {"turned_faces", orientation.turned_faces.size()},
                            {"turned_parts", orientation.turned_components},
                            {"one_sided_parts", orientation.n_one_sided},
                            {"area", measure.area},
                            {"volume", measure.volume},
                            {"seconds", seconds}};
  const std::string state = topology.is_closed()
                                ? "closed"
                                : fmt::format("{} open and {} non-manifold edges", topology.boundary_edges.count,
                                              topology.nonmanifold_edges.count);
  return {fmt::format("{}: {} triangles, {} nodes, {}{}, {:.1f} s", options.output, mesh.n_triangles(), mesh.n_nodes(),
                      state, artifact.is_complete ? "" : ", INCOMPLETE", seconds),
          json_text(json), ExitCode::kOk};
}

}  // namespace

StageSummary run_merge(const MergeStageOptions& options) {
  const Timer timer;
  keep_freed_memory();
  require_outputs(options);
  Progress progress("merging", 1);
  progress.step("reading", 0);
  std::vector<InputRef> inputs;
  PatchesArtifact patches = read_parts(options.patches, inputs);
  require_complete(patches, options);
  OrientationReport orientation;
  progress.step("nodes", 0.2);
  const MeshArtifact artifact = make_artifact(patches, options, std::move(inputs), orientation);
  patches = {};
  warn_of_changes(orientation);

  const SurfaceMesh& mesh = artifact.mesh;
  progress.step("checking and writing", 0.5);
  TopologyReport topology;
  std::string hash;
  run_jobs(
      {[&] { hash = write_mesh(options.output, artifact); }, [&] { topology = check_topology(mesh, edges_of(mesh)); }});
  for (const std::string& path : options.exports) export_and_warn(path, {mesh, all_triangles(mesh), {}}, {});

  return summarize(options, artifact, hash, topology, orientation, timer.seconds());
}

}  // namespace st
