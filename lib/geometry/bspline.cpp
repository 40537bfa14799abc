#include "geometry/bspline.h"

#include <algorithm>
#include <cmath>

namespace st {
namespace {

constexpr int kMaxOrder = 26;  // OpenCASCADE's largest degree is 25

// Power coefficients in s of the degree+1 basis functions that act on [knots[k], knots[k+1]]; t = middle + half * s.
// Cox-de Boor recursion carried out on polynomials.
void basis_polynomials(const std::vector<double>& knots, int k, int degree, double middle, double half, double* out) {
  const int order = degree + 1;
  std::vector<double> level(order * order, 0.0), next(order * order, 0.0);
  level[0] = 1.0;  // degree 0: the span's own function
  for (int p = 1; p <= degree; ++p) {
    std::fill(next.begin(), next.end(), 0.0);
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
    level.swap(next);
  }
  std::copy(level.begin(), level.end(), out);
}

}  // namespace

KnotSpans::KnotSpans(int degree, std::vector<double> flat_knots, double period) : degree_(degree), period_(period) {
  const int order = degree + 1, n_poles = static_cast<int>(flat_knots.size()) - order;
  lo_ = flat_knots[degree];
  hi_ = flat_knots[n_poles];
  for (int k = degree; k < n_poles; ++k) {
    const double a = flat_knots[k], b = flat_knots[k + 1];
    if (!(b > a)) continue;
    start_.push_back(a);
    end_.push_back(b);
    middle_.push_back(0.5 * (a + b));
    rate_.push_back(2.0 / (b - a));
    first_pole_.push_back(k - degree);
    basis_.resize(basis_.size() + order * order);
    basis_polynomials(flat_knots, k, degree, 0.5 * (a + b), 0.5 * (b - a), &basis_[basis_.size() - order * order]);
  }
  for (int k = degree + 1; k < n_poles;) {
    int multiplicity = 1;
    while (k + multiplicity < n_poles && flat_knots[k + multiplicity] == flat_knots[k]) ++multiplicity;
    if (multiplicity >= degree && flat_knots[k] > lo_ && flat_knots[k] < hi_) c0_knots_.push_back(flat_knots[k]);
    k += multiplicity;
  }
}

int KnotSpans::locate(double t, int& last, double& s) const {
  if (period_ > 0 && (t < lo_ || t > hi_)) t -= period_ * std::floor((t - lo_) / period_);
  int k = last;
  if (!(t >= start_[k] && t < end_[k])) {
    k = static_cast<int>(std::upper_bound(start_.begin(), start_.end(), t) - start_.begin()) - 1;
    last = k = std::clamp(k, 0, n_spans() - 1);
  }
  s = (t - middle_[k]) * rate_[k];
  return k;
}

BsplineCurve::BsplineCurve(KnotSpans knots, const std::vector<Pole>& poles, bool is_rational, double t_min, double t_max)
    : knots_(std::move(knots)), is_rational_(is_rational) {
  t_min_ = t_min;
  t_max_ = t_max;
  const int order = knots_.degree() + 1;
  coefficients_.assign(static_cast<std::size_t>(knots_.n_spans()) * order, Pole{});
  for (int k = 0; k < knots_.n_spans(); ++k)
    for (int j = 0; j < order; ++j)
      for (int c = 0; c < order; ++c)
        for (int x = 0; x < 4; ++x)
          coefficients_[k * order + c].x[x] += knots_.basis(k)[j * order + c] * poles[knots_.first_pole(k) + j].x[x];
}

Vec3 BsplineCurve::point(double t) const {
  double s;
  const int k = knots_.locate(t, last_, s), degree = knots_.degree();
  const Pole* c = &coefficients_[static_cast<std::size_t>(k) * (degree + 1)];
  double p[4] = {c[degree].x[0], c[degree].x[1], c[degree].x[2], c[degree].x[3]};
  for (int i = degree - 1; i >= 0; --i)
    for (int x = 0; x < 4; ++x) p[x] = p[x] * s + c[i].x[x];
  if (is_rational_) return {p[0] / p[3], p[1] / p[3], p[2] / p[3]};
  return {p[0], p[1], p[2]};
}

CurvePoint BsplineCurve::evaluate(double t) const {
  double s;
  const int k = knots_.locate(t, last_, s), degree = knots_.degree();
  const Pole* c = &coefficients_[static_cast<std::size_t>(k) * (degree + 1)];
  double p[4], d[4] = {}, e[4] = {};
  for (int x = 0; x < 4; ++x) p[x] = c[degree].x[x];
  for (int i = degree - 1; i >= 0; --i)
    for (int x = 0; x < 4; ++x) {
      e[x] = e[x] * s + d[x];
      d[x] = d[x] * s + p[x];
      p[x] = p[x] * s + c[i].x[x];
    }
  const double r = knots_.rate(k);
  Vec3 x0{p[0], p[1], p[2]}, x1 = r * Vec3{d[0], d[1], d[2]}, x2 = 2 * r * r * Vec3{e[0], e[1], e[2]};
  if (is_rational_) {
    const double w0 = p[3], w1 = r * d[3], w2 = 2 * r * r * e[3];
    x0 = x0 / w0;
    x1 = (x1 - w1 * x0) / w0;
    x2 = (x2 - 2 * w1 * x1 - w2 * x0) / w0;
  }
  return {x0, x1, x2};
}

BsplineSurface::BsplineSurface(KnotSpans u, KnotSpans v, std::vector<Pole> poles, int n_v, bool is_rational, Bounds bounds)
    : u_(std::move(u)), v_(std::move(v)), poles_(std::move(poles)), n_v_(n_v), is_rational_(is_rational) {
  type_ = SurfaceType::kBspline;
  u_min_ = bounds.u_min;
  u_max_ = bounds.u_max;
  v_min_ = bounds.v_min;
  v_max_ = bounds.v_max;
  u_breaks_ = u_.c0_knots();
  v_breaks_ = v_.c0_knots();
  patch_index_.assign(static_cast<std::size_t>(u_.n_spans()) * v_.n_spans(), -1);
}

const Pole* BsplineSurface::patch(int iu, int iv) const {
  const int nu = u_.degree() + 1, nv = v_.degree() + 1;
  std::int32_t& index = patch_index_[static_cast<std::size_t>(iu) * v_.n_spans() + iv];
  if (index >= 0) return &patches_[static_cast<std::size_t>(index) * nu * nv];
  index = static_cast<std::int32_t>(patches_.size() / (nu * nv));
  patches_.resize(patches_.size() + nu * nv, Pole{});
  Pole* out = &patches_[static_cast<std::size_t>(index) * nu * nv];
  const double *bu = u_.basis(iu), *bv = v_.basis(iv);
  Pole half[kMaxOrder];
  for (int j = 0; j < nu; ++j) {
    const Pole* row = &poles_[static_cast<std::size_t>(u_.first_pole(iu) + j) * n_v_ + v_.first_pole(iv)];
    for (int c = 0; c < nv; ++c) {
      half[c] = Pole{};
      for (int l = 0; l < nv; ++l)
        for (int x = 0; x < 4; ++x) half[c].x[x] += bv[l * nv + c] * row[l].x[x];
    }
    for (int b = 0; b < nu; ++b)
      for (int c = 0; c < nv; ++c)
        for (int x = 0; x < 4; ++x) out[b * nv + c].x[x] += bu[j * nu + b] * half[c].x[x];
  }
  return out;
}

Vec3 BsplineSurface::point(Vec2 uv) const {
  double s, t;
  const int iu = u_.locate(uv.x, last_u_, s), iv = v_.locate(uv.y, last_v_, t);
  const Pole* c = patch(iu, iv);
  const int nu = u_.degree() + 1, nv = v_.degree() + 1;
  double p[4] = {};
  for (int i = nu - 1; i >= 0; --i) {
    const Pole* row = c + i * nv;
    double q[4] = {row[nv - 1].x[0], row[nv - 1].x[1], row[nv - 1].x[2], row[nv - 1].x[3]};
    for (int j = nv - 2; j >= 0; --j)
      for (int x = 0; x < 4; ++x) q[x] = q[x] * t + row[j].x[x];
    for (int x = 0; x < 4; ++x) p[x] = p[x] * s + q[x];
  }
  if (is_rational_) return {p[0] / p[3], p[1] / p[3], p[2] / p[3]};
  return {p[0], p[1], p[2]};
}

SurfacePoint BsplineSurface::evaluate(Vec2 uv) const {
  double s, t;
  const int iu = u_.locate(uv.x, last_u_, s), iv = v_.locate(uv.y, last_v_, t);
  const Pole* c = patch(iu, iv);
  const int nu = u_.degree() + 1, nv = v_.degree() + 1;
  double p[4] = {}, pu[4] = {}, pv[4] = {};
  for (int i = nu - 1; i >= 0; --i) {
    const Pole* row = c + i * nv;
    double q[4], d[4] = {};
    for (int x = 0; x < 4; ++x) q[x] = row[nv - 1].x[x];
    for (int j = nv - 2; j >= 0; --j)
      for (int x = 0; x < 4; ++x) {
        d[x] = d[x] * t + q[x];
        q[x] = q[x] * t + row[j].x[x];
      }
    for (int x = 0; x < 4; ++x) {
      pu[x] = pu[x] * s + p[x];
      p[x] = p[x] * s + q[x];
      pv[x] = pv[x] * s + d[x];
    }
  }
  const double ru = u_.rate(iu), rv = v_.rate(iv);
  SurfacePoint r{{p[0], p[1], p[2]}, ru * Vec3{pu[0], pu[1], pu[2]}, rv * Vec3{pv[0], pv[1], pv[2]}};
  if (is_rational_) {
    const double w = 1.0 / p[3];
    r.x = w * r.x;
    r.du = w * (r.du - (ru * pu[3]) * r.x);
    r.dv = w * (r.dv - (rv * pv[3]) * r.x);
  }
  return r;
}

SurfacePoint2 BsplineSurface::evaluate2(Vec2 uv) const {
  double s, t;
  const int iu = u_.locate(uv.x, last_u_, s), iv = v_.locate(uv.y, last_v_, t);
  const Pole* c = patch(iu, iv);
  const int nu = u_.degree() + 1, nv = v_.degree() + 1;
  double p[4] = {}, pu[4] = {}, pv[4] = {}, puu[4] = {}, puv[4] = {}, pvv[4] = {};
  for (int i = nu - 1; i >= 0; --i) {
    const Pole* row = c + i * nv;
    double q[4], d[4] = {}, e[4] = {};
    for (int x = 0; x < 4; ++x) q[x] = row[nv - 1].x[x];
    for (int j = nv - 2; j >= 0; --j)
      for (int x = 0; x < 4; ++x) {
        e[x] = e[x] * t + d[x];
        d[x] = d[x] * t + q[x];
        q[x] = q[x] * t + row[j].x[x];
      }
    for (int x = 0; x < 4; ++x) {
      puu[x] = puu[x] * s + pu[x];
      pu[x] = pu[x] * s + p[x];
      p[x] = p[x] * s + q[x];
      puv[x] = puv[x] * s + pv[x];
      pv[x] = pv[x] * s + d[x];
      pvv[x] = pvv[x] * s + e[x];
    }
  }
  const double a = u_.rate(iu), b = v_.rate(iv);
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

}  // namespace st
