// B-spline curves and surfaces in local power basis: the inner loop's evaluators.
// Each knot span is a polynomial in s in [-1,1]; spans are converted when first met and kept (FACTS: 20-50 ns against
// 80-300 ns).
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/boxes.h"
#include "geometry/shape/curve.h"
#include "geometry/shape/patch_kernels.h"
#include "geometry/shape/surface.h"

namespace st {

/// Knots of one parameter direction, non-periodic, with the polynomial form of the basis functions of each span.
class KnotSpans {
 public:
  /// `flat_knots`: non-decreasing, n_poles + degree + 1 values; `period` > 0 wraps parameters into the knot range.
  KnotSpans(int degree, const std::vector<double>& flat_knots, double period);

  int degree() const { return degree_; }
  int n_spans() const { return static_cast<int>(spans_.size()); }
  double period() const { return period_; }
  /// Span that holds `t` (wrapped; clamped to the first and last), `s` its local parameter. `last` is the caller's
  /// cache.
  int locate(double t, int& last, double& s) const {
    const Span* span = &spans_[last];
    if (!span->holds(t)) {
      last = find(t);
      span = &spans_[last];
    }
    s = (t - span->middle) * span->rate;
    return last;
  }
  /// First pole that acts on a span.
  int first_pole(int span) const { return first_pole_[span]; }
  /// ds/dt of a span.
  double rate(int span) const { return spans_[span].rate; }
  /// Coefficient matrix [(degree+1)][(degree+1)]: row j = power coefficients of the j-th acting basis function.
  const double* basis(int span) const {
    return &basis_[static_cast<std::size_t>(span) * (degree_ + 1) * (degree_ + 1)];
  }
  /// Interior knots where the spline is only C0 (multiplicity >= degree), ascending.
  const std::vector<double>& c0_knots() const { return c0_knots_; }
  /// Different knots from first to last, ascending: n_spans() + 1 values.
  const std::vector<double>& distinct_knots() const { return knots_; }

  struct Span {
    double start, end;  ///< a few roundings below the knots: a bound that misses a kink by rounding gets the
                        ///< derivatives of its inside
    double middle, rate;
    bool holds(double t) const { return t >= start && t < end; }
  };
  const Span& span(int i) const { return spans_[i]; }
  /// Span that holds `t`, which is wrapped on return; the first or last one beyond them.
  int find(double& t) const;
  /// Different knots between `lo` and `hi`, ascending, repeated along the period; none that misses an end by rounding
  /// only.
  std::vector<double> knots_between(double lo, double hi) const;

 private:
  int degree_;
  double period_, lo_, hi_, rounding_, buckets_per_t_;
  std::vector<Span> spans_;
  std::vector<double> knots_;              // [n_spans + 1]
  std::vector<std::int32_t> bucket_span_;  // the span at the start of each of as many equal parts of the range
  std::vector<int> first_pole_;
  std::vector<double> basis_;
  std::vector<double> c0_knots_;
};

/// A pole in homogeneous coordinates: (w x, w y, w z, w).
struct Pole {
  double x[4];
};

class BsplineCurve : public Curve {
 public:
  BsplineCurve(KnotSpans knots, const std::vector<Pole>& poles, bool is_rational, double t_min, double t_max);
  std::unique_ptr<Curve> copy() const override;
  Vec3 point(double t) const override;
  CurvePoint evaluate(double t) const override;
  const std::vector<double>& c0_knots() const { return data_->knots.c0_knots(); }
  std::vector<double> knots() const override { return data_->knots.knots_between(t_min_, t_max_); }

 private:
  /// What copies have in common.
  struct Data {
    KnotSpans knots;
    std::vector<Pole> coefficients;  // [span][degree+1]
  };
  static Data data_of(KnotSpans knots, const std::vector<Pole>& poles);
  BsplineCurve(std::shared_ptr<const Data> data, bool is_rational, double t_min, double t_max);

  std::shared_ptr<const Data> data_;
  bool is_rational_;
  PatchKernels kernels_;
  mutable int last_ = 0;
};

class BsplineSurface : public Surface {
 public:
  /// `poles` [n_u][n_v], v fastest.
  BsplineSurface(KnotSpans u, KnotSpans v, std::vector<Pole> poles, int n_v, bool is_rational, const Box2& bounds);
  /// Shares the spans that are converted, on any thread.
  std::unique_ptr<Surface> copy() const override;
  /// The same within other bounds.
  std::unique_ptr<BsplineSurface> within(const Box2& bounds) const;
  /// Between the first knots and the last ones; nullptr where these bounds are not within, as beyond a period.
  std::unique_ptr<BsplineSurface> whole() const;
  Vec3 point(Vec2 uv) const override;
  SurfacePoint evaluate(Vec2 uv) const override;
  SurfacePoint2 evaluate2(Vec2 uv) const override;
  /// At a third of the cost of single calls where neighbours in the list have one v and lie in one patch.
  void evaluate_batch(std::span<const Vec2> uv, std::span<SurfacePoint> out) const override;
  /// The same of point().
  void point_batch(std::span<const Vec2> uv, std::span<Vec3> out) const;
  std::vector<double> u_knots() const override { return u_.knots_between(u_min_, u_max_); }
  std::vector<double> v_knots() const override { return v_.knots_between(v_min_, v_max_); }

 private:
  /// Local parameters in the patch met last.
  struct Local {
    double s, t;
  };
  Local locate(Vec2 uv) const {
    if (!met_.u.holds(uv.x) || !met_.v.holds(uv.y)) meet(uv);
    return {(uv.x - met_.u.middle) * met_.u.rate, (uv.y - met_.v.middle) * met_.v.rate};
  }
  /// Goes to the patch that holds (u,v), which is wrapped on return.
  void meet(Vec2& uv) const;
  /// Of what the kernels gave.
  SurfacePoint first_of(const double* values) const;
  Vec3 point_of(const double* values) const;
  /// take(i, values) gets what the first kernel gives at each of `uv`.
  template <class Take>
  void visit_batch(std::span<const Vec2> uv, const Take& take) const;
  const double* patch(int iu, int iv) const {
    const double* const known =
        data_->patch[static_cast<std::size_t>(iu) * v_.n_spans() + iv].load(std::memory_order_acquire);
    return known ? known : add_patch(iu, iv);
  }
  const double* add_patch(int iu, int iv) const;

  /// What copies have in common.
  struct Data {
    KnotSpans u, v;
    std::vector<Pole> poles;
    /// [n_spans_u][n_spans_v] of [degree_u+1][degree_v+1][stride], and one more; null until met.
    mutable std::vector<std::atomic<const double*>> patch;

    Data(KnotSpans u, KnotSpans v, std::vector<Pole> poles);
    Data(const Data&) = delete;
    ~Data();
  };
  BsplineSurface(std::shared_ptr<const Data> data, int n_v, bool is_rational, const Box2& bounds);

  std::shared_ptr<const Data> data_;
  const KnotSpans &u_, &v_;
  const std::vector<Pole>& poles_;
  int n_v_;
  bool is_rational_;
  int stride_;  // doubles per coefficient
  int order_u_, order_v_;
  PatchKernels kernels_;
  /// The patch met last, and its spans: those before the first hold nothing.
  struct Met {
    KnotSpans::Span u{1, 0, 0, 0}, v{1, 0, 0, 0};
    int iu = 0, iv = 0;
    const double* coefficients = nullptr;
  };
  mutable Met met_;
};

/// surface.point() at each of `uv`, as BsplineSurface::point_batch(); `out` has as many places.
void point_batch(const Surface& surface, std::span<const Vec2> uv, std::span<Vec3> out);

}  // namespace st
