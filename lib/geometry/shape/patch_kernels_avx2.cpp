// The same kernels in vectors of four doubles. Fused multiply-add stays out: its results would differ from other
// processors'.
#if defined(__x86_64__)
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
#define ST_FOUR_WIDE
#include "geometry/shape/patch_kernels_code.h"

namespace st::detail {

PatchKernels patch_kernels_avx2(int n_v, int stride) { return stride == 3 ? kernels_for<3>(n_v) : kernels_for<4>(n_v); }

}  // namespace st::detail
#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif
