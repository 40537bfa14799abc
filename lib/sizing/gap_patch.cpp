#include "sizing/gap_patch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/eigen.h"

namespace st {
namespace {

constexpr double kOverlap = 0.02;  // of the patch's width: no ray passes between neighbours
constexpr double kRidge = 1e-6;    // of the largest moment: keeps the fit of a degenerate patch solvable, and flat

/// Component of `d` across `n`, unit; zero where there is none.
Vec3 across(Vec3 d, Vec3 n) { return normalized(d - dot(d, n) * n); }

}  // namespace

Vec3 Paraboloid::normal_at(double s, double t) const {
  return normalized(normal - (k_ss * s + k_st * t) * axis_s - (k_st * s + k_tt * t) * axis_t);
}

bool Paraboloid::is_inside(double s0, double s1, double t0, double t1) const {
  if (inside == ~std::uint64_t{0}) return true;
  const auto cells = [](double x0, double x1, double lo, double hi) {  // first and last one
    if (!(hi > lo)) return std::pair(0, 7);
    const double per_cell = 8 / (hi - lo);
    const int first = std::clamp(static_cast<int>(per_cell * (x0 - lo)), 0, 7);
    return std::pair(first, std::clamp(static_cast<int>(std::ceil(per_cell * (x1 - lo))) - 1, first, 7));
  };
  const auto [first, last] = cells(s0, s1, s_lo, s_hi);
  const auto [first_row, last_row] = cells(t0, t1, t_lo, t_hi);
  const std::uint64_t columns = (2u << last) - (1u << first);
  for (int row = first_row; row <= last_row; ++row)
    if (inside >> (8 * row) & columns) return true;
  return false;
}

double Paraboloid::sagging() const {
  const auto of_circle = [](double k, double half) { return std::abs(k * k * k) * half * half * half * half / 8; };
  return of_circle(k_ss, std::max(-s_lo, s_hi)) + of_circle(k_tt, std::max(-t_lo, t_hi));
}

Box3 Paraboloid::box() const {
  Box3 box;
  const double h = 0.5 * (std::abs(k_ss) * std::max(s_lo * s_lo, s_hi * s_hi) +
                          std::abs(k_tt) * std::max(t_lo * t_lo, t_hi * t_hi)) +
                   std::abs(k_st) * std::max(-s_lo, s_hi) * std::max(-t_lo, t_hi);
  const double below = k_ss >= 0 && k_tt >= 0 && k_st == 0 ? 0 : -h,
               above = k_ss <= 0 && k_tt <= 0 && k_st == 0 ? 0 : h;
  for (const double s : {s_lo, s_hi})
    for (const double t : {t_lo, t_hi})
      for (const double z : {below, above}) box.add(x + s * axis_s + t * axis_t + z * normal);
  return box;
}

std::optional<double> Paraboloid::facing_distance(Vec3 from, Vec3 direction) const {
  const Vec3 o = from - x;
  const double os = dot(o, axis_s), ot = dot(o, axis_t), on = dot(o, normal);
  const double ds = dot(direction, axis_s), dt = dot(direction, axis_t), dn = dot(direction, normal);
  // 0.5 K(o + t d, o + t d) = on + t dn: the root next to that of the tangent plane.
  const double a = 0.5 * (k_ss * ds * ds + k_tt * dt * dt) + k_st * ds * dt;
  const double b = k_ss * os * ds + k_tt * ot * dt + k_st * (os * dt + ot * ds) - dn;
  const double c = height(os, ot) - on, discriminant = b * b - 4 * a * c;
  if (discriminant < 0 || b == 0) return std::nullopt;
  const double distance = -2 * c / (b + std::copysign(std::sqrt(discriminant), b));
  const double s = os + distance * ds, t = ot + distance * dt;
  if (!(s >= s_lo && s <= s_hi && t >= t_lo && t <= t_hi)) return std::nullopt;
  if (dot(normal_at(s, t), direction) > kFacing || !is_inside(s, s, t, t)) return std::nullopt;
  return distance;
}

Paraboloid fit_patch(const std::array<Vec3, 9>& points, Vec3 normal) {
  Paraboloid patch;
  patch.x = points[4];
  patch.normal = normal;
  const Vec3 along_u = across(points[5] - points[3], normal), along_v = across(points[7] - points[1], normal);
  const Vec3 spare = std::abs(normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  patch.axis_s = along_u == Vec3{} ? across(along_v == Vec3{} ? spare : cross(along_v, normal), normal) : along_u;
  patch.axis_t = cross(normal, patch.axis_s);
  if (dot(patch.axis_t, along_v) < 0) patch.axis_t = -patch.axis_t;

  std::array<double, 9> s, t, h;
  double scale = 0;
  for (std::size_t k = 0; k < 9; ++k) {
    const Vec3 d = points[k] - patch.x;
    s[k] = dot(d, patch.axis_s), t[k] = dot(d, patch.axis_t), h[k] = dot(d, normal);
    scale = std::max({scale, std::abs(s[k]), std::abs(t[k])});
    patch.s_lo = std::min(patch.s_lo, s[k]), patch.s_hi = std::max(patch.s_hi, s[k]);
    patch.t_lo = std::min(patch.t_lo, t[k]), patch.t_hi = std::max(patch.t_hi, t[k]);
  }
  if (!(scale > 0)) return patch;
  const double overlap_s = kOverlap * (patch.s_hi - patch.s_lo), overlap_t = kOverlap * (patch.t_hi - patch.t_lo);
  patch.s_lo -= overlap_s, patch.s_hi += overlap_s, patch.t_lo -= overlap_t, patch.t_hi += overlap_t;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 9; ++k) {
    const double a = s[k] / scale, b = t[k] / scale;
    const Eigen::Vector3d row(0.5 * a * a, a * b, 0.5 * b * b);
    moments += row * row.transpose();
    right += h[k] / scale * row;
  }
  moments.diagonal().array() += kRidge * moments.trace();
  const auto k = solve(moments, right, 0);
  if (k) patch.k_ss = k->x() / scale, patch.k_st = k->y() / scale, patch.k_tt = k->z() / scale;
  return patch;
}

}  // namespace st
