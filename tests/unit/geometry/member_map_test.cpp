#include "geometry/shape/member_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace st {
namespace {

constexpr std::array<Vec2, 3> kChart{{{1, 1}, {3, 1.5}, {1.5, 4}}};
constexpr std::array<Vec2, 3> kUv{{{0.3, 2}, {0.1, 5}, {0.5, 4}}};

TEST(AffineMap, takes_three_places_to_three) {
  const std::array<Vec2, 3> from{{{0, 0}, {2, 0}, {1, 3}}}, to{{{5, 5}, {6, 5}, {5, 9}}};
  const AffineMap map(from, to);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_LE(norm(map(from[k]) - to[k]), 1e-14);
  EXPECT_LE(norm(map(Vec2{1, 1}) - (1.0 / 3) * (to[0] + to[1] + to[2])), 1e-14);
}

TEST(MemberMap, takes_corners_to_corners_and_back) {
  for (const std::int32_t pole : {kNone, 0, 1, 2, 3, 4, 5}) {
    SCOPED_TRACE(pole);
    const MemberMap map(kChart, kUv, pole);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 off = map(kChart[k]).uv - kUv[k];
      if (pole == kNone || PoleCorner::of_code(pole).corner != static_cast<std::int32_t>(k)) {
        EXPECT_LE(norm(off), 1e-12);
        EXPECT_LE(norm(map.chart(kUv[k]) - kChart[k]), 1e-12);
      } else {
        EXPECT_LE(std::abs(PoleCorner::of_code(pole).is_along_v ? off.x : off.y), 1e-5);
      }
    }
    const Vec2 inside = 0.2 * kChart[0] + 0.3 * kChart[1] + 0.5 * kChart[2];
    EXPECT_LE(norm(map.chart(map(inside).uv) - inside), 1e-12);
  }
}

TEST(MemberMap, keeps_to_a_meridian_on_the_way_to_a_pole) {
  const MemberMap map(kChart, kUv, PoleCorner{1, false}.code());
  const Vec2 away = 0.25 * kChart[0] + 0.75 * kChart[2];
  const double u = map(away).uv.x;
  for (const double share : {0.5, 1e-3, 1e-5}) EXPECT_NEAR(map(kChart[1] + share * (away - kChart[1])).uv.x, u, 1e-6);
  EXPECT_TRUE(std::isfinite(map(kChart[1]).along_u.x));
}

TEST(MemberMap, has_the_derivatives_of_its_images) {
  constexpr double kStep = 1e-6;
  const Vec2 at = 0.2 * kChart[0] + 0.3 * kChart[1] + 0.5 * kChart[2];
  for (const std::int32_t pole : {kNone, 0, 2, 4}) {
    const MemberMap map(kChart, kUv, pole);
    const auto slope = [&](Vec2 way) { return (0.5 / kStep) * (map(at + kStep * way).uv - map(at - kStep * way).uv); };
    EXPECT_LE(norm(map(at).along_u - slope({1, 0})), 1e-8);
    EXPECT_LE(norm(map(at).along_v - slope({0, 1})), 1e-8);
  }
}

}  // namespace
}  // namespace st
