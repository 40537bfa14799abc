#include "stages/text_table.h"

#include <gtest/gtest.h>

namespace st {
namespace {

using Lines = std::vector<std::string>;

TEST(TextTable, aligns_names_left_and_numbers_right) {
  EXPECT_EQ(aligned_columns({{"group", "n"}, {"wing", "7"}, {"b", "1234"}}, 1),
            (Lines{"  group     n", "  wing      7", "  b      1234"}));
}

TEST(TextTable, counts_characters_and_leaves_the_column_after_the_numbers) {
  EXPECT_EQ(aligned_columns({{"Fl\u00fcgel", "1", "why so"}, {"b", "22", ""}}, 1),
            (Lines{"  Fl\u00fcgel   1  why so", "  b       22"}));
}

TEST(TextTable, no_rows_give_no_lines) { EXPECT_TRUE(aligned_columns({}, 3).empty()); }

}  // namespace
}  // namespace st
