// Vectors of eight floats for the kernels' code, compiled once per kind of processor by the file that includes it, with
// ST_EIGHT_WIDE where the processor has such. Include nothing here that has code of its own.
#pragma once

#include <cstdint>

#pragma GCC diagnostic ignored "-Wpsabi"  // vectors stay inside the file that includes this

namespace st {
namespace {

typedef float F4 __attribute__((vector_size(16)));
typedef std::int32_t I4 __attribute__((vector_size(16)));
typedef float F4Anywhere __attribute__((vector_size(16), aligned(4), may_alias));

inline F4 load_four(const float* p) { return *reinterpret_cast<const F4Anywhere*>(p); }
/// Without their signs.
inline F4 magnitudes(const F4& v) { return v < 0.0F ? -v : v; }
/// Bit k: the k-th is true.
inline int signs(const I4& mask) {
#if defined(__x86_64__)
  return __builtin_ia32_movmskps(reinterpret_cast<F4>(mask));
#else
  return (mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8);
#endif
}

#if defined(ST_EIGHT_WIDE)
typedef float F8 __attribute__((vector_size(32)));
typedef std::int32_t I8 __attribute__((vector_size(32)));
typedef float F8Anywhere __attribute__((vector_size(32), aligned(4), may_alias));
typedef std::int32_t I8Anywhere __attribute__((vector_size(32), aligned(4), may_alias));

inline F8 all(float v) { return v - F8{}; }
inline F8 load(const float* p) { return *reinterpret_cast<const F8Anywhere*>(p); }
inline I8 load(const std::int32_t* p) { return *reinterpret_cast<const I8Anywhere*>(p); }
inline void store(float* p, const F8& v) { *reinterpret_cast<F8Anywhere*>(p) = v; }
inline void store(std::int32_t* p, const I8& v) { *reinterpret_cast<I8Anywhere*>(p) = v; }
inline F8 least(const F8& a, const F8& b) { return a < b ? a : b; }
inline F8 most(const F8& a, const F8& b) { return a > b ? a : b; }
inline F8 root(const F8& v) {
  F8 r{};
  for (int i = 0; i < 8; ++i) r[i] = __builtin_sqrtf(v[i]);
  return r;
}
inline I8 where(const I8& mask, std::int32_t a, const I8& b) { return mask ? a - I8{} : b; }
inline F8 select(const I8& mask, const F8& a, const F8& b) { return mask ? a : b; }
inline bool is_any(const I8& mask) { return __builtin_ia32_movmskps256(reinterpret_cast<F8>(mask)) != 0; }
inline F4 least_half(const F8& v) {
  const F4 a = __builtin_shufflevector(v, v, 0, 1, 2, 3), b = __builtin_shufflevector(v, v, 4, 5, 6, 7);
  return a < b ? a : b;
}
/// Four numbers from each place.
inline F8 load_fours(const float* p, const float* q) {
  return __builtin_shufflevector(load_four(p), load_four(q), 0, 1, 2, 3, 4, 5, 6, 7);
}
// Of both fours of a and b: the first two numbers in turn, and the last two; the first two of each, and the last two.
inline F8 mix_first(const F8& a, const F8& b) { return __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13); }
inline F8 mix_last(const F8& a, const F8& b) { return __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15); }
inline F8 join_first(const F8& a, const F8& b) { return __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13); }
inline F8 join_last(const F8& a, const F8& b) { return __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15); }
#else
typedef std::int32_t I4Anywhere __attribute__((vector_size(16), aligned(4), may_alias));
struct F8 {
  F4 a, b;
};
struct I8 {
  I4 a, b;
};

inline F8 operator+(const F8& x, const F8& y) { return {x.a + y.a, x.b + y.b}; }
inline F8 operator-(const F8& x, const F8& y) { return {x.a - y.a, x.b - y.b}; }
inline F8 operator*(const F8& x, const F8& y) { return {x.a * y.a, x.b * y.b}; }
inline F8 operator/(const F8& x, const F8& y) { return {x.a / y.a, x.b / y.b}; }
inline F8 operator*(float s, const F8& x) { return {s * x.a, s * x.b}; }
inline F8 operator+(float s, const F8& x) { return {s + x.a, s + x.b}; }
inline F8 operator-(const F8& x, float s) { return {x.a - s, x.b - s}; }
inline F8 operator-(const F8& x) { return {-x.a, -x.b}; }
inline I8 operator<(const F8& x, const F8& y) { return {x.a < y.a, x.b < y.b}; }
inline I8 operator>(const F8& x, const F8& y) { return {x.a > y.a, x.b > y.b}; }
inline I8 operator<(const F8& x, float s) { return {x.a < s, x.b < s}; }
inline I8 operator>=(const F8& x, const F8& y) { return {x.a >= y.a, x.b >= y.b}; }
inline I8 operator&(const I8& x, const I8& y) { return {x.a & y.a, x.b & y.b}; }
inline I8 operator|(const I8& x, const I8& y) { return {x.a | y.a, x.b | y.b}; }
inline F8 all(float v) { return {v - F4{}, v - F4{}}; }
inline F8 load(const float* p) {
  return {*reinterpret_cast<const F4Anywhere*>(p), *reinterpret_cast<const F4Anywhere*>(p + 4)};
}
inline I8 load(const std::int32_t* p) {
  return {*reinterpret_cast<const I4Anywhere*>(p), *reinterpret_cast<const I4Anywhere*>(p + 4)};
}
inline void store(float* p, const F8& v) {
  *reinterpret_cast<F4Anywhere*>(p) = v.a;
  *reinterpret_cast<F4Anywhere*>(p + 4) = v.b;
}
inline void store(std::int32_t* p, const I8& v) {
  *reinterpret_cast<I4Anywhere*>(p) = v.a;
  *reinterpret_cast<I4Anywhere*>(p + 4) = v.b;
}
inline F4 least(const F4& x, const F4& y) { return x < y ? x : y; }
inline F4 most(const F4& x, const F4& y) { return x > y ? x : y; }
inline F8 least(const F8& x, const F8& y) { return {least(x.a, y.a), least(x.b, y.b)}; }
inline F8 most(const F8& x, const F8& y) { return {most(x.a, y.a), most(x.b, y.b)}; }
inline F4 root(const F4& v) {
  F4 r{};
  for (int i = 0; i < 4; ++i) r[i] = __builtin_sqrtf(v[i]);
  return r;
}
inline F8 root(const F8& v) { return {root(v.a), root(v.b)}; }
inline I8 where(const I8& mask, std::int32_t x, const I8& y) {
  return {mask.a ? x - I4{} : y.a, mask.b ? x - I4{} : y.b};
}
inline F8 select(const I8& mask, const F8& x, const F8& y) { return {mask.a ? x.a : y.a, mask.b ? x.b : y.b}; }
inline bool is_any(const I8& mask) { return signs(mask.a | mask.b) != 0; }
inline F4 least_half(const F8& v) { return least(v.a, v.b); }
inline F8 load_fours(const float* p, const float* q) { return {load_four(p), load_four(q)}; }
inline F4 mix_first(const F4& x, const F4& y) { return __builtin_shufflevector(x, y, 0, 4, 1, 5); }
inline F4 mix_last(const F4& x, const F4& y) { return __builtin_shufflevector(x, y, 2, 6, 3, 7); }
inline F4 join_first(const F4& x, const F4& y) { return __builtin_shufflevector(x, y, 0, 1, 4, 5); }
inline F4 join_last(const F4& x, const F4& y) { return __builtin_shufflevector(x, y, 2, 3, 6, 7); }
inline F8 mix_first(const F8& x, const F8& y) { return {mix_first(x.a, y.a), mix_first(x.b, y.b)}; }
inline F8 mix_last(const F8& x, const F8& y) { return {mix_last(x.a, y.a), mix_last(x.b, y.b)}; }
inline F8 join_first(const F8& x, const F8& y) { return {join_first(x.a, y.a), join_first(x.b, y.b)}; }
inline F8 join_last(const F8& x, const F8& y) { return {join_last(x.a, y.a), join_last(x.b, y.b)}; }
#endif

inline float least_of(const F8& v) {
  const F4 four = least_half(v), other = __builtin_shufflevector(four, four, 2, 3, 0, 1),
           two = four < other ? four : other, last = __builtin_shufflevector(two, two, 1, 0, 3, 2);
  return (two < last ? two : last)[0];
}

}  // namespace
}  // namespace st
