#include "meshing/face/row_map.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/meshing/row_case.h"

namespace st::test {
namespace {

TEST(MappedLines, are_spaced_as_the_sides_between_equal_edges) {
  const WallField field(0.1, 0, 1);
  RowCase face({band(10, 10, {0.1, 0.2, 0.33}, {0.1, 0.2, 0.33})}, field);
  const std::vector<NextLine> lines = mapped_lines(face.work, find_row_chains(face.work).at(0));
  ASSERT_EQ(lines.size(), 3u);
  for (std::size_t i = 1; i < 10; ++i) {
    EXPECT_NEAR(lines[0].columns[i].node.x.y, 0.1, 1e-9);
    EXPECT_NEAR(lines[1].columns[i].node.x.y, 0.2, 1e-9);
    EXPECT_NEAR(lines[1].columns[i].node.x.x, static_cast<double>(i), 1e-9);
    EXPECT_NE(lines[2].columns[i].existing, kNone);
  }
  EXPECT_EQ(lines[0].columns[10].existing, 11);
  EXPECT_EQ(std::count(lines[0].joined.begin(), lines[0].joined.end(), 1), 10);
}

TEST(MappedLines, are_none_where_the_field_asks_for_other_rows) {
  for (const double height : {0.2, 0.04}) {
    const WallField field(height, 0, 1);
    RowCase face({band(10, 10, {0.1, 0.2, 0.3}, {0.1, 0.2, 0.3})}, field);
    for (const RowChain& chain : find_row_chains(face.work))
      EXPECT_TRUE(mapped_lines(face.work, chain).empty()) << height;
  }
}

TEST(MappedLines, are_none_where_edges_or_sides_differ_or_much_is_not_flat) {
  const WallField field(0.1, 0, 1);
  RowCase sides({band(12, 12, {0.1, 0.2, 0.3}, {0.1, 0.2, 0.25, 0.3})}, field);
  EXPECT_TRUE(mapped_lines(sides.work, find_row_chains(sides.work).at(0)).empty());
  std::vector<Vec2> loop = band(10, 10, {0.1, 0.2}, {0.1, 0.2});
  loop.erase(loop.begin() + 15);  // one node less at the top
  RowCase uneven({loop}, field);
  EXPECT_TRUE(mapped_lines(uneven.work, find_row_chains(uneven.work).at(0)).empty());
  RowCase tall({band(10, 10, {0.1, 2, 4}, {0.1, 2, 4})}, field);
  EXPECT_TRUE(mapped_lines(tall.work, find_row_chains(tall.work).at(0)).empty());
}

}  // namespace
}  // namespace st::test
