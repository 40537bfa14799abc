#include "geometry/shape/patch_kernels.h"

#include "base/assert.h"
#include "geometry/shape/patch_kernels_code.h"

namespace st {

PatchKernels detail::patch_kernels_anywhere(int n_v, int stride) {
  return stride == 3 ? kernels_for<3>(n_v) : kernels_for<4>(n_v);
}

PatchKernels patch_kernels(int n_v, int stride) {
  ST_ASSERT(n_v >= 2 && (stride == 3 || stride == 4));
#if defined(__x86_64__)
  static const bool has_avx2 = __builtin_cpu_supports("avx2");
  if (has_avx2) return detail::patch_kernels_avx2(n_v, stride);
#endif
  return detail::patch_kernels_anywhere(n_v, stride);
}

}  // namespace st
