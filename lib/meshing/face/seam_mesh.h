// The tiles of a face without the triangles about the cuts, and these on their own: whoever enhances the cuts does not
// need the tiles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "mesh/surface_mesh.h"
#include "meshing/face/face_tiles.h"
#include "meshing/face/tile_seams.h"

namespace st {

/// Some triangles of a face. Of what is about cuts, boundary node i of the face is corner i, cut node j is n_boundary +
/// j, and inner node k is n_boundary + n_cut + k. A section, what is left of a tile, has a boundary of its own; so has
/// what fills a hole.
struct Piece {
  FaceMesh mesh;                                   ///< inner: its own nodes, then those of sections
  std::vector<InnerNode> owner;                    ///< of the latter, which stay there
  std::vector<std::array<std::int32_t, 2>> sides;  ///< about cuts, ids of the ends, the smaller first: each use of an
                                                   ///< edge between boundary nodes by triangles that are in no band
                                                   ///< any more

  // of what has a boundary of its own
  std::vector<FaceNode> boundary;  ///< its nodes on the boundary of the face
  // of a section
  std::vector<std::int32_t> number;           ///< of each among the nodes of the face's boundary
  std::vector<std::int32_t> boundary_number;  ///< of their ids, ascending, once each, among all of the face's boundary

  std::int32_t n_own() const { return static_cast<std::int32_t>(mesh.inner.size() - owner.size()); }
  static auto fields(auto& x) { return std::tie(x.mesh, x.owner, x.sides, x.boundary, x.number, x.boundary_number); }
};

/// What a section keeps, and what it gives away.
struct SplitPiece {
  Piece rest;  ///< the section
  Piece band;  ///< what is within some layers of the cuts; with the cause, the refinement and the folds of both

  static auto fields(auto& x) { return std::tie(x.rest, x.band); }
};

/// Takes the band off the mesh of a tile. Local, pure. The cost is linear.
SplitPiece split_tile(const FaceBoundary& boundary, const TileCut& cut, std::int32_t tile, FaceMesh mesh);

/// What does the enhancing.
struct SeamMaker {
  const Surface& surface;
  const SurfaceMaker& make_surface;  ///< see improve_seams()
  const FaceBoundary& boundary;
  const TileCut& cut;
  const SizeField& field;
  const FaceMeshOptions& options;

  /// The bands of all tiles as one mesh, improved: see improve_seams(). Its corners are on no cut: inner node k is
  /// n_boundary + k. Its cause is that of the first tile that failed, or tells that they do not fit; its folds are
  /// those of all. Local, pure.
  Piece run(std::vector<Piece> bands) const;
};

/// The mesh of the whole face from its sections and the seams of the face: section by section, the seams last.
FaceMesh join_sections(std::int32_t n_boundary, std::vector<Piece> sections, Piece seams);

}  // namespace st
