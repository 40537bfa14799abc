// Triangles of a mesh to the faces of a CAD model: the second half of an association.
#pragma once

#include <vector>

#include "meshing/associate/edge_chains.h"

namespace st {

/// Which triangle lies on which face, and where.
struct FaceRegions {
  std::vector<FaceId> face;                        ///< [n_triangles]
  std::vector<Vec2> corner_uv;                     ///< [3*n_triangles]
  std::vector<std::vector<TriangleId>> triangles;  ///< [n_faces] ascending
  double max_distance = 0;                         ///< of a node from its face, model unit
  Vec3 max_place;
};

/// Triangles agree in orientation across all mesh edges inside a region bounded by chains: turns those that do not, the
/// majority deciding. Returns how many were turned. Throws Error(kMismatch) naming places where triangles leave a hole,
/// or meet in threes, away from the chains, and where a one-sided region cannot be oriented.
std::int64_t orient_regions(SurfaceMesh& mesh, const MeshEdges& edges, const EdgeChains& chains,
                            const ChainSegments& segments);

/// Regions bounded by chains become faces by the edges around them, where that is not clear by distance; all nodes get
/// their (u,v), on seams and at poles one for each corner. Throws Error(kMismatch) when a region fits no face, a face
/// has no triangle, or nodes are too far from their face. Local, about linear.
FaceRegions find_face_regions(const SurfaceMesh& mesh, const MeshEdges& edges, const EdgeChains& chains,
                              const ChainSegments& segments, const Model& model, const NodeTolerance& tolerance);

}  // namespace st
