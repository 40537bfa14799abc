// (u,v) for the triangles of one face of an associated mesh.
#pragma once

#include <utility>
#include <vector>

#include "meshing/associate/edge_chains.h"

namespace st {

/// What find_face_parameters() needs to know.
struct AssociationView {
  const SurfaceMesh& mesh;  ///< triangles of a face oriented alike
  const MeshEdges& edges;
  const EdgeChains& chains;
  const ChainSegments& segments;
  const Model& model;
  const NodeTolerance& tolerance;
};

/// Sets corner_uv ([3*n_triangles] of the whole mesh) of the triangles of one face (ascending): on edges by the
/// trimming curves, on seams by that of the side on which the triangle lies, at poles on the pole's side nearest to the
/// triangle, inside by projection from neighbour to neighbour. Appends each inner node with its distance from the
/// surface. Local, about linear.
void find_face_parameters(const AssociationView& view, FaceId face, const std::vector<TriangleId>& triangles,
                          std::vector<Vec2>& corner_uv, std::vector<std::pair<NodeId, double>>& distances);

}  // namespace st
