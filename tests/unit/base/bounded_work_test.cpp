#include "base/bounded_work.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

namespace st {
namespace {

TEST(RunWithin, gives_what_the_work_returns_and_throws_what_it_throws) {
  EXPECT_EQ(run_within(60, [] { return 7; }), 7);
  EXPECT_THROW(run_within(60, []() -> int { throw std::runtime_error("no"); }), std::runtime_error);
  EXPECT_FALSE(has_abandoned_work());
}

TEST(RunWithin, gives_up_what_does_not_end) {
  const auto ends = std::make_shared<std::atomic<bool>>(false);
  const auto result = run_within(0.05, [ends] {
    while (!*ends) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return 1;
  });
  *ends = true;
  EXPECT_FALSE(result);
  EXPECT_TRUE(has_abandoned_work());
}

}  // namespace
}  // namespace st
