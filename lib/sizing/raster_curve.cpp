#include "sizing/raster_curve.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "base/current_work.h"
#include "sizing/cell_limit.h"
#include "sizing/line_stretch.h"

namespace st {
namespace {

constexpr int kFirstIntervals = 16;   // a full circle starts with 22.5 degrees each
constexpr int kMaxDepth = 24;         // halvings of a first interval
constexpr int kCornerHalvings = 12;   // a jump that survives 1/4096 of a quarter of the smallest length is a corner
constexpr double kCornerShare = 0.9;  // of the turning must survive
constexpr double kSmallRest = 0.01;   // of a segment: a shorter rest is added to the segment before it

/// Halves intervals of a curve until each is resolved, and measures them.
class CurveMeasurer {
 public:
  CurveMeasurer(const Curve& curve, const SamplingLimits& limits) : curve_(curve), limits_(limits) {}

  CurveTable run() {
    const double t0 = curve_.t_min(), step = (curve_.t_max() - t0) / kFirstIntervals;
    table_ = {{t0}, {0.0}, {0.0}, {}};
    CurvePoint a = curve_.evaluate(t0);
    for (int i = 1; i <= kFirstIntervals; ++i) {
      const double t = i == kFirstIntervals ? curve_.t_max() : t0 + i * step;
      const CurvePoint b = curve_.evaluate(t);
      measure(table_.t.back(), a, t, b, 0);
      a = b;
    }
    return std::move(table_);
  }

 private:
  void measure(double ta, const CurvePoint& a, double tb, const CurvePoint& b, int depth) {
    throw_if_late();
    require_samples(table_.t.size(), limits_.max_samples);
    const double tm = 0.5 * (ta + tb);
    const CurvePoint m = curve_.evaluate(tm);
    const double length = distance(a.x, m.x) + distance(m.x, b.x);
    const double turning = angle_between(a.d1, m.d1) + angle_between(m.d1, b.d1);
    const bool is_long = length > 0.5 * limits_.max_length;
    const bool is_bent = (turning > 0.25 * limits_.alpha || turning * length > 0.5 * limits_.chord) &&
                         length > 0.25 * limits_.min_length;
    if ((is_long || is_bent) && depth < kMaxDepth && ta < tm && tm < tb) {
      measure(ta, a, tm, m, depth + 1);
      measure(tm, m, tb, b, depth + 1);
      return;
    }
    const bool at_corner = turning > limits_.alpha && is_corner(ta, a, tb, b, turning);
    if (at_corner) table_.corners.push_back(table_.t.size() - 1);
    table_.t.push_back(tb);
    table_.s.push_back(table_.s.back() + length);
    table_.turning.push_back(table_.turning.back() + (at_corner ? 0.0 : turning));
  }

  /// Follows the half that turns more: a corner keeps its turning, an arc loses half of it each time.
  bool is_corner(double ta, CurvePoint a, double tb, CurvePoint b, double turning) const {
    for (int i = 0; i < kCornerHalvings; ++i) {
      const double tm = 0.5 * (ta + tb);
      const CurvePoint m = curve_.evaluate(tm);
      const double left = angle_between(a.d1, m.d1), right = angle_between(m.d1, b.d1);
      if (std::max(left, right) < kCornerShare * turning) return false;
      if (left > right) {
        tb = tm;
        b = m;
      } else {
        ta = tm;
        a = m;
      }
    }
    return true;
  }

  const Curve& curve_;
  const SamplingLimits& limits_;
  CurveTable table_;
};

/// y at x0 in the ascending table x -> y, from entry `i` on; i is moved to the interval that holds x0.
double interpolate(const std::vector<double>& x, const std::vector<double>& y, double x0, std::size_t& i) {
  while (i + 2 < x.size() && x[i + 1] < x0) ++i;
  const double width = x[i + 1] - x[i];
  return width > 0 ? y[i] + (y[i + 1] - y[i]) * std::clamp((x0 - x[i]) / width, 0.0, 1.0) : y[i + 1];
}

/// Walks one smooth piece of a measured curve.
class PieceWalker {
 public:
  PieceWalker(const Curve& curve, const CurveTable& table, const SamplingLimits& limits)
      : curve_(curve), table_(table), limits_(limits) {}

  void walk(std::size_t first, std::size_t last, std::int32_t cause, std::vector<RasterBox>& boxes) {
    const double end = table_.s[last];
    double s0 = table_.s[first];
    std::size_t i = first;
    Vec3 x0 = curve_.point(table_.t[first]);
    while (s0 < end) {
      interpolate(table_.s, table_.t, s0, i);
      const double s1 = next_stop(s0, i, last);
      const bool is_rest = s1 > end + kSmallRest * (end - s0);
      const double stop = s1 + kSmallRest * (s1 - s0) < end ? s1 : end;
      const Vec3 x1 = curve_.point(parameter(stop, i));
      const double length = is_rest ? rest_length(s0, end, i) : distance(x0, x1);
      add_box(0.5 * (s0 + stop), i, length, reach_of(0.5 * (x1 - x0)), cause, boxes);
      s0 = stop;
      x0 = x1;
    }
  }

 private:
  /// Arc length at which the segment from s0 ends if nothing stops it: beyond the table's end when the rest is short
  /// and straight.
  double next_stop(double s0, std::size_t i, std::size_t last) const {
    const double turning_end = interpolate_at(table_.s, table_.turning, s0, i) + limits_.alpha;
    double s = table_.s[last] + limits_.max_length;
    if (table_.turning[last] >= turning_end) {
      std::size_t j = i;
      s = interpolate(table_.turning, table_.s, turning_end, j);
    }
    s = std::min(s, s0 + limits_.max_length);
    if (std::isfinite(limits_.chord)) s = chord_stop(s0, s, i);
    return std::max(s, s0 + limits_.min_length);
  }

  /// Nearest arc length, at most s1, at which the sagitta of the arc from s0 reaches the limit (a flat arc: length *
  /// turning / 8).
  double chord_stop(double s0, double s1, std::size_t i) const {
    constexpr int kHalvings = 40;
    const double turning0 = interpolate_at(table_.s, table_.turning, s0, i);
    const auto is_low = [&](double s) {
      return (s - s0) * (interpolate_at(table_.s, table_.turning, s, i) - turning0) <= 8 * limits_.chord;
    };
    if (is_low(s1)) return s1;
    double low = s0, high = s1;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (low + high);
      (is_low(middle) ? low : high) = middle;
    }
    return low;
  }

  /// Length that the turning of a last piece, shorter than a segment, allows.
  double rest_length(double s0, double end, std::size_t i) const {
    const double turning =
        interpolate_at(table_.s, table_.turning, end, i) - interpolate_at(table_.s, table_.turning, s0, i);
    if (!(turning > 0)) return limits_.max_length;
    return std::min((end - s0) * limits_.alpha / turning, std::sqrt(8 * limits_.chord * (end - s0) / turning));
  }

  static double interpolate_at(const std::vector<double>& x, const std::vector<double>& y, double x0, std::size_t i) {
    return interpolate(x, y, x0, i);
  }
  double parameter(double s, std::size_t i) const { return interpolate(table_.s, table_.t, s, i); }

  void add_box(double s, std::size_t i, double length, const SampleReach& reach, std::int32_t cause,
               std::vector<RasterBox>& boxes) const {
    length = std::clamp(std::min(length, table_.s.back()), limits_.min_length, limits_.max_length);
    boxes.push_back({curve_.point(parameter(s, i)),
                     static_cast<float>(0.5 * limits_.cell_per_length * length),
                     static_cast<float>(length),
                     cause,
                     {},
                     stretch_at(s, length),
                     reach});
  }

  SampleStretch stretch_at(double s, double length) const {
    if (!limits_.stretches_curve) return {};
    const double way = table_.s.back();
    const auto point_at = [&](double share) { return curve_.point(parameter(share * way, 0)); };
    return stretch_along(point_at, s / way, way, length,
                         {limits_.max_aspect, limits_.max_along.value_or(limits_.max_length), limits_.alpha});
  }

  const Curve& curve_;
  const CurveTable& table_;
  const SamplingLimits& limits_;
};

}  // namespace

CurveTable measure_curve(const Curve& curve, const SamplingLimits& limits) {
  ST_ASSERT(0 < limits.min_length && limits.min_length <= limits.max_length);
  ST_ASSERT(0 < limits.alpha && limits.alpha <= kPi / 2 && limits.cell_per_length >= 1);
  return CurveMeasurer(curve, limits).run();
}

void raster_curve(const Curve& curve, const SamplingLimits& limits, std::int32_t cause, std::vector<RasterBox>& boxes) {
  const CurveTable table = measure_curve(curve, limits);
  SamplingLimits own = limits;
  if (limits.edge_cells)
    own.max_length = std::clamp(table.s.back() / *limits.edge_cells, limits.min_length, limits.max_length);
  PieceWalker walker(curve, table, own);
  std::size_t first = 0;
  for (const std::size_t corner : table.corners) {
    walker.walk(first, corner, cause, boxes);
    first = corner + 1;
  }
  walker.walk(first, table.t.size() - 1, cause, boxes);
}

}  // namespace st
