#include "stages/merge_stage.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/limits.h"
#include "base/log.h"
#include "base/progress.h"
#include "base/text.h"
#include "io/export/export.h"
#include "io/file/json_text.h"
#include "io/file/output_files.h"
#include "io/file/temporary_file.h"
#include "io/hdf5/artifact.h"
#include "mesh/edge_segments.h"
#include "stages/merge_columns.h"
#include "stages/mesh_export.h"
#include "stages/orientation_warnings.h"
#include "stages/phase_times.h"

namespace st {
namespace {

std::vector<FaceId> find_missing_faces(const PatchesArtifact& rest, const std::vector<PatchInFile>& patches) {
  std::vector<std::uint8_t> is_meshed(rest.labels.face_name.size(), 0);
  for (const PatchInFile& p : patches) is_meshed[p.face()] = 1;
  for (const FaceId f : closed_faces(rest.merged, rest.edges, rest.edge_vertices)) is_meshed[f] = 1;
  for (std::int32_t i = 0; i < rest.composites.size(); ++i)
    for (const FaceId f : rest.composites.members(i).subspan(1)) is_meshed[f] = 1;  // the first has the patch of all
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

/// The nodes of edges of parts of one model that were meshed apart, as one.
void add_part(PatchesArtifact& all, const PatchesArtifact& part, const std::string& path_all, const std::string& path) {
  require_same_geometry(path_all, all.header, path, part.header);
  if (!(all.merged == part.merged))
    throw Error(ExitCode::kMismatch,
                fmt::format("{} and {} merge different small features of the CAD; mesh the second part with --edges {}",
                            path_all, path, path_all));
  if (all.composites.member != part.composites.member)
    throw Error(
        ExitCode::kMismatch,
        fmt::format("{} and {} join different faces, as some cannot be meshed as one; mesh both on the geometry "
                    "of st-import --composite none",
                    path_all, path));
  all.edges = unite_edges(all.edges, part.edges, path_all, path);
}

/// What is to be merged: files of patches, and what they have besides.
struct MergeParts {
  std::vector<std::unique_ptr<PatchesFile>> files;
  std::vector<PatchInFile> patches;
  PatchesArtifact rest;  // of all files; without patches
  std::vector<InputRef> inputs;
};

MergeParts open_parts(const std::vector<std::string>& paths) {
  if (paths.empty()) throw Error(ExitCode::kUsage, "no patches given; name the artifact of st-mesh");
  MergeParts parts;
  for (const std::string& path : paths) {
    parts.files.push_back(std::make_unique<PatchesFile>(path));
    PatchesFile& file = *parts.files.back();
    parts.inputs.push_back(
        {"patches", std::filesystem::path(path).filename().string(), file.rest().header.content_hash});
    if (parts.files.size() == 1)
      parts.rest = file.rest();
    else
      add_part(parts.rest, file.rest(), paths[0], path);
  }
  parts.patches = patches_of(parts.files);
  if (paths.size() > 1) parts.rest.is_complete = find_missing_faces(parts.rest, parts.patches).empty();
  return parts;
}

void require_complete(const MergeParts& parts, const MergeStageOptions& options) {
  const PatchesArtifact& rest = parts.rest;
  if (rest.is_complete || options.allow_incomplete) return;
  const std::vector<FaceId> missing = find_missing_faces(rest, parts.patches);
  const auto hole =
      std::find_if(rest.failures.begin(), rest.failures.end(), [](const FaceFailure& f) { return !f.is_closed; });
  const std::string cause =
      hole == rest.failures.end() ? "" : fmt::format(" (face {}: {})", hole->face + 1, hole->cause);
  throw Error(
      ExitCode::kIncomplete,
      fmt::format("{}: incomplete, {} no complete mesh{}{}{}; mesh them, or merge the rest with --allow-incomplete",
                  options.patches[0], counted(missing.size(), "face has", "faces have"), missing.empty() ? "" : ": ",
                  list_faces(missing), cause));
}

/// Without triangles, and of nodes those on boundaries.
MeshArtifact make_artifact(MergeParts& parts, const MergeStageOptions& options, const MergeOrder& order) {
  MeshArtifact artifact;
  artifact.header.schema = "mesh";
  artifact.header.tool = "st-merge";
  artifact.header.tool_version = ST_VERSION;
  artifact.header.options_json = json_text(nlohmann::json{{"allow_incomplete", options.allow_incomplete}});
  artifact.header.unit = parts.rest.header.unit;
  artifact.header.unit_in_m = parts.rest.header.unit_in_m;
  artifact.header.geometry_hash = parts.rest.header.geometry_hash;
  artifact.header.inputs = std::move(parts.inputs);
  artifact.is_complete = parts.rest.is_complete;
  artifact.mesh = order.boundary;
  artifact.mesh.labels = parts.rest.labels;
  artifact.mesh.merged = parts.rest.merged;
  add_segments(artifact.mesh, parts.rest.edges, parts.rest.edge_vertices);
  return artifact;
}

StageSummary summarize(const MergeStageOptions& options, const MeshColumns& mesh, const MergeOrder& order,
                       const std::string& hash, bool is_complete, double seconds) {
  const MergedFacts& facts = order.facts;
  const OrientationReport& orientation = order.orientation;
  const nlohmann::json json{{"output", options.output},
                            {"hash", hash},
                            {"triangles", mesh.n_triangles()},
                            {"nodes", mesh.n_nodes()},
                            {"components", facts.n_components},
                            {"closed", facts.is_closed()},
                            {"complete", is_complete},
                            {"boundary_edges", facts.n_boundary_edges},
                            {"nonmanifold_edges", facts.n_nonmanifold_edges},
                            {"misoriented_edges", facts.n_misoriented_edges},
                            {"turned_faces", orientation.turned_faces.size()},
                            {"turned_parts", orientation.turned_components},
                            {"one_sided_parts", orientation.n_one_sided},
                            {"area", facts.area},
                            {"volume", facts.volume},
                            {"seconds", seconds},
                            {"processor_seconds", processor_json()}};
  const std::string state = facts.is_closed() ? "closed"
                                              : fmt::format("{} open and {} non-manifold edges", facts.n_boundary_edges,
                                                            facts.n_nonmanifold_edges);
  return {fmt::format("{}: {} triangles, {} nodes, {}{}, {:.1f} s", options.output, mesh.n_triangles(), mesh.n_nodes(),
                      state, is_complete ? "" : ", INCOMPLETE", seconds),
          json_text(json), ExitCode::kOk};
}

}  // namespace

void require_merge_outputs(const MergeStageOptions& options) {
  if (has_export_suffix(options.output))
    throw Error(ExitCode::kUsage, options.output +
                                      ": is the name of an exported file, and here the mesh artifact goes; "
                                      "give it to --export, and name the artifact .hdf");
  require_writable(options.output);
  for (const std::string& path : options.exports) {
    require_export_format(path, {});
    require_writable(path);
    require_derived_outputs(files_beside(path, {}));
  }
}

StageSummary run_merge(const MergeStageOptions& options) {
  const Timer timer;
  require_merge_outputs(options);
  Progress progress("merging", 1);
  progress.step("reading", 0);
  MergeParts parts = open_parts(options.patches);
  require_complete(parts, options);
  progress.step("nodes", 0.2);
  const MergeInput input{
      parts.rest.edges, parts.rest.vertex_xyz, parts.rest.edge_vertices, {}, parts.rest.labels.face_group};
  const MergeOrder order = find_merge_order(input, source_of(parts.patches));
  warn_of_changes(order.orientation);

  progress.step("writing", 0.5);
  const MeshArtifact artifact = make_artifact(parts, options, order);
  std::optional<CadPlaces> cad;
  if (!parts.rest.composites.empty())
    cad.emplace(parts.rest.composites, static_cast<FaceId>(parts.rest.labels.face_name.size()));
  const MeshColumns columns = merged_columns(parts.patches, input, order, cad ? &*cad : nullptr);
  const std::string hash = write_mesh(options.output, artifact, columns);
  if (!options.exports.empty()) {
    const SurfaceMesh mesh = read_mesh(options.output).mesh;
    for (const std::string& path : options.exports) export_and_warn(path, {mesh, all_triangles(mesh), {}}, {});
  }
  return summarize(options, columns, order, hash, artifact.is_complete, timer.seconds());
}

}  // namespace st
