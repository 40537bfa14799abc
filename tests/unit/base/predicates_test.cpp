#include "base/predicates.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>

namespace st {
namespace {

/// Oracle: 512-bit two's complement integers, wrapping; no rounding anywhere.
struct Int512 {
  std::array<std::uint64_t, 8> w{};
  Int512() = default;
  /// `x` times 2^20 must be an integer; the value represents x * 2^20.
  explicit Int512(double x) {
    int exponent = 0;
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(std::fabs(x), &exponent), 53));
    const int shift = exponent - 53 + 20;
    if (mantissa == 0) return;
    const auto m = static_cast<std::uint64_t>(shift < 0 ? mantissa >> -shift : mantissa);
    const int s = shift < 0 ? 0 : shift;
    w[s / 64] = m << (s % 64);
    if (s % 64) w[s / 64 + 1] = m >> (64 - s % 64);
    if (x < 0) *this = -*this;
  }
  Int512 operator-() const {
    Int512 r;
    std::uint64_t carry = 1;
    for (int i = 0; i < 8; ++i) {
      r.w[i] = ~w[i] + carry;
      carry = carry && r.w[i] == 0;
    }
    return r;
  }
  friend Int512 operator+(const Int512& a, const Int512& b) {
    Int512 r;
    unsigned __int128 carry = 0;
    for (int i = 0; i < 8; ++i) {
      carry += static_cast<unsigned __int128>(a.w[i]) + b.w[i];
      r.w[i] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    return r;
  }
  friend Int512 operator-(const Int512& a, const Int512& b) { return a + -b; }
  friend Int512 operator*(const Int512& a, const Int512& b) {
    Int512 r;
    for (int i = 0; i < 8; ++i) {
      unsigned __int128 carry = 0;
      for (int j = 0; i + j < 8; ++j) {
        carry += static_cast<unsigned __int128>(a.w[i]) * b.w[j] + r.w[i + j];
        r.w[i + j] = static_cast<std::uint64_t>(carry);
        carry >>= 64;
      }
    }
    return r;
  }
  int sign() const {
    if (w[7] >> 63) return -1;
    for (const std::uint64_t x : w)
      if (x) return 1;
    return 0;
  }
};

int sign(double x) { return (x > 0) - (x < 0); }

int oracle2d(Vec2 a, Vec2 b, Vec2 c) {
  const Int512 px = Int512(a.x) - Int512(c.x), py = Int512(a.y) - Int512(c.y), qx = Int512(b.x) - Int512(c.x),
               qy = Int512(b.y) - Int512(c.y);
  return (px * qy - py * qx).sign();
}

int oracle3d(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  const auto minus = [](Vec3 p, Vec3 q) {
    return std::array<Int512, 3>{Int512(p.x) - Int512(q.x), Int512(p.y) - Int512(q.y), Int512(p.z) - Int512(q.z)};
  };
  const auto p = minus(b, a), q = minus(c, a), r = minus(d, a);
  return ((p[1] * q[2] - p[2] * q[1]) * r[0] + (p[2] * q[0] - p[0] * q[2]) * r[1] + (p[0] * q[1] - p[1] * q[0]) * r[2])
      .sign();
}

/// Coordinates that make trouble: near 1 with the last bits set, huge beside tiny, and grids.
class Trouble {
 public:
  double small() { return static_cast<double>(static_cast<int>(random_() % 9) - 4); }
  double near_one() { return 0.5 + std::ldexp(small(), -20); }
  double mixed() {
    return std::ldexp(static_cast<double>(static_cast<std::int64_t>(random_() % 2001) - 1000),
                      static_cast<int>(random_() % 70) - 20);
  }
  double grid() { return std::ldexp(static_cast<double>(random_() % 33), -5) * 12; }
  double any() {
    switch (random_() % 3) {
      case 0:
        return near_one();
      case 1:
        return mixed();
      default:
        return grid();
    }
  }
  Vec2 any2() { return {any(), any()}; }
  Vec3 any3() { return {any(), any(), any()}; }

 private:
  std::mt19937_64 random_{7};
};

TEST(Predicates, orient2d_is_positive_for_counter_clockwise_triangles) {
  EXPECT_EQ(orient2d({0, 0}, {2, 0}, {0, 3}), 6);
  EXPECT_EQ(orient2d({0, 0}, {0, 3}, {2, 0}), -6);
}

TEST(Predicates, orient3d_is_positive_on_the_side_of_the_normal) {
  EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
  EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}), -1);
}

TEST(Predicates, orient2d_agrees_with_integer_arithmetic_on_troublesome_points) {
  Trouble t;
  for (int i = 0; i < 100000; ++i) {
    const Vec2 a = t.any2(), b = t.any2(), c = t.any2();
    ASSERT_EQ(sign(orient2d(a, b, c)), oracle2d(a, b, c));
    ASSERT_EQ(sign(detail::orient2d_exact(a, b, c)), oracle2d(a, b, c));
  }
}

TEST(Predicates, orient2d_sees_one_unit_in_the_last_place_beside_a_line) {
  // Kettner et al., Classroom examples of robustness problems: a naive determinant fails on much of this grid.
  const Vec2 q{12, 12}, r{24, 24};
  int naive_failures = 0;
  for (int i = 0; i < 256; ++i)
    for (int j = 0; j < 256; ++j) {
      const Vec2 p{0.5 + i * std::ldexp(1.0, -53), 0.5 + j * std::ldexp(1.0, -53)};
      const int expected = (p.y > p.x) - (p.y < p.x);
      const double naive = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
      ASSERT_EQ(sign(orient2d(q, r, p)), expected) << i << ' ' << j;
      naive_failures += sign(naive) != expected;
    }
  EXPECT_GT(naive_failures, 1000);
}

TEST(Predicates, orient3d_agrees_with_integer_arithmetic_on_troublesome_points) {
  Trouble t;
  for (int i = 0; i < 50000; ++i) {
    const Vec3 a = t.any3(), b = t.any3(), c = t.any3(), d = t.any3();
    ASSERT_EQ(sign(orient3d(a, b, c, d)), oracle3d(a, b, c, d));
    ASSERT_EQ(sign(detail::orient3d_exact(a, b, c, d)), oracle3d(a, b, c, d));
  }
}

TEST(Predicates, orient3d_decides_points_a_rounding_error_off_an_oblique_plane) {
  Trouble t;
  int coplanar = 0;
  for (int i = 0; i < 50000; ++i) {
    const Vec3 a{t.mixed(), t.mixed(), t.mixed()}, u{t.small(), t.small(), t.small()}, v{t.grid(), t.grid(), t.grid()};
    const Vec3 b = a + u, c = a + v, d = a + (u + v) + std::ldexp(t.small(), -10) * Vec3{1, 0, 0};
    ASSERT_EQ(sign(orient3d(a, b, c, d)), oracle3d(a, b, c, d));
    coplanar += orient3d(a, b, c, d) == 0;
  }
  EXPECT_GT(coplanar, 1000);
}

TEST(Predicates, signs_flip_when_two_arguments_are_swapped) {
  Trouble t;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 a = t.any3(), b = t.any3(), c = t.any3(), d = t.any3();
    const int s = sign(orient3d(a, b, c, d));
    ASSERT_EQ(sign(orient3d(b, a, c, d)), -s);
    ASSERT_EQ(sign(orient3d(a, c, b, d)), -s);
    ASSERT_EQ(sign(orient3d(a, b, d, c)), -s);
    const Vec2 e{a.x, a.y}, f{b.x, b.y}, g{c.x, c.y};
    ASSERT_EQ(sign(orient2d(e, f, g)), -sign(orient2d(f, e, g)));
    ASSERT_EQ(sign(orient2d(e, f, g)), sign(orient2d(f, g, e)));
  }
}

}  // namespace
}  // namespace st
