// A share of a mesh artifact, for ranks that need not know all of it.
#pragma once

#include <string>
#include <vector>

#include "io/hdf5/artifact.h"

namespace st {

/// All nodes on vertices and edges, and a consecutive share of the triangles with the nodes inside faces that they use.
struct MeshPart {
  MeshArtifact artifact;            ///< nodes renumbered, in canonical order
  TriangleId first_triangle = 0;    ///< number in the whole mesh of triangle 0
  std::vector<NodeId> node_number;  ///< [n_nodes] in the whole mesh, ascending
};

/// Share `part` of `n_parts` shares of about equal numbers of triangles. Reads no more than this: checksums stay
/// unverified, ids of nodes are checked. Throws Error(kInput). Local.
MeshPart read_mesh_part(const std::string& path, int part, int n_parts);

}  // namespace st
