#include "geometry/facet/facet_smoothing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>

#include "base/threads.h"
#include "geometry/facet/facet_faces.h"
#include "unit/geometry/facet_inputs.h"

namespace st {
namespace {

/// The unit cube, n quadrangles along each edge.
FacetInput fine_cube(int n) {
  const FacetInput cube = test::cube_facets();
  std::map<std::array<double, 3>, std::int32_t> known;
  FacetInput fine;
  fine.part_name = {""};
  for (std::size_t side = 0; side < cube.corners.size(); side += 2) {
    const Vec3 a = cube.x[cube.corners[side][0]], b = cube.x[cube.corners[side][1]];
    const Vec3 d = cube.x[cube.corners[side + 1][2]];
    const auto node = [&](int i, int j) {
      const Vec3 x = a + (static_cast<double>(i) / n) * (b - a) + (static_cast<double>(j) / n) * (d - a);
      const auto [it, is_new] = known.emplace(std::array{x.x, x.y, x.z}, static_cast<std::int32_t>(fine.x.size()));
      if (is_new) fine.x.push_back(x);
      return it->second;
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        fine.corners.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
        fine.corners.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
      }
  }
  fine.part.assign(fine.corners.size(), 0);
  return fine;
}

void add_noise(FacetInput& input, double deviation) {
  std::mt19937 numbers(3);
  std::normal_distribution<double> normal(0, deviation);
  for (Vec3& x : input.x) x += Vec3{normal(numbers), normal(numbers), normal(numbers)};
}

/// How far a node is off the cube, at most.
double off_cube(const FacetInput& input) {
  double off = 0;
  for (const Vec3 x : input.x) {
    double nearest = 1;
    for (const double c : {x.x, x.y, x.z}) nearest = std::min({nearest, std::abs(c), std::abs(1 - c)});
    off = std::max(off, nearest);
  }
  return off;
}

std::int32_t n_faces(const FacetInput& input) {
  const FacetMesh mesh = find_smooth_faces(input, radians(30));
  return 1 + *std::max_element(mesh.face.begin(), mesh.face.end());
}

TEST(FacetSmoothing, takes_noise_away_and_leaves_edges) {
  FacetInput cube = fine_cube(32);
  const double deviation = 0.1 / 32;
  add_noise(cube, deviation);
  const double before = off_cube(cube);
  EXPECT_GT(n_faces(cube), 10);
  const SmoothedFacets moved = smooth_facets(cube, 5 * deviation);
  EXPECT_EQ(n_faces(cube), 6);
  EXPECT_LT(off_cube(cube), 0.5 * before);
  EXPECT_GT(moved.mean, 0.3 * deviation);
  EXPECT_LT(moved.at_most, 0.01);
}

TEST(FacetSmoothing, moves_no_node_further_than_it_may) {
  FacetInput cube = fine_cube(16);
  add_noise(cube, 0.005);
  const std::vector<Vec3> before = cube.x;
  EXPECT_GT(smooth_facets(cube, 0.001).at_most, 0.5);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_LE(distance(cube.x[i], before[i]), 0.001 * (1 + 1e-9));
}

TEST(FacetSmoothing, evens_free_rims_and_keeps_their_corners) {
  FacetInput square = test::grid_facets(20, 20, [](int i, int j) { return Vec3{0.05 * i, 0.05 * j, 0}; });
  std::erase_if(square.corners, [&](const Corners& c) { return norm(area_normal(square.x, c)) == 0; });
  add_noise(square, 0.003);
  const auto off_rim = [&] {
    double sum = 0;
    for (const Vec3 x : square.x) {
      const double off = std::min({std::abs(x.x), std::abs(x.y), std::abs(1 - x.x), std::abs(1 - x.y)});
      if (off < 0.02) sum += off;
    }
    return sum;
  };
  const double before = off_rim();
  smooth_facets(square, 0.02);
  EXPECT_LT(off_rim(), 0.6 * before);
  double corner = 1;
  for (const Vec3 x : square.x) corner = std::min(corner, distance(x, Vec3{1, 1, 0}));
  EXPECT_LT(corner, 0.01);
}

TEST(FacetSmoothing, gives_the_same_bits_with_any_number_of_threads) {
  FacetInput one = fine_cube(32);
  add_noise(one, 0.002);
  FacetInput three = one;
  set_thread_count(1);
  smooth_facets(one, 0.01);
  set_thread_count(3);
  smooth_facets(three, 0.01);
  set_thread_count(1);
  for (std::size_t i = 0; i < one.x.size(); ++i) EXPECT_EQ(distance(one.x[i], three.x[i]), 0) << i;
}

TEST(FindNoise, is_that_of_the_nodes_and_none_of_smooth_bodies) {
  for (FacetInput body : {fine_cube(12), test::torus_facets(48, 24), test::sphere_facets(20), test::skin_facets(60, 9)})
    EXPECT_EQ(find_noise(body), 0);
  FacetInput cube = fine_cube(32);
  add_noise(cube, 0.001);
  EXPECT_NEAR(find_noise(cube), 0.001, 0.0002);
}

}  // namespace
}  // namespace st
