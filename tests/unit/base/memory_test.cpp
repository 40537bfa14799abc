// memory_limit(): never more than the machine has, and what a limit of the process leaves.
#include "base/memory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

namespace st {
namespace {

TEST(MemoryLimit, is_no_more_than_the_machine_has) {
  const double machine = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  EXPECT_GT(memory_limit(), 1e6);
  EXPECT_LE(memory_limit(), machine);
}

TEST(MemoryLimit, is_that_of_the_process_where_it_has_one) {
  rlimit old{};
  ASSERT_EQ(getrlimit(RLIMIT_DATA, &old), 0);
  rlimit small = old;
  small.rlim_cur = 3 << 28;
  ASSERT_EQ(setrlimit(RLIMIT_DATA, &small), 0);
  const double limit = memory_limit();
  setrlimit(RLIMIT_DATA, &old);
  EXPECT_LE(limit, 3 << 28);
}

}  // namespace
}  // namespace st
