#include "base/current_work.h"

#include <gtest/gtest.h>

#include <csignal>
#include <new>
#include <string>
#include <thread>

namespace st {
namespace {

std::string current() {
  char text[32];
  return describe_current_work(text, sizeof text) ? text : "nothing";
}

TEST(CurrentWork, is_the_innermost_one_of_this_thread) {
  EXPECT_EQ(current(), "nothing");
  const CurrentWork face("face", 12);
  {
    const CurrentWork edge("edge", 1047);
    EXPECT_EQ(current(), "edge 1047");
    std::thread([] { EXPECT_EQ(current(), "nothing"); }).join();
  }
  EXPECT_EQ(current(), "face 12");
}

/// What is said of a std::bad_alloc out of `work`.
template <class Work>
std::string memory_message(const Work& work) {
  try {
    with_memory_named(work);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kMemory);
    return e.what();
  }
  return "none";
}

TEST(CurrentWork, is_named_where_memory_ends) {
  const auto fail_inside = [] {
    const CurrentWork face("face", 12);
    { const CurrentWork edge("edge", 3); }
    throw std::bad_alloc();
    return 0;
  };
  EXPECT_EQ(memory_message(fail_inside).rfind("face 12: out of memory; use larger lengths", 0), 0u);
  EXPECT_EQ(memory_message([]() -> int { throw std::bad_alloc(); }).rfind("out of memory; ", 0), 0u) << "no old work";
  EXPECT_EQ(memory_message([&] {
              const CurrentWork outer("face", 7);
              return fail_inside();
            }).rfind("face 12: ", 0),
            0u)
      << "the innermost one";
  EXPECT_EQ(with_memory_named([] { return 5; }), 5);
}

int g_n_signals = 0;  // of late work, counted by the thread that is late

TEST(CurrentWork, is_late_after_its_seconds_and_its_thread_is_signalled) {
  g_n_signals = 0;
  const auto old = std::signal(SIGUSR1, [](int) { g_n_signals += is_current_work_late(); });
  {
    const CurrentWork in_time("face", 1, {1000}), without_limit("edge", 2);
    signal_late_work(SIGUSR1);
    EXPECT_FALSE(is_current_work_late());
    EXPECT_EQ(g_n_signals, 0);
    const CurrentWork late("face", 3, {1e-9});
    signal_late_work(SIGUSR1);
    EXPECT_TRUE(is_current_work_late());
    EXPECT_EQ(g_n_signals, 1);
    std::thread([] { EXPECT_FALSE(is_current_work_late()); }).join();
  }
  EXPECT_FALSE(is_current_work_late());
  signal_late_work(SIGUSR1);
  EXPECT_EQ(g_n_signals, 1);
  std::signal(SIGUSR1, old);
}

/// Whether `work` gives up in many looks at the clock.
bool gives_up() {
  try {
    for (int i = 0; i < 1000; ++i) throw_if_late();
  } catch (const LateWork& e) {
    EXPECT_STREQ(e.what(), "takes longer than 1e-09 s, its surface may be damaged; give it more with --time-limit");
    return true;
  }
  return false;
}

TEST(CurrentWork, gives_up_late_work_where_that_was_asked_for) {
  EXPECT_FALSE(gives_up());
  const CurrentWork in_time("face", 1, {1000, WhenLate::kThrow});
  EXPECT_FALSE(gives_up());
  {
    const CurrentWork watched("face", 2, {1e-9});
    EXPECT_FALSE(gives_up());
    const CurrentWork late("face", 3, {1e-9, WhenLate::kThrow});
    EXPECT_TRUE(gives_up());
  }
  EXPECT_FALSE(gives_up());
}

TEST(CurrentWork, fits_into_the_text_that_is_given) {
  const CurrentWork face("face", 120);
  char text[8];
  EXPECT_TRUE(describe_current_work(text, sizeof text));
  EXPECT_STREQ(text, "face 12");
  EXPECT_TRUE(describe_current_work(text, 4));
  EXPECT_STREQ(text, "fac");
}

}  // namespace
}  // namespace st
