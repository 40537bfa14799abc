// Which edges and faces are to be meshed, and what stays.
#pragma once

#include <vector>

#include "mesh/surface_mesh.h"
#include "meshing/topology/mesh_topology.h"

namespace st {

struct MeshPlan {
  std::vector<EdgeId> edges;            ///< to be meshed, ascending; nothing else ever is
  std::vector<FaceId> faces;            ///< likewise
  EdgeMesh kept_edges;                  ///< nodes of the other edges, on every rank
  std::vector<FacePatch> kept_patches;  ///< [n_faces] on rank 0: those of the other faces stay; or empty
  std::vector<double> face_weight;      ///< [n_faces] integrals of 1/h^2; empty: not known, and no face is cut
};

/// All edges and faces.
MeshPlan plan_all(const MeshTopology& topology);

/// `faces` (ascending) and those of their edges that have no nodes in `fixed` (which may be empty): parts meshed apart
/// fit.
MeshPlan plan_part(const MeshTopology& topology, std::vector<FaceId> faces, EdgeMesh fixed);

/// `faces` again. Edges get new nodes where all their faces are among these, unless `keep_edge` has them ([n_edges] 1:
/// it stays; empty: none). `patches` [n_faces] on rank 0.
MeshPlan plan_again(const MeshTopology& topology, std::vector<FaceId> faces, EdgeMesh edges,
                    std::vector<FacePatch> patches, const std::vector<char>& keep_edge = {});

}  // namespace st
