#include "geometry/ferguson.h"

namespace st {
namespace {

/// 0 0 0 0 1 1 2 2 ... n n n n for n = n_points - 1.
std::vector<double> double_knots(int n_points) {
  std::vector<double> knots(2 * n_points + 4);
  for (int i = 0; i < n_points; ++i) knots[2 * i + 2] = knots[2 * i + 3] = i;
  knots[0] = knots[1] = 0;
  knots[2 * n_points + 2] = knots[2 * n_points + 3] = n_points - 1;
  return knots;
}

/// Where the k-th of 2 n_points poles is, from its grid point: at the ends on the point, inside a third of the derivative before or after
/// it.
double reach(int k, int n_points) { return k == 0 || k == 2 * n_points - 1 ? 0.0 : (k % 2 == 0 ? -1.0 : 1.0) / 3; }

}  // namespace

std::unique_ptr<BsplineCurve> ferguson_curve(std::span<const Vec3> points, std::span<const Vec3> tangents) {
  const int n = static_cast<int>(points.size());
  std::vector<Pole> poles;
  for (int k = 0; k < 2 * n; ++k) {
    // the first pole is the first point, the second a third of its tangent further: both belong to point 0
    const Vec3 p = points[k / 2] + reach(k, n) * tangents[k / 2];
    poles.push_back({{p.x, p.y, p.z, 1}});
  }
  return std::make_unique<BsplineCurve>(KnotSpans(3, double_knots(n), 0), poles, false, 0, n - 1);
}

std::unique_ptr<BsplineSurface> ferguson_surface(const FergusonGrid& g) {
  std::vector<Pole> poles;
  for (int i = 0; i < 2 * g.n_u; ++i)
    for (int j = 0; j < 2 * g.n_v; ++j) {
      const std::size_t at = static_cast<std::size_t>(j / 2) * g.n_u + i / 2;
      const double a = reach(i, g.n_u), b = reach(j, g.n_v);
      const Vec3 p = g.x[at] + a * g.xu[at] + b * g.xv[at] + (a * b) * g.xuv[at];
      poles.push_back({{p.x, p.y, p.z, 1}});
    }
  return std::make_unique<BsplineSurface>(KnotSpans(3, double_knots(g.n_u), 0), KnotSpans(3, double_knots(g.n_v), 0), std::move(poles),
                                          2 * g.n_v, false, BsplineSurface::Bounds{0, double(g.n_u - 1), 0, double(g.n_v - 1)});
}

}  // namespace st
