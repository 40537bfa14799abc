#include "base/text.h"

#include <gtest/gtest.h>

namespace st {
namespace {

TEST(Text, is_trimmed_on_both_sides_only) {
  EXPECT_EQ(trimmed(" \t a b\r\n"), "a b");
  EXPECT_EQ(trimmed("a"), "a");
  EXPECT_EQ(trimmed(" \n"), "");
  EXPECT_EQ(trimmed(""), "");
}

TEST(Text, is_a_range_of_numbers_or_a_name) {
  EXPECT_EQ(as_range("17"), std::pair(std::int64_t{17}, std::int64_t{17}));
  EXPECT_EQ(as_range("17-20"), std::pair(std::int64_t{17}, std::int64_t{20}));
  for (const char* name : {"", "wing", "17x", "-17", "17-", "17-x", "17-20-", "17:20", "1.5"})
    EXPECT_EQ(as_range(name), std::nullopt) << name;
}

TEST(Text, is_a_number_as_a_whole_or_none) {
  EXPECT_EQ(as_number("1.5"), 1.5);
  EXPECT_EQ(as_number("-2e3"), -2000);
  for (const char* other : {"", "dpw", "1.5x", " 1", "inf", "nan"}) EXPECT_EQ(as_number(other), std::nullopt) << other;
}

TEST(Text, things_are_counted_in_words) {
  EXPECT_EQ(counted(1, "face"), "1 face");
  EXPECT_EQ(counted(0, "face"), "0 faces");
  EXPECT_EQ(counted(2, "vertex", "vertices"), "2 vertices");
}

}  // namespace
}  // namespace st
