#include "base/lists_by_key.h"

#include <gtest/gtest.h>

#include <array>
#include <utility>
#include <vector>

namespace st {
namespace {

template <class Item>
std::vector<std::vector<Item>> all_of(const ListsByKey<Item>& lists) {
  std::vector<std::vector<Item>> all;
  for (std::size_t k = 0; k < lists.n_keys(); ++k) all.emplace_back(lists[k].begin(), lists[k].end());
  return all;
}

TEST(ListsByKey, have_the_items_of_each_key_as_they_were_visited) {
  const std::vector<std::pair<int, char>> items = {{2, 'a'}, {0, 'b'}, {2, 'c'}, {2, 'a'}};
  ListsByKey<char> lists(4, [&](const auto& visit) {
    for (const auto& [key, item] : items) visit(key, item);
  });
  EXPECT_EQ(all_of(lists), (std::vector<std::vector<char>>{{'b'}, {}, {'a', 'c', 'a'}, {}}));
  lists[2][0] = 'z';
  EXPECT_EQ(all_of(lists)[2], (std::vector<char>{'z', 'c', 'a'}));
  EXPECT_EQ(ListsByKey<>().n_keys(), 0u);
}

struct Cell {
  std::int32_t n[3];
};

TEST(ListsByKey, are_the_cells_of_each_node_ascending) {
  const std::vector<std::vector<std::int32_t>> expected = {{0}, {0, 1, 2}, {0, 1}, {1, 2}, {2}, {}};
  const std::vector<std::array<std::int32_t, 3>> arrays = {{0, 1, 2}, {2, 1, 3}, {4, 3, 1}};  // node 5 has none
  EXPECT_EQ(all_of(cells_of_nodes(arrays, 6)), expected);
  const std::vector<Cell> cells = {{{0, 1, 2}}, {{2, 1, 3}}, {{4, 3, 1}}};
  EXPECT_EQ(all_of(cells_of_nodes(cells, 6)), expected);
}

}  // namespace
}  // namespace st
