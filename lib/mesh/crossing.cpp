#include "mesh/crossing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "base/assert.h"
#include "base/predicates.h"
#include "base/threads.h"
#include "mesh/float_box.h"
#include "mesh/pair_search.h"

namespace st {
namespace {

using Points = std::array<Vec3, 3>;

int sign(double x) { return (x > 0) - (x < 0); }
int side(const Points& t, Vec3 p) { return sign(orient3d(t[0], t[1], t[2], p)); }

Points corners(std::span<const Vec3> points, const Triangle& t) {
  return {points[t.n[0]], points[t.n[1]], points[t.n[2]]};
}

/// The point without its coordinate `axis`.
Vec2 drop(Vec3 p, int axis) { return axis == 0 ? Vec2{p.y, p.z} : axis == 1 ? Vec2{p.z, p.x} : Vec2{p.x, p.y}; }

/// Sign of the triangle's area seen along `axis`.
int turn(Vec3 a, Vec3 b, Vec3 c, int axis) { return sign(orient2d(drop(a, axis), drop(b, axis), drop(c, axis))); }

/// An axis along which the triangle is not seen edge-on, or kNone when it has no area.
int visible_axis(const Points& t) {
  for (int axis = 2; axis >= 0; --axis)
    if (turn(t[0], t[1], t[2], axis) != 0) return axis;
  return kNone;
}

bool in_order(double a, double b, double c) { return (a <= b && b <= c) || (c <= b && b <= a); }

/// Closed segments (a, b) and (p, q) in one plane, seen along `axis`.
bool segments_meet(Vec3 a, Vec3 b, Vec3 p, Vec3 q, int axis) {
  const int abp = turn(a, b, p, axis), abq = turn(a, b, q, axis), pqa = turn(p, q, a, axis), pqb = turn(p, q, b, axis);
  if (abp * abq > 0 || pqa * pqb > 0) return false;
  if (abp || abq || pqa || pqb) return true;
  const auto on = [&](Vec3 from, Vec3 x, Vec3 to) {
    const Vec2 f = drop(from, axis), m = drop(x, axis), t = drop(to, axis);
    return in_order(f.x, m.x, t.x) && in_order(f.y, m.y, t.y);
  };
  return on(a, p, b) || on(a, q, b) || on(p, a, q);
}

bool contains_coplanar(const Points& t, Vec3 p, int axis) {
  const int s0 = turn(t[0], t[1], p, axis), s1 = turn(t[1], t[2], p, axis), s2 = turn(t[2], t[0], p, axis);
  return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

/// Closed segment (p, q) and closed triangle; side_p, side_q: the sides of the triangle's plane that p and q lie on.
bool segment_meets_triangle(Vec3 p, Vec3 q, int side_p, int side_q, const Points& t) {
  if (side_p * side_q > 0) return false;
  if (side_p == 0 && side_q == 0) {
    const int axis = visible_axis(t);
    if (contains_coplanar(t, p, axis)) return true;
    for (int k = 0; k < 3; ++k)
      if (segments_meet(t[k], t[(k + 1) % 3], p, q, axis)) return true;
    return false;
  }
  const int s0 = sign(orient3d(p, q, t[0], t[1])), s1 = sign(orient3d(p, q, t[1], t[2]));
  if (s0 * s1 < 0) return false;
  const int s2 = sign(orient3d(p, q, t[2], t[0]));
  return s0 * s2 >= 0 && s1 * s2 >= 0;
}

bool all_beyond(const std::array<int, 3>& s) {
  return (s[0] > 0 && s[1] > 0 && s[2] > 0) || (s[0] < 0 && s[1] < 0 && s[2] < 0);
}

/// Coplanar triangles without a common node: apart when a side of one has the whole other strictly beyond it.
bool coplanar_meet(const Points& a, const Points& b) {
  const int axis = visible_axis(a);
  const auto separates = [&](const Points& s, const Points& t) {
    const int inside = turn(s[0], s[1], s[2], axis);
    const auto beyond = [&](int k, Vec3 p) { return turn(s[k], s[(k + 1) % 3], p, axis) == -inside; };
    for (int k = 0; k < 3; ++k)
      if (beyond(k, t[0]) && beyond(k, t[1]) && beyond(k, t[2])) return true;
    return false;
  };
  return !separates(a, b) && !separates(b, a);
}

/// Coplanar triangles with the common corner a[0] = b[0]: they meet beyond it when a leg of one lies in the other's
/// angle.
bool coplanar_angles_meet(const Points& a, const Points& b) {
  const int axis = visible_axis(a);
  const auto leg_in_angle = [&](const Points& t, Vec3 leg) {
    const int inside = turn(t[0], t[1], t[2], axis);
    return turn(t[0], t[1], leg, axis) * inside >= 0 && turn(t[0], leg, t[2], axis) * inside >= 0;
  };
  return leg_in_angle(a, b[1]) || leg_in_angle(a, b[2]) || leg_in_angle(b, a[1]);
}

bool disjoint_nodes_cross(const Points& a, const Points& b) {
  const std::array<int, 3> sb{side(a, b[0]), side(a, b[1]), side(a, b[2])};
  if (all_beyond(sb)) return false;
  if (sb[0] == 0 && sb[1] == 0 && sb[2] == 0) return coplanar_meet(a, b);
  const std::array<int, 3> sa{side(b, a[0]), side(b, a[1]), side(b, a[2])};
  if (all_beyond(sa)) return false;
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3;
    if (segment_meets_triangle(b[k], b[l], sb[k], sb[l], a) || segment_meets_triangle(a[k], a[l], sa[k], sa[l], b))
      return true;
  }
  return false;
}

/// Triangles with the common corner a[0] = b[0]: what they share beyond it reaches the opposite edge of one of them.
bool one_node_cross(const Points& a, const Points& b) {
  const int b1 = side(a, b[1]), b2 = side(a, b[2]);
  if (b1 * b2 > 0) return false;
  if (b1 == 0 && b2 == 0) return coplanar_angles_meet(a, b);
  const int a1 = side(b, a[1]), a2 = side(b, a[2]);
  if (a1 * a2 > 0) return false;
  return segment_meets_triangle(b[1], b[2], b1, b2, a) || segment_meets_triangle(a[1], a[2], a1, a2, b);
}

/// Triangles (u, v, p) and (u, v, q): they overlap when folded flat onto each other.
bool two_nodes_cross(Vec3 u, Vec3 v, Vec3 p, Vec3 q) {
  const Points t{u, v, p};
  if (side(t, q) != 0) return false;
  const int axis = visible_axis(t);
  return turn(u, v, p, axis) == turn(u, v, q, axis);
}

Points rotated(const Points& t, int k) { return {t[k], t[(k + 1) % 3], t[(k + 2) % 3]}; }

// --- bounding volume hierarchy ---

float round_down(double x) {
  const auto f = static_cast<float>(x);
  return f > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}
float round_up(double x) { return -round_down(-x); }

/// Rounded outwards.
FloatBox box_of(const Points& t) {
  const auto [x0, x1] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [y0, y1] = std::minmax({t[0].y, t[1].y, t[2].y});
  const auto [z0, z1] = std::minmax({t[0].z, t[1].z, t[2].z});
  return {{round_down(x0), round_down(y0), round_down(z0)}, {round_up(x1), round_up(y1), round_up(z1)}};
}

/// The lower 21 bits of x, two zeros between neighbours.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x001f00000000ffffull;
  x = (x | x << 16) & 0x001f0000ff0000ffull;
  x = (x | x << 8) & 0x100f00f00f00f00full;
  x = (x | x << 4) & 0x10c30c30c30c30c3ull;
  return (x | x << 2) & 0x1249249249249249ull;
}

/// Triangles in Morton order of their centres under a balanced binary tree of boxes.
class BoxTree {
 public:
  /// Both outlive the tree.
  BoxTree(std::span<const Vec3> points, std::span<const Triangle> triangles) : points_(points), triangles_(triangles) {
    sort_along_curve(points, triangles);
    boxes_.resize(order_.size());
    parallel_for(order_.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) boxes_[i] = box_of(corners(points, triangles[order_[i]]));
    });
    nodes_.reserve(order_.size() / 2 + 1);
    if (!order_.empty()) build(0, static_cast<std::int32_t>(order_.size()));
  }
  /// Parts of the tree, or pairs of them, to be searched apart.
  struct Search {
    std::int32_t a, b;  ///< nodes; b = kNone: pairs inside a
  };
  std::vector<Search> searches() const {
    std::vector<Search> list;
    if (!nodes_.empty()) split({0, kNone}, list);
    return list;
  }
  /// Tests every pair of a search whose boxes meet once.
  void test(Search search, PairSearch& found) const {
    search.b == kNone ? within(search.a, found) : between(search.a, search.b, found);
  }

 private:
  static constexpr std::int32_t kLeafSize = 4, kSearchSize = 8'192;
  static constexpr std::size_t kPerPiece = 16'384;
  struct Node {
    FloatBox box;
    std::int32_t begin, end, right;  ///< range in order_; left child is the next node, right = kNone in a leaf
  };

  void sort_along_curve(std::span<const Vec3> points, std::span<const Triangle> triangles) {
    Box3 all;
    for (const Triangle& t : triangles)
      for (const NodeId n : t.n) all.add(points[n]);
    const Vec3 extent = all.hi - all.lo;
    const auto cell = [](double x, double lo, double length) {
      return static_cast<std::uint64_t>(length > 0 ? std::clamp((x - lo) / length, 0.0, 1.0) * 2097151.0 : 0.0);
    };
    constexpr std::uint64_t kLeftOut = ~std::uint64_t{0};
    std::vector<std::pair<std::uint64_t, TriangleId>> keyed(triangles.size());
    parallel_for(triangles.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        const Points p = corners(points, triangles[t]);
        const Vec3 c = (p[0] + p[1] + p[2]) / 3.0;
        const std::uint64_t key = spread(cell(c.x, all.lo.x, extent.x)) | spread(cell(c.y, all.lo.y, extent.y)) << 1 |
                                  spread(cell(c.z, all.lo.z, extent.z)) << 2;
        keyed[t] = {is_degenerate(points, triangles[t]) ? kLeftOut : key, static_cast<TriangleId>(t)};
      }
    });
    parallel_sort(keyed.begin(), keyed.end(), std::less<>());
    order_.reserve(keyed.size());
    for (const auto& [key, t] : keyed)
      if (key != kLeftOut) order_.push_back(t);
  }

  std::int32_t build(std::int32_t begin, std::int32_t end) {
    const auto id = static_cast<std::int32_t>(nodes_.size());
    nodes_.push_back({boxes_[begin], begin, end, kNone});
    if (end - begin <= kLeafSize) {
      for (std::int32_t i = begin + 1; i < end; ++i) nodes_[id].box.add(boxes_[i]);
      return id;
    }
    const std::int32_t middle = begin + (end - begin) / 2;
    const std::int32_t left = build(begin, middle), right = build(middle, end);
    nodes_[id].right = right;
    nodes_[id].box = nodes_[left].box;
    nodes_[id].box.add(nodes_[right].box);
    return id;
  }

  std::int32_t size(std::int32_t n) const { return nodes_[n].end - nodes_[n].begin; }

  /// As within() and between() go on, down to small parts.
  void split(Search search, std::vector<Search>& list) const {
    const auto [a, b] = search;
    if (b == kNone) {
      if (size(a) <= kSearchSize) return list.push_back(search);
      for (const Search part : {Search{a + 1, kNone}, {nodes_[a].right, kNone}, {a + 1, nodes_[a].right}})
        split(part, list);
      return;
    }
    if (!nodes_[a].box.meets(nodes_[b].box)) return;
    if (size(a) + size(b) <= kSearchSize) return list.push_back(search);
    const bool is_first = size(a) >= size(b);
    const std::int32_t halved = is_first ? a : b;
    for (const std::int32_t half : {halved + 1, nodes_[halved].right})
      split(is_first ? Search{half, b} : Search{a, half}, list);
  }

  void test_leaf(std::int32_t i, std::int32_t begin, std::int32_t end, PairSearch& found) const {
    found.count(end - begin);
    for (std::int32_t j = begin; j < end; ++j)
      if (boxes_[i].meets(boxes_[j])) found.test(points_, triangles_, order_[i], order_[j]);
  }

  void within(std::int32_t n, PairSearch& found) const {
    const Node& node = nodes_[n];
    if (node.right != kNone) {
      within(n + 1, found);
      within(node.right, found);
      between(n + 1, node.right, found);
      return;
    }
    for (std::int32_t i = node.begin; i < node.end; ++i) test_leaf(i, i + 1, node.end, found);
  }

  void between(std::int32_t a, std::int32_t b, PairSearch& found) const {
    const Node &na = nodes_[a], &nb = nodes_[b];
    found.count(1);
    if (!na.box.meets(nb.box) || found.is_over()) return;
    const bool leaf_a = na.right == kNone, leaf_b = nb.right == kNone;
    if (leaf_a && leaf_b) {
      for (std::int32_t i = na.begin; i < na.end; ++i)
        if (boxes_[i].meets(nb.box)) test_leaf(i, nb.begin, nb.end, found);
    } else if (leaf_b || (!leaf_a && na.box.extent() >= nb.box.extent())) {
      between(a + 1, b, found);
      between(na.right, b, found);
    } else {
      between(a, b + 1, found);
      between(a, nb.right, found);
    }
  }

  std::span<const Vec3> points_;
  std::span<const Triangle> triangles_;
  std::vector<TriangleId> order_;
  std::vector<FloatBox> boxes_;  ///< of order_[i]
  std::vector<Node> nodes_;      ///< depth first
};

}  // namespace

bool is_degenerate(std::span<const Vec3> points, const Triangle& t) {
  return t.n[0] == t.n[1] || t.n[1] == t.n[2] || t.n[2] == t.n[0] || visible_axis(corners(points, t)) == kNone;
}

bool triangles_cross(std::span<const Vec3> points, const Triangle& a, const Triangle& b, int& n_shared) {
  ST_ASSERT(!is_degenerate(points, a) && !is_degenerate(points, b));
  int corner_a[3], corner_b[3];
  n_shared = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (a.n[i] == b.n[j]) corner_a[n_shared] = i, corner_b[n_shared++] = j;
  const Points pa = corners(points, a), pb = corners(points, b);
  switch (n_shared) {
    case 0:
      return disjoint_nodes_cross(pa, pb);
    case 1:
      return one_node_cross(rotated(pa, corner_a[0]), rotated(pb, corner_b[0]));
    case 2:
      return two_nodes_cross(pa[corner_a[0]], pa[corner_a[1]], pa[3 - corner_a[0] - corner_a[1]],
                             pb[3 - corner_b[0] - corner_b[1]]);
    default:
      return false;
  }
}

std::vector<TrianglePair> find_crossing_triangles(std::span<const Vec3> points, std::span<const Triangle> triangles) {
  bool was_ended = false;
  return find_crossing_triangles(points, triangles, was_ended);
}

std::vector<TrianglePair> find_crossing_triangles(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                                  bool& was_ended) {
  const BoxTree tree(points, triangles);
  const std::vector<BoxTree::Search> searches = tree.searches();
  return find_bounded(searches.size(), most_comparisons(triangles.size()), was_ended,
                      [&](std::size_t i, PairSearch& found) { tree.test(searches[i], found); });
}

}  // namespace st
