// A symmetric mesh: one half is meshed, the other is its image.
#pragma once

#include <vector>

#include "geometry/model/mirror.h"
#include "meshing/engine/mesh_result.h"
#include "meshing/topology/mesh_topology.h"

namespace st {

/// The faces that are meshed: those of the kept half, and in the plane. Ascending.
std::vector<FaceId> faces_to_mesh(const Mirror& mirror);

/// The merged features of the kept half and their images. What touches the plane stays as it is: nodes in the plane
/// are to stay there.
MergedFeatures mirrored(const MergedFeatures& merged, const Mirror& mirror, const ModelTables& tables);

/// Local, on rank 0, where all patches are. Gives `result`, in which faces_to_mesh() are meshed, the rest: nodes at the
/// image to the last bit (where the plane is at 0, else as far as 2 * value - x is rounded), with the same parameters
/// on their own edges and faces, triangles turned over. Nodes on what lies in the plane move into it. Returns `tables`
/// with the vertices where their nodes are. `tables`: the model's, of `topology` before merging.
ModelTables add_image(const Mirror& mirror, const ModelTables& tables, const MeshTopology& topology,
                      MeshResult& result);

}  // namespace st
