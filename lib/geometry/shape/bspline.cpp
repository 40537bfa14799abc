#include "geometry/shape/bspline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/assert.h"

namespace st {
namespace {

constexpr int kBucketsPerSpan = 2;
constexpr double kKnotRoundings = 4;  // epsilons by which a parameter may miss a knot
constexpr double kNoPiece = 1e-12;    // of the bounds: shorter pieces at their ends are rounding

// Power coefficients in s of the degree+1 basis functions that act on [knots[k], knots[k+1]]; t = middle + half * s.
// Cox-de Boor recursion carried out on polynomials.
void basis_polynomials(const std::vector<double>& knots, int k, int degree, double middle, double half, double* out) {
  const int order = degree + 1;
  double both[2][kMaxOrder * kMaxOrder];
  double *level = both[0], *next = both[1];
  std::fill_n(level, order * order, 0.0);
  level[0] = 1.0;  // degree 0: the span's own function
  for (int p = 1; p <= degree; ++p) {
    std::fill_n(next, order * order, 0.0);
    for (int j = 0; j < p; ++j) {  // function index k-(p-1)+j of degree p-1
      const int i = k - (p - 1) + j;
      const double width = knots[i + p] - knots[i];
      const double* n = &level[j * order];
      for (int c = 0; c < p; ++c) {
        // rises into function i (degree p), falls into function i-1
        const double a = n[c] * (middle - knots[i]) / width, b = n[c] * half / width;
        next[(j + 1) * order + c] += a;
        next[(j + 1) * order + c + 1] += b;
        next[j * order + c] += n[c] * (knots[i + p] - middle) / width;
        next[j * order + c + 1] -= b;
      }
    }
    std::swap(level, next);
  }
  std::copy_n(level, order * order, out);
}

}  // namespace

KnotSpans::KnotSpans(int degree, const std::vector<double>& flat_knots, double period)
    : degree_(degree), period_(period) {
  ST_ASSERT(degree >= 1 && flat_knots.size() >= 2 * static_cast<std::size_t>(degree + 1));
  ST_ASSERT(std::is_sorted(flat_knots.begin(), flat_knots.end()) &&
            flat_knots[degree] < flat_knots[flat_knots.size() - degree - 1]);
  const int order = degree + 1, n_poles = static_cast<int>(flat_knots.size()) - order;
  lo_ = flat_knots[degree];
  hi_ = flat_knots[n_poles];
  rounding_ = kKnotRoundings * std::numeric_limits<double>::epsilon() * std::max(std::abs(lo_), std::abs(hi_));
  for (int k = degree; k < n_poles; ++k) {
    const double a = flat_knots[k], b = flat_knots[k + 1];
    if (!(b > a)) continue;
    spans_.push_back({a - rounding_, b - rounding_, 0.5 * (a + b), 2.0 / (b - a)});
    knots_.push_back(a);
    first_pole_.push_back(k - degree);
    basis_.resize(basis_.size() + order * order);
    basis_polynomials(flat_knots, k, degree, 0.5 * (a + b), 0.5 * (b - a), &basis_[basis_.size() - order * order]);
  }
  knots_.push_back(hi_);
  for (int k = degree + 1; k < n_poles;) {
    int multiplicity = 1;
    while (k + multiplicity < n_poles && flat_knots[k + multiplicity] == flat_knots[k]) ++multiplicity;
    if (multiplicity >= degree && flat_knots[k] > lo_ && flat_knots[k] < hi_) c0_knots_.push_back(flat_knots[k]);
    k += multiplicity;
  }
  const int n_buckets = kBucketsPerSpan * n_spans();
  buckets_per_t_ = n_buckets / (hi_ - lo_);
  bucket_span_.resize(n_buckets);
  for (int b = 0, k = 0; b < n_buckets; ++b) {
    while (k + 1 < n_spans() && b >= (spans_[k + 1].start - lo_) * buckets_per_t_) ++k;
    bucket_span_[b] = k;
  }
}

int KnotSpans::find(double& t) const {
  if (period_ > 0 && (t < lo_ - rounding_ || t > hi_ + rounding_)) t -= period_ * std::floor((t - lo_) / period_);
  const double bucket = (t - lo_) * buckets_per_t_;
  const auto n_buckets = static_cast<double>(bucket_span_.size());
  int k = bucket_span_[bucket > 0 ? static_cast<std::size_t>(std::min(bucket, n_buckets - 1)) : 0];
  while (k + 1 < n_spans() && t >= spans_[k + 1].start) ++k;
  while (k > 0 && t < spans_[k].start) --k;
  return k;
}

std::vector<double> KnotSpans::knots_between(double lo, double hi) const {
  std::vector<double> knots;
  const double rounding = kNoPiece * (hi - lo);
  const int first = period_ > 0 ? static_cast<int>(std::floor((lo - lo_) / period_)) : 0;
  const int last = period_ > 0 ? static_cast<int>(std::floor((hi - lo_) / period_)) : 0;
  for (int turn = first; turn <= last; ++turn)
    for (std::size_t k = turn == first ? 1 : 0; k < spans_.size(); ++k) {
      const double t = knots_[k] + turn * period_;
      if (t > lo + rounding && t < hi - rounding) knots.push_back(t);
    }
  return knots;
}

BsplineCurve::BsplineCurve(KnotSpans knots, const std::vector<Pole>& poles, bool is_rational, double t_min,
                           double t_max)
    : BsplineCurve(std::make_shared<Data>(data_of(std::move(knots), poles)), is_rational, t_min, t_max) {}

BsplineCurve::BsplineCurve(std::shared_ptr<const Data> data, bool is_rational, double t_min, double t_max)
    : data_(std::move(data)),
      is_rational_(is_rational),
      kernels_(patch_kernels(data_->knots.degree() + 1, is_rational ? 4 : 3)) {
  t_min_ = t_min;
  t_max_ = t_max;
  period_ = data_->knots.period();
}

std::unique_ptr<Curve> BsplineCurve::copy() const {
  return std::unique_ptr<Curve>(new BsplineCurve(data_, is_rational_, t_min_, t_max_));
}

BsplineCurve::Data BsplineCurve::data_of(KnotSpans knots, const std::vector<Pole>& poles) {
  const int order = knots.degree() + 1;
  ST_ASSERT(poles.size() >= static_cast<std::size_t>(knots.first_pole(knots.n_spans() - 1) + order));
  std::vector<Pole> coefficients(static_cast<std::size_t>(knots.n_spans()) * order);
  for (int k = 0; k < knots.n_spans(); ++k)
    for (int j = 0; j < order; ++j)
      for (int c = 0; c < order; ++c)
        for (int x = 0; x < 4; ++x)
          coefficients[k * order + c].x[x] += knots.basis(k)[j * order + c] * poles[knots.first_pole(k) + j].x[x];
  return {std::move(knots), std::move(coefficients)};
}

Vec3 BsplineCurve::point(double t) const {
  double s;
  const int k = data_->knots.locate(t, last_, s), degree = data_->knots.degree();
  const Pole* c = &data_->coefficients[static_cast<std::size_t>(k) * (degree + 1)];
  double p[4] = {c[degree].x[0], c[degree].x[1], c[degree].x[2], c[degree].x[3]};
  for (int i = degree - 1; i >= 0; --i)
    for (int x = 0; x < 4; ++x) p[x] = p[x] * s + c[i].x[x];
  if (is_rational_) return {p[0] / p[3], p[1] / p[3], p[2] / p[3]};
  return {p[0], p[1], p[2]};
}

CurvePoint BsplineCurve::evaluate(double t) const {
  double s, out[12];
  const int k = data_->knots.locate(t, last_, s), order = data_->knots.degree() + 1;
  kernels_.line_second(data_->coefficients[static_cast<std::size_t>(k) * order].x, order, s, data_->knots.rate(k), out);
  return {{out[0], out[1], out[2]}, {out[4], out[5], out[6]}, {out[8], out[9], out[10]}};
}

BsplineSurface::BsplineSurface(KnotSpans u, KnotSpans v, std::vector<Pole> poles, int n_v, bool is_rational,
                               const Box2& bounds)
    : BsplineSurface(std::make_shared<const Data>(std::move(u), std::move(v), std::move(poles)), n_v, is_rational,
                     bounds) {}

BsplineSurface::Data::Data(KnotSpans u, KnotSpans v, std::vector<Pole> poles)
    : u(std::move(u)),
      v(std::move(v)),
      poles(std::move(poles)),
      patch(static_cast<std::size_t>(this->u.n_spans()) * this->v.n_spans()) {}

BsplineSurface::Data::~Data() {
  for (const auto& p : patch) delete[] p.load(std::memory_order_relaxed);
}

std::unique_ptr<Surface> BsplineSurface::copy() const { return within({{u_min_, v_min_}, {u_max_, v_max_}}); }

std::unique_ptr<BsplineSurface> BsplineSurface::within(const Box2& bounds) const {
  return std::unique_ptr<BsplineSurface>(new BsplineSurface(data_, n_v_, is_rational_, bounds));
}

std::unique_ptr<BsplineSurface> BsplineSurface::whole() const {
  const std::vector<double>&u = u_.distinct_knots(), &v = v_.distinct_knots();
  const bool is_within = u.front() <= u_min_ && u_max_ <= u.back() && v.front() <= v_min_ && v_max_ <= v.back();
  return is_within ? within({{u.front(), v.front()}, {u.back(), v.back()}}) : nullptr;
}

BsplineSurface::BsplineSurface(std::shared_ptr<const Data> data, int n_v, bool is_rational, const Box2& bounds)
    : data_(std::move(data)),
      u_(data_->u),
      v_(data_->v),
      poles_(data_->poles),
      n_v_(n_v),
      is_rational_(is_rational),
      stride_(is_rational ? 4 : 3),
      order_u_(u_.degree() + 1),
      order_v_(v_.degree() + 1),
      kernels_(patch_kernels(v_.degree() + 1, stride_)) {
  ST_ASSERT(n_v_ >= v_.first_pole(v_.n_spans() - 1) + v_.degree() + 1);
  ST_ASSERT(poles_.size() >= static_cast<std::size_t>(n_v_) * (u_.first_pole(u_.n_spans() - 1) + u_.degree() + 1));
  type_ = SurfaceType::kBspline;
  u_min_ = bounds.lo.x;
  u_max_ = bounds.hi.x;
  v_min_ = bounds.lo.y;
  v_max_ = bounds.hi.y;
  u_period_ = u_.period();
  v_period_ = v_.period();
  u_breaks_ = u_.c0_knots();
  v_breaks_ = v_.c0_knots();
}

void BsplineSurface::meet(Vec2& uv) const {
  if (!met_.u.holds(uv.x)) met_.u = u_.span(met_.iu = u_.find(uv.x));
  if (!met_.v.holds(uv.y)) met_.v = v_.span(met_.iv = v_.find(uv.y));
  met_.coefficients = patch(met_.iu, met_.iv);
}

const double* BsplineSurface::add_patch(int iu, int iv) const {
  auto own = std::make_unique_for_overwrite<double[]>(static_cast<std::size_t>(order_u_) * order_v_ * stride_ + 1);
  kernels_.convert(poles_[static_cast<std::size_t>(u_.first_pole(iu)) * n_v_ + v_.first_pole(iv)].x, n_v_, u_.basis(iu),
                   order_u_, v_.basis(iv), order_v_, own.get());
  const double* known = nullptr;
  auto& patch = data_->patch[static_cast<std::size_t>(iu) * v_.n_spans() + iv];
  if (patch.compare_exchange_strong(known, own.get(), std::memory_order_acq_rel)) return own.release();
  return known;  // another thread was first; it found the same
}

SurfacePoint BsplineSurface::first_of(const double* values) const {
  const double *p = values, *pu = values + 4, *pv = values + 8, ru = met_.u.rate, rv = met_.v.rate;
  SurfacePoint r{{p[0], p[1], p[2]}, ru * Vec3{pu[0], pu[1], pu[2]}, rv * Vec3{pv[0], pv[1], pv[2]}};
  if (is_rational_) {
    const double w = 1.0 / p[3];
    r.x = w * r.x;
    r.du = w * (r.du - (ru * pu[3]) * r.x);
    r.dv = w * (r.dv - (rv * pv[3]) * r.x);
  }
  return r;
}

Vec3 BsplineSurface::point_of(const double* p) const {
  if (is_rational_) return {p[0] / p[3], p[1] / p[3], p[2] / p[3]};
  return {p[0], p[1], p[2]};
}

Vec3 BsplineSurface::point(Vec2 uv) const {
  const Local at = locate(uv);
  double p[4];
  kernels_.point(met_.coefficients, order_u_, order_v_, at.s, at.t, p);
  return point_of(p);
}

SurfacePoint BsplineSurface::evaluate(Vec2 uv) const {
  const Local at = locate(uv);
  double values[12];
  kernels_.first(met_.coefficients, order_u_, order_v_, at.s, at.t, values);
  return first_of(values);
}

template <class Take>
void BsplineSurface::visit_batch(std::span<const Vec2> uv, const Take& take) const {
  double rows[8 * kMaxOrder], values[12];
  const double* of = nullptr;  // the patch of the rows
  for (std::size_t i = 0; i < uv.size(); ++i) {
    const Local at = locate(uv[i]);
    if (met_.coefficients != of || uv[i].y != uv[i - 1].y)
      kernels_.rows(of = met_.coefficients, order_u_, order_v_, at.t, rows);
    kernels_.first_of_rows(rows, order_u_, at.s, values);
    take(i, values);
  }
}

void BsplineSurface::evaluate_batch(std::span<const Vec2> uv, std::span<SurfacePoint> out) const {
  ST_ASSERT(uv.size() == out.size());
  visit_batch(uv, [&](std::size_t i, const double* values) { out[i] = first_of(values); });
}

void BsplineSurface::point_batch(std::span<const Vec2> uv, std::span<Vec3> out) const {
  ST_ASSERT(uv.size() == out.size());
  visit_batch(uv, [&](std::size_t i, const double* values) { out[i] = point_of(values); });
}

SurfacePoint2 BsplineSurface::evaluate2(Vec2 uv) const {
  const Local at = locate(uv);
  double out[24];
  kernels_.second(met_.coefficients, order_u_, order_v_, at.s, at.t, out);
  const double *p = out, *pu = out + 4, *pv = out + 8, *puu = out + 12, *puv = out + 16, *pvv = out + 20;
  const double a = met_.u.rate, b = met_.v.rate;
  const auto v3 = [](const double* w, double f) { return f * Vec3{w[0], w[1], w[2]}; };
  SurfacePoint2 r{v3(p, 1), v3(pu, a), v3(pv, b), v3(puu, 2 * a * a), v3(puv, a * b), v3(pvv, 2 * b * b)};
  if (is_rational_) {
    const double w = 1.0 / p[3], wu = a * pu[3], wv = b * pv[3];
    r.x = w * r.x;
    r.du = w * (r.du - wu * r.x);
    r.dv = w * (r.dv - wv * r.x);
    r.duu = w * (r.duu - 2 * wu * r.du - (2 * a * a * puu[3]) * r.x);
    r.duv = w * (r.duv - wu * r.dv - wv * r.du - (a * b * puv[3]) * r.x);
    r.dvv = w * (r.dvv - 2 * wv * r.dv - (2 * b * b * pvv[3]) * r.x);
  }
  return r;
}

void point_batch(const Surface& surface, std::span<const Vec2> uv, std::span<Vec3> out) {
  if (const auto* own = dynamic_cast<const BsplineSurface*>(&surface)) return own->point_batch(uv, out);
  for (std::size_t i = 0; i < uv.size(); ++i) out[i] = surface.point(uv[i]);
}

}  // namespace st
