#include "splines.h"

#include <BSplCLib.hxx>
#include <GeomFill.hxx>
#include <Geom_BSplineCurve.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace aircraft {
namespace {

constexpr int kDegree = 3;

TColStd_Array1OfReal reals(const std::vector<double>& values) {
  TColStd_Array1OfReal array(1, int(values.size()));
  for (int i = 0; i < int(values.size()); ++i) array(i + 1) = values[i];
  return array;
}

TColStd_Array1OfInteger integers(const std::vector<int>& values) {
  TColStd_Array1OfInteger array(1, int(values.size()));
  for (int i = 0; i < int(values.size()); ++i) array(i + 1) = values[i];
  return array;
}

/// sin or cos without the rounding noise that would lift points off the symmetry plane.
double clean(double x) { return std::abs(x) < 1e-14 ? 0.0 : x; }

}  // namespace

CubicInterpolation::CubicInterpolation(std::vector<double> parameters) : parameters_(std::move(parameters)) {
  const int n = int(parameters_.size());
  if (n < kDegree + 1) throw std::invalid_argument("cubic interpolation needs at least four parameters");
  flat_knots_.assign(kDegree + 1, parameters_.front());
  for (int j = 1; j + kDegree < n; ++j)
    flat_knots_.push_back((parameters_[j] + parameters_[j + 1] + parameters_[j + 2]) / kDegree);
  flat_knots_.insert(flat_knots_.end(), kDegree + 1, parameters_.back());
}

std::vector<Vec4> CubicInterpolation::poles(const std::vector<Vec4>& points) const {
  if (points.size() != parameters_.size()) throw std::invalid_argument("as many points as parameters expected");
  std::vector<Vec4> result = points;
  TColStd_Array1OfInteger contact(1, int(points.size()));
  contact.Init(0);
  int failed = 0;
  BSplCLib::Interpolate(kDegree, reals(flat_knots_), reals(parameters_), contact, 4, result[0][0], failed);
  if (failed != 0) throw std::runtime_error("cubic interpolation failed");
  result.front() = points.front();  // clamped ends are met exactly
  result.back() = points.back();
  return result;
}

std::vector<double> CubicInterpolation::knots() const {
  return {flat_knots_.begin() + kDegree, flat_knots_.end() - kDegree};
}

std::vector<int> CubicInterpolation::multiplicities() const {
  std::vector<int> result(knots().size(), 1);
  result.front() = result.back() = kDegree + 1;
  return result;
}

Handle(Geom_BSplineSurface)
    skin(const std::vector<std::vector<gp_Pnt>>& rows, const CubicInterpolation& u, const CubicInterpolation& v) {
  const int nu = int(rows.front().size()), nv = int(rows.size());
  std::vector<std::vector<Vec4>> row_poles;
  for (const auto& row : rows) {
    std::vector<Vec4> points;
    for (const gp_Pnt& p : row) points.push_back({p.X(), p.Y(), p.Z(), 0});
    row_poles.push_back(u.poles(points));
  }
  TColgp_Array2OfPnt poles(1, nu, 1, nv);
  for (int i = 0; i < nu; ++i) {
    std::vector<Vec4> column;
    for (const auto& row : row_poles) column.push_back(row[i]);
    column = v.poles(column);
    for (int j = 0; j < nv; ++j) poles(i + 1, j + 1) = gp_Pnt(column[j][0], column[j][1], column[j][2]);
  }
  return new Geom_BSplineSurface(poles, reals(u.knots()), reals(v.knots()), integers(u.multiplicities()),
                                 integers(v.multiplicities()), kDegree, kDegree);
}

Handle(Geom_BSplineSurface) elliptic_sector(const std::vector<Ellipse>& sections, const CubicInterpolation& v,
                                            double angle_begin, double angle_end) {
  std::vector<Vec4> shape, centre;
  for (const Ellipse& e : sections) {
    shape.push_back({e.x, e.half_width, e.half_height, 0});
    centre.push_back({e.centre_y, e.centre_z, 0, 0});
  }
  shape = v.poles(shape);
  centre = v.poles(centre);

  const double middle = 0.5 * (angle_begin + angle_end), weight = std::cos(0.5 * (angle_end - angle_begin));
  const double s[3] = {clean(std::sin(angle_begin)), clean(std::sin(middle)) / weight, clean(std::sin(angle_end))};
  const double c[3] = {clean(std::cos(angle_begin)), clean(std::cos(middle)) / weight, clean(std::cos(angle_end))};
  const int nv = int(sections.size());
  TColgp_Array2OfPnt poles(1, 3, 1, nv);
  TColStd_Array2OfReal weights(1, 3, 1, nv);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < nv; ++j) {
      poles(i + 1, j + 1) = gp_Pnt(shape[j][0], centre[j][0] + shape[j][1] * s[i], centre[j][1] + shape[j][2] * c[i]);
      weights(i + 1, j + 1) = i == 1 ? weight : 1.0;
    }
  }
  return new Geom_BSplineSurface(poles, weights, reals({angle_begin, angle_end}), reals(v.knots()), integers({3, 3}),
                                 integers(v.multiplicities()), 2, kDegree);
}

Handle(Geom_BSplineSurface)
    segment(const Handle(Geom_BSplineSurface) & surface, std::array<double, 2> u, std::array<double, 2> v) {
  auto part = Handle(Geom_BSplineSurface)::DownCast(surface->Copy());
  part->Segment(u[0], u[1], v[0], v[1]);
  return part;
}

Handle(Geom_BSplineSurface) ruled(const Handle(Geom_Curve) & a, const Handle(Geom_Curve) & b) {
  auto p = Handle(Geom_BSplineCurve)::DownCast(a), q = Handle(Geom_BSplineCurve)::DownCast(b);
  const int n = p->NbPoles();
  if (n != q->NbPoles()) throw std::invalid_argument("ruled surface between incompatible curves");
  TColgp_Array2OfPnt poles(1, 2, 1, n);
  TColStd_Array2OfReal weights(1, 2, 1, n);
  for (int i = 1; i <= n; ++i) {
    poles(1, i) = p->Pole(i);
    poles(2, i) = q->Pole(i);
    weights(1, i) = p->Weight(i);
    weights(2, i) = q->Weight(i);
  }
  return new Geom_BSplineSurface(poles, weights, reals({0, 1}), p->Knots(), integers({2, 2}), p->Multiplicities(), 1,
                                 p->Degree());
}

std::vector<double> linspace(double a, double b, int n) {
  std::vector<double> values(n);
  for (int i = 0; i < n; ++i) values[i] = i == n - 1 ? b : a + (b - a) * i / (n - 1);
  return values;
}

double smoothstep(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace aircraft
