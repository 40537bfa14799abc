#include "base/processor_time.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace st {
namespace {

TEST(ProcessorTime, of_the_thread_grows_with_work_and_not_with_sleep) {
  const double begin = thread_seconds();
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_LT(thread_seconds() - begin, 0.01);
  while (thread_seconds() - begin < 0.01) continue;
  EXPECT_GE(thread_seconds() - begin, 0.01);
}

TEST(ProcessorTime, of_the_process_has_that_of_other_threads) {
  const double own = thread_seconds(), all = process_seconds();
  std::thread([] {
    while (thread_seconds() < 0.02) continue;
  }).join();
  EXPECT_GE(process_seconds() - all, 0.02);
  EXPECT_LT(thread_seconds() - own, 0.02);
}

}  // namespace
}  // namespace st
