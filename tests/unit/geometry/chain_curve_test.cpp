#include "geometry/shape/chain_curve.h"

#include <gtest/gtest.h>

#include "geometry/shape/polyline.h"
#include "geometry/shape/projection.h"

namespace st {
namespace {

/// From (0,0,0) over (2,0,0) to (2,3,0) and (2,3,4): the second piece is passed backwards.
ChainCurve chain() {
  std::vector<std::unique_ptr<Curve>> pieces;
  pieces.push_back(std::make_unique<PolylineCurve>(std::vector<Vec3>{{0, 0, 0}, {2, 0, 0}}));
  pieces.push_back(std::make_unique<PolylineCurve>(std::vector<Vec3>{{2, 3, 0}, {2, 1, 0}, {2, 0, 0}}));
  pieces.push_back(std::make_unique<PolylineCurve>(std::vector<Vec3>{{2, 3, 0}, {2, 3, 4}}));
  return {ChainParameters({{0, 2, 2}, {3, 0, 3}, {0, 4, 4}}), std::move(pieces)};
}

TEST(ChainCurve, passes_its_pieces_head_to_tail) {
  const ChainCurve curve = chain();
  EXPECT_EQ(curve.t_min(), 0);
  EXPECT_EQ(curve.t_max(), 9);
  EXPECT_LE(distance(curve.point(1), {1, 0, 0}), 1e-15);
  EXPECT_LE(distance(curve.point(3), {2, 1, 0}), 1e-15);
  EXPECT_LE(distance(curve.point(9), {2, 3, 4}), 1e-15);
  EXPECT_LE(distance(curve.evaluate(3.5).d1, {0, 1, 0}), 1e-15);
  EXPECT_EQ(curve.knots(), (std::vector<double>{2, 3, 5}));
  EXPECT_NEAR(arc_length(curve, 0, 9, 36), 9, 1e-12);
}

TEST(ChainCurve, finds_feet_on_other_pieces_than_the_guess) {
  const ChainCurve curve = chain();
  for (const double guess : {0.1, 2.5, 8.9}) {
    EXPECT_NEAR(project_near(curve, {3, 1.5, 0}, guess).value_or(-1), 3.5, 1e-9);
    EXPECT_NEAR(project_near(curve, {2.5, 3, 1}, guess).value_or(-1), 6, 1e-9);
  }
}

TEST(ChainCurve, copies_are_the_same) {
  const ChainCurve curve = chain();
  const auto copy = curve.copy();
  ASSERT_TRUE(copy);
  for (double t = 0; t <= 9; t += 0.5) EXPECT_EQ(distance(copy->point(t), curve.point(t)), 0);
}

TEST(ChainCurve2d, passes_its_pieces_head_to_tail) {
  std::vector<std::unique_ptr<Curve2d>> pieces;
  pieces.push_back(std::make_unique<PolylineCurve2d>(std::vector<double>{5, 6}, std::vector<Vec2>{{0, 0}, {2, 0}}));
  pieces.push_back(std::make_unique<PolylineCurve2d>(std::vector<double>{0, 1}, std::vector<Vec2>{{2, 4}, {2, 0}}));
  const ChainCurve2d curve(ChainParameters({{5, 6, 2}, {1, 0, 4}}), std::move(pieces));
  EXPECT_LE(norm(curve.point(1) - Vec2{1, 0}), 1e-15);
  EXPECT_LE(norm(curve.point(2) - Vec2{2, 0}), 1e-15);
  EXPECT_LE(norm(curve.point(5) - Vec2{2, 3}), 1e-15);
}

TEST(RimCurve2d, maps_each_part_by_its_triangle) {
  auto own = std::make_unique<PolylineCurve2d>(std::vector<double>{0, 2}, std::vector<Vec2>{{0, 0}, {2, 0}});
  const std::array<Vec2, 3> first{{{0, 0}, {1, 0}, {0, 1}}}, second{{{1, 0}, {2, 0}, {1, 1}}};
  const RimCurve2d curve(std::move(own), {{0, MemberMap({{{0, 0}, {0, 1}, {-1, 0}}}, first, kNone)},
                                          {1, MemberMap({{{0, 1}, {0, 4}, {-1, 1}}}, second, kNone)}});
  EXPECT_LE(norm(curve.point(0.5) - Vec2{0, 0.5}), 1e-15);
  EXPECT_LE(norm(curve.point(1.5) - Vec2{0, 2.5}), 1e-15);
}

}  // namespace
}  // namespace st
