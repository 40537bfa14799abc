#include "sizing/cut_cells.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "base/axis.h"
#include "base/predicates.h"
#include "base/threads.h"

namespace st {
namespace {

constexpr double kTouching = 1 + 1e-9;  // cells are that much larger: what touches them cuts them

struct LeafTriangle {
  std::int32_t leaf;
  TriangleId triangle;
};

/// Finds the leaves of one triangle after the other.
class TriangleWalk {
 public:
  TriangleWalk(const OctreeView& octree, const SurfaceView& surface) : octree_(octree), surface_(surface) {}

  void visit(TriangleId t) {
    triangle_ = t;
    for (int k = 0; k < 3; ++k) corner_[k] = surface_.corner(t, k);
    box_ = {};
    for (const Vec3& x : corner_) box_.add(x);
    normal_ = cross(corner_[1] - corner_[0], corner_[2] - corner_[0]);
    steepness_ = (std::abs(normal_.x) + std::abs(normal_.y) + std::abs(normal_.z)) * kTouching;
    const double half = 0.5 * octree_.edge;
    const Vec3 center = octree_.lo + Vec3{half, half, half};
    if (meets_box(center, kTouching * half)) descend(octree_.node_children.empty() ? ~0 : 0, center, half);
  }
  std::vector<LeafTriangle> found;

 private:
  /// Halves of a cube that the triangle's box meets: a bit for each axis.
  struct Halves {
    int lower, upper;

    bool is_one_child() const { return (lower ^ upper) == 7; }
    bool has(int child) const { return ((child & upper) | (~child & lower)) == 7; }
  };
  Halves halves(Vec3 center, double q) const {
    const double reach = (kTouching - 1) * q;
    return {
        (box_.lo.x <= center.x + reach) | (box_.lo.y <= center.y + reach) << 1 | (box_.lo.z <= center.z + reach) << 2,
        (box_.hi.x >= center.x - reach) | (box_.hi.y >= center.y - reach) << 1 | (box_.hi.z >= center.z - reach) << 2};
  }
  std::int32_t child(std::int32_t node, int o) const {
    return octree_.node_children[8 * static_cast<std::size_t>(node) + static_cast<std::size_t>(o)];
  }
  static Vec3 child_center(Vec3 center, double q, int o) {
    return center + Vec3{o & 1 ? q : -q, o & 2 ? q : -q, o & 4 ? q : -q};
  }

  /// Precondition: the triangle's box meets the cube.
  void descend(std::int32_t node, Vec3 center, double half) {
    Halves met{};
    for (; node >= 0; half *= 0.5) {  // large cubes have the triangle in one child
      met = halves(center, 0.5 * half);
      if (!met.is_one_child()) break;
      node = child(node, met.upper);
      center = child_center(center, 0.5 * half, met.upper);
    }
    if (!meets_plane(center, kTouching * half)) return;
    if (node < 0) {
      if (!is_apart(center, kTouching * half)) found.push_back({~node, triangle_});
      return;
    }
    const double q = 0.5 * half;
    for (int o = 0; o < 8; ++o)
      if (met.has(o)) descend(child(node, o), child_center(center, q, o), q);
  }
  bool meets_box(Vec3 c, double h) const {
    return box_.lo.x <= c.x + h && box_.hi.x >= c.x - h && box_.lo.y <= c.y + h && box_.hi.y >= c.y - h &&
           box_.lo.z <= c.z + h && box_.hi.z >= c.z - h;
  }
  bool meets_plane(Vec3 c, double h) const { return std::abs(dot(normal_, c - corner_[0])) <= h * steepness_; }

  /// Whether a plane along an edge of the triangle and an edge of the cube separates them: with the box
  /// and the plane the
  /// separating axes of a triangle and a cube (Akenine-Moeller 2001).
  bool is_apart(Vec3 center, double h) const {
    const Vec3 c[3] = {corner_[0] - center, corner_[1] - center, corner_[2] - center};
    for (int k = 0; k < 3; ++k) {
      const Vec3 e = c[(k + 1) % 3] - c[k];
      // an edge projects to one value, so two corners tell: one of the edge, and the one across
      const Vec3 &p = c[k], &q = c[(k + 2) % 3];
      const auto separates = [h](double a, double b, double reach) {
        return std::min(a, b) > reach * h || std::max(a, b) < -reach * h;
      };
      if (separates(e.y * p.z - e.z * p.y, e.y * q.z - e.z * q.y, std::abs(e.y) + std::abs(e.z)) ||
          separates(e.z * p.x - e.x * p.z, e.z * q.x - e.x * q.z, std::abs(e.z) + std::abs(e.x)) ||
          separates(e.x * p.y - e.y * p.x, e.x * q.y - e.y * q.x, std::abs(e.x) + std::abs(e.y)))
        return true;
    }
    return false;
  }

  const OctreeView& octree_;
  const SurfaceView& surface_;
  TriangleId triangle_ = 0;
  Vec3 corner_[3], normal_;
  double steepness_ = 0;  // half the width of a cube across the plane, over half its edge and the normal's length
  Box3 box_;
};

/// Of one triangle around the ray from x along +x. Seen along it, each triangle winds around x or not; common edges of
/// two triangles are counted once whatever the rounding.
int winding_of(const std::array<Vec3, 3>& p, Vec3 x) {
  if (std::max({p[0].x, p[1].x, p[2].x}) < x.x) return 0;
  const Vec2 origin{x.y, x.z};
  int turns = 0;
  for (int k = 0; k < 3; ++k) {
    const Vec2 a{p[k].y, p[k].z}, b{p[(k + 1) % 3].y, p[(k + 1) % 3].z};
    if ((a.y <= origin.y) == (b.y <= origin.y)) continue;
    const double side = orient2d(a, b, origin);
    if (b.y > origin.y && side > 0) ++turns;
    if (a.y > origin.y && side < 0) --turns;
  }
  if (turns == 0) return 0;
  // the side of the triangle that x lies on tells whether the ray meets it: seen along +x, a counter-clockwise one
  // has its normal there
  const double side = orient3d(p[0], p[1], p[2], x);
  return (turns > 0 && side < 0) || (turns < 0 && side > 0) ? turns : 0;
}

}  // namespace

CutCells find_cut_cells(const OctreeView& octree, const SurfaceView& surface) {
  constexpr std::size_t kPerPiece = 1'024;  // triangles
  const std::size_t n = surface.triangles.size();
  std::vector<std::vector<LeafTriangle>> found((n + kPerPiece - 1) / kPerPiece);
  parallel_for(n, kPerPiece, [&](std::size_t begin, std::size_t end) {
    TriangleWalk walk(octree, surface);
    for (std::size_t t = begin; t < end; ++t) walk.visit(static_cast<TriangleId>(t));
    found[begin / kPerPiece] = std::move(walk.found);
  });
  std::vector<std::int64_t> next(octree.leaf_keys.size(), 0);  // of each leaf its triangles, then where the next goes
  std::size_t n_found = 0;
  for (const auto& piece : found) {
    n_found += piece.size();
    for (const auto& [leaf, triangle] : piece) ++next[leaf];
  }
  CutCells cells;
  for (std::int32_t leaf = 0; leaf < octree.n_leaves(); ++leaf) {
    if (next[leaf] == 0) continue;
    cells.leaf.push_back(leaf);
    cells.offsets.push_back(cells.offsets.back() + std::exchange(next[leaf], cells.offsets.back()));
  }
  cells.triangle.resize(n_found);
  for (const auto& piece : found)  // triangles come ascending
    for (const auto& [leaf, triangle] : piece) cells.triangle[next[leaf]++] = triangle;
  return cells;
}

Vec3 ClippedTriangle::middle() const {
  Vec3 sum;
  for (int k = 0; k < n; ++k) sum += corner[k];
  return sum / std::max(n, 1);
}

// Sutherland and Hodgman: one side of the cube after the other.
ClippedTriangle clip_triangle(Vec3 a, Vec3 b, Vec3 c, Vec3 center, double half) {
  ClippedTriangle polygon{3, {a - center, b - center, c - center}};
  for (int side = 0; side < 6 && polygon.n > 0; ++side) {
    const int axis = side / 2;
    const double sign = side % 2 ? -1 : 1;
    const auto is_inside = [&](const Vec3& v) { return sign * component(v, axis) <= half; };
    if (std::all_of(polygon.corner, polygon.corner + polygon.n, is_inside)) continue;
    ClippedTriangle next;
    double to_next = half - sign * component(polygon.corner[0], axis);
    for (int k = 0; k < polygon.n; ++k) {
      const Vec3 p = polygon.corner[k], q = polygon.corner[k + 1 < polygon.n ? k + 1 : 0];
      const double dp = to_next, dq = half - sign * component(q, axis);
      to_next = dq;
      if (dp >= 0) next.corner[next.n++] = p;
      if ((dp > 0 && dq < 0) || (dp < 0 && dq > 0)) next.corner[next.n++] = p + dp / (dp - dq) * (q - p);
    }
    polygon = next;
  }
  for (int k = 0; k < polygon.n; ++k) polygon.corner[k] += center;
  return polygon;
}

bool line_meets_triangle(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto are_apart = [](double s, double t) { return (s > 0 && t < 0) || (s < 0 && t > 0); };
  const double u = orient3d(p, q, a, b), v = orient3d(p, q, b, c);
  if (are_apart(u, v)) return false;
  const double w = orient3d(p, q, c, a);
  return !are_apart(u, w) && !are_apart(v, w);
}

bool segment_meets_triangle(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const double sp = orient3d(a, b, c, p), sq = orient3d(a, b, c, q);
  if ((sp > 0 && sq > 0) || (sp < 0 && sq < 0)) return false;
  return line_meets_triangle(p, q, a, b, c);
}

std::vector<int> winding_numbers(const SurfaceView& surface, std::span<const Vec3> points) {
  constexpr std::size_t kPerPiece = 4'096;  // triangles
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return std::pair(points[i].y, i); });
  std::vector<double> y;
  for (const std::size_t i : order) y.push_back(points[i].y);
  std::vector<int> winding(points.size(), 0);
  parallel_for(surface.triangles.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const auto id = static_cast<TriangleId>(t);
      const std::array<Vec3, 3> p = {surface.corner(id, 0), surface.corner(id, 1), surface.corner(id, 2)};
      const auto [lo, hi] = std::minmax({p[0].y, p[1].y, p[2].y});
      for (auto k = std::ranges::lower_bound(y, lo) - y.begin(); k < std::ssize(y) && y[k] <= hi; ++k)
        if (const int turns = winding_of(p, points[order[k]]); turns != 0)
          std::atomic_ref(winding[order[k]]).fetch_add(turns, std::memory_order_relaxed);
    }
  });
  return winding;
}

int winding_number(const SurfaceView& surface, Vec3 x) { return winding_numbers(surface, {&x, 1}).front(); }

}  // namespace st
