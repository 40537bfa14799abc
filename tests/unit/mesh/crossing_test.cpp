#include "mesh/crossing.h"

#include <gtest/gtest.h>

#include <random>

#include "base/predicates.h"
#include "base/threads.h"
#include "unit/mesh/shapes.h"

namespace st {
namespace {

bool cross_points(std::array<Vec3, 3> a, std::array<Vec3, 3> b) {
  const std::vector<Vec3> points{a[0], a[1], a[2], b[0], b[1], b[2]};
  const auto pairs = find_crossing_triangles(points, std::vector<Triangle>{{{0, 1, 2}}, {{3, 4, 5}}});
  return !pairs.empty();
}

std::vector<TrianglePair> every_pair(const SurfaceMesh& m) {
  std::vector<TrianglePair> pairs;
  for (TriangleId a = 0; a < m.n_triangles(); ++a)
    for (TriangleId b = a + 1; b < m.n_triangles(); ++b) {
      int shared = 0;
      if (!is_degenerate(m.node_xyz, m.triangles[a]) && !is_degenerate(m.node_xyz, m.triangles[b]) &&
          triangles_cross(m.node_xyz, m.triangles[a], m.triangles[b], shared))
        pairs.push_back({a, b, shared});
    }
  return pairs;
}

const std::array<Vec3, 3> kFlat{Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{0, 4, 0}};

TEST(Crossing, finds_an_edge_through_the_middle_of_a_triangle) {
  EXPECT_TRUE(cross_points(kFlat, {Vec3{1, 1, -1}, Vec3{1, 1, 1}, Vec3{9, 9, 1}}));
}
TEST(Crossing, ignores_a_triangle_whose_plane_is_cut_outside) {
  EXPECT_FALSE(cross_points(kFlat, {Vec3{3, 3, -1}, Vec3{3, 3, 1}, Vec3{9, 9, 1}}));
}
TEST(Crossing, counts_a_corner_that_touches_from_above) {
  EXPECT_TRUE(cross_points(kFlat, {Vec3{1, 1, 0}, Vec3{1, 1, 1}, Vec3{9, 9, 1}}));
}
TEST(Crossing, ignores_a_corner_that_hovers_by_one_rounding_error) {
  EXPECT_FALSE(cross_points(kFlat, {Vec3{1, 1, 1e-300}, Vec3{1, 1, 1}, Vec3{9, 9, 1}}));
}
TEST(Crossing, counts_edges_that_touch_in_a_point) {
  EXPECT_TRUE(cross_points(kFlat, {Vec3{1, 0, -1}, Vec3{1, 0, 1}, Vec3{1, -5, 0}}));
}
TEST(Crossing, counts_coplanar_overlap) {
  EXPECT_TRUE(cross_points(kFlat, {Vec3{3, 3, 0}, Vec3{-1, 3, 0}, Vec3{-1, -1, 0}}));
}
TEST(Crossing, counts_a_coplanar_triangle_inside_another) {
  EXPECT_TRUE(cross_points(kFlat, {Vec3{1, 1, 0}, Vec3{1.5, 1, 0}, Vec3{1, 1.5, 0}}));
}
TEST(Crossing, ignores_coplanar_triangles_apart) {
  EXPECT_FALSE(cross_points(kFlat, {Vec3{5, 0, 0}, Vec3{6, 0, 0}, Vec3{5, 1, 0}}));
}
TEST(Crossing, ignores_coplanar_triangles_in_line) {
  EXPECT_FALSE(cross_points(kFlat, {Vec3{5, 0, 0}, Vec3{6, 0, 0}, Vec3{5, -1, 0}}));
}
TEST(Crossing, decides_overlap_in_an_oblique_plane) {
  const auto tilt = [](Vec3 p) { return Vec3{p.x, p.y, 3 * p.x + 5 * p.y + 1}; };
  EXPECT_TRUE(cross_points({tilt(kFlat[0]), tilt(kFlat[1]), tilt(kFlat[2])},
                           {tilt({3, 3, 0}), tilt({-1, 3, 0}), tilt({-1, -1, 0})}));
  EXPECT_FALSE(cross_points({tilt(kFlat[0]), tilt(kFlat[1]), tilt(kFlat[2])},
                            {tilt({3, 3, 0}), tilt({4, 3, 0}), tilt({3, 4, 0})}));
}

TEST(Crossing, of_triangles_with_one_common_node_needs_a_second_common_point) {
  const std::vector<Vec3> points{{0, 0, 0},   {4, 0, 0},   {0, 4, 0},   {1, 1, -1}, {1, 1, 1},
                                 {-1, -1, 2}, {-3, -1, 0}, {-1, -3, 0}, {1, 2, 0},  {2, 1, 0}};
  const auto crosses = [&](Triangle t) {
    return !find_crossing_triangles(points, std::vector<Triangle>{{{0, 1, 2}}, t}).empty();
  };
  EXPECT_TRUE(crosses({{0, 3, 4}})) << "the opposite edge pierces";
  EXPECT_TRUE(crosses({{0, 8, 9}})) << "flat on the other";
  EXPECT_FALSE(crosses({{0, 4, 5}})) << "only the node is common";
  EXPECT_FALSE(crosses({{0, 6, 7}})) << "same plane, other side of the node";
}

TEST(Crossing, of_flat_triangles_with_one_common_node_sees_a_narrow_angle_in_a_wide_one) {
  const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 1, 0}, {1, 4, 0}};
  const Triangle wide{{0, 1, 2}}, narrow{{0, 3, 4}};
  EXPECT_EQ(find_crossing_triangles(points, std::vector<Triangle>{wide, narrow}).size(), 1u);
  EXPECT_EQ(find_crossing_triangles(points, std::vector<Triangle>{narrow, wide}).size(), 1u);
}

TEST(Crossing, of_triangles_with_a_common_edge_means_folded_flat) {
  const std::vector<Vec3> points{{0, 0, 0}, {4, 1, 3}, {0, 4, 1}, {1, 1.25, 1}, {4, -3, 2}, {0, 4, 1.5}};
  const auto crosses = [&](Triangle t) {
    return !find_crossing_triangles(points, std::vector<Triangle>{{{0, 1, 2}}, t}).empty();
  };
  EXPECT_TRUE(crosses({{1, 0, 3}})) << "folded flat";
  EXPECT_FALSE(crosses({{1, 0, 4}})) << "flat, beside each other";
  EXPECT_FALSE(crosses({{1, 0, 5}})) << "a thin wedge";
  EXPECT_FALSE(crosses({{2, 1, 0}})) << "a duplicate is another defect";
}

TEST(Crossing, finds_nothing_in_clean_closed_meshes) {
  for (const SurfaceMesh& m : {shapes::cube(7), shapes::sphere(6, {3, 1, 2}), shapes::torus(24, 12)})
    EXPECT_TRUE(find_crossing_triangles(m.node_xyz, m.triangles).empty());
}

TEST(Crossing, finds_the_same_pairs_as_a_comparison_of_all_with_all) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> coordinate(0, 1);
  for (const bool on_grid : {false, true}) {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    for (int i = 0; i < 300; ++i) {
      Vec3 p{coordinate(random), coordinate(random), coordinate(random)};
      points.push_back(on_grid ? Vec3{std::floor(5 * p.x), std::floor(5 * p.y), std::floor(5 * p.z)} : p);
    }
    for (int i = 0; i < 400; ++i) {
      const auto n = [&] { return static_cast<NodeId>(random() % points.size()); };
      triangles.push_back({{n(), n(), n()}});
    }
    const SurfaceMesh m = shapes::from(points, triangles);
    const auto found = find_crossing_triangles(m.node_xyz, m.triangles), expected = every_pair(m);
    ASSERT_EQ(found.size(), expected.size());
    EXPECT_GT(found.size(), 1000u);
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(found[i].a, expected[i].a);
      ASSERT_EQ(found[i].b, expected[i].b);
      ASSERT_EQ(found[i].n_shared, expected[i].n_shared);
    }
  }
}

TEST(Crossing, does_not_depend_on_how_the_corners_are_turned) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 20000; ++i) {
    std::vector<Vec3> p(6);
    for (Vec3& x : p) x = {double(random() % 4), double(random() % 4), double(random() % 3)};
    const Triangle a{{0, 1, 2}}, b{{3, 4, 5}}, c{{1, 0, 2}}, d{{4, 5, 3}};
    if (is_degenerate(p, a) || is_degenerate(p, b)) continue;
    int shared = 0;
    const bool expected = triangles_cross(p, a, b, shared);
    ASSERT_EQ(triangles_cross(p, c, d, shared), expected);
    ASSERT_EQ(triangles_cross(p, d, a, shared), expected);
  }
}

/// Plain arithmetic decides most pairs; what it sees depends on the angles, the answer does not.
TEST(Crossing, is_the_same_after_shears_that_are_exact) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> coordinate(-3, 3), node(3, 7);
  int n_crossing = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::vector<Vec3> points(8);
    for (Vec3& p : points) p = {double(coordinate(random)), double(coordinate(random)), double(coordinate(random))};
    const Triangle a{{0, 1, 2}};
    const Triangle b = i % 3 == 0   ? Triangle{{3, 4, 5}}
                       : i % 3 == 1 ? Triangle{{node(random), 1, 6 + i % 2 - 6 * (node(random) > 5)}}
                                    : Triangle{{2, 1, node(random)}};
    std::array<int, 4> answers{};
    int n_answers = 0;
    for (const double shear : {0.0, 5.0, -64.0, 4096.0}) {
      std::vector<Vec3> sheared = points;
      for (Vec3& p : sheared) p = {p.x + shear * p.y, p.y - shear * p.z, p.z};
      int shared = 0;
      if (is_degenerate(sheared, a) || is_degenerate(sheared, b)) break;
      answers[n_answers++] = triangles_cross(sheared, a, b, shared);
    }
    if (n_answers == 0) continue;
    ASSERT_EQ(n_answers, 4);
    n_crossing += answers[0];
    EXPECT_TRUE(answers[1] == answers[0] && answers[2] == answers[0] && answers[3] == answers[0]) << i;
  }
  EXPECT_GT(n_crossing, 1000);
}

TEST(Crossing, of_two_cubes_that_penetrate_is_found) {
  const SurfaceMesh m = shapes::join(shapes::cube(4), shapes::cube(4, {0.55, 0.55, 0.55}));
  const auto pairs = find_crossing_triangles(m.node_xyz, m.triangles);
  ASSERT_FALSE(pairs.empty());
  for (const TrianglePair& p : pairs) EXPECT_TRUE(p.a < 192 && p.b >= 192 && p.n_shared == 0);
}

TEST(Crossing, ends_where_triangles_lie_in_each_other_without_end_and_says_so) {
  constexpr int kCopies = 3000;  // of one triangle, turned a little: every two cross
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  for (int i = 0; i < kCopies; ++i) {
    const double angle = 6.0 * i / kCopies;
    for (int k = 0; k < 3; ++k)
      points.push_back({std::cos(angle + 2.1 * k), std::sin(angle + 2.1 * k), 1e-3 * std::sin(7 * angle + k)});
    triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}});
  }
  std::vector<std::vector<TrianglePair>> found;
  for (const int n_threads : {1, 4}) {
    set_thread_count(n_threads);
    bool was_ended = false;
    found.push_back(find_crossing_triangles(points, triangles, was_ended));
    EXPECT_TRUE(was_ended);
  }
  set_thread_count(1);
  EXPECT_GT(found[0].size(), 100'000u);
  EXPECT_LT(found[0].size(), 2'000'000u);
  ASSERT_EQ(found[0].size(), found[1].size());
  for (std::size_t i = 0; i < found[0].size(); ++i)
    ASSERT_TRUE(found[0][i].a == found[1][i].a && found[0][i].b == found[1][i].b);
}

}  // namespace
}  // namespace st
