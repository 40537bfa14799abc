#include "mesh/touching_triangles.h"

#include <gtest/gtest.h>

#include <vector>

#include "mesh/crossing.h"

namespace st {
namespace {

constexpr double kReach = 1e-3;

/// A floor, and a tent upside down whose lowest node is this high above it.
struct TentOnFloor {
  explicit TentOnFloor(double height)
      : points{{-9, -9, 0}, {9, -9, 0}, {0, 12, 0}, {0, 0, height}, {1, 0, 0.5}, {0, 1, 0.5}} {}
  bool crosses() const {
    int n_shared = 0;
    return triangles_cross(points, floor, tent, n_shared);
  }
  bool part(NodeId first_movable) {
    return move_touching_apart(std::vector<TouchingPair>{{floor, tent, kReach}}, first_movable, points);
  }
  Triangle floor{{0, 1, 2}}, tent{{3, 4, 5}};
  std::vector<Vec3> points;
};

TEST(MoveTouchingApart, lifts_the_node_that_touches) {
  for (const double height : {0.0, -0.5 * kReach, 1e-9}) {
    TentOnFloor t(height);
    const std::vector<Vec3> before = t.points;
    EXPECT_TRUE(t.part(3));
    EXPECT_FALSE(t.crosses());
    EXPECT_NEAR(t.points[3].z, kTouchingGap * kReach, 1e-12);
    for (const NodeId n : {0, 1, 2, 4, 5}) EXPECT_TRUE(t.points[n] == before[n]) << n;
  }
}

TEST(MoveTouchingApart, lowers_the_floor_where_the_node_may_not_move) {
  TentOnFloor t(0);
  std::swap(t.points[0], t.points[3]), std::swap(t.points[1], t.points[4]), std::swap(t.points[2], t.points[5]);
  std::swap(t.floor, t.tent);
  ASSERT_TRUE(t.crosses());
  EXPECT_TRUE(t.part(3));
  EXPECT_FALSE(t.crosses());
  EXPECT_EQ(t.points[0].z, 0);
  for (const NodeId n : {3, 4, 5}) EXPECT_NEAR(t.points[n].z, -kTouchingGap * kReach, 1e-12);
}

TEST(MoveTouchingApart, leaves_what_crosses) {
  TentOnFloor t(-2 * kReach);
  EXPECT_FALSE(t.part(0));
  EXPECT_TRUE(t.crosses());
}

TEST(MoveTouchingApart, leaves_triangles_on_each_other) {
  TentOnFloor t(0);
  t.points[4].z = t.points[5].z = 1e-9;
  EXPECT_FALSE(t.part(0));
}

}  // namespace
}  // namespace st
