#include "geometry/shape/surface_crossing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/boxes.h"
#include "base/finite.h"

namespace st {
namespace {

constexpr int kSteps = 30;               // of Newton's method
constexpr double kLeastSine = 0.02;      // of the angle of surfaces that pass through each other
constexpr double kCone = 0.25;           // cosine of 75 degrees: with all normals so near, nothing folds back
constexpr int kCoarse = 12, kFine = 40;  // cells of the grid along u and v
constexpr int kBlock = 4;                // cells of a block along u and v
constexpr int kMostTried = 300;          // starts of Newton's method
constexpr double kBetween = 1e-3;        // of the surface's extent: how far it goes away between both places

/// Columns of the symmetric matrix J J^T and its solution for the right side r; nullopt where it is singular.
std::optional<Vec3> solve(const std::array<Vec3, 4>& columns, Vec3 r) {
  Vec3 x, y, z;
  for (const Vec3 c : columns) x += c.x * c, y += c.y * c, z += c.z * c;
  const double det = dot(x, cross(y, z)), scale = x.x + y.y + z.z;
  if (!(std::abs(det) > 1e-24 * scale * scale * scale)) return std::nullopt;
  return Vec3{dot(r, cross(y, z)) / det, dot(x, cross(r, z)) / det, dot(x, cross(y, r)) / det};
}

Vec2 within(const Surface& s, Vec2 uv) {
  return {std::clamp(uv.x, s.u_min(), s.u_max()), std::clamp(uv.y, s.v_min(), s.v_max())};
}

// --- a grid on one surface ---

struct Cell {
  int i, j;
};

class Grid {
 public:
  Grid(const Surface& s, int n) : s_(s), n_(n) {
    const auto n_along = static_cast<std::size_t>(n) + 1;
    std::vector<Vec2> uv;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) uv.push_back(at(i, j));  // in rows of one v, which are cheap
    std::vector<SurfacePoint> rows(uv.size());
    s.evaluate_batch(uv, rows);
    points_.resize(uv.size());
    for (std::size_t j = 0; j < n_along; ++j)
      for (std::size_t i = 0; i < n_along; ++i) points_[i * n_along + j] = rows[j * n_along + i];
    for (const SurfacePoint& p : points_) box_.add(p.x);
  }
  Vec2 at(double i, double j) const {
    return {s_.u_min() + (s_.u_max() - s_.u_min()) * i / n_, s_.v_min() + (s_.v_max() - s_.v_min()) * j / n_};
  }
  int n() const { return n_; }
  double extent() const { return box_.diagonal(); }
  Vec3 x(int i, int j) const { return points_[static_cast<std::size_t>(i) * (n_ + 1) + j].x; }

  bool is_sound() const {
    return std::all_of(points_.begin(), points_.end(), [](const SurfacePoint& p) { return is_finite(p.x); });
  }
  /// Are all normals near to their mean?
  bool is_open_to_one_side() const {
    std::vector<Vec3> normals;
    Vec3 sum;
    for (const SurfacePoint& p : points_) {
      normals.push_back(normalized(cross(p.du, p.dv)));
      sum += normals.back();
    }
    const Vec3 mean = normalized(sum);
    return std::all_of(normals.begin(), normals.end(), [&](Vec3 n) { return norm2(n) == 0 || dot(n, mean) > kCone; });
  }
  Box3 box(int i0, int i1, int j0, int j1) const {
    Box3 box;
    for (int i = i0; i <= i1; ++i)
      for (int j = j0; j <= j1; ++j) box.add(x(i, j));
    return box;
  }

 private:
  const Surface& s_;
  int n_;
  std::vector<SurfacePoint> points_;
  Box3 box_;
};

using Corners = std::array<Vec3, 3>;

/// Does a side of `t` go through `r`?
bool pierces(const Corners& t, const Corners& r) {
  const Vec3 n = cross(r[1] - r[0], r[2] - r[0]);
  for (int k = 0; k < 3; ++k) {
    const Vec3 p = t[k], q = t[(k + 1) % 3];
    const double dp = dot(p - r[0], n), dq = dot(q - r[0], n);
    if (dp == dq || (dp < 0) == (dq < 0)) continue;
    const Vec3 at = p + dp / (dp - dq) * (q - p);
    bool is_in = true;
    for (int m = 0; m < 3; ++m) is_in = is_in && dot(cross(r[(m + 1) % 3] - r[m], at - r[m]), n) >= 0;
    if (is_in) return true;
  }
  return false;
}

/// Looks at pairs of cells that are no neighbours.
class SelfCrossing {
 public:
  SelfCrossing(const Surface& s, const Grid& grid, double tolerance, const std::function<bool(Vec2)>& is_inside)
      : s_(s), grid_(grid), tolerance_(tolerance), is_inside_(is_inside) {
    const int n = grid.n();
    const double near = 1e-6 * grid.extent();
    for (int k = 0; k <= n; ++k) {
      closed_u_ = closed_u_ && distance(grid.x(0, k), grid.x(n, k)) <= near;
      closed_v_ = closed_v_ && distance(grid.x(k, 0), grid.x(k, n)) <= near;
    }
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) boxes_.push_back(grid.box(i, i + 1, j, j + 1));
  }

  std::optional<CommonPoint> find() {
    struct Block {
      Box3 box;
      int i, j;
    };
    std::vector<Block> blocks;
    const int n = grid_.n();
    for (int i = 0; i < n; i += kBlock)
      for (int j = 0; j < n; j += kBlock)
        blocks.push_back({grid_.box(i, std::min(i + kBlock, n), j, std::min(j + kBlock, n)), i, j});
    for (std::size_t a = 0; a < blocks.size() && !found_; ++a)
      for (std::size_t b = a; b < blocks.size() && !found_ && n_tried_ < kMostTried; ++b)
        if (meet(blocks[a].box, blocks[b].box)) test({blocks[a].i, blocks[a].j}, {blocks[b].i, blocks[b].j});
    return found_;
  }

 private:
  void test(Cell a, Cell b) {
    const int n = grid_.n();
    for (int i = a.i; i < std::min(a.i + kBlock, n); ++i)
      for (int j = a.j; j < std::min(a.j + kBlock, n); ++j) {
        for (int k = b.i; k < std::min(b.i + kBlock, n); ++k)
          for (int l = b.j; l < std::min(b.j + kBlock, n); ++l)
            if (!found_ && n_tried_ < kMostTried && meet(boxes_[i * n + j], boxes_[k * n + l]) &&
                are_apart({i, j}, {k, l}) && cross_in({i, j}, {k, l}))
              try_from({i, j}, {k, l});
      }
  }

  /// Each pair once; across a seam neighbours are neighbours, too; rows along the bounds share poles.
  bool are_apart(Cell a, Cell b) const {
    const int n = grid_.n();
    if (a.i * n + a.j >= b.i * n + b.j) return false;
    const auto steps = [&](int p, int q, bool is_closed) {
      const int d = std::abs(p - q);
      return is_closed ? std::min(d, n - d) : d;
    };
    const auto on_bounds = [&](Cell c) { return c.i == 0 || c.j == 0 || c.i == n - 1 || c.j == n - 1; };
    if (on_bounds(a) && on_bounds(b)) return false;
    return steps(a.i, b.i, closed_u_) > 1 || steps(a.j, b.j, closed_v_) > 1;
  }

  bool cross_in(Cell a, Cell b) const {
    const auto halves = [&](Cell c) {
      const Vec3 p = grid_.x(c.i, c.j), q = grid_.x(c.i + 1, c.j), r = grid_.x(c.i + 1, c.j + 1),
                 s = grid_.x(c.i, c.j + 1);
      return std::array<Corners, 2>{Corners{p, q, r}, Corners{p, r, s}};
    };
    for (const Corners& t : halves(a))
      for (const Corners& r : halves(b))
        if (pierces(t, r) || pierces(r, t)) return true;
    return false;
  }

  void try_from(Cell a, Cell b) {
    ++n_tried_;
    const auto p =
        common_point(s_, grid_.at(a.i + 0.5, a.j + 0.5), s_, grid_.at(b.i + 0.5, b.j + 0.5), 1e-9 * grid_.extent());
    if (p && p->sine > kLeastSine && are_two_places(*p) && is_off_bounds(p->uv_a, p->x) &&
        is_off_bounds(p->uv_b, p->x) && is_inside_(p->uv_a) && is_inside_(p->uv_b))
      found_ = p;
  }

  /// Does the surface go away from the point between them, whichever way?
  bool are_two_places(const CommonPoint& p) const {
    const auto goes_away = [&](Vec2 a, Vec2 b) {
      return distance(s_.point(within(s_, 0.5 * (a + b))), p.x) > std::max(tolerance_, kBetween * grid_.extent());
    };
    const Vec2 wrapped{p.uv_b.x + (p.uv_b.x < p.uv_a.x ? 1 : -1) * (s_.u_max() - s_.u_min()), p.uv_b.y};
    const Vec2 turned{p.uv_b.x, p.uv_b.y + (p.uv_b.y < p.uv_a.y ? 1 : -1) * (s_.v_max() - s_.v_min())};
    const double cell_u = (s_.u_max() - s_.u_min()) / grid_.n(), cell_v = (s_.v_max() - s_.v_min()) / grid_.n();
    const auto is_far = [&](Vec2 b) {
      return std::abs(b.x - p.uv_a.x) > 0.25 * cell_u || std::abs(b.y - p.uv_a.y) > 0.25 * cell_v;
    };
    return goes_away(p.uv_a, p.uv_b) && (!closed_u_ || is_far(wrapped)) && (!closed_v_ || is_far(turned));
  }

  bool is_off_bounds(Vec2 uv, Vec3 x) const {
    for (const Vec2 side :
         {Vec2{s_.u_min(), uv.y}, Vec2{s_.u_max(), uv.y}, Vec2{uv.x, s_.v_min()}, Vec2{uv.x, s_.v_max()}})
      if (distance(s_.point(side), x) <= tolerance_) return false;
    return true;
  }

  const Surface& s_;
  const Grid& grid_;
  double tolerance_;
  const std::function<bool(Vec2)>& is_inside_;
  bool closed_u_ = true, closed_v_ = true;
  std::vector<Box3> boxes_;  // [n * n] of the cells
  int n_tried_ = 0;
  std::optional<CommonPoint> found_;
};

/// Lines across one direction of a surface, at shares of its range.
class Pinch {
 public:
  Pinch(const Surface& surface, bool is_along_u) : s_(surface), is_along_u_(is_along_u) {}

  /// The first line at which the normal turns over, and the surface shrinks.
  std::optional<Vec3> find(double tolerance, const std::function<bool(Vec2)>& is_inside) const {
    for (const double across : {0.3, 0.6}) {
      const std::vector<Vec3> normals = normals_along(across);
      for (int k = 1; k + 2 < kLines; ++k) {
        const double a = static_cast<double>(k) / kLines, b = static_cast<double>(k + 1) / kLines;
        if (!(dot(normals[k - 1], normals[k]) < -kTurned)) continue;
        const double at = turn(a, b, across);
        if (length(at) <= tolerance && is_inside(uv(a, across)) && is_inside(uv(b, across)))
          return s_.point(uv(at, across));
      }
    }
    return std::nullopt;
  }

 private:
  static constexpr int kLines = 64, kBisections = 40, kSamples = 16;
  static constexpr double kTurned = 0.5;  // cosine

  Vec2 uv(double along, double across) const {
    const double u = is_along_u_ ? along : across, v = is_along_u_ ? across : along;
    return {s_.u_min() + u * (s_.u_max() - s_.u_min()), s_.v_min() + v * (s_.v_max() - s_.v_min())};
  }
  Vec3 normal(double along, double across) const {
    const SurfacePoint p = s_.evaluate(uv(along, across));
    return normalized(cross(p.du, p.dv));
  }
  /// At k / kLines along, 0 < k < kLines - 1.
  std::vector<Vec3> normals_along(double across) const {
    std::vector<Vec2> places;
    for (int k = 1; k + 1 < kLines; ++k) places.push_back(uv(static_cast<double>(k) / kLines, across));
    std::vector<SurfacePoint> points(places.size());
    s_.evaluate_batch(places, points);
    std::vector<Vec3> normals;
    for (const SurfacePoint& p : points) normals.push_back(normalized(cross(p.du, p.dv)));
    return normals;
  }
  double turn(double a, double b, double across) const {
    const Vec3 before = normal(a, across);
    for (int k = 0; k < kBisections; ++k) (dot(before, normal(0.5 * (a + b), across)) > 0 ? a : b) = 0.5 * (a + b);
    return 0.5 * (a + b);
  }
  double length(double along) const {
    double sum = 0;
    for (int k = 0; k < kSamples; ++k)
      sum += distance(s_.point(uv(along, static_cast<double>(k) / kSamples)),
                      s_.point(uv(along, static_cast<double>(k + 1) / kSamples)));
    return sum;
  }

  const Surface& s_;
  bool is_along_u_;
};

}  // namespace

std::optional<CommonPoint> common_point(const Surface& a, Vec2 guess_a, const Surface& b, Vec2 guess_b,
                                        double precision) {
  Vec2 p = within(a, guess_a), q = within(b, guess_b);
  for (int k = 0; k < kSteps; ++k) {
    const SurfacePoint on_a = a.evaluate(p), on_b = b.evaluate(q);
    const Vec3 r = on_a.x - on_b.x;
    if (norm(r) <= precision) {
      const Vec3 n = normalized(cross(on_a.du, on_a.dv)), m = normalized(cross(on_b.du, on_b.dv));
      if (norm2(n) == 0 || norm2(m) == 0) return std::nullopt;
      return CommonPoint{0.5 * (on_a.x + on_b.x), p, q, norm(cross(n, m))};
    }
    const auto y = solve({on_a.du, on_a.dv, on_b.du, on_b.dv}, r);
    if (!y || !is_finite(*y)) return std::nullopt;
    p = within(a, p - Vec2{dot(on_a.du, *y), dot(on_a.dv, *y)});
    q = within(b, q + Vec2{dot(on_b.du, *y), dot(on_b.dv, *y)});
  }
  return std::nullopt;
}

std::optional<CommonPoint> find_self_crossing(const Surface& surface, double tolerance,
                                              const std::function<bool(Vec2)>& is_inside) {
  const Grid coarse(surface, kCoarse);
  if (!coarse.is_sound() || coarse.is_open_to_one_side()) return std::nullopt;
  const Grid fine(surface, kFine);
  if (!fine.is_sound()) return std::nullopt;
  return SelfCrossing(surface, fine, tolerance, is_inside).find();
}

std::optional<Vec3> find_pinch(const Surface& surface, double tolerance, const std::function<bool(Vec2)>& is_inside) {
  for (const bool is_along_u : {true, false})
    if (const auto place = Pinch(surface, is_along_u).find(tolerance, is_inside)) return place;
  return std::nullopt;
}

}  // namespace st
