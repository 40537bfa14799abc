// A heavy face cut into tiles that are meshed one by one.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "meshing/face/face_boundary.h"
#include "meshing/face/face_mesher.h"

namespace st {

/// Where a boundary node lies on its edge.
struct BoundaryPlace {
  std::int32_t index = 0;   ///< on the edge; the same for both uses of a seam
  std::int32_t to_end = 0;  ///< nodes to the nearer end of the edge; 0: a vertex
  bool is_rough = false;    ///< on no edge, but on the sides of triangles that stay
};

/// The place of the node with this number of `numbering`.
BoundaryPlace place_on_edge(std::int32_t id, const BoundaryNumbering& numbering);
/// The places of all nodes of a face's boundary.
std::vector<BoundaryPlace> boundary_places(const FaceBoundary& boundary, const BoundaryNumbering& numbering);

/// Boundary of a tile, its interior on the left. Nodes: boundary node i of the face as i, cut node j as
/// n_boundary + j.
struct Tile {
  std::vector<std::array<std::int32_t, 2>> segments;
  double weight = 0;  ///< expected triangles

  static auto fields(auto& x) { return std::tie(x.segments, x.weight); }
};

/// How a face is cut: by its boundary and the sizes alone.
struct TileCut {
  std::vector<FaceNode> nodes;       ///< on the cuts, with ids beyond those of the boundary
  std::vector<Tile> tiles;           ///< empty: the face stays whole
  std::int32_t n_boundary = 0;       ///< nodes on the boundary of the face
  std::vector<std::int32_t> shared;  ///< of these, ascending: those that several tiles have

  std::vector<std::int32_t> number;  ///< [n_boundary] of their ids among these, ascending, once each

  static auto fields(auto& x) { return std::tie(x.nodes, x.tiles, x.n_boundary, x.shared, x.number); }
};

/// Whether edges may be longer along a direction, at a node of the loops or a place inside: such a face stays whole, as
/// rows would end at cuts. Local, pure.
bool has_long_edges(const Surface& surface, const FaceBoundary& boundary, const SizeField& field);

/// Cuts a face along edges of a coarse mesh of itself into tiles of about `tile_triangles` triangles (Chen, Zhao, Zheng
/// et al., Proc. 22nd International Meshing Roundtable, 2013, cut a background mesh likewise). `places`: of the
/// boundary's nodes. `make_surface`: see improve_seams(). Local, pure. Cost: the coarse mesh, 24 to 96 triangles per
/// tile.
TileCut cut_face(const Surface& surface, const SurfaceMaker& make_surface, const FaceBoundary& boundary,
                 std::span<const BoundaryPlace> places, const SizeField& field, double tile_triangles);

/// Its nodes, ascending: the numbers of those of its boundary are their places here.
std::vector<std::int32_t> nodes_of(const Tile& tile);

/// What mesh_face() needs of one tile.
FaceBoundary tile_boundary(const FaceBoundary& boundary, const TileCut& cut, const Tile& tile);

}  // namespace st
