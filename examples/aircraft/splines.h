/// Cubic B-spline curves and surfaces through given points: the raw material of the example's parts. Lengths in metres.
#pragma once

#include <Geom_BSplineSurface.hxx>
#include <array>
#include <functional>
#include <gp_Pnt.hxx>
#include <vector>

namespace aircraft {

using Vec4 = std::array<double, 4>;

/// Interpolation by clamped cubic B-splines. The knots are averages of the parameters, so curves over the same
/// parameters share them.
class CubicInterpolation {
 public:
  /// @param parameters strictly increasing, at least four.
  explicit CubicInterpolation(std::vector<double> parameters);

  /// Poles of the curve that passes through points[i] at parameter i. @param points as many as parameters.
  std::vector<Vec4> poles(const std::vector<Vec4>& points) const;

  /// The whole parameter range.
  double first() const { return parameters_.front(); }
  double last() const { return parameters_.back(); }

  /// Distinct knots and their multiplicities (4 at both ends, 1 inside).
  std::vector<double> knots() const;
  std::vector<int> multiplicities() const;

 private:
  std::vector<double> parameters_;
  std::vector<double> flat_knots_;
};

/// Surface through a grid of points: u along each row, v from row to row. @param rows rows[j][i] lies at (u_i, v_j).
Handle(Geom_BSplineSurface)
    skin(const std::vector<std::vector<gp_Pnt>>& rows, const CubicInterpolation& u, const CubicInterpolation& v);

/// One cross-section of a slender body: an ellipse in a plane x = const.
struct Ellipse {
  double x = 0;            ///< station
  double half_width = 0;   ///< along y
  double half_height = 0;  ///< along z
  double centre_y = 0;
  double centre_z = 0;
};

/// Exact sector of a body whose cross-sections are ellipses interpolated along v. u is the angle in rad, from the top
/// (+z) towards +y.
/// @param sections as many as v has parameters; a section of zero size becomes a pole.
/// @param angle_begin,angle_end less than 180 degrees apart.
Handle(Geom_BSplineSurface) elliptic_sector(const std::vector<Ellipse>& sections, const CubicInterpolation& v,
                                            double angle_begin, double angle_end);

/// Copy of the part of a surface between the given parameters.
Handle(Geom_BSplineSurface)
    segment(const Handle(Geom_BSplineSurface) & surface, std::array<double, 2> u, std::array<double, 2> v);

/// Ruled surface between two compatible curves; u across from `a` (0) to `b` (1), v along them.
Handle(Geom_BSplineSurface) ruled(const Handle(Geom_Curve) & a, const Handle(Geom_Curve) & b);

/// n values from a to b, both included.
std::vector<double> linspace(double a, double b, int n);

/// 0 below 0, 1 above 1, in between a cubic that starts and ends level.
double smoothstep(double t);

}  // namespace aircraft
