// Cells that triangles cut.
#include "sizing/cut_cells.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/threads.h"
#include "unit/mesh/shapes.h"

namespace st {
namespace {

double area(const ClippedTriangle& p) {
  Vec3 sum;
  for (int k = 1; k + 1 < p.n; ++k) sum += cross(p.corner[k] - p.corner[0], p.corner[k + 1] - p.corner[0]);
  return 0.5 * norm(sum);
}

/// The unit cube in 2 x 2 x 2 cells.
struct EightCells {
  std::array<std::uint64_t, 8> keys{};
  std::array<std::uint8_t, 8> levels{};
  std::array<std::int32_t, 8> children{};
  EightCells() {
    for (int o = 0; o < 8; ++o) keys[o] = o, levels[o] = 1, children[o] = ~o;
  }
  OctreeView view() const { return {{0, 0, 0}, 1, keys, levels, children}; }
};

TEST(CutCells, are_those_that_triangles_meet_or_touch) {
  const EightCells octree;
  const std::vector<Vec3> points{{0.1, 0.1, 0.2}, {0.9, 0.1, 0.2}, {0.1, 0.9, 0.2}, {0.5, 0.1, 0.6}, {0.5, 0.3, 0.6},
                                 {0.5, 0.2, 0.9}, {3, 3, 3},       {4, 3, 3},       {3, 4, 3}};
  const std::vector<Triangle> triangles{{{0, 1, 2}}, {{3, 4, 5}}, {{6, 7, 8}}};
  const CutCells cut = find_cut_cells(octree.view(), {points, triangles});
  // the first touches the upper cell of its level at (0.5, 0.5), the second lies between two cells, the third is
  // outside
  EXPECT_EQ(cut.leaf, (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(cut.triangle, (std::vector<TriangleId>{0, 0, 0, 0, 1, 1}));
  EXPECT_EQ(cut.triangles(4).size(), 1u);
}

TEST(CutCells, of_a_tree_of_one_leaf_are_that_leaf) {
  const std::vector<Vec3> points{{0.1, 0.1, 0.2}, {0.9, 0.1, 0.2}, {0.1, 0.9, 0.2}};
  const std::vector<Triangle> triangles{{{0, 1, 2}}, {{2, 1, 0}}};
  const std::array<std::uint64_t, 1> key{};
  const std::array<std::uint8_t, 1> level{};
  const CutCells cut = find_cut_cells({{0, 0, 0}, 1, key, level, {}}, {points, triangles});
  ASSERT_EQ(cut.n_cut(), 1);
  EXPECT_EQ(cut.triangle, (std::vector<TriangleId>{0, 1}));
  EXPECT_EQ(find_cut_cells({{5, 5, 5}, 1, key, level, {}}, {points, triangles}).n_cut(), 0);
}

TEST(ClipTriangle, keeps_what_lies_inside_and_drops_what_lies_outside) {
  const ClippedTriangle all = clip_triangle({-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0, 0.5, 0}, {0, 0, 0}, 1);
  EXPECT_EQ(all.n, 3);
  EXPECT_NEAR(area(all), 0.5, 1e-12);
  EXPECT_LE(distance(all.middle(), {0, -1.0 / 6, 0}), 1e-12);
  EXPECT_EQ(clip_triangle({2, 0, 0}, {3, 0, 0}, {2, 1, 0}, {0, 0, 0}, 1).n, 0);
}

TEST(ClipTriangle, cuts_a_large_triangle_to_the_section_of_the_cube) {
  EXPECT_NEAR(area(clip_triangle({-100, -100, 0.3}, {100, -100, 0.3}, {0, 200, 0.3}, {0, 0, 0}, 1)), 4, 1e-9);
  // the plane x + y + z = 0 cuts a regular hexagon of side sqrt(2) out of the cube of edge 2
  const ClippedTriangle hexagon = clip_triangle({100, -100, 0}, {0, 100, -100}, {-100, 0, 100}, {0, 0, 0}, 1);
  EXPECT_NEAR(area(hexagon), 3 * std::sqrt(3.0), 1e-9);
}

TEST(ClipTriangle, gives_parts_that_add_up_to_the_triangle) {
  const Vec3 a{0.1, 0.2, 0.15}, b{3.7, 0.9, 1.8}, c{1.1, 3.4, 2.6};
  double sum = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k) sum += area(clip_triangle(a, b, c, {i + 0.5, j + 0.5, k + 0.5}, 0.5));
  EXPECT_NEAR(sum, 0.5 * norm(cross(b - a, c - a)), 1e-9);
}

TEST(SegmentMeetsTriangle, counts_touching_and_is_not_met_beside) {
  const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  EXPECT_TRUE(segment_meets_triangle({0.2, 0.2, -1}, {0.2, 0.2, 1}, a, b, c));
  EXPECT_TRUE(segment_meets_triangle({0.5, 0, -1}, {0.5, 0, 1}, a, b, c)) << "on a side";
  EXPECT_TRUE(segment_meets_triangle({0, 0, -1}, {0, 0, 1}, a, b, c)) << "in a corner";
  EXPECT_TRUE(segment_meets_triangle({0.2, 0.2, 0}, {0.2, 0.2, 1}, a, b, c)) << "ends on it";
  EXPECT_FALSE(segment_meets_triangle({0.6, 0.6, -1}, {0.6, 0.6, 1}, a, b, c));
  EXPECT_FALSE(segment_meets_triangle({0.2, 0.2, 0.1}, {0.2, 0.2, 1}, a, b, c)) << "ends above";
}

TEST(WindingNumber, is_one_inside_minus_one_when_turned_and_zero_outside) {
  SurfaceMesh m = shapes::sphere(5, {1, 2, 3}, 2);
  const auto at = [&](Vec3 x) { return winding_number({m.node_xyz, m.triangles}, x); };
  EXPECT_EQ(at({1, 2, 3}), 1);
  EXPECT_EQ(at({1.5, 2.9, 3.4}), 1);
  EXPECT_EQ(at({1, 2, 5.5}), 0);
  EXPECT_EQ(at({-9, 2, 3}), 0) << "its ray meets the surface twice";
  shapes::turn(m);
  EXPECT_EQ(at({1, 2, 3}), -1);
}

TEST(WindingNumber, of_many_points_is_that_of_each_at_every_number_of_threads) {
  const SurfaceMesh m = shapes::sphere(24, {1, 2, 3}, 2);
  const SurfaceView surface{m.node_xyz, m.triangles};
  std::vector<Vec3> points;
  for (double y = -1; y < 5; y += 0.25)
    for (double z = 0.1; z < 6; z += 0.5) points.push_back({1 + 0.1 * z, y, z});
  for (const int n_threads : {1, 3}) {
    set_thread_count(n_threads);
    const std::vector<int> winding = winding_numbers(surface, points);
    set_thread_count(1);
    int n_inside = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double off = distance(points[i], {1, 2, 3});
      if (off < 1.9 || off > 2) {
        ASSERT_EQ(winding[i], off < 1.9 ? 1 : 0) << i;
      }
      ASSERT_EQ(winding[i], winding_number(surface, points[i]));
      n_inside += winding[i];
    }
    EXPECT_GT(n_inside, 50);
  }
}

}  // namespace
}  // namespace st
