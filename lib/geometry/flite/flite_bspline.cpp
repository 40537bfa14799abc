#include "geometry/flite/flite_bspline.h"

#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>

#include "geometry/flite/flite_spline.h"

namespace st::occt {
namespace {

struct Knots {
  TColStd_Array1OfReal values;
  TColStd_Array1OfInteger multiplicities;
  int degree;
};

Knots knots_of(int n_points) {
  Knots knots{TColStd_Array1OfReal(1, n_points), TColStd_Array1OfInteger(1, n_points), natural_spline_degree(n_points)};
  for (int i = 1; i <= n_points; ++i) {
    knots.values(i) = i - 1;
    knots.multiplicities(i) = i == 1 || i == n_points ? knots.degree + 1 : 1;
  }
  return knots;
}

gp_Pnt point(Vec3 p) { return {p.x, p.y, p.z}; }

}  // namespace

Handle(Geom_BSplineCurve) bspline_curve(std::span<const Vec3> points) {
  const std::vector<Vec3> poles = natural_spline_poles(points);
  TColgp_Array1OfPnt array(1, static_cast<int>(poles.size()));
  for (std::size_t i = 0; i < poles.size(); ++i) array(static_cast<int>(i) + 1) = point(poles[i]);
  const Knots knots = knots_of(static_cast<int>(points.size()));
  return new Geom_BSplineCurve(array, knots.values, knots.multiplicities, knots.degree);
}

Handle(Geom_BSplineSurface) bspline_surface(int n_u, int n_v, std::span<const Vec3> points) {
  const int m_u = natural_spline_n_poles(n_u), m_v = natural_spline_n_poles(n_v);
  const std::vector<Vec3> poles = natural_surface_poles(n_u, n_v, points);
  TColgp_Array2OfPnt array(1, m_u, 1, m_v);
  for (int j = 0; j < m_v; ++j)
    for (int i = 0; i < m_u; ++i) array(i + 1, j + 1) = point(poles[static_cast<std::size_t>(j) * m_u + i]);
  const Knots u = knots_of(n_u), v = knots_of(n_v);
  return new Geom_BSplineSurface(array, u.values, v.values, u.multiplicities, v.multiplicities, u.degree, v.degree);
}

}  // namespace st::occt
