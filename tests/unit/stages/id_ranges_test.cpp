#include "stages/id_ranges.h"

#include <gtest/gtest.h>

#include <vector>

namespace st {
namespace {

TEST(IdRanges, unite_what_follows_each_other) {
  const std::vector<std::int32_t> ids = {1, 2, 3, 7, 9, 10};
  EXPECT_EQ(id_ranges(ids), "1-3, 7, 9-10");
  EXPECT_EQ(id_ranges(ids, '"'), "\"1-3\", 7, \"9-10\"");
  EXPECT_EQ(id_ranges({}), "");
}

}  // namespace
}  // namespace st
