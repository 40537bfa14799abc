// Fixed-size linear algebra: the only header that includes Eigen, and the way from our vectors to Eigen's and back.
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/vec.h"

namespace st {

using Matrix32 = Eigen::Matrix<double, 3, 2>;

inline Eigen::Vector2d to_eigen(Vec2 a) { return {a.x, a.y}; }
inline Eigen::Vector3d to_eigen(Vec3 a) { return {a.x, a.y, a.z}; }
inline Vec2 to_vec2(const Eigen::Vector2d& a) { return {a.x(), a.y()}; }
inline Vec3 to_vec3(const Eigen::Vector3d& a) { return {a.x(), a.y(), a.z()}; }

/// The symmetric matrix {{a, b}, {b, c}}.
inline Eigen::Matrix2d symmetric(double a, double b, double c) { return (Eigen::Matrix2d() << a, b, b, c).finished(); }

/// The adjugate: m * adjugate(m) is the determinant times the identity.
inline Eigen::Matrix2d adjugate(const Eigen::Matrix2d& m) {
  return (Eigen::Matrix2d() << m(1, 1), -m(0, 1), -m(1, 0), m(0, 0)).finished();
}

/// Of a symmetric matrix: eigenvalues ascending, and a unit vector for each, whose largest component is positive.
struct PrincipalAxes {
  std::array<double, 3> value;
  std::array<Vec3, 3> axis;
};

inline PrincipalAxes principal_axes(const Eigen::Matrix3d& symmetric_matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(symmetric_matrix);
  PrincipalAxes result{};
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = to_vec3(Eigen::Vector3d(solver.eigenvectors().col(k)));
    const double ends[] = {axis.x, axis.y, axis.z};
    const double sign = *std::max_element(ends, ends + 3, [](double a, double b) { return std::abs(a) < std::abs(b); });
    result.value[k] = solver.eigenvalues()[k];
    result.axis[k] = sign < 0 ? -1 * axis : axis;
  }
  return result;
}

/// x of m x = b, for 2 x 2 and 3 x 3 (more would need pivots). nullopt unless the determinant is above
/// `least_determinant` (>= 0): m is too near to singular, of negative determinant, or not a number.
template <int N>
std::optional<Eigen::Matrix<double, N, 1>> solve(const Eigen::Matrix<double, N, N>& m,
                                                 const Eigen::Matrix<double, N, 1>& b, double least_determinant) {
  static_assert(N == 2 || N == 3);
  const double determinant = m.determinant();
  if (!(determinant > least_determinant)) return std::nullopt;
  if constexpr (N == 2)
    return adjugate(m) * b / determinant;  // one rounding less than with the inverse
  else
    return m.inverse() * b;
}

}  // namespace st
