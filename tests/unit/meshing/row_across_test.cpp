#include "meshing/face/row_across.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/meshing/row_case.h"

namespace st::test {
namespace {

TEST(RowAcross, is_led_to_in_whole_rows) {
  const WallField field(0.1, 0, 1);
  RowCase one({band(10, 10, {0.14}, {0.14})}, field), two({band(10, 10, {0.17}, {0.17})}, field);
  const NextLine last = next_line(one.work, line_of(11), {});
  for (std::int32_t i = 1; i <= 10; ++i) {  // the first would run along the side
    EXPECT_TRUE(last.columns[i].is_across);
    EXPECT_EQ(last.columns[i].existing, 21 - i);
  }
  const NextLine first = next_line(two.work, line_of(11), {});
  for (std::int32_t i = 1; i <= 10; ++i) {
    EXPECT_FALSE(first.columns[i].is_across);
    EXPECT_NEAR(first.columns[i].node.x.y, 0.085, 1e-9);
  }
  for (const NextLine& line : {last, first}) EXPECT_GE(std::count(line.joined.begin(), line.joined.end(), 1), 9);
}

TEST(RowAcross, is_not_led_to_where_nodes_are_out_of_step) {
  const WallField field(0.1, 0, 1);
  for (const double aside : {0.0, 0.3}) {
    std::vector<Vec2> loop = band(10, 10, {0.14}, {0.14});
    for (std::size_t i = 12; i + 1 < loop.size(); ++i) loop[i].x += aside;
    RowCase face({loop}, field);
    const NextLine line = next_line(face.work, line_of(11), {});
    for (std::int32_t i = 2; i <= 9; ++i) EXPECT_EQ(line.columns[i].is_across, aside == 0) << aside << " " << i;
  }
}

}  // namespace
}  // namespace st::test
