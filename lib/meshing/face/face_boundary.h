// From the model's loops and the nodes on its edges to the boundary of one face in (u,v).
#pragma once

#include <string>

#include "geometry/model/model.h"
#include "mesh/surface_mesh.h"
#include "meshing/face/face_mesher.h"
#include "meshing/topology/mesh_topology.h"

namespace st {

/// Numbers of boundary nodes over the whole model, see boundary_id().
struct BoundaryNumbering {
  /// All references outlive the object.
  BoundaryNumbering(const MeshTopology& m, const EdgeMesh& e) : topology(m), tables(m.tables()), edges(e) {}
  /// All numbers are below.
  std::int32_t end() const { return tables.n_vertices() + static_cast<std::int32_t>(edges.node_t.size()); }
  std::int32_t vertex(VertexId v) const { return v; }
  /// Node `index` of an edge (0 and the last are its vertices); where a strip is closed, the node of its other edge at
  /// the same place.
  std::int32_t edge_node(EdgeId e, std::int32_t index) const;
  /// Is node `index` of the strip's kept edge also one of its closed edge?
  bool is_closed(const MeshTopology::Strip& strip, std::int32_t index) const;
  struct Entity {
    EntityDim dim;
    std::int32_t entity, index;  ///< vertex, 0 - or edge, node index on it
  };
  Entity entity(std::int32_t id) const;

  const MeshTopology& topology;
  const ModelTables& tables;  ///< of `topology`
  const EdgeMesh& edges;
};

/// Boundary of a face: junctions snapped to one (u,v), poles cut into nodes, seams twice; without nodes for a strip
/// that is closed all along. Throws Error(kGeometry) when a trimming curve is missing.
FaceBoundary make_face_boundary(const Model& model, const Surface& surface, FaceId face,
                                const BoundaryNumbering& numbering);

/// The loops by the nodes of their edges alone, (u,v) NaN: for a face whose trimming curves cannot be used.
FaceBoundary make_boundary_in_space(FaceId face, const BoundaryNumbering& numbering);

/// Segments that an edge needs whatever its length: 3 when it is a loop of its own, 2 when it is one of two, else 1.
std::vector<int> min_segments_per_edge(const ModelTables& tables);

}  // namespace st
