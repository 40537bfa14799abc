// The same kernels in vectors of eight floats. Fused multiply-add stays out: its results would differ from other
// processors'.
#if defined(__x86_64__)
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
#define ST_EIGHT_WIDE
#include "sizing/cone_along_code.h"

namespace st::detail {

const ConeKernels& cone_kernels_avx2() { return kKernels; }

}  // namespace st::detail
#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif
