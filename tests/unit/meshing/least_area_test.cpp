#include "meshing/face/least_area.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace st {
namespace {

struct LeastAreaCase {
  explicit LeastAreaCase(std::vector<Vec3> nodes) : x(std::move(nodes)), id(x.size()), side_cost(x.size() * x.size()) {
    std::iota(id.begin(), id.end(), 0);
  }
  std::vector<std::array<std::size_t, 3>> run() const {
    std::vector<Vec3> middle;
    for (const Vec3 a : x)
      for (const Vec3 b : x) middle.push_back(0.5 * (a + b));
    return triangulate_least_area(x, id, middle, side_cost);
  }
  double area() const {
    double sum = 0;
    for (const auto& [i, j, k] : run()) sum += 0.5 * norm(cross(x[j] - x[i], x[k] - x[i]));
    return sum;
  }

  std::vector<Vec3> x;
  std::vector<std::int32_t> id;
  std::vector<double> side_cost;
};

TEST(LeastArea, covers_a_plane_polygon_with_a_dent_once) {
  const LeastAreaCase dent({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}});
  EXPECT_EQ(dent.run().size(), 3u);
  EXPECT_NEAR(dent.area(), 10, 1e-12);  // any fan from another corner than the dent's lies outside in part
  std::map<std::pair<std::size_t, std::size_t>, int> uses;
  for (const auto& [i, j, k] : dent.run())
    for (const auto& [a, b] : {std::pair{i, j}, std::pair{j, k}, std::pair{k, i}}) {
      ++uses[{a, b}];
      --uses[{b, a}];
    }
  for (const auto& [side, n] : uses)
    EXPECT_EQ(n != 0, (side.first + 1) % 5 == side.second || (side.second + 1) % 5 == side.first);
}

TEST(LeastArea, takes_the_diagonal_of_less_area) {
  const LeastAreaCase bent({{0, 0, 0}, {3, 0, 0}, {3, 1, 2}, {0, 1, 0}});
  std::vector<double> areas;
  for (const std::size_t dear : {0 * 4 + 2, 1 * 4 + 3}) {
    LeastAreaCase other = bent;
    other.side_cost[dear] = 100;
    areas.push_back(other.area());
  }
  EXPECT_GT(std::abs(areas[0] - areas[1]), 0.1);
  EXPECT_EQ(bent.area(), std::min(areas[0], areas[1]));
}

TEST(LeastArea, avoids_a_side_that_costs_more_than_the_area_it_saves) {
  LeastAreaCase dent({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}});
  dent.side_cost[0 * 5 + 3] = 1000;
  for (const auto& triple : dent.run())
    for (const auto& [a, b] : {std::pair{0, 1}, std::pair{1, 2}, std::pair{0, 2}})
      EXPECT_FALSE(triple[a] == 0 && triple[b] == 3);
}

TEST(LeastArea, names_no_node_twice_in_one_triangle) {
  LeastAreaCase twice({{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 0, 0}});
  twice.id = {0, 1, 0, 1};
  EXPECT_TRUE(twice.run().empty());
}

}  // namespace
}  // namespace st
