// The planar triangulation that carries a face's mesh: nodes in the (scaled) parameter plane, triangles with
// neighbours, constrained edges.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "meshing/face/face_node.h"

namespace st {

/// A node of a face in the plane. Its `h` is the edge length to aim at: the request, limited by growth and turning.
/// What is asked of the nodes around another one comes first: it is in two lines of the cache.
struct alignas(64) MeshNode : FaceNode {
  bool is_kept = false;  ///< of a ring about a narrow part, or of a line at which rows begin: not to be collapsed
  bool is_laid = false;  ///< in a row: for mend_flaws() alone to be moved, and not by that where kept
  Vec2 p{};              ///< scaled parameter plane
  Vec3 normal{};         ///< unit normal du x dv; where that is singular, of a place a little inside
  double request = 0;    ///< edge length that the field requests
  Vec3 du{}, dv{};       ///< derivatives by the scaled parameters
  Vec3 squeeze{};        ///< of stretched sizes, in the tangent plane; see base/local_size.h
};
static_assert(sizeof(MeshNode) == 192);

/// Plane nodes of one pole: one point in space, no side between them.
inline bool are_one_pole(const MeshNode& a, const MeshNode& b) { return a.is_pole && b.is_pole && a.id == b.id; }

/// A triangle, counter-clockwise in the plane. Edge k runs from v[k] to v[(k+1)%3]; n[k] is the neighbour across it.
struct alignas(32) PlaneTriangle {
  std::int32_t v[3];
  std::int32_t n[3];
  std::uint8_t constrained = 0;  ///< bit k: edge k is a boundary segment
  std::uint8_t toggles = 0;      ///< bit k: crossing edge k changes between inside and outside
  std::uint8_t state = 0;        ///< TriangleState
  float quality = 0;             ///< for enhance(), which sets it
};
static_assert(sizeof(PlaneTriangle) == 32);

/// Retired: no node can be placed in it, though it is not small enough. Laid: of a row, and stays as it is.
enum TriangleState : std::uint8_t { kOutside = 0, kUnfinished = 1, kFinished = 2, kDead = 3, kRetired = 4, kLaid = 5 };

/// Symmetric metric E dx^2 + 2 F dx dy + G dy^2.
struct Metric {
  double e = 1, f = 0, g = 1;
  double length2(Vec2 d) const { return e * d.x * d.x + 2 * f * d.x * d.y + g * d.y * d.y; }
};

/// Two boundary segments that cross or touch, or a node on a segment: where (plane nodes).
struct LoopConflict {
  std::int32_t node_a, node_b;    ///< ends of the segment that could not be inserted
  std::int32_t other_a, other_b;  ///< ends of the one in its way; equal: a node on the segment
};

class Triangulation {
 public:
  std::vector<MeshNode> nodes;
  std::vector<PlaneTriangle> triangles;
  std::int32_t n_boundary = 0;  ///< nodes [0, n_boundary) are boundary nodes; the next four span a box around them;
                                ///< inner nodes follow

  /// Triangulates the boundary nodes (already in `nodes`; the four box nodes are appended) and forces `segments` (node
  /// pairs) as edges, then marks inside by parity. Returns the conflicts; the triangulation is usable only when there
  /// is none.
  std::vector<LoopConflict> build(const std::vector<std::pair<std::int32_t, std::int32_t>>& segments);

  /// Takes over a part of a mesh in place of build(): its nodes, the `n_fixed` of its rim first, and its triangles, as
  /// inside. Four unused nodes come between. Sides without a neighbour are constrained.
  void adopt(std::int32_t n_fixed, std::vector<MeshNode> part, const std::vector<std::array<std::int32_t, 3>>& corners);
  /// A side that must stay.
  void constrain(std::int32_t t, int k);
  /// Makes a-b an edge that must stay, by swaps; inside and outside remain as they are. False when a node or an edge
  /// that must stay is in its way.
  bool force_side(std::int32_t a, std::int32_t b);
  /// Is a-b an edge that must stay?
  bool is_fixed(std::int32_t a, std::int32_t b) const;
  /// An edge that had to stay need not. Precondition: force_side() made it so, and no boundary segment is there.
  void release_side(std::int32_t a, std::int32_t b);
  /// The triangle to the left of edge a -> b and its third corner; kNone when there is no such edge.
  std::pair<std::int32_t, std::int32_t> left_of(std::int32_t a, std::int32_t b) const;

  /// Triangle that contains p, walked from `start` without crossing a constrained edge; kNone when one is in the way.
  std::int32_t locate(Vec2 p, std::int32_t start) const;

  /// Triangle that contains p, straight from a node; kNone when an edge that must stay is in the way.
  std::int32_t seen_from(std::int32_t node, Vec2 p) const;
  /// Likewise from a point of edge a -> b to its left.
  std::int32_t seen_left_of(std::int32_t a, std::int32_t b, Vec2 from, Vec2 p) const;
  /// The first edge that must stay on the straight way from a node to p; kNone: there is none.
  std::pair<std::int32_t, std::int32_t> side_met(std::int32_t node, Vec2 p) const;

  /// The triangle at `node` in which the way to p begins, whatever must stay; kNone: there is none.
  std::int32_t triangle_towards(std::int32_t node, Vec2 p) const;

  /// The cavity of p: triangles whose circumcircle (in the metric) holds p, grown from `start`, star-shaped about p.
  /// Fills cavity() and ring(). False when p lies on a constrained edge or on a node.
  bool find_cavity(Vec2 p, const Metric& metric, std::int32_t start);
  struct RingEdge {
    std::int32_t a, b, outer;  ///< counter-clockwise; triangle beyond, kNone at the rim
    std::int8_t outer_side;    ///< of that triangle
    bool constrained, toggles;
  };
  const std::vector<std::int32_t>& cavity() const { return cavity_; }
  const std::vector<RingEdge>& ring() const { return ring_; }
  /// Replaces the cavity by the fan about `node`. new_triangles() lists the fan. States are kUnfinished.
  void fill_cavity(std::int32_t node);
  const std::vector<std::int32_t>& new_triangles() const { return fan_; }

  /// Swaps edge k of t. Precondition: unconstrained and the quadrilateral strictly convex (can_swap).
  void swap(std::int32_t t, int k);
  bool can_swap(std::int32_t t, int k) const;

  /// A triangle at the node, kNone when unknown. Kept up to date by all operations.
  std::int32_t triangle_at(std::int32_t node) const { return node_triangle_[node]; }
  /// Tells the triangulation of a node appended to `nodes`.
  void added_node() { node_triangle_.push_back(kNone); }
  /// Nodes and triangles around an inner node, counter-clockwise: triangle i holds (node, around[i], around[i+1]).
  bool ring_of(std::int32_t node, std::vector<std::int32_t>& around, std::vector<std::int32_t>& tris) const;
  /// Calls visit(node, triangle) for those; false where the rim is in the way.
  template <class Visit>
  bool visit_ring(std::int32_t node, const Visit& visit) const;
  /// Removes inner node `node` by moving it onto ring node `target_index` of the given ring. Precondition: all
  /// remaining triangles are valid.
  void collapse(std::int32_t node, int target_index, const std::vector<std::int32_t>& around,
                const std::vector<std::int32_t>& tris);

  /// Numbers inner nodes anew along a space-filling curve, and triangles as they come about nodes: who goes through
  /// them finds what is around in the caches. Triangles of the box about the loops are last.
  void sort_along_curve();

  int index_of(std::int32_t t, std::int32_t node) const {
    const PlaneTriangle& r = triangles[t];
    return r.v[0] == node ? 0 : r.v[1] == node ? 1 : 2;
  }

 private:
  void start_box();
  std::vector<std::int32_t> order_along_curve() const;
  void renumber_nodes(const std::vector<std::int32_t>& order);
  void renumber_triangles();
  bool insert_boundary_node(std::int32_t node, std::int32_t& hint);
  std::optional<LoopConflict> insert_segment(std::int32_t a, std::int32_t b);
  std::optional<LoopConflict> force_edge(std::int32_t a, std::int32_t b);
  void mark(std::int32_t t, int k);
  void classify();
  std::int32_t go_straight(Vec2 from, Vec2 p, std::int32_t t, int exit,
                           std::pair<std::int32_t, std::int32_t>* met = nullptr) const;
  std::int32_t find_edge(std::int32_t a, std::int32_t b, int& k) const;
  int neighbour_index(std::int32_t t, std::int32_t of) const {
    const PlaneTriangle& r = triangles[t];
    return r.n[0] == of ? 0 : r.n[1] == of ? 1 : 2;
  }

  std::vector<std::int32_t> node_triangle_;
  std::vector<std::int32_t> cavity_, fan_;
  std::vector<RingEdge> ring_;
  /// A side of a triangle of the cavity, across which it may grow: from `a` to `b`, as find_cavity()'s point sees them.
  struct CavitySide {
    std::int32_t t;
    int k;
    Vec2 a, b;              ///< from the point
    double a2, b2, b_by_a;  ///< squares of their lengths in the metric; their cross product
  };
  std::vector<CavitySide> stack_;
};

template <class Visit>
bool Triangulation::visit_ring(std::int32_t node, const Visit& visit) const {
  constexpr int kNext[] = {1, 2, 0}, kPrev[] = {2, 0, 1}, kMost = 1000;
  const std::int32_t first = node_triangle_[node];
  std::int32_t t = first;
  int n = 0;
  do {
    const PlaneTriangle& r = triangles[t];
    const int i = index_of(t, node);
    visit(r.v[kNext[i]], t);
    t = r.n[kPrev[i]];
  } while (t != first && t != kNone && ++n < kMost);
  return t == first;
}

}  // namespace st
