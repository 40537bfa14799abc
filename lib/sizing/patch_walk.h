// Halving the parameter rectangle of a trimmed surface until each patch is small enough. Internal to sizing.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "base/boxes.h"
#include "base/current_work.h"
#include "geometry/shape/chart_surface.h"
#include "geometry/shape/composite_surface.h"
#include "geometry/shape/loop_polygons.h"
#include "geometry/shape/surface.h"

namespace st {

/// A rectangle in (u,v) with probes at its corners, the middles of its sides and its middle: probe[3 * row + column],
/// rows in v. Probe: a struct with the position `Vec3 x`.
template <class Probe>
struct Patch {
  double u[3], v[3];
  std::array<Probe, 9> probe;
  std::array<bool, 9> is_inside{};      // inside the loops
  std::span<const std::int32_t> sides;  // sides of the loops that meet it
  int n_inside = 0;
  std::uint16_t is_known = 0, is_contained = 0;  // a bit per probe: whether the answer of contains() is known, and the
                                                 // answer
  int n_splits = 0, n_doubts = 0;

  Vec2 uv(std::size_t k) const { return {u[k % 3], v[k / 3]}; }
};

struct PatchSize {
  Vec3 center;        // of the bounding box of the probes
  double extent = 0;  // its largest side
};

template <class Probe>
PatchSize measure(const Patch<Probe>& patch) {
  Box3 box;
  for (const Probe& q : patch.probe) box.add(q.x);
  const Vec3 e = box.hi - box.lo;
  return {box.center(), std::max({e.x, e.y, e.z})};
}

/// Longest row and longest column of a patch.
struct PatchSpans {
  double along_u = 0, along_v = 0;
};

template <class Probe>
PatchSpans measure_spans(const Patch<Probe>& patch) {
  const auto& p = patch.probe;
  PatchSpans spans;
  for (std::size_t k = 0; k < 3; ++k) {
    spans.along_u =
        std::max(spans.along_u, distance(p[3 * k].x, p[3 * k + 1].x) + distance(p[3 * k + 1].x, p[3 * k + 2].x));
    spans.along_v = std::max(spans.along_v, distance(p[k].x, p[3 + k].x) + distance(p[3 + k].x, p[6 + k].x));
  }
  return spans;
}

/// Area of the patch's four quarters, each times the share of its corners inside the loops.
template <class Probe>
double inside_area(const Patch<Probe>& patch) {
  double area = 0;
  for (const std::size_t k : {0u, 1u, 3u, 4u}) {
    const auto& p = patch.probe;
    const double quarter = 0.5 * norm(cross(p[k + 4].x - p[k].x, p[k + 3].x - p[k + 1].x));
    area += 0.25 * quarter *
            (patch.is_inside[k] + patch.is_inside[k + 1] + patch.is_inside[k + 3] + patch.is_inside[k + 4]);
  }
  return area;
}

/// What of a patch lies inside the loops: the middle of its bounding rectangle in (u,v), and half the longest ways
/// across, in space.
struct PatchPart {
  Vec2 uv;
  Vec3 center, along_u, along_v;
};

/// Adds the piece of a line that lies inside a box, if any.
inline void add_clipped(Vec2 a, Vec2 b, const Box2& clip, Box2& box) {
  const Vec2 d = b - a;
  double t0 = 0, t1 = 1;
  const auto cut = [&](double at, double along, double lo, double hi) {
    if (along == 0) return lo <= at && at <= hi;
    const double enter = ((along > 0 ? lo : hi) - at) / along, leave = ((along > 0 ? hi : lo) - at) / along;
    t0 = std::max(t0, enter);
    t1 = std::min(t1, leave);
    return true;
  };
  if (!cut(a.x, d.x, clip.lo.x, clip.hi.x) || !cut(a.y, d.y, clip.lo.y, clip.hi.y) || t0 > t1) return;
  box.add(a + t0 * d);
  box.add(a + t1 * d);
}

/// Between the probes, without further evaluations. Not of patches that must_split() splits.
template <class Probe>
PatchPart part_inside(const Patch<Probe>& patch, const LoopPolygons& loops) {
  const auto widen = [](Vec3& half, Vec3 side) {
    if (0.25 * norm2(side) > norm2(half)) half = 0.5 * side;
  };
  const auto is_half_way = [](const double(&x)[3]) { return 2 * (x[1] - x[0]) == x[2] - x[0]; };
  if (patch.sides.empty() && is_half_way(patch.u) && is_half_way(patch.v)) {  // what follows, of the whole patch
    const auto& p = patch.probe;
    PatchPart part{patch.uv(4), p[4].x, {}, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      widen(part.along_u, p[3 * k + 2].x - p[3 * k].x);
      widen(part.along_v, p[k + 6].x - p[k].x);
    }
    return part;
  }
  const Box2 whole{{patch.u[0], patch.v[0]}, {patch.u[2], patch.v[2]}};
  Box2 box;
  for (const std::int32_t s : patch.sides) add_clipped(loops.sides()[s].a, loops.sides()[s].b, whole, box);
  for (std::size_t k = 0; k < 9; ++k)
    if (patch.is_inside[k]) box.add(patch.uv(k));
  if (box.is_empty()) box = whole;
  const auto place = [](double x, double lo, double size) { return size > 0 ? 2 * (x - lo) / size : 0; };
  const auto at = [&](double u, double v) {  // bilinear in each quarter
    const double s = place(u, whole.lo.x, whole.size().x), t = place(v, whole.lo.y, whole.size().y);
    const std::size_t i = s > 1, j = t > 1, k = 3 * j + i;
    const double a = s - static_cast<double>(i), b = t - static_cast<double>(j);
    return (1 - b) * ((1 - a) * patch.probe[k].x + a * patch.probe[k + 1].x) +
           b * ((1 - a) * patch.probe[k + 3].x + a * patch.probe[k + 4].x);
  };
  const Vec2 c = box.center();
  PatchPart part{c, at(c.x, c.y), {}, {}};
  for (const double v : {box.lo.y, c.y, box.hi.y}) widen(part.along_u, at(box.hi.x, v) - at(box.lo.x, v));
  for (const double u : {box.lo.x, c.x, box.hi.x}) widen(part.along_v, at(u, box.hi.y) - at(u, box.lo.y));
  return part;
}

/// Of 8 x 8 cells of a patch those that have their middle inside the loops; where none has, those that the loops cut:
/// bit 8 * row + column, rows in v.
template <class Probe>
std::uint64_t cells_inside(const Patch<Probe>& patch, const LoopPolygons& loops) {
  if (patch.sides.empty()) return ~std::uint64_t{0};
  const Box2 whole{{patch.u[0], patch.v[0]}, {patch.u[2], patch.v[2]}};
  const Vec2 cell = 0.125 * whole.size();
  std::uint64_t inside = 0;
  for (int k = 0; k < 64; ++k) {
    const int row = k / 8, column = k % 8;
    const Vec2 middle = whole.lo + Vec2{(column + 0.5) * cell.x, (row + 0.5) * cell.y};
    inside |= static_cast<std::uint64_t>(loops.contains(middle)) << k;
  }
  if (inside != 0) return inside;
  for (const std::int32_t i : patch.sides) {
    const LoopSide& side = loops.sides()[i];
    Box2 piece;
    add_clipped(side.a, side.b, whole, piece);
    if (piece.is_empty()) continue;
    const bool rises = (side.b.x - side.a.x) * (side.b.y - side.a.y) >= 0;
    const Vec2 begin{piece.lo.x, rises ? piece.lo.y : piece.hi.y}, end{piece.hi.x, rises ? piece.hi.y : piece.lo.y};
    constexpr int kSteps = 16;  // two per cell: a corner that is cut off counts as outside
    for (int k = 0; k <= kSteps; ++k) {
      const Vec2 x = begin + static_cast<double>(k) / kSteps * (end - begin) - whole.lo;
      const int column = std::clamp(static_cast<int>(x.x / cell.x), 0, 7);
      const int row = std::clamp(static_cast<int>(x.y / cell.y), 0, 7);
      inside |= std::uint64_t{1} << (8 * row + column);
    }
  }
  return inside;
}

/// Walks the patches of a trimmed surface that lie inside its loops or are cut by them. `Visitor` has
///   Probe probe(Vec2 uv)                                       evaluates one point;
///   bool must_split(const PatchSize&)                          true: split it, whatever of it is inside (is_inside is
///   not yet known); bool visit(const Patch<Probe>&, const PatchSize&, int& n_doubts)   true: split it; false: done
///   with it.
/// A patch is split across its longer side in space, of a composite in its chart, and not more than 60
/// times. Throws LateWork.
template <class Probe, class Visitor>
class PatchWalk {
 public:
  PatchWalk(const Surface& surface, const LoopPolygons& loops, Visitor& visitor)
      : composite_(dynamic_cast<const CompositeSurface*>(&surface)),
        stretch_(stretch_of(surface)),
        loops_(loops),
        visitor_(visitor),
        sides_(kMaxSplits + 2) {
    sides_[0].resize(loops.sides().size());
    for (std::size_t i = 0; i < sides_[0].size(); ++i) sides_[0][i] = static_cast<std::int32_t>(i);
  }

  /// Walks one rectangle, cut into n x n to start with.
  void walk(double u0, double u1, double v0, double v1, int n) {
    for (int b = 0; b < n; ++b)
      for (int a = 0; a < n; ++a) {
        Patch<Probe> patch;
        set_lines(patch.u, u0 + (u1 - u0) * a / n, u0 + (u1 - u0) * (a + 1) / n);
        set_lines(patch.v, v0 + (v1 - v0) * b / n, v0 + (v1 - v0) * (b + 1) / n);
        for (std::size_t k = 0; k < 9; ++k) patch.probe[k] = visitor_.probe(patch.uv(k));
        visit(patch, sides_[0], false);
      }
  }

 private:
  static constexpr int kMaxSplits = 60;

  static void set_lines(double (&x)[3], double lo, double hi) {
    x[0] = lo;
    x[1] = 0.5 * (lo + hi);
    x[2] = hi;
  }

  void visit(Patch<Probe>& patch, std::span<const std::int32_t> candidates, bool is_inside) {
    throw_if_late();
    collect_sides(patch, candidates);
    if (patch.sides.empty() && !is_inside && !loops_.contains(patch.uv(4))) return;
    const PatchSize size = size_of(patch);
    int n_doubts = patch.n_doubts;
    if (!visitor_.must_split(size)) {
      classify(patch);
      if (!visitor_.visit(patch, size, n_doubts)) return;
    }
    if (patch.n_splits == kMaxSplits) return;
    patch.n_doubts = n_doubts;
    const PatchSpans spans = spans_of(patch);
    split(patch, spans.along_u >= spans.along_v);
  }

  static double stretch_of(const Surface& surface) {
    if (const auto* s = dynamic_cast<const CompositeSurface*>(&surface)) return s->largest_stretch();
    if (const auto* s = dynamic_cast<const ChartSurface*>(&surface)) return s->largest_stretch();
    return std::numeric_limits<double>::infinity();
  }

  /// Places may jump by a distance that no split makes smaller: those of a composite between members and beside the
  /// patch, those of facets where these overlap in the chart, which is believed once splits have not helped. The chart
  /// itself has no jumps.
  bool is_measured_in_chart(const Patch<Probe>& patch) const {
    constexpr int kSplitsToDoubt = 30;  // 1 / 32,768 of a side of the surface, in each direction
    return composite_ || patch.n_splits >= kSplitsToDoubt;
  }
  PatchSize size_of(const Patch<Probe>& patch) const {
    PatchSize size = measure(patch);
    if (is_measured_in_chart(patch)) size.extent = std::min(size.extent, stretch_ * norm(patch.uv(8) - patch.uv(0)));
    return size;
  }
  PatchSpans spans_of(const Patch<Probe>& patch) const {
    const PatchSpans in_chart{patch.u[2] - patch.u[0], patch.v[2] - patch.v[0]};
    if (composite_) return in_chart;
    const PatchSpans in_space = measure_spans(patch);
    const bool jumps = is_measured_in_chart(patch) && std::max(in_space.along_u, in_space.along_v) >
                                                          2 * stretch_ * std::max(in_chart.along_u, in_chart.along_v);
    return jumps ? in_chart : in_space;
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
        inherit(patch, at(half), child, at(0));
        inherit(patch, at(half + 1), child, at(2));
        child.probe[at(1)] = visitor_.probe(child.uv(at(1)));
      }
      visit(child, patch.sides, patch.sides.empty());
    }
  }

  static void inherit(const Patch<Probe>& patch, std::size_t from, Patch<Probe>& child, std::size_t to) {
    child.probe[to] = patch.probe[from];
    child.is_known |= static_cast<std::uint16_t>((patch.is_known >> from & 1) << to);
    child.is_contained |= static_cast<std::uint16_t>((patch.is_contained >> from & 1) << to);
  }

  /// Those of the candidates that meet the patch. One list per depth: a patch's own is in use while its parts are
  /// walked.
  void collect_sides(Patch<Probe>& patch, std::span<const std::int32_t> candidates) {
    std::vector<std::int32_t>& own = sides_[static_cast<std::size_t>(patch.n_splits) + 1];
    own.clear();
    for (const std::int32_t s : candidates)
      if (meets(patch, loops_.sides()[s])) own.push_back(s);
    patch.sides = own;
  }

  /// Sets is_inside and n_inside of a patch that is inside as a whole or cut.
  void classify(Patch<Probe>& patch) const {
    if (patch.sides.empty()) {
      patch.is_inside.fill(true);
      patch.n_inside = 9;
      return;
    }
    for (std::size_t k = 0; k < 9; ++k) {
      if (!(patch.is_known >> k & 1)) {
        patch.is_known |= static_cast<std::uint16_t>(1 << k);
        patch.is_contained |= static_cast<std::uint16_t>(loops_.contains(patch.uv(k)) << k);
      }
      patch.is_inside[k] = (patch.is_contained >> k & 1) || is_on_loop(patch, patch.uv(k));
      patch.n_inside += patch.is_inside[k];
    }
  }

  /// Probes on a loop count as inside: faces often end where they are bent most (a leading edge), and exactly on an
  /// iso-line.
  bool is_on_loop(const Patch<Probe>& patch, Vec2 uv) const {
    constexpr double kOnLoop = 0.02;  // distance from a side, patch widths
    const Vec2 scale{1 / (patch.u[2] - patch.u[0]), 1 / (patch.v[2] - patch.v[0])};
    for (const std::int32_t i : patch.sides) {
      const LoopSide& s = loops_.sides()[i];
      const Vec2 d{(s.b.x - s.a.x) * scale.x, (s.b.y - s.a.y) * scale.y},
          r{(uv.x - s.a.x) * scale.x, (uv.y - s.a.y) * scale.y};
      const double d2 = dot(d, d), t = d2 > 0 ? std::clamp(dot(r, d) / d2, 0.0, 1.0) : 0;
      const Vec2 off = r - t * d;
      if (dot(off, off) < kOnLoop * kOnLoop) return true;
    }
    return false;
  }

  static bool meets(const Patch<Probe>& patch, const LoopSide& s) {
    if (std::max(s.a.x, s.b.x) < patch.u[0] || std::min(s.a.x, s.b.x) > patch.u[2] ||
        std::max(s.a.y, s.b.y) < patch.v[0] || std::min(s.a.y, s.b.y) > patch.v[2])
      return false;
    const Vec2 d = s.b - s.a;
    int n_left = 0;  // of the four corners, seen along the side
    for (const std::size_t k : {0u, 2u, 6u, 8u}) n_left += cross(d, patch.uv(k) - s.a) > 0;
    return d == Vec2{} || (n_left != 0 && n_left != 4);
  }

  const CompositeSurface* const composite_;  // null for all others
  const double stretch_;                     // in space over the chart at most; infinite where nothing is known
  const LoopPolygons& loops_;
  Visitor& visitor_;
  std::vector<std::vector<std::int32_t>> sides_;  // all; then by depth, of the patches on the way down
};

}  // namespace st
