// Edges that take their nodes from those on the other side of a narrow face.
#pragma once

#include <functional>
#include <vector>

#include "geometry/model/model.h"
#include "mesh/edge_mesh.h"
#include "meshing/topology/mesh_topology.h"
#include "sizing/size_field.h"

namespace st {

/// An edge along one side of a narrow face, and what lies along the other side.
struct FacingEdges {
  struct Leader {
    EdgeId edge = kNone;
    bool is_opposed = false;  ///< it runs against the one that follows
  };
  EdgeId edge = kNone;          ///< it follows
  std::vector<Leader> leaders;  ///< end to end, in its direction; they follow none
  double width = 0;             ///< of the face on the mean, model unit
};

/// An edge follows once at most. Not those of closed strips. The narrowest first; `has_rows`: sizes may be stretched,
/// and edges lead across several faces, by the faces' order. Local.
std::vector<FacingEdges> find_facing_edges(const MeshTopology& topology, bool has_rows);

/// Nodes of the edge that follows: those across from its leaders' nodes (`nodes_of`), or its own (`own`) where they
/// need not face each other. They do where sizes are stretched along both, in rows, and where chords of one side leave
/// their curve by a good part of the width: they would cross those of the other side. Pure.
EdgeMesh facing_nodes(const Model& model, const SizeField& field, const FacingEdges& facing, const EdgeMesh& own,
                      const std::function<EdgeMesh(EdgeId)>& nodes_of);

}  // namespace st
