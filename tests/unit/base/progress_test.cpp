#include "base/progress.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>
#include <vector>

#include "base/log.h"

namespace st {
namespace {

/// What `action` writes to stderr, no terminal here, at one verbosity.
template <class Action>
std::string said_at(Verbosity v, const Action& action) {
  set_verbosity(v);
  testing::internal::CaptureStderr();
  action();
  set_verbosity(Verbosity::kNormal);
  return testing::internal::GetCapturedStderr();
}

TEST(ProgressText, tells_share_rate_and_time_left) {
  EXPECT_EQ(progress_text("meshing", 250000, 1e6, "triangles", 2), "meshing 25 %, 0.12 million triangles/s, 6 s left");
  EXPECT_EQ(progress_text("sampling", 50, 100, "", 30), "sampling 50 %, 30 s left");
  EXPECT_EQ(progress_text("meshing", 100, 1e4, "triangles", 3), "meshing 1 %");
  EXPECT_EQ(progress_text("meshing", 1e3, 1e5, "triangles", 0.5), "meshing 1 %");
}

TEST(ProgressText, long_times_are_minutes_and_hours) {
  EXPECT_EQ(progress_text("w", 10, 100, "", 60), "w 10 %, 9 min left");
  EXPECT_EQ(progress_text("w", 10, 100, "", 1200), "w 10 %, 3.0 h left");
}

TEST(ProgressText, all_done_leaves_no_time) {
  EXPECT_EQ(progress_text("w", 10, 10, "", 5), "w 100 %");
  EXPECT_EQ(progress_text("w", 12, 10, "", 5), "w 100 %");
  EXPECT_EQ(progress_text("w", 0, 0, "", 5), "w 100 %");
}

TEST(LogPace, the_first_ten_seconds_are_silent) {
  LogPace pace;
  EXPECT_FALSE(pace.is_due(0, 0));
  EXPECT_FALSE(pace.is_due(9.9, 0.99));
  EXPECT_TRUE(pace.is_due(10, 0.99));
}

TEST(LogPace, a_line_for_each_tenth_or_ten_seconds) {
  LogPace pace;
  EXPECT_TRUE(pace.is_due(10, 0.30));
  EXPECT_FALSE(pace.is_due(11, 0.39));
  EXPECT_TRUE(pace.is_due(11, 0.41));
  EXPECT_FALSE(pace.is_due(20, 0.42));
  EXPECT_TRUE(pace.is_due(21, 0.42));
}

TEST(Progress, short_work_leaves_no_line_in_a_log) {
  const auto work = [] {
    Progress progress("faces", 10);
    progress.update(5);
    progress.step("corners", 7);
  };
  EXPECT_EQ(said_at(Verbosity::kNormal, work), "");
  EXPECT_EQ(said_at(Verbosity::kQuiet, work), "");
}

TEST(Progress, advances_from_several_threads) {
  const auto work = [] {
    Progress progress("faces", 400);
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i)
      threads.emplace_back([&] {
        for (int k = 0; k < 100; ++k) progress.advance(1);
      });
    for (std::thread& t : threads) t.join();
  };
  EXPECT_EQ(said_at(Verbosity::kNormal, work), "");
}

TEST(Progress, is_told_in_processes_that_fork_while_it_is_told) {
  const Progress outer("importing", 1);
  for (int i = 0; i < 20; ++i) {
    { const Progress before("reading", 1); }
    const pid_t child = fork();
    if (child == 0) {
      alarm(10);
      for (int k = 0; k < 20; ++k) {
        const Progress inner("joining", 1);
        usleep(500);
      }
      _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_EQ(status, 0) << "fork " << i;
  }
}

TEST(Progress, verbose_tells_how_long_it_took) {
  EXPECT_EQ(said_at(Verbosity::kVerbose, [] { Progress("faces", 10).update(5); }), "  faces: 0.00 s\n");
}

TEST(Progress, lines_of_a_rank_are_redrawn_and_its_other_words_are_not) {
  const auto relay = [](const std::string& text) { return said_at(Verbosity::kNormal, [&] { relay_progress(text); }); };
  EXPECT_EQ(relay("\r\033[Kmeshing 43 %\n"), "\r\033[Kmeshing 43 %");
  EXPECT_EQ(relay("warning: w\n"), "");
  EXPECT_FALSE(relay_progress("warning: w\n"));
  EXPECT_FALSE(relay_progress(""));
}

/// In a process of its own: the environment is read once, and the clock of others has run.
void be_fast() { setenv("ST_PROGRESS_SECONDS", "0.2", 1); }

TEST(ProgressDeathTest, a_step_that_tells_nothing_gets_lines_all_the_same) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto work = [](const char* step) {
    be_fast();
    Progress progress("importing", 1);
    progress.step(step, 0.4);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
  };
  EXPECT_EXIT((work("sewing"), _exit(0)), testing::ExitedWithCode(0), "importing: sewing 40 %, 0 s so far");
  EXPECT_EXIT((set_verbosity(Verbosity::kQuiet), work("sewing"), _exit(0)), testing::ExitedWithCode(0), "^$");
}

TEST(ProgressDeathTest, the_innermost_work_speaks) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto work = [] {
    be_fast();
    Progress outer("importing", 1), inner("uniting bodies", 4);
    inner.update(1);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
  };
  EXPECT_EXIT((work(), _exit(0)), testing::ExitedWithCode(0), "uniting bodies 25 %, 0 s so far");
}

}  // namespace
}  // namespace st
