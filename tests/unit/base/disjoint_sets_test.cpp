// Sets of elements that were joined.
#include "base/disjoint_sets.h"

#include <gtest/gtest.h>

namespace st {
namespace {

TEST(DisjointSets, are_represented_by_their_lowest_element) {
  DisjointSets sets(10);
  sets.join(7, 3);
  sets.join(9, 7);
  sets.join(1, 2);
  for (const std::int32_t i : {3, 7, 9}) EXPECT_EQ(sets.find(i), 3);
  EXPECT_EQ(sets.find(2), 1);
  EXPECT_EQ(sets.find(0), 0);
  sets.join(9, 1);
  EXPECT_EQ(sets.find(7), 1);
}

TEST(DisjointSets, are_grouped_by_their_lowest_element) {
  DisjointSets sets(6);
  sets.join(4, 1);
  sets.join(5, 0);
  sets.join(1, 3);
  EXPECT_EQ(sets.groups(), (std::vector<std::vector<std::int32_t>>{{0, 5}, {1, 3, 4}, {2}}));
  EXPECT_TRUE(DisjointSets(0).groups().empty());
}

}  // namespace
}  // namespace st
