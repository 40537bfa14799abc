// Holes of one face: their boundary in (u,v), and the face's patch once they are filled.
#pragma once

#include <string>
#include <vector>

#include "meshing/face_mesher.h"
#include "meshing/hole_curves.h"

namespace st {

/// Numbers of the nodes that holes are made of: those of BoundaryNumbering for the new edges, then the inner nodes of the old mesh.
struct HoleNumbering {
  HoleNumbering(const HoleMesh& mesh, const EdgeUpdate& update);
  std::int32_t inner(NodeId n) const { return first_inner + n - mesh.inner_begin[0]; }
  bool is_inner(std::int32_t id) const { return id >= first_inner; }
  NodeId mesh_node(std::int32_t inner_id) const { return inner_id - first_inner + mesh.inner_begin[0]; }

  const HoleMesh& mesh;
  const EdgeUpdate& update;
  BoundaryNumbering boundary;
  std::int32_t first_inner;
  std::vector<std::int32_t> of_node;  ///< [n_nodes of the mesh] its number; kNone: replaced on its edge
};

/// Boundary of all holes of a face: sides between marked triangles and others, and the face's own loops with the new nodes. Seams appear
/// twice, poles get their segments; nothing is ordered, segments count by parity. A face without an unmarked triangle has the loops of
/// make_face_boundary. Throws Error(kInternal) when marks and runs do not fit.
FaceBoundary make_hole_boundary(const Model& model, const Surface& surface, FaceId face, const HoleMarks& marks,
                                const HoleNumbering& numbering, const SizeField& field);

/// The face's patch: unmarked triangles as they were, then those of `fill` (null: there is no hole).
FacePatch make_hole_patch(FaceId face, const HoleMarks& marks, const HoleNumbering& numbering, const FaceBoundary* boundary,
                          const FaceMesh* fill);

}  // namespace st
