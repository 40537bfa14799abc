#include "geometry/brep/face_integral.h"

#include <Geom2dAdaptor_Curve.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cmath>
#include <vector>

namespace st::occt {
namespace {

/// 5-point Gauss-Legendre on [-1, 1].
constexpr int kGauss = 5, kSamples = 16;
constexpr double kX[kGauss] = {-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831, 0.9061798459386640};
constexpr double kW[kGauss] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
                               0.2369268850561891};

FaceIntegral operator+(FaceIntegral a, FaceIntegral b) { return {a.area + b.area, a.volume + b.volume}; }
FaceIntegral operator*(double s, FaceIntegral a) { return {s * a.area, s * a.volume}; }

/// Integrates over the trimmed domain.
class Integrator {
 public:
  Integrator(const FaceDomain& domain, Vec3 origin) : d_(domain), origin_(origin) {
    for (double s : {0.0, 0.5, 1.0})
      for (double t : {0.0, 0.5, 1.0}) reach_ = std::max(reach_, distance(at(s, t), origin));
    set_intervals(1);
    refine_intervals();
  }

  FaceIntegral run() {
    FaceIntegral coarse;
    struct Piece {
      const Geom2dAdaptor_Curve* curve;
      double t0, t1;
      double sign;  // -1: of a loop that runs the wrong way
      FaceIntegral value;
    };
    std::vector<Geom2dAdaptor_Curve> curves;
    std::vector<Piece> pieces;
    std::size_t n = 0;
    for (const LoopUv& loop : d_.loops) n += loop.coedges.size();
    curves.reserve(n);
    for (const LoopUv& loop : d_.loops)
      for (const CoedgeUv& c : loop.coedges) {
        if (c.curve.IsNull() || contributes_nothing(c)) continue;
        curves.emplace_back(c.curve, std::min(c.t_start, c.t_end), std::max(c.t_start, c.t_end));
        const std::vector<double> t = split_at_knots(c, curves.back());
        for (std::size_t i = 0; i + 1 < t.size(); ++i) {
          const double sign = loop.is_turned ? -1 : 1;
          pieces.push_back({&curves.back(), t[i], t[i + 1], sign, boundary(curves.back(), t[i], t[i + 1])});
          coarse = coarse + sign * pieces.back().value;
        }
      }
    if (pieces.size() > kManyPieces) return coarse;
    const double tolerance = kRelative * std::max(std::fabs(coarse.area), 1e-300);
    FaceIntegral sum;
    for (const Piece& p : pieces) sum = sum + p.sign * adapt(*p.curve, p.t0, p.t1, p.value, tolerance, kMaxDepth);
    return sum;
  }

 private:
  static constexpr std::size_t kManyPieces = 256;  // between knots one rule is enough: a surface of so many is a
                                                   // measured one
  static constexpr double kRelative = 1e-6;
  static constexpr int kMaxDepth = 10, kMaxIntervals = 1024;

  Vec3 at(double s, double t) const {
    const Box2& b = d_.bounds;
    return d_.surface->point({b.lo.x + s * (b.hi.x - b.lo.x), b.lo.y + t * (b.hi.y - b.lo.y)});
  }

  /// Areas within the tolerance, volumes within that of a cone on it.
  bool agree(FaceIntegral a, FaceIntegral b, double tolerance) const {
    return std::fabs(a.area - b.area) <= tolerance && std::fabs(a.volume - b.volume) <= tolerance * reach_ / 3;
  }

  FaceIntegral density(const SurfacePoint& p) const {
    const Vec3 n = cross(p.du, p.dv);
    return {norm(n), dot(p.x - origin_, n) / 3};
  }

  void add_places(double u0, double u1, double v) {
    for (const double x : kX) places_.push_back({0.5 * (u0 + u1) + 0.5 * (u1 - u0) * x, v});
  }

  /// Integral of the density over [u0, u1], one Gauss rule, from the surface at its places.
  FaceIntegral along_u(double u0, double u1, const SurfacePoint* p) const {
    FaceIntegral sum;
    for (int k = 0; k < kGauss; ++k) sum = sum + kW[k] * density(p[k]);
    return 0.5 * (u1 - u0) * sum;
  }

  /// Integral from the lower bound to u: whole intervals and the rest of the last one (beyond the bounds:
  /// extrapolated).
  FaceIntegral primitive(double u, double v) {
    std::size_t n_whole = 0;
    if (u > u_.front())
      while (n_whole + 2 < u_.size() && !(u <= u_[n_whole + 1])) ++n_whole;
    places_.clear();
    for (std::size_t i = 0; i < n_whole; ++i) add_places(u_[i], u_[i + 1], v);
    add_places(u_[n_whole], u, v);
    points_.resize(places_.size());
    d_.surface->evaluate_batch(places_, points_);
    FaceIntegral sum;
    for (std::size_t i = 0; i < n_whole; ++i) sum = sum + along_u(u_[i], u_[i + 1], &points_[i * kGauss]);
    return sum + along_u(u_[n_whole], u, &points_[n_whole * kGauss]);
  }

  /// `n` equal intervals between neighbouring knots.
  void set_intervals(int n) {
    std::vector<double> knots{d_.bounds.lo.x};
    for (double b : d_.u_knots)
      if (b > knots.back() && b < d_.bounds.hi.x) knots.push_back(b);
    knots.push_back(d_.bounds.hi.x);
    u_.assign(1, knots.front());
    for (std::size_t i = 0; i + 1 < knots.size(); ++i)
      for (int k = 1; k <= n; ++k) u_.push_back(knots[i] + (knots[i + 1] - knots[i]) * k / n);
  }

  /// Doubles the intervals until the integrals along three lines of constant v stand still.
  void refine_intervals() {
    const auto lines = [&] {
      FaceIntegral sum;
      for (double s : {0.13, 0.47, 0.89})
        sum = sum + primitive(d_.bounds.hi.x, d_.bounds.lo.y + s * (d_.bounds.hi.y - d_.bounds.lo.y));
      return sum;
    };
    FaceIntegral before = lines();
    for (int n = 2; static_cast<int>(u_.size()) <= kMaxIntervals; n *= 2) {
      const std::vector<double> coarser = u_;
      set_intervals(n);
      const FaceIntegral now = lines();
      const bool stands_still = agree(now, before, kRelative * now.area);
      before = now;
      if (!stands_still) continue;
      u_ = coarser;
      return;
    }
  }

  bool contributes_nothing(const CoedgeUv& c) const {
    if (!c.is_line) return false;
    const gp_Pnt2d a = c.curve->Value(c.t_start), b = c.curve->Value(c.t_end);
    return a.Y() == b.Y() || (a.X() == d_.bounds.lo.x && b.X() == d_.bounds.lo.x);
  }

  /// Parameters where the trimming curve crosses a knot line of the surface, between its ends.
  std::vector<double> split_at_knots(const CoedgeUv& c, const Geom2dAdaptor_Curve& curve) const {
    std::vector<double> t{c.t_start};
    const int n = d_.v_knots.empty() ? 0 : kSamples;
    for (int k = 0; k < n; ++k) {
      const double a = c.t_start + (c.t_end - c.t_start) * k / n, b = c.t_start + (c.t_end - c.t_start) * (k + 1) / n;
      const double va = curve.Value(a).Y(), vb = curve.Value(b).Y();
      std::vector<double> found;
      for (double v : d_.v_knots)
        if ((va < v) != (vb < v)) found.push_back(crossing(curve, a, b, v));
      std::sort(found.begin(), found.end(), [&](double x, double y) { return c.t_start < c.t_end ? x < y : x > y; });
      t.insert(t.end(), found.begin(), found.end());
    }
    t.push_back(c.t_end);
    return t;
  }

  static double crossing(const Geom2dAdaptor_Curve& curve, double a, double b, double v) {
    const bool below = curve.Value(a).Y() < v;
    for (int i = 0; i < 50; ++i) {
      const double m = 0.5 * (a + b);
      ((curve.Value(m).Y() < v) == below ? a : b) = m;
    }
    return 0.5 * (a + b);
  }

  /// Boundary integral of the primitive times dv, one Gauss rule.
  FaceIntegral boundary(const Geom2dAdaptor_Curve& curve, double t0, double t1) {
    FaceIntegral sum;
    gp_Pnt2d p;
    gp_Vec2d d;
    for (int k = 0; k < kGauss; ++k) {
      curve.D1(0.5 * (t0 + t1) + 0.5 * (t1 - t0) * kX[k], p, d);
      if (d.Y() != 0) sum = sum + (kW[k] * d.Y()) * primitive(p.X(), p.Y());
    }
    return 0.5 * (t1 - t0) * sum;
  }

  FaceIntegral adapt(const Geom2dAdaptor_Curve& curve, double t0, double t1, FaceIntegral whole, double tolerance,
                     int depth) {
    const double middle = 0.5 * (t0 + t1);
    const FaceIntegral a = boundary(curve, t0, middle), b = boundary(curve, middle, t1);
    if (depth == 0 || agree(a + b, whole, tolerance)) return a + b;
    return adapt(curve, t0, middle, a, tolerance, depth - 1) + adapt(curve, middle, t1, b, tolerance, depth - 1);
  }

  const FaceDomain& d_;
  Vec3 origin_;
  double reach_ = 0;  ///< of the face from the origin, about
  std::vector<double> u_;
  std::vector<Vec2> places_;  // along u at one v, of primitive()
  std::vector<SurfacePoint> points_;
};

}  // namespace

FaceIntegral integrate_face(const FaceDomain& domain, Vec3 origin) { return Integrator(domain, origin).run(); }

double area_of_faces(const TopoDS_Shape& shape) {
  double area = 0;
  for (TopExp_Explorer f(shape, TopAbs_FACE); f.More(); f.Next()) {
    const FaceDomain domain = make_domain(TopoDS::Face(f.Current().Oriented(TopAbs_FORWARD)));
    if (!domain.loops.empty()) area += std::abs(integrate_face(domain, {}).area);
  }
  return area;
}

}  // namespace st::occt
