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

}  // namespace
}  // namespace st
