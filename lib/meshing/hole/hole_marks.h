// Which triangles and segments no longer respect the sizes (the analysis of a remeshing).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "meshing/hole/hole_mesh.h"
#include "meshing/hole/side_requests.h"
#include "meshing/topology/periodic_pairs.h"

namespace st {

struct HoleMarkOptions {
  double too_long = 1.4;   ///< times the requested length, > 1
  double too_short = 0.7;  ///< likewise, in (0, 1)
  double change = 0.1;     ///< relative: where the request changed by less, edges are good whatever their length
  int layers = 2;          ///< triangles around a marked one that are marked with it, >= 1
  std::vector<char> keep_face = {};        ///< [n_faces] 1: nothing of it changes; empty: none
  std::vector<char> keep_edge = {};        ///< [n_edges] 1: its segments stay; empty: none
  std::span<const Vec3> earlier_xyz = {};  ///< empty, or [n_nodes] before the geometry moved: edges that it made longer
                                           ///< or shorter count, too
  std::vector<Vec3> squeeze = {};          ///< empty, or [n_nodes] of stretched sizes, see base/local_size.h
  const SideRequests* metrics = nullptr;   ///< of sizes that are metrics in space, by which edges are judged along
                                           ///< themselves; null: they are none
  std::vector<double> most_along = {};     ///< [n_nodes] of metrics: longest request in any direction
  bool was_stretched = false;              ///< the mesh was made for stretched sizes, or these are
  std::vector<char> becomes_stretched = {};  ///< empty, or [n_faces] 1: these are, and the face's mesh was not
  const PeriodicPairs* pairs = nullptr;      ///< segments of edges that are images of one another go together; null:
                                             ///< there are none
  std::vector<TriangleId> redo = {};         ///< marked whatever their edges, unless kept
  bool only_redo = false;                    ///< lengths do not count: what is not in `redo` or near it stays
};

/// 1: to be redone.
struct HoleMarks {
  std::vector<char> triangle;  ///< [n_triangles]
  std::vector<char> segment;   ///< [edges.node_t] by CadSegment::index; all triangles that touch an inner node of a run
                               ///< of these are marked
  std::int64_t n_triangles() const;
};

/// The part of the whole mesh that a rank has, and the part of that which it marks. A rank's mesh has all nodes on
/// vertices and edges, and a consecutive share of the triangles with their nodes, by their order in the whole mesh.
struct MeshShare {
  TriangleId begin = 0, end = 0;         ///< triangles of the rank's mesh that it marks
  TriangleId first_triangle = 0;         ///< number in the whole mesh of the rank's triangle 0
  std::vector<NodeId> node_number = {};  ///< of the rank's nodes in the whole mesh, ascending; empty: they are the same
};

/// A node of the whole mesh that a marked triangle of `face` touches.
struct TouchedNode {
  FaceId face;
  NodeId node;
};

/// Where faces lie on several ranks. Collective: what every rank's triangles touch goes in, what all of them touch
/// comes out.
using NodeExchange = std::function<std::vector<TouchedNode>(const std::vector<TouchedNode>& own)>;

/// An edge is marked when its length is out of bounds for `wanted` ([n_nodes], > 0) where that differs from the size
/// stored with the mesh; with it its triangles, and `layers` around them within their face (over a CAD edge where its
/// segments are marked); segments between marked ones and triangles with marked ones at all corners follow. On several
/// ranks, each with its share: together they mark what one would. Of the triangles only those of the share are marked,
/// of `wanted` only the values on their nodes and on all edges are used; segments are marked on every rank.
/// `options.redo` numbers the whole mesh's triangles. Calls `exchange` layers + 1 times. Pure but for that.
HoleMarks mark_share(const HoleMesh& mesh, const MeshShare& share, std::span<const double> wanted,
                     const HoleMarkOptions& options, const NodeExchange& exchange);

/// Grows a hole within its face by `layers`; segments stay. `hole`: its triangles.
void grow_hole(const HoleMesh& mesh, FaceId face, std::span<const TriangleId> hole, int layers, HoleMarks& marks);

}  // namespace st
