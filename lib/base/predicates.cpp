#include "base/predicates.h"

#include <array>

namespace st::detail {

namespace {

/// A number as a sum of doubles that do not overlap, smallest first, without zeros. N bounds the number of terms.
template <int N>
struct Expansion {
  std::array<double, N> term;
  int n = 0;
  void push(double t) {
    if (t != 0) term[n++] = t;
  }
  /// Nearest double, with the exact sign: the largest term dominates the rest.
  double estimate() const {
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += term[i];
    return sum;
  }
};

/// x + y = sum + returned error.
inline double two_sum(double x, double y, double& error) {
  const double sum = x + y, y_virtual = sum - x;
  error = (x - (sum - y_virtual)) + (y - y_virtual);
  return sum;
}

/// x * y = product + error (Dekker; no fused multiply-add is assumed).
inline double two_product(double x, double y, double& error) {
  constexpr double kSplitter = 134217729.0;  // 2^27 + 1
  const double product = x * y;
  const double xs = kSplitter * x, ys = kSplitter * y;
  const double x_hi = xs - (xs - x), x_lo = x - x_hi, y_hi = ys - (ys - y), y_lo = y - y_hi;
  error = x_lo * y_lo - (((product - x_hi * y_hi) - x_lo * y_hi) - x_hi * y_lo);
  return product;
}

/// x - y exactly.
Expansion<2> difference(double x, double y) {
  double error;
  const double sum = two_sum(x, -y, error);
  Expansion<2> e;
  e.push(error);
  e.push(sum);
  return e;
}

/// e + s * f, s = +1 or -1: merge by magnitude, then carry upwards (fast expansion sum).
template <int N, int M>
Expansion<N + M> add(const Expansion<N>& e, const Expansion<M>& f, double s = 1) {
  Expansion<N + M> h;
  int i = 0, j = 0;
  const auto next = [&] {
    const bool from_e = j == f.n || (i < e.n && std::fabs(e.term[i]) < std::fabs(f.term[j]));
    return from_e ? e.term[i++] : s * f.term[j++];
  };
  if (e.n + f.n == 0) return h;
  double carry = next();
  while (i < e.n || j < f.n) {
    double error;
    carry = two_sum(carry, next(), error);
    h.push(error);
  }
  h.push(carry);
  return h;
}

template <int N, int M>
Expansion<N + M> subtract(const Expansion<N>& e, const Expansion<M>& f) {
  return add(e, f, -1);
}

/// e * b (Shewchuk's scale expansion).
template <int N>
Expansion<2 * N> scale(const Expansion<N>& e, double b) {
  Expansion<2 * N> h;
  if (e.n == 0) return h;
  double error;
  double carry = two_product(e.term[0], b, error);
  h.push(error);
  for (int i = 1; i < e.n; ++i) {
    double low, rest;
    const double high = two_product(e.term[i], b, low);
    const double mid = two_sum(carry, low, rest);
    h.push(rest);
    carry = two_sum(high, mid, rest);
    h.push(rest);
  }
  h.push(carry);
  return h;
}

/// e * f, f short: one scaled copy of e for each term of f, added pairwise.
template <int N>
Expansion<4 * N> multiply(const Expansion<N>& e, const Expansion<2>& f) {
  if (f.n == 0 || e.n == 0) return {};
  const Expansion<2 * N> low = scale(e, f.term[0]);
  return add(low, f.n == 2 ? scale(e, f.term[1]) : Expansion<2 * N>{});
}

using Difference = Expansion<2>;

/// a * d - b * c.
Expansion<16> det2(const Difference& a, const Difference& b, const Difference& c, const Difference& d) {
  return subtract(multiply(a, d), multiply(b, c));
}

}  // namespace

double orient2d_exact(Vec2 a, Vec2 b, Vec2 c) {
  const Difference acx = difference(a.x, c.x), acy = difference(a.y, c.y), bcx = difference(b.x, c.x),
                   bcy = difference(b.y, c.y);
  return det2(acx, acy, bcx, bcy).estimate();
}

double orient3d_exact(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const Difference px = difference(a.x, d.x), py = difference(a.y, d.y), pz = difference(a.z, d.z);
  const Difference qx = difference(b.x, d.x), qy = difference(b.y, d.y), qz = difference(b.z, d.z);
  const Difference rx = difference(c.x, d.x), ry = difference(c.y, d.y), rz = difference(c.z, d.z);
  const auto first = multiply(det2(rx, ry, qx, qy), pz);
  const auto second = multiply(det2(px, py, rx, ry), qz);
  const auto third = multiply(det2(qx, qy, px, py), rz);
  return add(add(first, second), third).estimate();
}

}  // namespace st::detail
