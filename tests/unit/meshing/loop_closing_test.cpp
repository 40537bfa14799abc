#include "meshing/face/loop_closing.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "unit/meshing/faces.h"

namespace st {
namespace {

using test::FaceCase;
using test::kPlane;
using test::MeshView;
using test::polygons;

std::vector<Vec2> square(double lo, double hi, int n) {
  std::vector<Vec2> loop;
  const double step = (hi - lo) / n;
  for (int i = 0; i < n; ++i) loop.push_back({lo + i * step, lo});
  for (int i = 0; i < n; ++i) loop.push_back({hi, lo + i * step});
  for (int i = 0; i < n; ++i) loop.push_back({hi - i * step, hi});
  for (int i = 0; i < n; ++i) loop.push_back({lo, hi - i * step});
  return loop;
}

std::vector<Vec2> reversed(std::vector<Vec2> loop) {
  std::reverse(loop.begin(), loop.end());
  return loop;
}

/// Segments are used once in their direction; any other side twice, to and fro.
void expect_watertight(const FaceBoundary& boundary, const FaceMesh& mesh) {
  const MeshView view{boundary, mesh};
  std::map<std::pair<std::int64_t, std::int64_t>, int> uses;
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    const std::size_t j = i % 3 == 2 ? i - 2 : i + 1;
    const auto a = view.key(mesh.corners[i]), b = view.key(mesh.corners[j]);
    ASSERT_NE(a, b);
    ++uses[{a, b}];
    --uses[{b, a}];
  }
  for (const auto& [a, b] : boundary.segments) {
    --uses[{view.key(a), view.key(b)}];
    ++uses[{view.key(b), view.key(a)}];
  }
  for (const auto& [side, n] : uses) EXPECT_EQ(n, 0) << side.first << " " << side.second;
}

TEST(CloseLoops, fills_a_square_with_a_hole_as_any_mesh_would) {
  const FaceBoundary boundary = polygons({square(0, 4, 8), reversed(square(1, 2, 4))}, 0.5);
  const ClosedFace closed = close_loops(&kPlane, boundary, UniformField(0.5), 1e-6);
  ASSERT_EQ(closed.mesh.cause, FailureCause::kNone);
  test::expect_valid(boundary, closed.mesh);
  const MeshView view{boundary, closed.mesh};
  EXPECT_NEAR(view.area(), 15, 1e-9);
  EXPECT_GT(view.mean_quality(), 0.75);
  EXPECT_LT(closed.deviation, 1e-9);
  EXPECT_TRUE(closed.is_near);
}

TEST(CloseLoops, splits_long_sides) {
  const FaceBoundary boundary = polygons({square(0, 4, 8)}, 0.5);
  const ClosedFace closed = close_loops(&kPlane, boundary, UniformField(0.5), 1e-6);
  const MeshView view{boundary, closed.mesh};
  for (std::size_t i = 0; i < closed.mesh.corners.size(); ++i)
    EXPECT_LT(distance(view.x(closed.mesh.corners[i]), view.x(closed.mesh.corners[i % 3 == 2 ? i - 2 : i + 1])), 0.9);
}

TEST(CloseLoops, joins_many_holes) {
  std::vector<std::vector<Vec2>> loops = {square(0, 10, 10)};
  for (int i = 1; i < 10; ++i)
    for (int j = 1; j < 10; ++j) {
      loops.push_back(reversed(square(0, 0.4, 1)));
      for (Vec2& p : loops.back()) p = {p.x + i - 0.2, p.y + j - 0.2};
    }
  const FaceBoundary boundary = polygons(loops, 1);
  const ClosedFace closed = close_loops(&kPlane, boundary, UniformField(5), 1e-6);
  ASSERT_EQ(closed.mesh.cause, FailureCause::kNone);
  test::expect_valid(boundary, closed.mesh);
  EXPECT_NEAR((MeshView{boundary, closed.mesh}.area()), 100 - 81 * 0.16, 1e-9);
}

TEST(CloseLoops, closes_loops_that_cross) {
  const FaceBoundary boundary = polygons({square(0, 4, 8), reversed(square(2, 5, 6))}, 0.5);
  ASSERT_EQ(mesh_face(kPlane, boundary, UniformField(0.5), {}).cause, FailureCause::kCrossingLoops);
  const ClosedFace closed = close_loops(&kPlane, boundary, UniformField(0.5), 1e-6);
  ASSERT_EQ(closed.mesh.cause, FailureCause::kNone);
  expect_watertight(boundary, closed.mesh);
}

TEST(CloseLoops, closes_a_loop_that_crosses_itself) {
  const FaceBoundary boundary = polygons({{{0, 0}, {3, 0}, {3, 3}, {2.9, -0.1}, {1, 3}, {0, 3}}}, 5);
  const ClosedFace closed = close_loops(&kPlane, boundary, UniformField(5), 1e-6);
  ASSERT_EQ(closed.mesh.cause, FailureCause::kNone);
  expect_watertight(boundary, closed.mesh);
  EXPECT_FALSE(closed.is_near) << "a part is turned over";
}

TEST(CloseLoops, joins_loops_at_a_node_that_they_share) {
  FaceBoundary boundary = polygons({square(0, 4, 4), {{0, 0}, {1, 2}, {2, 1}}}, 1);
  boundary.nodes[16].id = boundary.nodes[0].id;
  const ClosedFace closed = close_loops(&kPlane, boundary, UniformField(1), 1e-6);
  ASSERT_EQ(closed.mesh.cause, FailureCause::kNone);
  expect_watertight(boundary, closed.mesh);
  EXPECT_NEAR((MeshView{boundary, closed.mesh}.area()), 14.5, 1e-9);
}

TEST(CloseLoops, leaves_out_ways_to_and_fro) {
  FaceBoundary boundary = polygons({{{0, 0}, {4, 0}, {6, 0}, {4, 0}, {4, 4}, {0, 4}}}, 2);
  boundary.nodes[3].id = boundary.nodes[1].id;
  const ClosedFace closed = close_loops(&kPlane, boundary, UniformField(2), 1e-6);
  ASSERT_EQ(closed.mesh.cause, FailureCause::kNone);
  expect_watertight(boundary, closed.mesh);
  EXPECT_NEAR((MeshView{boundary, closed.mesh}.area()), 16, 1e-9);
}

TEST(CloseLoops, follows_a_curved_surface_around_its_seam) {
  const UniformField field(1);
  const FaceCase face("cylinder", field);
  const ClosedFace closed = close_loops(face.surface.get(), face.boundary, field, 1e-6);
  ASSERT_EQ(closed.mesh.cause, FailureCause::kNone);
  expect_watertight(face.boundary, closed.mesh);
  EXPECT_NEAR((MeshView{face.boundary, closed.mesh}.area()), face.area(), 0.02 * face.area());
  EXPECT_TRUE(closed.is_near);
}

TEST(CloseLoops, needs_no_surface) {
  FaceBoundary boundary = polygons({square(0, 4, 8)}, 0.5);
  for (FaceNode& n : boundary.nodes) n.uv = {NAN, NAN};
  const ClosedFace closed = close_loops(nullptr, boundary, UniformField(0.5), 1e-6);
  ASSERT_EQ(closed.mesh.cause, FailureCause::kNone);
  expect_watertight(boundary, closed.mesh);
  EXPECT_NEAR((MeshView{boundary, closed.mesh}.area()), 16, 1e-9);
  EXPECT_FALSE(closed.is_near) << "nothing is known of it";
}

TEST(CloseLoops, goes_by_some_of_many_nodes_first) {
  const FaceBoundary boundary = polygons({square(0, 4, 200)}, 0.02);
  const ClosedFace closed = close_loops(&kPlane, boundary, UniformField(0.5), 1e-6);
  ASSERT_EQ(closed.mesh.cause, FailureCause::kNone);
  test::expect_valid(boundary, closed.mesh);
  EXPECT_NEAR((MeshView{boundary, closed.mesh}.area()), 16, 1e-9);
}

TEST(CloseLoops, cannot_close_what_has_no_area) {
  FaceBoundary boundary = polygons({{{0, 0}, {1, 0}, {2, 0}, {1, 0}}}, 1);
  boundary.nodes[3].id = boundary.nodes[1].id;
  EXPECT_NE(close_loops(&kPlane, boundary, UniformField(1), 1e-6).mesh.cause, FailureCause::kNone);
}

}  // namespace
}  // namespace st
