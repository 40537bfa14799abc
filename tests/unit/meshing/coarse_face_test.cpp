#include "meshing/face/coarse_face.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

#include "unit/meshing/faces.h"

namespace st {
namespace {

/// A plate of 64 x 64 segments, whose corners are vertices.
struct CoarsePlate {
  CoarsePlate() {
    constexpr double kStep = 10.0 / 64;
    std::vector<Vec2> loop;
    for (int i = 0; i < 64; ++i) loop.push_back({kStep * i, 0});
    for (int i = 0; i < 64; ++i) loop.push_back({10, kStep * i});
    for (int i = 64; i > 0; --i) loop.push_back({kStep * i, 10});
    for (int i = 64; i > 0; --i) loop.push_back({0, kStep * i});
    boundary = test::polygons({loop}, kStep);
    for (std::int32_t i = 0; i < 256; ++i) places.push_back({i % 64, std::min(i % 64, 64 - i % 64)});
  }

  FaceBoundary boundary;
  std::vector<BoundaryPlace> places;
  UniformField field{10.0 / 64};
};

TEST(CoarseFace, has_few_triangles_between_parts_that_are_all_of_the_loop) {
  const CoarsePlate plate;
  CoarseFace coarse(test::kPlane, plate.boundary, plate.places, plate.field);
  ASSERT_TRUE(coarse.make(8));
  EXPECT_GT(coarse.n_triangles(), 30);
  EXPECT_LT(coarse.n_triangles(), 1000);
  std::multiset<std::pair<std::int32_t, std::int32_t>> segments;
  for (const CoarseFace::Part& part : coarse.parts()) {
    EXPECT_EQ(coarse.boundary_node(part.from), part.begin);
    EXPECT_EQ(coarse.boundary_node(part.to), part.end);
    coarse.for_each_segment(part, [&](std::int32_t a, std::int32_t b) { segments.insert({a, b}); });
  }
  EXPECT_TRUE(segments == std::multiset(plate.boundary.segments.begin(), plate.boundary.segments.end()));
}

TEST(CoarseFace, keeps_vertices_and_more_nodes_near_them) {
  const CoarsePlate plate;
  CoarseFace coarse(test::kPlane, plate.boundary, plate.places, plate.field);
  ASSERT_TRUE(coarse.make(8));
  std::set<std::int32_t> kept;
  for (std::int32_t c = 0; c < coarse.n_on_boundary(); ++c) kept.insert(coarse.boundary_node(c));
  for (const std::int32_t node : {0, 1, 2, 4, 8, 16, 24, 32, 60, 62, 63, 64, 128, 192})
    EXPECT_TRUE(kept.contains(node)) << node;
  for (const std::int32_t node : {20, 28, 30, 36}) EXPECT_FALSE(kept.contains(node)) << node;
}

TEST(CoarseFace, cannot_be_made_of_an_open_loop) {
  CoarsePlate plate;
  plate.boundary.segments.pop_back();
  EXPECT_FALSE(CoarseFace(test::kPlane, plate.boundary, plate.places, plate.field).make(8));
}

}  // namespace
}  // namespace st
