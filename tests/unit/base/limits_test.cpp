// checked_id(): the largest number that is taken, and what is said of the next one.
#include "base/limits.h"

#include <gtest/gtest.h>

namespace st {
namespace {

TEST(Limits, takes_what_can_be_numbered) {
  EXPECT_EQ(checked_id(0, "nodes"), 0);
  EXPECT_EQ(checked_id(kMaxIds, "nodes"), std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(checked_id(7, "nodes", 7), 7);
  EXPECT_NO_THROW(require_countable(kMaxTriangles, "triangles", kMaxTriangles));
}

TEST(Limits, leave_room_for_the_last_side_of_the_last_triangle) {
  EXPECT_LE(3 * kMaxTriangles, kMaxIds);
  EXPECT_GT(3 * (kMaxTriangles + 1), kMaxIds);
}

TEST(Limits, refuse_one_more_with_the_numbers_and_what_to_do) {
  for (const std::uint64_t limit : {std::uint64_t{7}, kMaxTriangles, kMaxIds}) try {
      checked_id(limit + 1, "triangles of the mesh", limit);
      ADD_FAILURE() << "taken: " << limit + 1;
    } catch (const Error& e) {
      const std::string text = e.what();
      EXPECT_EQ(e.code(), ExitCode::kUsage);
      EXPECT_NE(text.find(std::to_string(limit + 1) + " triangles of the mesh"), std::string::npos) << text;
      EXPECT_NE(text.find("at most " + std::to_string(limit)), std::string::npos) << text;
      EXPECT_NE(text.find("larger lengths"), std::string::npos) << text;
    }
}

}  // namespace
}  // namespace st
