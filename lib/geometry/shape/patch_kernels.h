// Horner's rule for polynomial patches and curves in power basis: the innermost loops of every B-spline evaluation.
// Each processor gets the widest vectors it has. No operation is fused or reordered, so all of them give the same bits.
#pragma once

namespace st {

constexpr int kMaxOrder = 26;  // OpenCASCADE's largest degree is 25

/// A coefficient is `stride` doubles (x, y, z and, where stride is 4, the weight), but four are read: an array of
/// coefficients needs one more double behind it when stride is 3. Results have four doubles per value, too; without a
/// weight the fourth means nothing.
struct PatchKernels {
  /// x(s,t) = sum c[i][j] s^i t^j of orders n_u, n_v. `out`: x | x, xs, xt | x, xs, xt, xss/2, xst, xtt/2.
  using Patch = void (*)(const double* c, int n_u, int n_v, double s, double t, double* out);
  Patch point, first, second;
  /// Sums over t alone: `out` has x(t) and xt(t) per row i, 8 n_u doubles; then x, xs, xt along s, as `first` gives
  /// them.
  using Rows = void (*)(const double* c, int n_u, int n_v, double t, double* out);
  Rows rows;
  using Row = void (*)(const double* rows, int n_u, double s, double* out);
  Row first_of_rows;
  /// Power coefficients of a patch from poles of four doubles, `n_row` of them per row: `basis_u`, `basis_v` as
  /// KnotSpans::basis(). `out`: n_u n_v coefficients of `stride` doubles; writes one double beyond where stride is 3.
  using Convert = void (*)(const double* poles, int n_row, const double* basis_u, int n_u, const double* basis_v,
                           int n_v, double* out);
  Convert convert;
  /// x(s) = sum c[i] s^i of order n, with four doubles per coefficient whatever the stride; divided by the weight where
  /// that is 4. `rate` = ds/dt. `out`: x, dx/dt, d2x/dt2.
  using Line = void (*)(const double* c, int n, double s, double rate, double* out);
  Line line_second;
};

/// Kernels for patches whose order in t (degree + 1 >= 2) is `n_v` and for curves of that order. `stride` 3 or 4.
PatchKernels patch_kernels(int n_v, int stride);

namespace detail {
PatchKernels patch_kernels_anywhere(int n_v, int stride);
PatchKernels patch_kernels_avx2(int n_v, int stride);  ///< Precondition: the processor has AVX2.
}  // namespace detail

}  // namespace st
