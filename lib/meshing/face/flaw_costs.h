// What is wrong with the triangles of a stretched mesh, as numbers: internal to lib/meshing.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "mesh/row_quality.h"
#include "meshing/face/flaw_mending.h"
#include "meshing/face/triangle_shape.h"

namespace st {

/// Costs of angles, of steps of size, and of what quality in the metric lacks outside rows. The least is the best mesh.
class FlawCosts {
 public:
  using Corners = std::array<std::int32_t, 3>;
  static constexpr double kUnsound = 1e9;  ///< above all others

  explicit FlawCosts(const Triangulation& mesh) : m_(mesh) {}

  Vec3 x(std::int32_t node) const { return m_.nodes[node].x; }
  static Corners corners(const PlaneTriangle& t) { return {t.v[0], t.v[1], t.v[2]}; }
  double area(const Corners& c) const { return norm(cross(x(c[1]) - x(c[0]), x(c[2]) - x(c[0]))); }
  /// 0: outside, or none.
  double area(std::int32_t t) const {
    if (t == kNone || m_.triangles[t].state == kOutside || m_.triangles[t].state == kDead) return 0;
    return area(corners(m_.triangles[t]));
  }

  /// Negative cosine of the largest angle in space, 0 where that is not obtuse.
  double bluntness(const Corners& c) const {
    const Vec3 side[3] = {x(c[1]) - x(c[0]), x(c[2]) - x(c[1]), x(c[0]) - x(c[2])};
    const double n[3] = {norm2(side[0]), norm2(side[1]), norm2(side[2])};
    const int k = n[0] >= n[1] && n[0] >= n[2] ? 0 : n[1] >= n[2] ? 1 : 2, i = (k + 1) % 3, j = (k + 2) % 3;
    const double product = dot(side[i], side[j]);
    return product > 0 ? product / std::sqrt(std::max(n[i] * n[j], 1e-300)) : 0;
  }
  /// 1 where one of the areas is none.
  static double growth(double a, double b) { return a > 0 && b > 0 ? std::sqrt(std::max(a, b) / std::min(a, b)) : 1; }
  static double angle_cost(double bluntness) {
    return cost_above(bluntness, kAngleFrom, kAngleUnit) + (is_blunt(bluntness) ? kFlawCost : 0);
  }
  static double growth_cost(double a, double b) {
    if (std::max(a, b) <= kGrowthFrom * kGrowthFrom * std::min(a, b)) return 0;  // as nearly all
    const double ratio = growth(a, b);
    return cost_above(ratio, kGrowthFrom, kGrowthUnit) + (ratio > kMostGrowth ? kFlawCost : 0);
  }
  double shape_cost(const Corners& c) const { return angle_cost(bluntness(c)) + lack_cost(c); }
  double lack_cost(const Corners& c) const { return cost_above(1 - quality(c), kLackFrom, kLackUnit); }
  static bool is_blunt(double bluntness) { return bluntness > -std::cos(kMostAngle); }

  /// Half of a laid quadrilateral that st-check takes for one of a row: the diagonal is the longest side of both.
  bool is_in_row(std::int32_t t) const {
    const PlaneTriangle& r = m_.triangles[t];
    if (r.state != kLaid) return false;
    const Sides own(m_, r);
    const std::int32_t o = r.n[own.longest];
    if (o == kNone || m_.triangles[o].state != kLaid) return false;
    const PlaneTriangle& s = m_.triangles[o];
    const Sides other(m_, s);
    if (s.n[other.longest] != t) return false;
    // squares of opposite sides
    const double first = own.square[(own.longest + 1) % 3] + other.square[(other.longest + 1) % 3];
    const double second = own.square[(own.longest + 2) % 3] + other.square[(other.longest + 2) % 3];
    if (std::max(first, second) > kRowAspect * kRowAspect * std::min(first, second)) return true;
    return own.is_right_angled() && other.is_right_angled();
  }
  /// Across the longest side; kNone: none.
  std::int32_t beyond_longest(std::int32_t t) const { return m_.triangles[t].n[Sides(m_, m_.triangles[t]).longest]; }

  /// Larger angles or steps than asked for, or too little quality outside rows.
  bool is_flawed(std::int32_t t) const {
    const double own = area(t);
    if (!(own > 0)) return false;
    const Corners c = corners(m_.triangles[t]);
    if (is_blunt(bluntness(c)) || (!is_in_row(t) && 1 - quality(c) > kMostLack)) return true;
    for (const std::int32_t other : m_.triangles[t].n)
      if (growth(own, area(other)) > kMostGrowth) return true;
    return false;
  }

  /// Of these triangles as they are, and of their steps; where it is above `most`, of the first ones alone.
  double cost(std::span<const std::int32_t> triangles, double most = kUnsound) const {
    double sum = 0;
    for (const std::int32_t t : triangles) {
      if (sum > most) return sum;
      const double own = area(t);
      if (!(own > 0)) continue;
      const Corners c = corners(m_.triangles[t]);
      sum += is_in_row(t) ? angle_cost(bluntness(c)) : shape_cost(c);
      for (const std::int32_t other : m_.triangles[t].n) sum += growth_cost(own, area(other));
    }
    return sum;
  }

  /// Against the surface's normals, or nearly. One of these may be wrong, as where the parametrisation is singular.
  bool is_steep(const Corners& c) const {
    const Vec3 n = cross(x(c[1]) - x(c[0]), x(c[2]) - x(c[0]));
    std::array<double, 3> along;
    std::ranges::transform(c, along.begin(), [&](std::int32_t i) { return dot(n, m_.nodes[i].normal); });
    std::ranges::sort(along);
    return !(along[0] > kSteepCosine * norm(n) || along[1] > kAlongCosine * norm(n));
  }
  double quality(const Corners& c) const { return metric_quality(m_.nodes[c[0]], m_.nodes[c[1]], m_.nodes[c[2]]); }

 private:
  // Where each number comes from: docs/design/heuristics.md.
  static constexpr double kSteepCosine = 0.5;   // between the normals of a triangle and of the surface: no change makes
                                                // less
  static constexpr double kAlongCosine = 0.95;  // likewise of two nodes, if the third has a wrong one
  // costs: squares of what is above, in these units
  static constexpr double kAngleFrom = 0.75;  // of the negative cosine of the largest angle
  static constexpr double kAngleUnit = 0.1;
  static constexpr double kGrowthFrom = 2.1;  // of steps of size
  static constexpr double kGrowthUnit = 0.2;
  static constexpr double kLackFrom = 0.134;  // of what a triangle's quality lacks of 1: half a square
  static constexpr double kLackUnit = 0.1;
  static constexpr double kMostLack = 0.15;          // triangles outside rows that lack more are flawed
  static constexpr double kFlawCost = 1;             // more where an angle or a step is above what is asked for
  static constexpr double kMostCost = 10;            // of one angle or step
  static constexpr double kContinuedCosine = 0.342;  // shorter ones of rows have angles so near to 90 degrees

  struct Sides {
    std::array<double, 3> square;
    int longest;
    Sides(const Triangulation& m, const PlaneTriangle& t) {
      for (int k = 0; k < 3; ++k) square[k] = norm2(m.nodes[t.v[(k + 1) % 3]].x - m.nodes[t.v[k]].x);
      longest = static_cast<int>(std::ranges::max_element(square) - square.begin());
    }
    bool is_right_angled() const {
      const double a = square[(longest + 1) % 3], b = square[(longest + 2) % 3], twice = square[longest] - a - b;
      return twice * twice < 4 * kContinuedCosine * kContinuedCosine * a * b;
    }
  };

  static double cost_above(double value, double from, double unit) {
    const double above = std::max(0.0, (value - from) / unit);
    return std::min(kMostCost, above * above);
  }

  const Triangulation& m_;
};

}  // namespace st
