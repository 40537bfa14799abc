// Meshes the regions of a model on all ranks: whole faces for st-mesh, the holes of a mesh for st-remesh.
#pragma once

#include "base/executor.h"
#include "features/strip.h"
#include "geometry/model/model.h"
#include "meshing/engine/hole_marker.h"
#include "meshing/engine/mesh_plan.h"
#include "meshing/engine/mesh_result.h"

namespace st {

/// Collective. The topology with edges and strips merged that are far smaller than the sizes, see
/// find_merged_features(). Rank 0 decides.
MeshTopology merge_small_features(const Model& model, const SizeField& field, double below, const Executor& executor,
                                  const std::vector<Strip>* strips = nullptr);

/// Collective. The edges and faces of the plan.
MeshResult mesh_regions(const Model& model, const MeshTopology& topology, const SizeField& field, MeshPlan plan,
                        const MeshOptions& options, const Executor& executor);

/// What the holes of a mesh are filled for.
enum class HoleOutput {
  kMesh,    ///< MeshResult::mesh, as st-merge would make it
  kPatches  ///< MeshResult::patches
};

/// Collective. The holes that are marked; faces whose holes cannot be filled are meshed as wholes, on the nodes that
/// other faces share. Nodes and triangles that stay have their numbers in the mesh before.
MeshResult mesh_regions(HoleMarker& holes, const SizeField& field, HoleOutput output, const MeshOptions& options,
                        const Executor& executor);

}  // namespace st
