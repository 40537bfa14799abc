#include "geometry/shape/patch_kernels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <vector>

namespace st {
namespace {

std::vector<double> coefficients(int n) {
  std::vector<double> c(n + 1);
  for (int i = 0; i <= n; ++i) c[i] = 1.5 + std::sin(1.7 * i) / (1 + 0.1 * i);
  return c;
}

/// sum of c s^i t^j and its derivatives, term by term.
double term_sum(const std::vector<double>& c, int n_u, int n_v, int stride, int x, double s, double t, int ds, int dt) {
  const auto power = [](double a, int n, int d) {
    double f = 1;
    for (int k = 0; k < d; ++k) f *= n - k;
    return n < d ? 0.0 : f * std::pow(a, n - d);
  };
  double sum = 0;
  for (int i = 0; i < n_u; ++i)
    for (int j = 0; j < n_v; ++j) sum += c[(i * n_v + j) * stride + x] * power(s, i, ds) * power(t, j, dt);
  return sum;
}

TEST(PatchKernels, sum_the_terms_of_every_order) {
  for (int n_u : {2, 3, 6, 9})
    for (int n_v : {2, 3, 4, 5, 6, 7, 14})
      for (int stride : {3, 4}) {
        const std::vector<double> c = coefficients(n_u * n_v * stride);
        const PatchKernels k = patch_kernels(n_v, stride);
        const double s = 0.6, t = -0.8;
        double p[4], d[12], e[24];
        k.point(c.data(), n_u, n_v, s, t, p);
        k.first(c.data(), n_u, n_v, s, t, d);
        k.second(c.data(), n_u, n_v, s, t, e);
        for (int x = 0; x < stride; ++x) {
          const auto want = [&](int ds, int dt) { return term_sum(c, n_u, n_v, stride, x, s, t, ds, dt); };
          EXPECT_NEAR(p[x], want(0, 0), 1e-11);
          EXPECT_EQ(d[x], p[x]);
          EXPECT_NEAR(d[4 + x], want(1, 0), 1e-11);
          EXPECT_NEAR(d[8 + x], want(0, 1), 1e-11);
          for (int i = 0; i < 12; i += 4) EXPECT_EQ(e[i + x], d[i + x]);
          EXPECT_NEAR(2 * e[12 + x], want(2, 0), 1e-10);
          EXPECT_NEAR(e[16 + x], want(1, 1), 1e-10);
          EXPECT_NEAR(2 * e[20 + x], want(0, 2), 1e-10);
        }
      }
}

TEST(PatchKernels, rows_give_the_bits_of_a_point) {
  for (int n_u : {2, 3, 6, 9})
    for (int n_v : {2, 3, 4, 5, 6, 7, 14})
      for (int stride : {3, 4}) {
        const std::vector<double> c = coefficients(n_u * n_v * stride);
        const PatchKernels k = patch_kernels(n_v, stride);
        std::vector<double> rows(8 * static_cast<std::size_t>(n_u));
        double p[12], q[12];
        k.rows(c.data(), n_u, n_v, -0.8, rows.data());
        for (double s : {0.6, -1.0, 0.1}) {
          k.first(c.data(), n_u, n_v, s, -0.8, p);
          k.first_of_rows(rows.data(), n_u, s, q);
          for (int i = 0; i < 12; ++i)
            if (i % 4 < stride) {
              EXPECT_EQ(p[i], q[i]);
            }
        }
      }
}

TEST(PatchKernels, convert_poles_by_the_bases) {
  const int n_u = 3, n_v = 4, n_row = 7;
  const std::vector<double> poles = coefficients(n_u * n_row * 4), u = coefficients(n_u * n_u),
                            v = coefficients(n_v * n_v);
  for (int stride : {3, 4}) {
    std::vector<double> c(static_cast<std::size_t>(n_u) * n_v * stride + 1);
    patch_kernels(n_v, stride).convert(poles.data(), n_row, u.data(), n_u, v.data(), n_v, c.data());
    for (int b = 0; b < n_u; ++b)
      for (int d = 0; d < n_v; ++d)
        for (int x = 0; x < stride; ++x) {
          double sum = 0;
          for (int i = 0; i < n_u; ++i)
            for (int l = 0; l < n_v; ++l) sum += u[i * n_u + b] * v[l * n_v + d] * poles[(i * n_row + l) * 4 + x];
          EXPECT_NEAR(c[(b * n_v + d) * stride + x], sum, 1e-11);
        }
  }
}

TEST(PatchKernels, give_the_same_bits_on_every_processor) {
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("avx2")) {
    std::cout << "SKIPPED: PatchKernels.give_the_same_bits_on_every_processor: this processor has no AVX2" << std::endl;
    GTEST_SKIP();
  }
  for (int n : {2, 3, 4, 5, 6, 9})
    for (int stride : {3, 4}) {
      const std::vector<double> c = coefficients(n * n * 4);
      const PatchKernels a = detail::patch_kernels_anywhere(n, stride), b = detail::patch_kernels_avx2(n, stride);
      for (double s = -1; s <= 1; s += 0.37) {
        double p[24], q[24];
        const auto expect_same = [&](int n_values) {
          for (int i = 0; i < n_values; ++i)
            if (i % 4 < stride) {
              EXPECT_EQ(p[i], q[i]);
            }
        };
        a.second(c.data(), n, n, s, 0.9 * s + 0.05, p);
        b.second(c.data(), n, n, s, 0.9 * s + 0.05, q);
        expect_same(24);
        a.line_second(c.data(), n, s, 1.7, p);
        b.line_second(c.data(), n, s, 1.7, q);
        expect_same(12);
        double rows_p[72], rows_q[72];
        a.rows(c.data(), n, n, s, rows_p);
        b.rows(c.data(), n, n, s, rows_q);
        a.first_of_rows(rows_p, n, 0.9 * s, p);
        b.first_of_rows(rows_q, n, 0.9 * s, q);
        expect_same(12);
        std::vector<double> patch_p(n * n * 4 + 1), patch_q(patch_p);
        a.convert(c.data(), n, c.data(), n, c.data() + 1, n, patch_p.data());
        b.convert(c.data(), n, c.data(), n, c.data() + 1, n, patch_q.data());
        for (int i = 0; i < n * n * stride; ++i) EXPECT_EQ(patch_p[i], patch_q[i]);
      }
    }
#else
  std::cout << "SKIPPED: PatchKernels.give_the_same_bits_on_every_processor: one kind of processor only" << std::endl;
  GTEST_SKIP();
#endif
}

}  // namespace
}  // namespace st
