// Edges of a triangulation and their triangles, and connected components: plain arrays in a fixed order.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/disjoint_sets.h"
#include "base/ids.h"
#include "mesh/surface_mesh.h"

namespace st {

inline bool has_repeated_node(const Triangle& t) { return t.n[0] == t.n[1] || t.n[1] == t.n[2] || t.n[2] == t.n[0]; }

/// Side k of triangle t as one number, 3 t + k: it runs from node n[k] to node n[(k+1) % 3].
using SideId = std::int32_t;

/// All sides of a triangulation sorted by (lower node, higher node, side): equal node pairs are the uses of one mesh
/// edge. Triangles with a repeated node have no sides here. 24 bytes per triangle and 4 per node.
class EdgeTable {
 public:
  /// Precondition: node ids in [0, n_nodes). Throws Error(kUsage) beyond kMaxTriangles. Linear time but for the log of
  /// the valence.
  EdgeTable(std::span<const Triangle> triangles, std::int64_t n_nodes);

  /// Calls visit(lower node, higher node, sides) once per mesh edge, ascending; `sides`: span of SideId, ascending.
  template <class Visit>
  void for_each_edge(const Visit& visit) const {
    for_each_edge(0, n_nodes(), visit);
  }
  /// The same for the edges whose lower node is in [begin, end).
  template <class Visit>
  void for_each_edge(NodeId begin, NodeId end_of_low, const Visit& visit) const {
    for (NodeId low = begin; low < end_of_low; ++low)
      for (std::int32_t i = offsets_[low], end; i < offsets_[low + 1]; i = end) {
        for (end = i + 1; end < offsets_[low + 1] && high_[end] == high_[i];) ++end;
        visit(low, high_[i], std::span<const SideId>(side_).subspan(i, end - i));
      }
  }
  NodeId n_nodes() const { return static_cast<NodeId>(offsets_.size()) - 1; }

 private:
  void sort_buckets(std::size_t first, std::size_t last);

  std::vector<std::int32_t> offsets_;  ///< [n_nodes+1] into high_ and side_
  std::vector<NodeId> high_;           ///< [3 n_triangles]
  std::vector<SideId> side_;           ///< [3 n_triangles]
};

inline EdgeTable edges_of(const SurfaceMesh& mesh) { return {mesh.triangles, mesh.n_nodes()}; }

inline NodeId side_start(std::span<const Triangle> triangles, SideId side) { return triangles[side / 3].n[side % 3]; }
/// True when the two sides run the same way: their triangles are not oriented alike.
inline bool run_alike(std::span<const Triangle> triangles, SideId a, SideId b) {
  return side_start(triangles, a) == side_start(triangles, b);
}

/// [3 n_triangles] the lowest corner, 3 t + k as a side, of the fan that each corner is in: triangles around a node
/// that edges join, those of several or of different orientation, too. `edges`: of these triangles.
std::vector<SideId> find_fans(std::span<const Triangle> triangles, const EdgeTable& edges);

/// Finds connected components of a mesh whose triangles come in pieces.
class ComponentFinder {
 public:
  explicit ComponentFinder(std::int64_t n_nodes) : sets_(n_nodes), component_(n_nodes, kNone) {}
  void add(std::span<const Triangle> triangles);
  /// As node_components(), of all that came. Once.
  std::vector<std::int32_t> components(std::int32_t& n_components);

 private:
  DisjointSets sets_;
  std::vector<std::int32_t> component_;
};

/// Connected component of each node, kNone for nodes without a triangle; triangles connect their nodes. Components are
/// numbered by their lowest node. `n_components` is set.
std::vector<std::int32_t> node_components(std::span<const Triangle> triangles, std::int64_t n_nodes,
                                          std::int32_t& n_components);

}  // namespace st
