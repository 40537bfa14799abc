#include "meshing/face/plane_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace st {
namespace {

constexpr int kProbe = 6;        // grid on which the derivatives are looked at
constexpr int kIntervals = 48;   // along a coordinate in which they are uneven
constexpr double kUneven = 4;    // largest over least length of a derivative, each the mean across
constexpr double kLeast = 0.02;  // of the mean length: the plane stays a plane where the derivative vanishes

struct Lengths {
  double u = 0, v = 0;
};

Lengths lengths_at(const Surface& s, double x, double y) {
  const SurfacePoint p = s.evaluate({s.u_min() + x * (s.u_max() - s.u_min()), s.v_min() + y * (s.v_max() - s.v_min())});
  return {norm(p.du), norm(p.dv)};
}

bool is_uneven(const double (&means)[kProbe]) {
  const auto [least, largest] = std::minmax_element(std::begin(means), std::end(means));
  return std::isfinite(*largest) && *largest > kUneven * *least;
}

/// At the ends of the intervals, with a floor. `length(at, across)`: both from 0 to 1.
template <class Length>
std::vector<double> factors_of(double mean, const Length& length) {
  std::vector<double> factors;
  for (int i = 0; i <= kIntervals; ++i) {
    double sum = 0;
    for (int j = 0; j < kProbe; ++j) sum += length(static_cast<double>(i) / kIntervals, (j + 0.5) / kProbe);
    factors.push_back(std::isfinite(sum) ? std::max(sum / kProbe, kLeast * mean) : mean);
  }
  return factors;
}

}  // namespace

PlaneAxis::PlaneAxis(double lo, double hi, std::vector<double> factors)
    : lo_(lo), step_((hi - lo) / static_cast<double>(factors.size() - 1)), factors_(std::move(factors)), at_{0} {
  for (std::size_t i = 1; i < factors_.size(); ++i)
    at_.push_back(at_.back() + 0.5 * step_ * (factors_[i - 1] + factors_[i]));
  scale_ = at_.back() / (hi - lo);
}

std::size_t PlaneAxis::interval_of(double u) const {
  const double last = static_cast<double>(factors_.size() - 2);
  return static_cast<std::size_t>(std::clamp(std::floor((u - lo_) / step_), 0.0, last));
}

/// Beyond the ends, where nodes may lie by rounding or a little more, as at the end.
double PlaneAxis::factor(double u) const {
  if (factors_.empty()) return scale_;
  const std::size_t i = interval_of(u);
  const double share = std::clamp((u - lo_) / step_ - static_cast<double>(i), 0.0, 1.0);
  return factors_[i] + share * (factors_[i + 1] - factors_[i]);
}

double PlaneAxis::integral(double u) const {
  const std::size_t i = interval_of(u);
  const double way = u - lo_ - static_cast<double>(i) * step_, inside = std::clamp(way, 0.0, step_);
  const double slope = (factors_[i + 1] - factors_[i]) / step_;
  return at_[i] + inside * (factors_[i] + 0.5 * slope * inside) + (way - inside) * factor(u);
}

double PlaneAxis::inverse(double p) const {
  const auto after = std::upper_bound(at_.begin() + 1, at_.end() - 1, p);
  const auto i = static_cast<std::size_t>(after - at_.begin()) - 1;
  const double begin = lo_ + static_cast<double>(i) * step_, rest = p - at_[i];
  if (rest < 0) return begin + rest / factors_[i];
  if (p > at_[i + 1]) return begin + step_ + (p - at_[i + 1]) / factors_[i + 1];
  const double slope = (factors_[i + 1] - factors_[i]) / step_;
  return begin + 2 * rest / (factors_[i] + std::sqrt(std::max(0.0, factors_[i] * factors_[i] + 2 * slope * rest)));
}

PlaneMap::PlaneMap(const Surface& s) {
  double means_u[kProbe] = {}, means_v[kProbe] = {}, su = 0, sv = 0;
  const double du = (s.u_max() - s.u_min()) / kProbe, dv = (s.v_max() - s.v_min()) / kProbe;
  std::array<Vec2, kProbe * kProbe> places;  // in rows of one v, which are cheap
  std::array<SurfacePoint, kProbe * kProbe> points;
  for (int j = 0; j < kProbe; ++j)
    for (int i = 0; i < kProbe; ++i) places[kProbe * j + i] = {s.u_min() + (i + 0.5) * du, s.v_min() + (j + 0.5) * dv};
  s.evaluate_batch(places, points);
  for (int i = 0; i < kProbe; ++i)
    for (int j = 0; j < kProbe; ++j) {
      const SurfacePoint& p = points[kProbe * j + i];
      su += norm(p.du);
      sv += norm(p.dv);
      means_u[i] += norm(p.du);
      means_v[j] += norm(p.dv);
    }
  const double n = kProbe * kProbe;
  su = su > 0 && std::isfinite(su) ? su / n : 1.0;
  sv = sv > 0 && std::isfinite(sv) ? sv / n : 1.0;
  u = is_uneven(means_u)
          ? PlaneAxis(s.u_min(), s.u_max(), factors_of(su, [&](double x, double y) { return lengths_at(s, x, y).u; }))
          : PlaneAxis(su);
  v = is_uneven(means_v)
          ? PlaneAxis(s.v_min(), s.v_max(), factors_of(sv, [&](double y, double x) { return lengths_at(s, x, y).v; }))
          : PlaneAxis(sv);
}

}  // namespace st
