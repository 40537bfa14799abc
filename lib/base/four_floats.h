// Four numbers at once, as every processor has them. Results are those of the same steps one by one.
#pragma once

#include <cstdint>

namespace st {

typedef float FourFloats __attribute__((vector_size(16)));
typedef std::int32_t FourInts __attribute__((vector_size(16)));  ///< of a comparison: -1 where it holds

/// The four from a place on.
inline FourFloats load_four(const float* p) {
  typedef float Anywhere __attribute__((vector_size(16), aligned(4), may_alias));
  return *reinterpret_cast<const Anywhere*>(p);
}

/// Bit k: the k-th comparison holds.
inline std::uint32_t bits_of(const FourInts& holds) {
#if defined(__x86_64__)
  return static_cast<std::uint32_t>(__builtin_ia32_movmskps(reinterpret_cast<FourFloats>(holds)));
#else
  return static_cast<std::uint32_t>((holds[0] & 1) | (holds[1] & 2) | (holds[2] & 4) | (holds[3] & 8));
#endif
}

}  // namespace st
