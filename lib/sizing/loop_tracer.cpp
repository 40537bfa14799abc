#include "sizing/loop_tracer.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/current_work.h"
#include "sizing/raster_curve.h"

namespace st {
namespace {

constexpr double kRelativeDeviation = 1e-3;  // of the polygon from the trimming curve, over the face's (u,v) range
constexpr int kMaxHalvings = 6;
constexpr double kSamePoint = 1e-9;  // over the face's (u,v) range
constexpr int kFirstSides = 4;       // of a degenerate edge
constexpr int kMaxRefinements = 6;   // of sides that cross: what crosses then does so in the CAD model

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
    for (const TracedSide& s : sides_)
      result.push_back({s.a.uv, s.b.uv, s.a.coedge == s.b.coedge ? s.a.coedge : kNone});
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
    throw_if_late();
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
    for (const TracedSide& s : sides_) plain.push_back({s.a.uv, s.b.uv, kNone});
    std::vector<char> crosses(sides_.size(), 0);
    throw_if_late();
    for (const auto& [i, k] : crossing_sides(plain)) crosses[i] = crosses[k] = 1;
    bool is_refined = false;
    std::vector<TracedSide> refined;
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      const TracedSide& s = sides_[i];
      const double tm = 0.5 * (s.a.t + s.b.t);
      if (!crosses[i] || s.a.coedge != s.b.coedge || tm == s.a.t || tm == s.b.t) {
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

}  // namespace

LoopPolygons loop_polygons(const Model& model, FaceId face, const ModelLimits& limits) {
  return LoopPolygons(LoopTracer(model, face, limits).run());
}

}  // namespace st
