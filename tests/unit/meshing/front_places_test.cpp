#include "meshing/face/front_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "unit/meshing/faces.h"

namespace st {
namespace {

/// Work on the plane, or on a cylinder of radius 1 where sides turn.
struct PlacesOn {
  PlacesOn(const Surface& surface, const SizeField& field) {
    work.set_surface(surface);
    work.field = &field;
  }
  MeshNode node(Vec2 uv) {
    MeshNode n;
    n.p = work.plane.to_plane(uv);
    work.evaluate(n);
    work.ask_sizes(n);
    return n;
  }

  FaceWork work;
};

TEST(FrontPlaces, make_an_equilateral_triangle_of_a_side_as_long_as_its_size) {
  const UniformField field(0.5);
  PlacesOn plane(test::kPlane, field);
  MeshNode p;
  double r = 0;
  ASSERT_TRUE(FrontPlaces<false>(plane.work).of_side(plane.node({1, 1}), plane.node({1.5, 1}), r, p));
  EXPECT_NEAR(r, 0.5, 1e-9);
  EXPECT_NEAR(distance(p.x, {1.25, 1 + 0.25 * std::sqrt(3.0), 0}), 0, 1e-6);
}

TEST(FrontPlaces, let_sides_grow_by_a_bound) {
  const UniformField field(5);
  PlacesOn plane(test::kPlane, field);
  const MeshNode a = plane.node({1, 1}), b = plane.node({1.2, 1});
  MeshNode p;
  double r = 0;
  ASSERT_TRUE(FrontPlaces<false>(plane.work).of_side(a, b, r, p));
  EXPECT_LE(r, kGrowth * 0.8 * 5 + 1e-9);
  EXPECT_NEAR(distance(p.x, a.x), r, 0.06 * r);
  EXPECT_NEAR(distance(p.x, b.x), r, 0.06 * r);
}

TEST(FrontPlaces, of_rows_are_at_right_angles) {
  const UniformField field(0.5);
  PlacesOn plane(test::kPlane, field);
  const MeshNode a = plane.node({2, 2});
  MeshNode p;
  double length = a.h;
  ASSERT_TRUE(FrontPlaces<true>(plane.work).of_row(a, {0, 1, 0}, {1, 0, 0}, length, p));
  EXPECT_NEAR(distance(p.x, {2, 2.5, 0}), 0, 1e-3);
  EXPECT_NEAR(length, 0.5, 1e-9);
}

TEST(FrontPlaces, are_nearer_where_the_normal_turns) {
  const test::FaceCase side("cylinder", UniformField(1));
  const UniformField field(1);
  PlacesOn cylinder(*side.surface, field);
  const Vec2 at{0.5 * (side.surface->u_min() + side.surface->u_max()),
                0.5 * (side.surface->v_min() + side.surface->v_max())};
  const MeshNode a = cylinder.node(at);
  struct Reached {
    double length, turned;
  };
  const auto reach = [&](double max_turning) {
    cylinder.work.max_turning = max_turning;
    MeshNode p;
    double length = a.h;
    EXPECT_TRUE(FrontPlaces<true>(cylinder.work).of_row(a, normalized(a.du), normalized(a.dv), length, p));
    return Reached{length, std::acos(std::clamp(dot(a.normal, p.normal), -1.0, 1.0))};
  };
  const Reached far = reach(3), near = reach(0.6 * far.turned);
  ASSERT_GT(far.turned, 0.01);
  EXPECT_NEAR(near.length, 0.6 * far.length, 0.1 * far.length);
  EXPECT_LT(near.turned, 0.75 * far.turned);
}

}  // namespace
}  // namespace st
