#include "mesh/touching_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace st {
namespace {

constexpr int kPasses = 8;          // nodes have several pairs
constexpr double kOneSided = 0.25;  // of the extent on one side of a plane: at most so much is on the other
constexpr double kFlat = 0.01;      // of the reach: a triangle of less extent lies in the plane

/// Where a triangle's nodes are, seen from another one's plane.
struct Side {
  Vec3 towards;                    // unit normal of the plane, to the side of the triangle; zero: on both sides of it
  std::array<double, 3> distance;  // of its nodes, to that side
  double share = kOneSided;        // of the extent on the wrong side
};

Side side_of(const Triangle& t, const Triangle& plane, std::span<const Vec3> x, double reach) {
  Side side{};
  const Vec3 origin = x[plane.n[0]];
  const Vec3 product = cross(x[plane.n[1]] - origin, x[plane.n[2]] - origin);
  if (norm(product) == 0) return side;
  const Vec3 normal = product / norm(product);
  for (int k = 0; k < 3; ++k) side.distance[k] = dot(x[t.n[k]] - origin, normal);
  auto [low, high] = std::minmax({side.distance[0], side.distance[1], side.distance[2]});
  const bool is_below = high < -low;
  if (is_below) {
    low = -std::exchange(high, -low);
    for (double& d : side.distance) d = -d;
  }
  if (high < kFlat * reach || -low > reach) return side;
  const double share = std::max(0.0, -low) / high;
  if (share >= kOneSided) return side;
  side.towards = is_below ? -normal : normal;
  side.share = share;
  return side;
}

/// Moves the nodes of `t` that are too near the plane, or the plane.
bool move_off(const Triangle& t, const Triangle& plane, const Side& side, double gap, NodeId first_movable,
              std::span<Vec3> x) {
  bool is_moved = false;
  double missing = 0;  // where nodes may not move
  for (int k = 0; k < 3; ++k) {
    const double step = gap - side.distance[k];
    if (step <= 0) continue;
    if (t.n[k] < first_movable) {
      missing = std::max(missing, step);
      continue;
    }
    x[t.n[k]] += step * side.towards;
    is_moved = true;
  }
  for (const NodeId n : plane.n) {
    if (missing == 0 || n < first_movable) continue;
    x[n] -= missing * side.towards;
    is_moved = true;
  }
  return is_moved;
}

}  // namespace

bool move_touching_apart(std::span<const TouchingPair> pairs, NodeId first_movable, std::span<Vec3> points) {
  bool has_moved = false;
  for (int pass = 0; pass < kPasses; ++pass) {
    bool is_moved = false;
    for (const TouchingPair& p : pairs) {
      const Side of_b = side_of(p.b, p.a, points, p.reach), of_a = side_of(p.a, p.b, points, p.reach);
      const double gap = kTouchingGap * p.reach;
      if (std::min(of_a.share, of_b.share) >= kOneSided) continue;
      is_moved |= of_b.share <= of_a.share ? move_off(p.b, p.a, of_b, gap, first_movable, points)
                                           : move_off(p.a, p.b, of_a, gap, first_movable, points);
    }
    has_moved |= is_moved;
    if (!is_moved) break;
  }
  return has_moved;
}

}  // namespace st
