#include "meshing/engine/mesh_regions.h"

#include <algorithm>
#include <utility>

#include "base/share.h"
#include "mesh/merge.h"
#include "meshing/engine/face_rounds.h"
#include "meshing/engine/hole_rounds.h"
#include "meshing/topology/small_features.h"

namespace st {
namespace {

/// Collective. Adds to the counts and times of the result.
void run_faces(const Model& model, const MeshTopology& topology, const SizeField& field, MeshPlan plan,
               const MeshOptions& options, const Executor& executor, MeshResult& result) {
  FaceRounds rounds(model, topology, field, std::move(plan), options, executor, result);
  rounds.run();
  rounds.report(options.patches);
}

/// Nodes of edges that were done again keep no number but those at the ends.
void carry_previous(const EdgeMesh& before, EdgeMesh& after) {
  after.node_previous.assign(after.node_t.size(), kNone);
  for (EdgeId e = 0; e < after.n_edges(); ++e) {
    const std::int32_t a = before.first_node(e), n = before.n_nodes(e), b = after.first_node(e), m = after.n_nodes(e);
    if (n == 0 || m == 0) continue;
    const bool is_same =
        n == m && std::equal(before.node_t.begin() + a, before.node_t.begin() + a + n, after.node_t.begin() + b);
    for (std::int32_t i = 0; is_same && i < n; ++i) after.node_previous[b + i] = before.node_previous[a + i];
    after.node_previous[b] = before.node_previous[a];
    after.node_previous[b + m - 1] = before.node_previous[a + n - 1];
  }
}

/// Collective. Faces whose holes could not be filled, as wholes.
void mesh_failed_faces(const HoleMarker& holes, HoleRounds& rounds, const SizeField& field, const MeshOptions& options,
                       const Executor& executor, MeshResult& result) {
  const EdgeMesh before = result.edges;
  std::vector<FacePatch> patches;
  if (executor.is_root()) patches = rounds.take_patches();
  run_faces(
      holes.model(), holes.mesh().topology, field,
      plan_again(holes.mesh().topology, rounds.failed_faces(), before, std::move(patches), rounds.edges_to_keep()),
      options, executor, result);
  carry_previous(before, result.edges);
  for (FacePatch& p : result.patches) {
    p.inner_previous.resize(p.inner_xyz.size(), kNone);
    p.triangle_previous.resize(p.triangles.size(), kNone);
  }
  store_requests(field, result);
}

SurfaceMesh merge_result(const ModelTables& t, const MeshResult& result) {
  std::vector<FacePatch> patches = result.patches;
  std::erase_if(patches, [](const FacePatch& p) { return p.triangles.empty(); });
  OrientationReport report;
  return merge_patches({result.edges, t.vertex_xyz, t.edge_vertices, patches, t.labels.face_group}, report);
}

}  // namespace

MeshTopology merge_small_features(const Model& model, const SizeField& field, double below, const Executor& executor,
                                  const std::vector<Strip>* strips) {
  MergedFeatures merged;
  if (executor.is_root()) merged = find_merged_features(model, field, below, strips);
  share(executor, merged);
  return MeshTopology(model.tables(), std::move(merged));
}

MeshResult mesh_regions(const Model& model, const MeshTopology& topology, const SizeField& field, MeshPlan plan,
                        const MeshOptions& options, const Executor& executor) {
  MeshResult result;
  run_faces(model, topology, field, std::move(plan), options, executor, result);
  if (!options.stores_requests) return result;
  executor.begin_phase("requests");
  if (executor.is_root() || options.patches == PatchesGo::kNowhere) store_requests(field, result);
  return result;
}

MeshResult mesh_regions(HoleMarker& holes, const SizeField& field, HoleOutput output, const MeshOptions& options,
                        const Executor& executor) {
  MeshResult result;
  HoleRounds rounds(holes, field, options, executor, result);
  rounds.run();
  if (!rounds.failed_faces().empty()) {
    mesh_failed_faces(holes, rounds, field, options, executor, result);
    if (executor.is_root() && output == HoleOutput::kMesh) result.mesh = merge_result(holes.mesh().tables, result);
  } else if (executor.is_root() && output == HoleOutput::kPatches) {
    result.patches = rounds.take_patches();
    result.mesh = {};
    if (result.edges.node_request == result.edges.node_size) result.edges.node_request.clear();
  }
  return result;
}

}  // namespace st
