#include "base/threads.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/processor_time.h"

namespace st {
namespace {

/// Sets the number of threads for one test.
class Threads {
 public:
  explicit Threads(int n) { set_thread_count(n); }
  ~Threads() { set_thread_count(1); }
};

TEST(ParallelFor, covers_the_range_once_in_pieces_that_do_not_depend_on_the_threads) {
  std::set<std::vector<std::size_t>> all;
  for (const int n_threads : {1, 2, 3, 8}) {
    const Threads threads(n_threads);
    std::vector<std::size_t> n_seen(1003, 0), piece_of(1003, 0);
    parallel_for(1003, 10, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) ++n_seen[i], piece_of[i] = begin;
    });
    EXPECT_EQ(n_seen, std::vector<std::size_t>(1003, 1));
    all.insert(piece_of);
  }
  EXPECT_EQ(all.size(), 1U);
}

TEST(ParallelFor, runs_nothing_for_an_empty_range) {
  const Threads threads(3);
  parallel_for(0, 10, [](std::size_t, std::size_t) { ADD_FAILURE(); });
}

TEST(ParallelFor, uses_as_many_threads_as_are_set) {
  for (const int n_threads : {1, 3}) {
    const Threads threads(n_threads);
    std::mutex mutex;
    std::set<std::thread::id> ids;
    std::atomic<int> n_inside = 0;
    parallel_for(n_threads, 1, [&](std::size_t, std::size_t) {
      ++n_inside;
      while (n_inside < n_threads) std::this_thread::yield();  // all are here at the same time
      const std::lock_guard lock(mutex);
      ids.insert(std::this_thread::get_id());
    });
    EXPECT_EQ(ids.size(), static_cast<std::size_t>(n_threads));
  }
}

TEST(ParallelFor, throws_what_the_first_piece_threw) {
  const Threads threads(3);
  for (int run = 0; run < 200; ++run) {
    std::string text;
    try {
      parallel_for(50, 1, [](std::size_t i, std::size_t) {
        if (i % 7 == 3) throw std::runtime_error(std::to_string(i));
      });
    } catch (const std::runtime_error& e) {
      text = e.what();
    }
    ASSERT_EQ(text, "3");
  }
}

TEST(ParallelFor, ends_early_after_an_exception) {
  const Threads threads(2);
  std::atomic<int> n_run = 0;
  EXPECT_THROW(parallel_for(1000000, 1,
                            [&](std::size_t i, std::size_t) {
                              ++n_run;
                              if (i == 0) throw std::runtime_error("first");
                              std::this_thread::sleep_for(std::chrono::microseconds(10));
                            }),
               std::runtime_error);
  EXPECT_LT(n_run, 1000000);
}

TEST(ParallelFor, may_stand_in_a_piece_of_another_one) {
  const Threads threads(3);
  std::atomic<int> sum = 0;
  parallel_for(20, 1, [&](std::size_t i, std::size_t) {
    parallel_for(30, 1, [&](std::size_t j, std::size_t) { sum += static_cast<int>(i * j); });
  });
  EXPECT_EQ(sum, 190 * 435);
}

TEST(ParallelFor, inside_the_last_piece_of_another_one_has_helpers) {
  const Threads threads(2);
  std::atomic<int> n_inside = 0;
  parallel_for(2, 1, [&](std::size_t i, std::size_t) {
    if (i == 0) return;
    parallel_for(2, 1, [&](std::size_t, std::size_t) {
      ++n_inside;
      while (n_inside < 2) std::this_thread::yield();  // both pieces at the same time
    });
  });
  EXPECT_EQ(n_inside, 2);
}

TEST(ParallelFor, inside_another_one_throws_through_both) {
  const Threads threads(2);
  EXPECT_THROW(parallel_for(4, 1,
                            [](std::size_t, std::size_t) {
                              parallel_for(4, 1, [](std::size_t, std::size_t) { throw std::runtime_error("inner"); });
                            }),
               std::runtime_error);
}

TEST(SecondsInLoops, count_the_outermost_loop_of_this_thread) {
  for (const int n_threads : {1, 2}) {
    const Threads threads(n_threads);
    const double before = seconds_in_loops().all, longest = seconds_in_loops().longest;
    parallel_for(2, 1, [](std::size_t, std::size_t) {
      parallel_for(2, 1, [](std::size_t, std::size_t) {
        for (const double begin = thread_seconds(); thread_seconds() - begin < 0.005;) continue;
      });
    });
    EXPECT_LT(seconds_in_loops().all - before, 5);
    if (n_threads == 1) {
      const double all = seconds_in_loops().all - before, of_longest = seconds_in_loops().longest - longest;
      EXPECT_GE(of_longest, 0.005);
      EXPECT_GE(all - of_longest, 0.015) << "three pieces of the four could run beside the longest";
    }
    const double after = seconds_in_loops().all;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_EQ(seconds_in_loops().all, after);
  }
}

TEST(SecondsInLoops, do_not_count_loops_of_one_piece_but_those_within) {
  const auto busy = [](std::size_t, std::size_t) {
    for (const double begin = thread_seconds(); thread_seconds() - begin < 0.005;) continue;
  };
  const double before = seconds_in_loops().all;
  parallel_for(1, 1, busy);
  parallel_for(3, 3, busy);
  EXPECT_EQ(seconds_in_loops().all, before);
  parallel_for(1, 1, [&](std::size_t, std::size_t) { parallel_for(2, 1, busy); });
  EXPECT_GE(seconds_in_loops().all - before, 0.01);
}

TEST(RunJobs, runs_each_once) {
  for (const int n_threads : {1, 3}) {
    const Threads threads(n_threads);
    std::vector<int> n_run(5, 0);
    std::vector<std::function<void()>> jobs;
    for (int& n : n_run) jobs.emplace_back([&n] { ++n; });
    run_jobs(jobs);
    EXPECT_EQ(n_run, std::vector<int>(5, 1));
  }
}

TEST(ProcessorCount, is_that_of_the_processors_this_process_may_use) {
  cpu_set_t before, first;
  ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
  EXPECT_EQ(processor_count(), CPU_COUNT(&before));
  CPU_ZERO(&first);
  for (int cpu = 0; CPU_COUNT(&first) == 0; ++cpu)
    if (CPU_ISSET(cpu, &before)) CPU_SET(cpu, &first);
  ASSERT_EQ(sched_setaffinity(0, sizeof first, &first), 0);
  EXPECT_EQ(processor_count(), 1);
  sched_setaffinity(0, sizeof before, &before);
}

TEST(ThreadCount, is_at_least_one) {
  EXPECT_THROW(set_thread_count(0), Error);
  EXPECT_EQ(thread_count(), 1);
  EXPECT_GE(processor_count(), 1);
}

}  // namespace
}  // namespace st
