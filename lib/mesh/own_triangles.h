// Which triangles of a mesh are looked at: all, or a share of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "mesh/surface_mesh.h"

namespace st {

/// Triangles whose sums are added up at a time: by a piece of the whole mesh, so that neither threads nor shares show.
inline constexpr std::size_t kTrianglesPerPiece = 4096;

/// A share of a mesh has own triangles [begin, end), and around them all others that have a node in common with these:
/// an edge or a node is looked at in the share that owns the first of its triangles. Triangles and nodes have the order
/// of the whole mesh.
struct OwnTriangles {
  TriangleId begin = 0, end = 0;
  TriangleId first = 0;                      ///< number of `begin` in the whole mesh: where a piece begins
  std::span<const NodeId> node_number = {};  ///< [n_nodes] in the whole mesh, ascending; empty: as here

  static OwnTriangles all(const SurfaceMesh& mesh) { return {0, static_cast<TriangleId>(mesh.n_triangles())}; }
  bool is_all(const SurfaceMesh& mesh) const { return begin == 0 && end == mesh.n_triangles() && node_number.empty(); }
  bool has(TriangleId t) const { return t >= begin && t < end; }
  /// Whether side 3 t + k is one of an own triangle.
  bool has_side(std::int32_t side) const { return side >= 3 * begin && side < 3 * end; }
  std::size_t size() const { return static_cast<std::size_t>(end - begin); }
  std::size_t n_pieces() const { return (size() + kTrianglesPerPiece - 1) / kTrianglesPerPiece; }
  /// Of an own triangle: its piece among those of the share.
  std::size_t piece(TriangleId t) const { return static_cast<std::size_t>(t - begin) / kTrianglesPerPiece; }
  TriangleId number(TriangleId own) const { return own - begin + first; }
  NodeId node(NodeId n) const { return node_number.empty() ? n : node_number[n]; }
  /// Of the edge between two nodes among all edges.
  std::int64_t order(NodeId low, NodeId high) const { return std::int64_t{node(low)} << 32 | node(high); }
};

}  // namespace st
