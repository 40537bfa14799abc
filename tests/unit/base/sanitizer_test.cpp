// The sanitizers are on where they are meant to be, and end a program that does wrong. Empty in other builds.
#include <gtest/gtest.h>

#include <climits>
#include <cstdlib>
#include <thread>
#include <vector>

namespace {

#ifdef __SANITIZE_ADDRESS__
TEST(SanitizerDeathTest, finds_a_read_of_freed_memory) {
  const auto read_freed = [] {
    volatile int* numbers = new int[2]{1, 2};
    delete[] numbers;
    std::exit(numbers[1]);
  };
  EXPECT_DEATH(read_freed(), "heap-use-after-free");
}

TEST(SanitizerDeathTest, finds_an_overflow_of_a_signed_sum) {
  volatile int largest = INT_MAX;
  EXPECT_DEATH(std::exit(largest + 1), "signed integer overflow");
}
#endif

#ifdef ST_ASSERTIONS
TEST(SanitizerDeathTest, finds_an_index_behind_the_end_of_a_vector) {
  const std::vector<int> numbers(3);
  volatile std::size_t end = numbers.size();
  EXPECT_DEATH(std::exit(numbers[end]), "Assertion");
}
#endif

#ifdef __SANITIZE_THREAD__
TEST(SanitizerDeathTest, finds_two_threads_that_write_one_number) {
  const auto race = [] {
    int n = 0;
    std::thread other([&n] {
      for (int i = 0; i < 1000; ++i) ++n;
    });
    for (int i = 0; i < 1000; ++i) ++n;
    other.join();
    std::exit(n == 0);
  };
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(race(), "data race");
}
#endif

}  // namespace
