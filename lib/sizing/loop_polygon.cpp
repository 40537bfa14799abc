#include "sizing/loop_polygon.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include "base/predicates.h"
#include "sizing/raster_curve.h"

namespace st {
namespace {

constexpr double kRelativeDeviation = 1e-3;  // of the polygon from the trimming curve, over the face's (u,v) range
constexpr int kMaxHalvings = 6;
constexpr double kSamePoint = 1e-9;  // over the face's (u,v) range
constexpr int kFirstSides = 4;       // of a degenerate edge
constexpr std::size_t kMaxBins = 4096;
constexpr int kMaxRefinements = 6;  // of sides that cross: what crosses then does so in the CAD model

/// Turns the trimming curves of one face into sides.
class LoopTracer {
 public:
  LoopTracer(const Model& model, FaceId face, const ModelLimits& limits) : model_(model), face_(face), limits_(limits) {
    const double* bounds = &model.tables().face_uv_bounds[4 * static_cast<std::size_t>(face)];
    scale_ = {1 / std::max(bounds[1] - bounds[0], 1e-300), 1 / std::max(bounds[3] - bounds[2], 1e-300)};
  }

  std::vector<LoopSide> run() {
    const ModelTables& t = model_.tables();
    for (const LoopId loop : t.loops(face_)) {
      points_.clear();
      const std::size_t l = static_cast<std::size_t>(loop), first = sides_.size();
      for (const CoedgeId c : t.loop_coedges(l)) trace(c);
      if (!points_.empty()) join(points_.back(), points_.front().uv);
      for (std::size_t i = 0; i < points_.size(); ++i)
        sides_.push_back({points_[i], points_[(i + 1) % points_.size()]});
      if (sides_.size() > first) sides_.back().b.coedge = kNone;  // closes the loop, on no trimming curve
    }
    for (int i = 0; i < kMaxRefinements && refine_crossing_sides(); ++i) {
    }
    std::vector<LoopSide> result;
    for (const TracedSide& s : sides_) result.push_back({s.a.uv, s.b.uv});
    return result;
  }

 private:
  struct TracedPoint {
    Vec2 uv;
    CoedgeId coedge;
    double t;
  };
  struct TracedSide {
    TracedPoint a, b;
  };

  void trace(CoedgeId coedge) {
    const ModelTables& t = model_.tables();
    const EdgeId edge = t.coedge_edge[coedge];
    std::vector<double> parameters = edge_parameters(edge);
    if (t.coedge_is_reversed[coedge]) std::reverse(parameters.begin(), parameters.end());
    const std::unique_ptr<Curve2d> curve = model_.pcurve(face_, coedge);
    Vec2 a = curve->point(parameters.front());
    if (!points_.empty()) join(points_.back(), a);
    points_.push_back({a, coedge, parameters.front()});
    for (std::size_t i = 1; i < parameters.size(); ++i) {
      const Vec2 b = curve->point(parameters[i]);
      follow(*curve, coedge, parameters[i - 1], a, parameters[i], b, 0);
      points_.push_back({b, coedge, parameters[i]});
      a = b;
    }
  }

  /// Sides that meet share their point exactly: rounding would make them cross.
  void join(TracedPoint& end, Vec2 start) const {
    const Vec2 off = end.uv - start;
    if (std::hypot(off.x * scale_.x, off.y * scale_.y) < kSamePoint) end.uv = start;
  }

  std::vector<double> edge_parameters(EdgeId edge) const {
    const ModelTables& t = model_.tables();
    if (!t.edge_is_degenerate[edge]) return measure_curve(*model_.curve(edge), limits_.trace(edge)).t;
    const double t0 = t.edge_range[2 * static_cast<std::size_t>(edge)],
                 t1 = t.edge_range[2 * static_cast<std::size_t>(edge) + 1];
    std::vector<double> parameters;
    for (int i = 0; i <= kFirstSides; ++i) parameters.push_back(t0 + (t1 - t0) * i / kFirstSides);
    return parameters;
  }

  /// Adds points between a and b where the trimming curve leaves the straight side.
  void follow(const Curve2d& curve, CoedgeId coedge, double ta, Vec2 a, double tb, Vec2 b, int depth) {
    if (depth == kMaxHalvings) return;
    const double tm = 0.5 * (ta + tb);
    const Vec2 m = curve.point(tm), off = m - 0.5 * (a + b);
    if (std::hypot(off.x * scale_.x, off.y * scale_.y) < kRelativeDeviation) return;
    follow(curve, coedge, ta, a, tm, m, depth + 1);
    points_.push_back({m, coedge, tm});
    follow(curve, coedge, tm, m, tb, b, depth + 1);
  }

  /// Halves the sides that cross others on their trimming curves. False: there is none, or none that can be halved.
  bool refine_crossing_sides() {
    std::vector<LoopSide> plain;
    for (const TracedSide& s : sides_) plain.push_back({s.a.uv, s.b.uv});
    const std::vector<std::int32_t> crossing = crossing_sides(plain);
    bool is_refined = false;
    std::vector<TracedSide> refined;
    auto next = crossing.begin();
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const TracedSide& s = sides_[i];
      const bool crosses = next != crossing.end() && static_cast<std::size_t>(*next) == i;
      if (crosses) ++next;
      const double tm = 0.5 * (s.a.t + s.b.t);
      if (!crosses || s.a.coedge != s.b.coedge || tm == s.a.t || tm == s.b.t) {
        refined.push_back(s);
        continue;
      }
      const TracedPoint middle{model_.pcurve(face_, s.a.coedge)->point(tm), s.a.coedge, tm};
      refined.push_back({s.a, middle});
      refined.push_back({middle, s.b});
      is_refined = true;
    }
    sides_ = std::move(refined);
    return is_refined;
  }

  const Model& model_;
  FaceId face_;
  const ModelLimits& limits_;
  Vec2 scale_;
  std::vector<TracedPoint> points_;
  std::vector<TracedSide> sides_;
};

/// Do the two sides cross properly: neither touches the other with an end?
bool cross_properly(const LoopSide& s, const LoopSide& r) {
  const auto opposite = [](double x, double y) { return (x > 0 && y < 0) || (x < 0 && y > 0); };
  return opposite(orient2d(s.a, s.b, r.a), orient2d(s.a, s.b, r.b)) &&
         opposite(orient2d(r.a, r.b, s.a), orient2d(r.a, r.b, s.b));
}

}  // namespace

LoopPolygons::LoopPolygons(std::vector<LoopSide> sides) : sides_(std::move(sides)) {
  if (sides_.empty()) return;
  double v_max = sides_.front().a.y;
  v_min_ = v_max;
  for (const LoopSide& s : sides_) {
    v_min_ = std::min({v_min_, s.a.y, s.b.y});
    v_max = std::max({v_max, s.a.y, s.b.y});
  }
  const std::size_t n_bins = std::clamp<std::size_t>(sides_.size(), 1, kMaxBins);
  bins_per_v_ = v_max > v_min_ ? static_cast<double>(n_bins) / (v_max - v_min_) : 0;
  const auto bin = [&](double v) { return std::min(static_cast<std::size_t>((v - v_min_) * bins_per_v_), n_bins - 1); };
  bin_offsets_.assign(n_bins + 1, 0);
  for (const LoopSide& s : sides_)
    for (std::size_t b = bin(std::min(s.a.y, s.b.y)); b <= bin(std::max(s.a.y, s.b.y)); ++b) ++bin_offsets_[b + 1];
  for (std::size_t b = 0; b < n_bins; ++b) bin_offsets_[b + 1] += bin_offsets_[b];
  bin_sides_.resize(static_cast<std::size_t>(bin_offsets_.back()));
  std::vector<std::int32_t> next(bin_offsets_.begin(), bin_offsets_.end() - 1);
  for (std::size_t i = 0; i < sides_.size(); ++i)
    for (std::size_t b = bin(std::min(sides_[i].a.y, sides_[i].b.y)); b <= bin(std::max(sides_[i].a.y, sides_[i].b.y));
         ++b)
      bin_sides_[next[b]++] = static_cast<std::int32_t>(i);
}

bool LoopPolygons::contains(Vec2 uv) const {
  if (sides_.empty()) return true;
  const double position = (uv.y - v_min_) * bins_per_v_;
  const std::size_t n_bins = bin_offsets_.size() - 1;
  if (!(position >= 0 && position <= static_cast<double>(n_bins))) return false;
  const std::size_t b = std::min(static_cast<std::size_t>(position), n_bins - 1);
  bool is_inside = false;
  for (std::int32_t k = bin_offsets_[b]; k < bin_offsets_[b + 1]; ++k) {
    const LoopSide& s = sides_[bin_sides_[k]];
    if ((s.a.y > uv.y) == (s.b.y > uv.y)) continue;
    if (uv.x < s.a.x + (uv.y - s.a.y) / (s.b.y - s.a.y) * (s.b.x - s.a.x)) is_inside = !is_inside;
  }
  return is_inside;
}

std::vector<std::int32_t> crossing_sides(std::span<const LoopSide> sides) {
  // Sweeps along the axis that the sides run along less: fewer of them lie side by side.
  double along_u = 0, along_v = 0;
  Vec2 lo{1e300, 1e300}, hi{-1e300, -1e300};
  for (const LoopSide& s : sides) {
    along_u += std::abs(s.b.x - s.a.x), along_v += std::abs(s.b.y - s.a.y);
    lo = {std::min({lo.x, s.a.x, s.b.x}), std::min({lo.y, s.a.y, s.b.y})},
    hi = {std::max({hi.x, s.a.x, s.b.x}), std::max({hi.y, s.a.y, s.b.y})};
  }
  const bool by_u = along_u * (hi.y - lo.y) < along_v * (hi.x - lo.x);
  const auto along = [&](Vec2 p) { return by_u ? p.x : p.y; };
  const auto across = [&](Vec2 p) { return by_u ? p.y : p.x; };
  std::vector<std::int32_t> order(sides.size());
  std::iota(order.begin(), order.end(), 0);
  const auto start = [&](std::int32_t i) { return std::min(along(sides[i].a), along(sides[i].b)); };
  std::sort(order.begin(), order.end(),
            [&](std::int32_t i, std::int32_t j) { return std::pair(start(i), i) < std::pair(start(j), j); });
  std::vector<std::int32_t> open, result;
  for (const std::int32_t i : order) {
    const LoopSide& s = sides[i];
    const auto [low, high] = std::minmax({across(s.a), across(s.b)});
    std::erase_if(open, [&](std::int32_t k) { return std::max(along(sides[k].a), along(sides[k].b)) < start(i); });
    for (const std::int32_t k : open) {
      const LoopSide& r = sides[k];
      if (std::max(across(r.a), across(r.b)) < low || std::min(across(r.a), across(r.b)) > high ||
          !cross_properly(s, r))
        continue;
      result.push_back(i);
      result.push_back(k);
    }
    open.push_back(i);
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

LoopPolygons loop_polygons(const Model& model, FaceId face, const ModelLimits& limits) {
  return LoopPolygons(LoopTracer(model, face, limits).run());
}

}  // namespace st
