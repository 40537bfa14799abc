// The patches of a model as one mesh, to be looked at as a whole.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/crossing.h"
#include "meshing/engine/model_mesher.h"

namespace st {

/// All patches as one mesh by global node ids, the triangles by face.
struct JoinedPatches {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> face_begin;  ///< [n_faces+1]
  std::int32_t n_boundary = 0;           ///< nodes on vertices and edges; those inside faces follow
  FaceId face_of(TriangleId t) const;
  /// Half the triangle's longest side, at its centre; half its shortest where it spans the face from boundary to
  /// boundary.
  RefinementPoint refinement_of(TriangleId t) const;
};

/// Nodes on vertices and edges are those of `numbering`; `patches` [n_faces] by face, empty ones allowed.
JoinedPatches join_patches(const BoundaryNumbering& numbering, const std::vector<FacePatch>& patches);

/// Pairs of triangles of two faces about one chord: an edge between the same two nodes on boundaries inside both faces,
/// sorted, at least one face fresh. Two faces along common edges, too flat for a node inside, lie on each other there.
std::vector<TrianglePair> find_repeated_chords(const BoundaryNumbering& numbering, const JoinedPatches& mesh,
                                               std::span<const char> face_is_fresh);

}  // namespace st
