// A hole's boundary in (u,v), and what fills it.
#pragma once

#include <vector>

#include "meshing/face/face_mesher.h"
#include "meshing/face/face_tiles.h"
#include "meshing/face/seam_mesh.h"
#include "meshing/hole/hole_curves.h"
#include "meshing/hole/hole_rim.h"

namespace st {

/// Numbers of the nodes that holes are made of: those of BoundaryNumbering for the new edges, then the inner nodes of
/// the old mesh.
struct HoleNumbering {
  /// Of `mesh` only the nodes on vertices and edges are used: a mesh cut off after these will do.
  HoleNumbering(const HoleMesh& mesh, const EdgeUpdate& update);
  /// kNone: replaced on its edge.
  std::int32_t number(NodeId n) const {
    return n < mesh.inner_begin[0] ? of_node[n] : first_inner + n - mesh.inner_begin[0];
  }
  bool is_inner(std::int32_t id) const { return id >= first_inner; }

  const HoleMesh& mesh;
  const EdgeUpdate& update;
  BoundaryNumbering boundary;
  std::int32_t first_inner;
  std::vector<std::int32_t> of_node;  ///< [nodes on vertices and edges]
};

/// Boundary of a hole: its sides to triangles that stay, and the new nodes on CAD edges. Seams appear twice, poles get
/// their segments; nothing is ordered, segments count by parity. A whole face has the loops of make_face_boundary.
/// Throws Error(kInternal) when marks and runs do not fit. Of `marks` the segments are used.
FaceBoundary make_hole_boundary(const Model& model, const Surface& surface, const HoleRim& rim, const HoleMarks& marks,
                                const HoleNumbering& numbering, const SizeField& field);

/// Where the nodes of such a boundary lie: on their edges, or in a run of inner nodes along it. Those where runs and
/// edges meet are like vertices.
std::vector<BoundaryPlace> hole_places(const FaceBoundary& boundary, const HoleNumbering& numbering);

/// What fills the hole, with the nodes of its boundary, by id of HoleNumbering. Oriented as the old mesh. `mesh`:
/// mesh_face of `boundary`.
Piece make_hole_fill(const HoleRim& rim, const FaceBoundary& boundary, FaceMesh mesh);

}  // namespace st
