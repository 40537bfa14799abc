// A foreign triangulation associated to a CAD model: which node lies on which vertex, edge or face.
#pragma once

#include <optional>
#include <vector>

#include "geometry/model/model.h"
#include "mesh/surface_mesh.h"

namespace st {

struct AssociationOptions {
  std::optional<double> tolerance;  ///< model unit, > 0: how far nodes may lie from the CAD; nullopt: 5 % of the
                                    ///< shortest mesh edge at the node, at least a millionth of the model's diagonal,
                                    ///< and the CAD's own tolerance on top
};

/// What the association found. Ids 0-based.
struct AssociationReport {
  double max_distance = 0;  ///< of a node from its vertex, edge or face, model unit
  Vec3 max_place;
  std::int64_t n_nodes[3] = {0, 0, 0};       ///< on vertices, on edges, in faces
  std::vector<std::int64_t> face_triangles;  ///< [n_faces]
  std::int64_t n_turned = 0;                 ///< triangles turned to agree with the others of their face
  std::int64_t n_unused = 0;                 ///< nodes without a triangle, left out
};

struct AssociatedMesh {
  SurfaceMesh mesh;               ///< canonical (see SurfaceMesh), coordinates to the bit as given; node_size as given
  std::vector<NodeId> file_node;  ///< [n_nodes] node of the foreign mesh
  std::vector<TriangleId> file_triangle;  ///< [n_triangles] likewise
  AssociationReport report;
};

/// Vertices take the nearest node, edges the chain of mesh edges that follows their curve, faces the triangles between
/// the chains; nodes are projected to find their parameters. Faces and groups of `foreign` are not looked at. Short CAD
/// edges whose vertices share a node are merged features of the result. Throws Error(kMismatch), with numbers and the
/// first places, when the bounding boxes differ so much that the unit or the model is another one, when triangles leave
/// a hole where the model is closed or meet in threes, when no chain of mesh edges follows an edge, or when nodes lie
/// on no face. Local, about linear.
AssociatedMesh associate_mesh(const SurfaceMesh& foreign, const Model& model, const AssociationOptions& options);

}  // namespace st
