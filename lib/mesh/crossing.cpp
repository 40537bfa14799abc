#include "mesh/crossing.h"

#include <algorithm>
#include <array>

#include "base/assert.h"
#include "base/four_floats.h"
#include "base/predicates.h"
#include "mesh/triangle_tree.h"

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

// Most pairs are apart by far. Plain arithmetic sees that where it holds by more than its rounding; the signs that
// follow are exact.
constexpr double kSure = 1e-13;  // of the sum of the squared lengths: 25 times the rounding of what is compared with it

/// A plane square to the way between the middles parts them.
bool are_surely_apart(const Vec3& a, const Vec3& a1, const Vec3& a2, const Vec3& b, const Vec3& b1, const Vec3& b2) {
  const Vec3 p = a1 - a, q = a2 - a, r = b - a, s = b1 - a, t = b2 - a, way = (p + q) - (r + s + t);
  const double nearest = std::min({0.0, dot(p, way), dot(q, way)});
  const double furthest = std::max({dot(r, way), dot(s, way), dot(t, way)});
  return nearest - furthest > kSure * (norm2(p) + norm2(q) + norm2(r) + norm2(s) + norm2(t));
}

/// A plane through the common corner has the other two of each triangle on its two sides.
bool are_surely_apart_beyond(const Vec3& corner, const Vec3& a1, const Vec3& a2, const Vec3& b1, const Vec3& b2) {
  const Vec3 p = a1 - corner, q = a2 - corner, r = b1 - corner, s = b2 - corner, way = (p + q) - (r + s);
  const double sure = kSure * (norm2(p) + norm2(q) + norm2(r) + norm2(s));
  return std::min(dot(p, way), dot(q, way)) > sure && std::max(dot(r, way), dot(s, way)) < -sure;
}

/// Seen along the common edge (u, v), the corners p and q are more than a right angle apart.
bool are_surely_opened(const Vec3& u, const Vec3& v, const Vec3& p, const Vec3& q) {
  const Vec3 edge = v - u, to_p = p - u, to_q = q - u;
  const double length2 = norm2(edge);
  return dot(to_p, to_q) * length2 - dot(to_p, edge) * dot(to_q, edge) < -kSure * length2 * (norm2(to_p) + norm2(to_q));
}

/// The nodes that two triangles have in common: the first corner of each is the only shared one, or the only other one.
struct SharedNodes {
  std::int8_t n = 0;
  std::array<std::int8_t, 3> a{0, 1, 2}, b{0, 1, 2};  ///< their corners, in their order
};

[[gnu::noinline]] bool cross_exactly(std::span<const Vec3> points, const Triangle& t, const Triangle& u,
                                     const SharedNodes& shared) {
  const Points a = rotated(corners(points, t), shared.a[0]), b = rotated(corners(points, u), shared.b[0]);
  if (shared.n == 0) return disjoint_nodes_cross(a, b);
  if (shared.n == 1) return one_node_cross(a, b);
  return shared.n == 2 && two_nodes_cross(a[1], a[2], a[0], b[0]);
}

/// Bit 3 i + j: corner i of a is corner j of b.
std::uint32_t equal_nodes(const Triangle& a, const Triangle& b) {
  const FourInts of_b{b.n[0], b.n[1], b.n[2], kNone};
  return bits_of(of_b == a.n[0]) | bits_of(of_b == a.n[1]) << 3 | bits_of(of_b == a.n[2]) << 6;
}

/// By equal_nodes(): without branches, as nothing foretells which corners are shared.
constexpr auto kSharedNodes = [] {
  std::array<SharedNodes, 512> all;
  for (unsigned equal = 0; equal < all.size(); ++equal) {
    SharedNodes& shared = all[equal];
    int sum_a = 0, sum_b = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (equal >> (3 * i + j) & 1) ++shared.n, sum_a += i, sum_b += j;
    const auto start_at = [&](std::array<std::int8_t, 3>& corners, int sum) {
      const int first = shared.n == 1 ? sum : (6 - sum) % 3;
      for (int k = 0; k < 3; ++k) corners[k] = static_cast<std::int8_t>((first + k) % 3);
    };
    if (shared.n == 1 || shared.n == 2) start_at(shared.a, sum_a), start_at(shared.b, sum_b);
  }
  return all;
}();

}  // namespace

bool is_degenerate(std::span<const Vec3> points, const Triangle& t) {
  return t.n[0] == t.n[1] || t.n[1] == t.n[2] || t.n[2] == t.n[0] || visible_axis(corners(points, t)) == kNone;
}

bool triangles_cross(std::span<const Vec3> points, const Triangle& a, const Triangle& b, int& n_shared) {
  ST_ASSERT(!is_degenerate(points, a) && !is_degenerate(points, b));
  const SharedNodes& shared = kSharedNodes[equal_nodes(a, b)];
  n_shared = shared.n;
  const auto at_a = [&](int k) -> const Vec3& { return points[a.n[shared.a[k]]]; };
  const auto at_b = [&](int k) -> const Vec3& { return points[b.n[shared.b[k]]]; };
  if (shared.n == 1 && are_surely_apart_beyond(at_a(0), at_a(1), at_a(2), at_b(1), at_b(2))) return false;
  if (shared.n == 2 && are_surely_opened(at_a(1), at_a(2), at_a(0), at_b(0))) return false;
  if (shared.n == 0 && are_surely_apart(at_a(0), at_a(1), at_a(2), at_b(0), at_b(1), at_b(2))) return false;
  return cross_exactly(points, a, b, shared);
}

std::vector<TrianglePair> find_crossing_triangles(std::span<const Vec3> points, std::span<const Triangle> triangles) {
  bool was_ended = false;
  return find_crossing_triangles(points, triangles, was_ended);
}

std::vector<TrianglePair> find_crossing_triangles(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                                  bool& was_ended, std::int64_t* n_compared) {
  const std::int32_t begin[] = {0, static_cast<std::int32_t>(triangles.size())};
  return find_pairs({points, triangles, begin}, WithinGroup::kAll, {{0, 0}}, was_ended, n_compared);
}

}  // namespace st
