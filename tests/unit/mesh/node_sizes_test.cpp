#include "mesh/node_sizes.h"

#include <gtest/gtest.h>

namespace st {
namespace {

// Stretched beyond x = 20,000 alone: pieces without stretch, with it, and with both.
LocalSize size_at(Vec3 x, int&) {
  if (x.x < 20'000) return {1 + x.x, 1 + x.x, {}};
  return {1 + x.x, 4 * (1 + x.x), {0, 1, 0}};
}

TEST(NodeSizes, AreThoseRequestedInEachDirection) {
  std::vector<Vec3> xyz;
  for (int n = 0; n < 40'000; ++n) xyz.push_back({static_cast<double>(n), 0, 0});
  const NodeSizes sizes(xyz, size_at);
  int hint = 0;
  for (const Vec3 d : {Vec3{1, 0, 0}, Vec3{0, 2, 0}, Vec3{1, 1, 0}})
    for (NodeId n = 0; n < 40'000; n += 7)
      ASSERT_EQ(sizes.length(n, d, hint), size_at(xyz[static_cast<std::size_t>(n)], hint).in(d)) << n;
}

TEST(NodeSizes, AreAskedForEachEdgeWhereThatMatters) {
  const std::vector<Vec3> xyz{{1, 0, 0}, {2, 0, 0}};
  const NodeSizes sizes(xyz, size_at, [](Vec3 x, Vec3 way, int&) { return x.x + norm(way); });
  int hint = 0;
  EXPECT_EQ(sizes.length(NodeId{1}, {0, 3, 0}, hint), 5);
  EXPECT_EQ(sizes.length(Vec3{1.5, 0, 0}, {0, 3, 0}, hint), 4.5);
}

}  // namespace
}  // namespace st
