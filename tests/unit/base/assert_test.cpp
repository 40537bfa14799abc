#include "base/assert.h"

#include <gtest/gtest.h>

namespace {

int n_evaluations = 0;
bool is_counted(bool result) {
  ++n_evaluations;
  return result;
}

TEST(Assert, lets_a_condition_that_holds_pass) { ST_ASSERT(is_counted(true)); }

#ifdef ST_ASSERTIONS
TEST(AssertDeathTest, ends_the_program_and_says_where_and_what) {
  EXPECT_DEATH(ST_ASSERT(is_counted(false)), "assert_test.cpp:.*assertion failed: is_counted\\(false\\)");
}
#else
TEST(Assert, evaluates_nothing_in_a_release_build) {
  n_evaluations = 0;
  ST_ASSERT(is_counted(false));
  EXPECT_EQ(n_evaluations, 0);
}
#endif

}  // namespace
