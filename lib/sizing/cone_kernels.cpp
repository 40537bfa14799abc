#include "sizing/cone_kernels.h"

#include "sizing/cone_along_code.h"

namespace st {

const ConeKernels& detail::cone_kernels_anywhere() { return kKernels; }

const ConeKernels& cone_kernels() {
#if defined(__x86_64__)
  static const bool has_avx2 = __builtin_cpu_supports("avx2");
  if (has_avx2) return detail::cone_kernels_avx2();
#endif
  return detail::cone_kernels_anywhere();
}

}  // namespace st
