#include "geometry/flite/flite_trim.h"

#include <iterator>

#include "geometry/brep/pcurve_fit.h"
#include "geometry/shape/projection.h"

namespace st::occt {
namespace {

constexpr int kFewestIntervals = 8, kMaxPoints = 2000, kRounds = 7;
constexpr double kSamePoint = 1e-14;
constexpr double kOverhang = 0.25;  // of a unit of parameter, one span: so far polynomials go on beyond the sides

class CurveProjector {
 public:
  CurveProjector(const Surface& surface, const Curve& curve, double resolution)
      : surface_(surface), curve_(curve), resolution_(resolution), poles_(singular_sides(surface, resolution)) {}

  TrimmingCurve project() {
    first_points();
    Handle(Geom2d_BSplineCurve) pcurve;
    for (int round = 0; round < kRounds; ++round) {
      pcurve = through_points();
      if (!refine(pcurve) || points_.size() > kMaxPoints) break;
    }
    return measured(pcurve);
  }

 private:
  /// The knots and what halves their intervals, from the middle outwards: each point has the last ones to go on from.
  void first_points() {
    std::vector<double> t{curve_.t_min()};
    for (const double knot : curve_.knots()) t.push_back(knot);
    t.push_back(curve_.t_max());
    while (t.size() <= kFewestIntervals) t = halved(t);
    t = halved(t);
    const std::size_t middle = t.size() / 2;
    const SurfaceFoot foot = closest_point(surface_, curve_.point(t[middle]));
    points_[t[middle]] = on_side(foot.uv);
    for (std::size_t k = middle + 1; k < t.size(); ++k)
      add(t[k], k == middle + 1 ? foot.uv : ahead(t[k], t[k - 1], t[k - 2]));
    for (std::size_t k = middle; k-- > 0;) add(t[k], ahead(t[k], t[k + 1], t[k + 2]));
  }

  static std::vector<double> halved(const std::vector<double>& t) {
    std::vector<double> finer{t[0]};
    for (std::size_t k = 1; k < t.size(); ++k) finer.push_back(0.5 * (t[k - 1] + t[k])), finer.push_back(t[k]);
    return finer;
  }

  /// On the line through the points at `last` and `before`.
  Vec2 ahead(double t, double last, double before) const {
    const Vec2 a = points_.at(before), b = points_.at(last);
    return b + ((t - last) / (last - before)) * (b - a);
  }

  void add(double t, Vec2 guess) {
    const Vec3 p = curve_.point(t);
    for (const SingularSide& pole : poles_)
      if (distance(pole.x, p) <= 2 * resolution_) {
        points_[t] = at_pole(pole.side, guess);
        return;
      }
    points_[t] = on_side(foot(p, guess));
  }

  Vec2 at_pole(int side, Vec2 guess) const {
    if (side < 2)
      return {side == 0 ? surface_.u_min() : surface_.u_max(), std::clamp(guess.y, surface_.v_min(), surface_.v_max())};
    return {std::clamp(guess.x, surface_.u_min(), surface_.u_max()), side == 2 ? surface_.v_min() : surface_.v_max()};
  }

  /// By Newton's steps from the guess; by search where these fail or end far from the curve.
  Vec2 foot(Vec3 p, Vec2 guess) const {
    const auto near = near_foot(p, guess);
    const double d = near ? distance(surface_.point(*near), p) : 0;
    if (near && d <= 100 * resolution_) return *near;
    const SurfaceFoot global = closest_point(surface_, p);
    return near && d <= 1.5 * global.distance ? *near : next_to(guess, global.uv);
  }

  std::optional<Vec2> near_foot(Vec3 p, Vec2 guess) const {
    // the evaluator's bounds limit Newton's steps; along a period they may be anywhere
    const Vec2 shift{whole_periods(guess.x, surface_.u_min(), surface_.u_period()),
                     whole_periods(guess.y, surface_.v_min(), surface_.v_period())};
    const auto uv = project_near(surface_, p, guess - shift);
    if (!uv || is_outside(uv->x, surface_.u_min(), surface_.u_max(), surface_.u_period()) ||
        is_outside(uv->y, surface_.v_min(), surface_.v_max(), surface_.v_period()))
      return {};
    return *uv + shift;
  }

  static double whole_periods(double x, double lo, double period) {
    return period > 0 ? period * std::floor((x - lo) / period) : 0;
  }
  static bool is_outside(double x, double lo, double hi, double period) {
    return period > 0 ? x < lo || x > hi : x < lo - kOverhang || x > hi + kOverhang;
  }

  /// `uv` moved by whole periods next to the guess.
  Vec2 next_to(Vec2 guess, Vec2 uv) const {
    if (surface_.u_period() > 0) uv.x += surface_.u_period() * std::round((guess.x - uv.x) / surface_.u_period());
    if (surface_.v_period() > 0) uv.y += surface_.v_period() * std::round((guess.y - uv.y) / surface_.v_period());
    return uv;
  }

  /// `uv`, or the point of the side that is within the resolution of it.
  Vec2 on_side(Vec2 uv) const {
    const SurfacePoint s = surface_.evaluate(uv);
    const auto snap = [&](double& x, double side, Vec3 derivative) {
      if (x != side && std::fabs(x - side) < 1 && std::fabs(x - side) * norm(derivative) <= resolution_) x = side;
    };
    if (surface_.u_period() == 0) snap(uv.x, surface_.u_min(), s.du), snap(uv.x, surface_.u_max(), s.du);
    if (surface_.v_period() == 0) snap(uv.y, surface_.v_min(), s.dv), snap(uv.y, surface_.v_max(), s.dv);
    return uv;
  }

  double off(const Handle(Geom2d_BSplineCurve) & pcurve, double t) const {
    const gp_Pnt2d uv = pcurve->Value(t);
    return distance(surface_.point({uv.X(), uv.Y()}), curve_.point(t));
  }

  /// Adds the middle of every interval where the trimming curve is off by more than its end points; false: none.
  bool refine(const Handle(Geom2d_BSplineCurve) & pcurve) {
    std::vector<double> finer;
    for (auto p = points_.begin(); std::next(p) != points_.end(); ++p) {
      const double t0 = p->first, t1 = std::next(p)->first, t = 0.5 * (t0 + t1);
      if (off(pcurve, t) > resolution_ + 1.05 * std::max(off(pcurve, t0), off(pcurve, t1))) finer.push_back(t);
    }
    for (const double t : finer) {
      const gp_Pnt2d uv = pcurve->Value(t);
      add(t, {uv.X(), uv.Y()});
    }
    return !finer.empty();
  }

  Handle(Geom2d_BSplineCurve) through_points() const {
    if (const auto line = straight_line(); !line.IsNull()) return line;
    const Handle(Geom2d_BSplineCurve) spline = spline_through(points_, kSamePoint);
    return spline.IsNull() ? polygon_through(points_) : spline;
  }

  /// Null where a point is off the line between the ends.
  Handle(Geom2d_BSplineCurve) straight_line() const {
    const auto [t0, a] = *points_.begin();
    const auto [t1, b] = *points_.rbegin();
    constexpr double kSame = 1e-9;
    for (const auto& [t, uv] : points_)
      if (norm(uv - a - ((t - t0) / (t1 - t0)) * (b - a)) > kSame) return {};
    return polygon_through({{t0, a}, {t1, b}});
  }

  TrimmingCurve measured(const Handle(Geom2d_BSplineCurve) & pcurve) const {
    TrimmingCurve result{pcurve, 0, curve_.point(curve_.t_min())};
    const auto look = [&](double t) {
      if (const double d = off(pcurve, t); d > result.distance) result.distance = d, result.xyz = curve_.point(t);
    };
    for (auto p = points_.begin(); p != points_.end(); ++p) {
      look(p->first);
      if (const auto next = std::next(p); next != points_.end())
        for (const double s : {0.25, 0.5, 0.75}) look(p->first + s * (next->first - p->first));
    }
    return result;
  }

  const Surface& surface_;
  const Curve& curve_;
  double resolution_;
  std::vector<SingularSide> poles_;
  UvPoints points_;
};

}  // namespace

TrimmingCurve project_curve(const Surface& surface, const Curve& curve, double resolution) {
  return CurveProjector(surface, curve, resolution).project();
}

Handle(Geom2d_BSplineCurve) straight_pcurve(Vec2 a, Vec2 b, double t_max) {
  return polygon_through({{0.0, a}, {t_max, b}});
}

}  // namespace st::occt
