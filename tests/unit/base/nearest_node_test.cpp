// The nearest of many points.
#include "base/nearest_node.h"

#include <gtest/gtest.h>

#include <random>

namespace st {
namespace {

TEST(NearestNode, is_the_lowest_of_the_nearest) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> coarse(0, 9);  // many equal points
  const auto point = [&] { return Vec3{0.1 * coarse(random), 0.1 * coarse(random), 0.1 * coarse(random)}; };
  std::vector<Vec3> xyz;
  std::vector<NodeId> nodes;
  for (NodeId n = 0; n < 2000; ++n) {
    xyz.push_back(point());
    if (n % 3) nodes.push_back(n);
  }
  const NearestNode nearest(xyz, nodes);
  for (int i = 0; i < 500; ++i) {
    const Vec3 x = point() + Vec3{0.01 * (i % 7), 0, 0};
    NodeId expected = nodes[0], last = nodes[0];
    for (const NodeId n : nodes) {
      if (norm2(xyz[n] - x) < norm2(xyz[expected] - x)) expected = n;
      if (norm2(xyz[n] - x) <= norm2(xyz[last] - x)) last = n;
    }
    EXPECT_EQ(nearest.find(x), expected);
    EXPECT_EQ(nearest.find(x, nodes[i]), expected) << "from a guess";
    EXPECT_EQ(nearest.find(x, last), expected) << "from one as near";
  }
  EXPECT_EQ(NearestNode(xyz, {}).find({}), kNone);
}

TEST(NearestNode, of_points_on_a_line_or_at_one_place_is_found_too) {
  std::vector<Vec3> line, heap(100, Vec3{1, 2, 3});
  std::vector<NodeId> nodes;
  for (NodeId n = 0; n < 100; ++n) line.push_back({0, 0, double(n)}), nodes.push_back(n);
  for (NodeId n = 0; n < 100; ++n) EXPECT_EQ(NearestNode(line, nodes).find({5, 5, n + 0.3}), n);
  EXPECT_EQ(NearestNode(heap, nodes).find({9, 9, 9}), 0);
}

}  // namespace
}  // namespace st
