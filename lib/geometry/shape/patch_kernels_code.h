// The kernels' code, compiled once per kind of processor by the file that includes it, with ST_FOUR_WIDE where vectors
// hold four doubles. Include nothing here that has code of its own.
#pragma once

#include "geometry/shape/patch_kernels.h"

#pragma GCC diagnostic ignored "-Wpsabi"  // vectors stay inside this file

namespace st {
namespace {

#if defined(ST_FOUR_WIDE)
typedef double V4 __attribute__((vector_size(32)));
typedef double V4Anywhere __attribute__((vector_size(32), aligned(8), may_alias));

inline V4 load(const double* p) { return *reinterpret_cast<const V4Anywhere*>(p); }
inline void store(double* p, const V4& x) { *reinterpret_cast<V4Anywhere*>(p) = x; }
inline double fourth(const V4& x) { return x[3]; }
#else
typedef double V2 __attribute__((vector_size(16)));
typedef double V2Anywhere __attribute__((vector_size(16), aligned(8), may_alias));
struct V4 {
  V2 lo, hi;
};

inline V4 operator+(const V4& a, const V4& b) { return {a.lo + b.lo, a.hi + b.hi}; }
inline V4 operator-(const V4& a, const V4& b) { return {a.lo - b.lo, a.hi - b.hi}; }
inline V4 operator*(const V4& a, double s) { return {a.lo * s, a.hi * s}; }
inline V4 operator*(double s, const V4& a) { return a * s; }
inline V4 operator/(const V4& a, double s) { return {a.lo / s, a.hi / s}; }
inline V4 load(const double* p) {
  return {*reinterpret_cast<const V2Anywhere*>(p), *reinterpret_cast<const V2Anywhere*>(p + 2)};
}
inline void store(double* p, const V4& x) {
  *reinterpret_cast<V2Anywhere*>(p) = x.lo;
  *reinterpret_cast<V2Anywhere*>(p + 2) = x.hi;
}
inline double fourth(const V4& x) { return x.hi[1]; }
#endif

// kOrder is n_v where it is known to the compiler, 0 where it is not.
template <int kOrder, int kStride>
void patch_point(const double* c, int n_u, int n_v, double s, double t, double* out) {
  const int n = kOrder ? kOrder : n_v;
  V4 x{};
  for (int i = n_u - 1; i >= 0; --i) {
    const double* row = c + i * n * kStride;
    V4 q = load(row + (n - 1) * kStride);
    for (int j = n - 2; j >= 0; --j) q = q * t + load(row + j * kStride);
    x = x * s + q;
  }
  store(out, x);
}

template <int kOrder, int kStride>
void patch_first(const double* c, int n_u, int n_v, double s, double t, double* out) {
  const int n = kOrder ? kOrder : n_v;
  V4 x{}, xs{}, xt{};
  for (int i = n_u - 1; i >= 0; --i) {
    const double* row = c + i * n * kStride;
    V4 d = load(row + (n - 1) * kStride), q = d * t + load(row + (n - 2) * kStride);
    for (int j = n - 3; j >= 0; --j) {
      d = d * t + q;
      q = q * t + load(row + j * kStride);
    }
    xs = xs * s + x;
    x = x * s + q;
    xt = xt * s + d;
  }
  store(out, x);
  store(out + 4, xs);
  store(out + 8, xt);
}

template <int kOrder, int kStride>
void patch_rows(const double* c, int n_u, int n_v, double t, double* out) {
  const int n = kOrder ? kOrder : n_v;
  for (int i = 0; i < n_u; ++i) {
    const double* row = c + i * n * kStride;
    V4 d = load(row + (n - 1) * kStride), q = d * t + load(row + (n - 2) * kStride);
    for (int j = n - 3; j >= 0; --j) {
      d = d * t + q;
      q = q * t + load(row + j * kStride);
    }
    store(out + 8 * i, q);
    store(out + 8 * i + 4, d);
  }
}

inline void patch_first_of_rows(const double* rows, int n_u, double s, double* out) {
  V4 x{}, xs{}, xt{};
  for (int i = n_u - 1; i >= 0; --i) {
    xs = xs * s + x;
    x = x * s + load(rows + 8 * i);
    xt = xt * s + load(rows + 8 * i + 4);
  }
  store(out, x);
  store(out + 4, xs);
  store(out + 8, xt);
}

template <int kOrder, int kStride>
void patch_convert(const double* poles, int n_row, const double* basis_u, int n_u, const double* basis_v, int n_v,
                   double* out) {
  const int n = kOrder ? kOrder : n_v;
  double half[kMaxOrder * kMaxOrder * 4];
  for (int i = 0; i < n_u; ++i) {
    const double* row = poles + static_cast<long>(i) * n_row * 4;
    for (int c = 0; c < n; ++c) {
      V4 sum{};
      for (int l = 0; l < n; ++l) sum = sum + basis_v[l * n + c] * load(row + l * 4);
      store(half + (i * n + c) * 4, sum);
    }
  }
  for (int b = 0; b < n_u; ++b)
    for (int c = 0; c < n; ++c) {
      V4 sum{};
      for (int i = 0; i < n_u; ++i) sum = sum + basis_u[i * n_u + b] * load(half + (i * n + c) * 4);
      store(out + (b * n + c) * kStride, sum);
    }
}

template <int kOrder, int kStride>
void patch_second(const double* c, int n_u, int n_v, double s, double t, double* out) {
  const int n = kOrder ? kOrder : n_v;
  V4 x{}, xs{}, xt{}, xss{}, xst{}, xtt{};
  for (int i = n_u - 1; i >= 0; --i) {
    const double* row = c + i * n * kStride;
    V4 e{}, d = load(row + (n - 1) * kStride), q = d * t + load(row + (n - 2) * kStride);
    for (int j = n - 3; j >= 0; --j) {
      e = e * t + d;
      d = d * t + q;
      q = q * t + load(row + j * kStride);
    }
    xss = xss * s + xs;
    xs = xs * s + x;
    x = x * s + q;
    xst = xst * s + xt;
    xt = xt * s + d;
    xtt = xtt * s + e;
  }
  store(out, x);
  store(out + 4, xs);
  store(out + 8, xt);
  store(out + 12, xss);
  store(out + 16, xst);
  store(out + 20, xtt);
}

template <int kOrder>
inline void line_horner(const double* c, int n_given, double s, V4& x, V4& xs, V4& half_xss) {
  const int n = kOrder ? kOrder : n_given;
  V4 e{}, d = load(c + (n - 1) * 4), q = d * s + load(c + (n - 2) * 4);
  for (int j = n - 3; j >= 0; --j) {
    e = e * s + d;
    d = d * s + q;
    q = q * s + load(c + j * 4);
  }
  x = q;
  xs = d;
  half_xss = e;
}

template <int kOrder>
void line_second(const double* c, int n_given, double s, double rate, double* out) {
  V4 x, x1, x2;
  line_horner<kOrder>(c, n_given, s, x, x1, x2);
  store(out, x);
  store(out + 4, rate * x1);
  store(out + 8, 2 * rate * rate * x2);
}

// x = p/w and its derivatives, from those of p and w.
template <int kOrder>
void rational_line_second(const double* c, int n_given, double s, double rate, double* out) {
  V4 p, p1, p2;
  line_horner<kOrder>(c, n_given, s, p, p1, p2);
  p1 = rate * p1;
  p2 = 2 * rate * rate * p2;
  const double w = fourth(p), w1 = fourth(p1), w2 = fourth(p2);
  const V4 x = p / w, x1 = (p1 - w1 * x) / w;
  store(out, x);
  store(out + 4, x1);
  store(out + 8, (p2 - 2 * w1 * x1 - w2 * x) / w);
}

template <int kOrder, int kStride>
PatchKernels kernels_of() {
  return {patch_point<kOrder, kStride>,
          patch_first<kOrder, kStride>,
          patch_second<kOrder, kStride>,
          patch_rows<kOrder, kStride>,
          patch_first_of_rows,
          patch_convert<kOrder, kStride>,
          kStride == 4 ? rational_line_second<kOrder> : line_second<kOrder>};
}

template <int kStride>
PatchKernels kernels_for(int n_v) {
  switch (n_v) {
    case 2:
      return kernels_of<2, kStride>();
    case 3:
      return kernels_of<3, kStride>();
    case 4:
      return kernels_of<4, kStride>();
    case 5:
      return kernels_of<5, kStride>();
    case 6:
      return kernels_of<6, kStride>();
    default:
      return kernels_of<0, kStride>();
  }
}

}  // namespace
}  // namespace st
