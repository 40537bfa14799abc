#include "geometry/flite/flite_spline.h"

#include "base/assert.h"

namespace st {
namespace {

/// Derivatives at the points: T(i-1) + 4 T(i) + T(i+1) = 3 (P(i+1) - P(i-1)), at the ends 2 T(0) + T(1) = 3 (P(1) -
/// P(0)).
std::vector<Vec3> natural_tangents(std::span<const Vec3> p) {
  const std::size_t n = p.size();
  std::vector<double> ratio(n);
  std::vector<Vec3> t(n);
  for (std::size_t i = 0; i < n; ++i) {
    const bool is_end = i == 0 || i + 1 == n;
    const Vec3 right = 3.0 * (p[std::min(i + 1, n - 1)] - p[i == 0 ? 0 : i - 1]);
    const double pivot = (is_end ? 2.0 : 4.0) - (i == 0 ? 0.0 : ratio[i - 1]);
    ratio[i] = 1.0 / pivot;
    t[i] = (i == 0 ? right : right - t[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 0;) t[i] -= ratio[i] * t[i + 1];
  return t;
}

/// 0 0 0 0 1 2 ... n n n n for n = n_points - 1; of two points 0 0 1 1.
std::vector<double> flat_knots(int n_points) {
  std::vector<double> knots;
  for (int i = 0; i < n_points; ++i)
    knots.insert(knots.end(), i == 0 || i == n_points - 1 ? natural_spline_degree(n_points) + 1 : 1, double(i));
  return knots;
}

KnotSpans spans(int n_points) { return {natural_spline_degree(n_points), flat_knots(n_points), 0}; }

Pole pole(Vec3 p) { return {{p.x, p.y, p.z, 1}}; }

}  // namespace

std::vector<Vec3> natural_spline_poles(std::span<const Vec3> p) {
  ST_ASSERT(p.size() >= 2);
  const int n = static_cast<int>(p.size());
  if (n == 2) return {p.begin(), p.end()};
  const std::vector<Vec3> t = natural_tangents(p);
  std::vector<Vec3> poles{p[0]};
  // the pole of the knots a, b, c is the blossom of any of their pieces at (a, b, c)
  for (int k = 0; k < n; ++k) {
    const int i = std::min(k, n - 2);  // piece from i to i + 1, P + T s + A s^2 + B s^3
    const Vec3 chord = p[i + 1] - p[i], quadratic = 3.0 * chord - 2.0 * t[i] - t[i + 1],
               cubic = t[i] + t[i + 1] - 2.0 * chord;
    const double a = std::max(k - 1, 0) - i, b = k - i, c = std::min(k + 1, n - 1) - i;
    poles.push_back(p[i] + ((a + b + c) / 3) * t[i] + ((a * b + b * c + c * a) / 3) * quadratic + (a * b * c) * cubic);
  }
  poles.push_back(p[n - 1]);
  return poles;
}

std::vector<Vec3> natural_surface_poles(int n_u, int n_v, std::span<const Vec3> points) {
  ST_ASSERT(n_u >= 2 && n_v >= 2 && points.size() == static_cast<std::size_t>(n_u) * n_v);
  const int m_u = natural_spline_n_poles(n_u), m_v = natural_spline_n_poles(n_v);
  std::vector<Vec3> rows, result(static_cast<std::size_t>(m_u) * m_v), column(n_v);
  for (int j = 0; j < n_v; ++j) {
    const std::vector<Vec3> poles = natural_spline_poles(points.subspan(static_cast<std::size_t>(j) * n_u, n_u));
    rows.insert(rows.end(), poles.begin(), poles.end());
  }
  for (int i = 0; i < m_u; ++i) {
    for (int j = 0; j < n_v; ++j) column[j] = rows[static_cast<std::size_t>(j) * m_u + i];
    const std::vector<Vec3> poles = natural_spline_poles(column);
    for (int j = 0; j < m_v; ++j) result[static_cast<std::size_t>(j) * m_u + i] = poles[j];
  }
  return result;
}

std::unique_ptr<BsplineCurve> ferguson_curve(std::span<const Vec3> points) {
  std::vector<Pole> poles;
  for (const Vec3 p : natural_spline_poles(points)) poles.push_back(pole(p));
  const int n = static_cast<int>(points.size());
  return std::make_unique<BsplineCurve>(spans(n), poles, false, 0, n - 1);
}

std::unique_ptr<BsplineSurface> ferguson_surface(int n_u, int n_v, std::span<const Vec3> points) {
  const int m_u = natural_spline_n_poles(n_u), m_v = natural_spline_n_poles(n_v);
  const std::vector<Vec3> by_row = natural_surface_poles(n_u, n_v, points);
  std::vector<Pole> poles;
  for (int i = 0; i < m_u; ++i)
    for (int j = 0; j < m_v; ++j) poles.push_back(pole(by_row[static_cast<std::size_t>(j) * m_u + i]));
  return std::make_unique<BsplineSurface>(spans(n_u), spans(n_v), std::move(poles), m_v, false,
                                          Box2{{0, 0}, {n_u - 1.0, n_v - 1.0}});
}

}  // namespace st
