#include "base/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace st {
namespace {

std::vector<Box3> random_boxes(int n) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(0, 1), extent(0, 0.1);
  std::vector<Box3> boxes;
  for (int i = 0; i < n; ++i) {
    const Vec3 lo{place(random), place(random), place(random)};
    boxes.push_back({lo, lo + Vec3{extent(random), extent(random), extent(random)}});
  }
  return boxes;
}

TEST(BoxTree, finds_the_nearest_box_and_looks_at_few) {
  const std::vector<Box3> boxes = random_boxes(5000);
  const BoxTree tree(boxes);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-0.5, 1.5);
  std::int64_t n_visited = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 x{uniform(random), uniform(random), uniform(random)};
    double best = std::numeric_limits<double>::infinity(), nearest = best;
    for (const Box3& box : boxes) nearest = std::min(nearest, distance2(x, box));
    tree.visit_near(
        x, [&](std::int32_t, double d2) { return d2 < best; },
        [&](std::int32_t item) {
          ++n_visited;
          best = std::min(best, distance2(x, boxes[item]));
        });
    ASSERT_EQ(best, nearest);
  }
  EXPECT_LT(n_visited, 500 * 100);
}

TEST(BoxTree, holds_every_box_once_in_boxes_around_it) {
  const std::vector<Box3> boxes = random_boxes(1000);
  const BoxTree tree(boxes);
  std::vector<int> n_seen(boxes.size(), 0);
  for (const BoxTree::Node& node : tree.nodes())
    for (std::int32_t i = node.begin; i < node.end; ++i) {
      const Box3& box = boxes[tree.items()[i]];
      ASSERT_EQ(distance2(box.lo, node.box) + distance2(box.hi, node.box), 0);
      n_seen[tree.items()[i]] += node.right == 0;
    }
  EXPECT_EQ(std::count(n_seen.begin(), n_seen.end(), 1), 1000);
}

TEST(BoxTree, may_be_empty_or_of_boxes_at_one_place) {
  int n = 0;
  BoxTree().visit_near(
      {}, [](std::int32_t, double) { return true; }, [&](std::int32_t) { ++n; });
  EXPECT_EQ(n, 0);
  const BoxTree same(std::vector<Box3>(1000, Box3{{0, 0, 0}, {1, 1, 1}}));
  same.visit_near(
      {5, 5, 5}, [](std::int32_t, double) { return true; }, [&](std::int32_t) { ++n; });
  EXPECT_EQ(n, 1000);
}

}  // namespace
}  // namespace st
