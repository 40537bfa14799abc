// Halving the parameter rectangle of a trimmed surface until each patch is small enough. Internal to sizing.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/surface.h"
#include "sizing/loop_polygon.h"

namespace st {

/// A rectangle in (u,v) with probes at its corners, the middles of its sides and its middle: probe[3 * row + column], rows in v.
/// Probe: a struct with the position `Vec3 x`.
template <class Probe>
struct Patch {
  double u[3], v[3];
  std::array<Probe, 9> probe;
  std::array<bool, 9> is_inside{};  // inside the loops
  std::vector<std::int32_t> sides;  // sides of the loops that meet it
  int n_inside = 0;
  int n_splits = 0, n_doubts = 0;

  Vec2 uv(std::size_t k) const { return {u[k % 3], v[k / 3]}; }
};

struct PatchSize {
  Vec3 center;                      // of the bounding box of the probes
  double extent = 0;                // its largest side
  double along_u = 0, along_v = 0;  // longest row, longest column
};

template <class Probe>
PatchSize measure(const Patch<Probe>& patch) {
  const auto& p = patch.probe;
  PatchSize size;
  Box3 box;
  for (const Probe& q : p) box.add(q.x);
  const Vec3 e = box.hi - box.lo;
  size.center = box.center();
  size.extent = std::max({e.x, e.y, e.z});
  for (std::size_t k = 0; k < 3; ++k) {
    size.along_u = std::max(size.along_u, distance(p[3 * k].x, p[3 * k + 1].x) + distance(p[3 * k + 1].x, p[3 * k + 2].x));
    size.along_v = std::max(size.along_v, distance(p[k].x, p[3 + k].x) + distance(p[3 + k].x, p[6 + k].x));
  }
  return size;
}

/// Area of the patch's four quarters, each times the share of its corners inside the loops.
template <class Probe>
double inside_area(const Patch<Probe>& patch) {
  double area = 0;
  for (const std::size_t k : {0u, 1u, 3u, 4u}) {
    const auto& p = patch.probe;
    const double quarter = 0.5 * norm(cross(p[k + 4].x - p[k].x, p[k + 3].x - p[k + 1].x));
    area += 0.25 * quarter * (patch.is_inside[k] + patch.is_inside[k + 1] + patch.is_inside[k + 3] + patch.is_inside[k + 4]);
  }
  return area;
}

/// Walks the patches of a trimmed surface that lie inside its loops or are cut by them. `Visitor` has
///   Probe probe(Vec2 uv)                                       evaluates one point;
///   bool visit(const Patch<Probe>&, const PatchSize&, int& n_doubts)   true: split it; false: done with it.
/// A patch is split across its longer side in space, and not more than 60 times.
template <class Probe, class Visitor>
class PatchWalk {
 public:
  PatchWalk(const LoopPolygons& loops, Visitor& visitor) : loops_(loops), visitor_(visitor) {
    all_sides_.resize(loops.sides().size());
    for (std::size_t i = 0; i < all_sides_.size(); ++i) all_sides_[i] = static_cast<std::int32_t>(i);
  }

  /// Walks one rectangle, cut into n x n to start with.
  void walk(double u0, double u1, double v0, double v1, int n) {
    for (int b = 0; b < n; ++b)
      for (int a = 0; a < n; ++a) {
        Patch<Probe> patch;
        set_lines(patch.u, u0 + (u1 - u0) * a / n, u0 + (u1 - u0) * (a + 1) / n);
        set_lines(patch.v, v0 + (v1 - v0) * b / n, v0 + (v1 - v0) * (b + 1) / n);
        for (std::size_t k = 0; k < 9; ++k) patch.probe[k] = visitor_.probe(patch.uv(k));
        visit(patch, all_sides_);
      }
  }

 private:
  static constexpr int kMaxSplits = 60;

  static void set_lines(double (&x)[3], double lo, double hi) {
    x[0] = lo;
    x[1] = 0.5 * (lo + hi);
    x[2] = hi;
  }

  void visit(Patch<Probe>& patch, const std::vector<std::int32_t>& candidates) {
    if (!classify(patch, candidates)) return;
    const PatchSize size = measure(patch);
    int n_doubts = patch.n_doubts;
    if (!visitor_.visit(patch, size, n_doubts) || patch.n_splits == kMaxSplits) return;
    patch.n_doubts = n_doubts;
    split(patch, size.along_u >= size.along_v);
  }

  void split(const Patch<Probe>& patch, bool along_u) {
    const double(&old)[3] = along_u ? patch.u : patch.v;
    for (std::size_t half = 0; half < 2; ++half) {
      Patch<Probe> child;
      std::copy(patch.u, patch.u + 3, child.u);
      std::copy(patch.v, patch.v + 3, child.v);
      child.n_splits = patch.n_splits + 1;
      child.n_doubts = patch.n_doubts;
      set_lines(along_u ? child.u : child.v, old[half], old[half + 1]);
      for (std::size_t k = 0; k < 3; ++k) {  // across: two lines of probes are the parent's, the middle one is new
        const auto at = [&](std::size_t line) { return along_u ? 3 * k + line : 3 * line + k; };
        child.probe[at(0)] = patch.probe[at(half)];
        child.probe[at(2)] = patch.probe[at(half + 1)];
        child.probe[at(1)] = visitor_.probe(child.uv(at(1)));
      }
      visit(child, patch.sides);
    }
  }

  /// Sets sides, is_inside, n_inside. False: the patch lies outside the loops.
  bool classify(Patch<Probe>& patch, const std::vector<std::int32_t>& candidates) const {
    for (const std::int32_t s : candidates)
      if (meets(patch, loops_.sides()[s])) patch.sides.push_back(s);
    if (patch.sides.empty()) {
      if (!loops_.contains(patch.uv(4))) return false;
      patch.is_inside.fill(true);
      patch.n_inside = 9;
      return true;
    }
    for (std::size_t k = 0; k < 9; ++k) {
      patch.is_inside[k] = loops_.contains(patch.uv(k)) || is_on_loop(patch, patch.uv(k));
      patch.n_inside += patch.is_inside[k];
    }
    return true;
  }

  /// Probes on a loop count as inside: faces often end where they are bent most (a leading edge), and exactly on an iso-line.
  bool is_on_loop(const Patch<Probe>& patch, Vec2 uv) const {
    constexpr double kOnLoop = 0.02;  // distance from a side, patch widths
    const Vec2 scale{1 / (patch.u[2] - patch.u[0]), 1 / (patch.v[2] - patch.v[0])};
    for (const std::int32_t i : patch.sides) {
      const LoopSide& s = loops_.sides()[i];
      const Vec2 d{(s.b.x - s.a.x) * scale.x, (s.b.y - s.a.y) * scale.y}, r{(uv.x - s.a.x) * scale.x, (uv.y - s.a.y) * scale.y};
      const double d2 = dot(d, d), t = d2 > 0 ? std::clamp(dot(r, d) / d2, 0.0, 1.0) : 0;
      const Vec2 off = r - t * d;
      if (dot(off, off) < kOnLoop * kOnLoop) return true;
    }
    return false;
  }

  static bool meets(const Patch<Probe>& patch, const LoopSide& s) {
    if (std::max(s.a.x, s.b.x) < patch.u[0] || std::min(s.a.x, s.b.x) > patch.u[2] || std::max(s.a.y, s.b.y) < patch.v[0] ||
        std::min(s.a.y, s.b.y) > patch.v[2])
      return false;
    const Vec2 d = s.b - s.a;
    int n_left = 0;  // of the four corners, seen along the side
    for (const std::size_t k : {0u, 2u, 6u, 8u}) n_left += cross(d, patch.uv(k) - s.a) > 0;
    return d == Vec2{} || (n_left != 0 && n_left != 4);
  }

  const LoopPolygons& loops_;
  Visitor& visitor_;
  std::vector<std::int32_t> all_sides_;
};

}  // namespace st
