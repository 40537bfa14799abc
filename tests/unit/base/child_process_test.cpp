// run_in_child(): results, errors, crashes and endless loops of the child.
#include "base/child_process.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <new>
#include <stdexcept>

#include "base/error.h"

namespace st {
namespace {

/// The error of a child that does `work`; fails the test when there is none.
Error error_of(const std::function<std::string()>& work, double cpu_seconds = 0) {
  try {
    run_in_child(work, {cpu_seconds}, "wing.step");
  } catch (const Error& e) {
    return e;
  }
  ADD_FAILURE() << "no error";
  return Error(ExitCode::kOk, "");
}

bool says(const Error& e, const std::string& text) { return std::string(e.what()).find(text) != std::string::npos; }

TEST(ChildProcess, gives_back_what_the_work_returns) {
  std::string large(1 << 20, 'x');
  large[5] = '\0';
  EXPECT_EQ(run_in_child([&] { return large; }, {}, "wing.step"), large);
  EXPECT_EQ(run_in_child([] { return std::string(); }, {}, "wing.step"), "");
}

TEST(ChildProcess, passes_errors_on_with_their_code) {
  const Error e = error_of([]() -> std::string { throw Error(ExitCode::kGeometry, "a; b"); });
  EXPECT_EQ(e.code(), ExitCode::kGeometry);
  EXPECT_STREQ(e.what(), "a; b");
  EXPECT_THROW(run_in_child([]() -> std::string { throw std::logic_error("x"); }, {}, "wing.step"), std::runtime_error);
}

TEST(ChildProcess, makes_a_crash_an_error_of_the_input) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE}) {
    const Error e = error_of([=] {
      std::signal(signal, SIG_DFL);
      std::raise(signal);
      return std::string();
    });
    EXPECT_EQ(e.code(), ExitCode::kInput);
    EXPECT_TRUE(says(e, "wing.step") && says(e, "crashed")) << e.what();
  }
}

TEST(ChildProcess, ends_work_that_does_not_end) {
  const Error e = error_of(
      [] {
        volatile bool goes_on = true;
        while (goes_on) {
        }
        return std::string();
      },
      0.05);
  EXPECT_EQ(e.code(), ExitCode::kInput);
  EXPECT_TRUE(says(e, "0.05 s") && says(e, "--time-limit")) << e.what();
}

TEST(ChildProcess, ends_work_that_waits_for_ever) {
  try {
    run_in_child(
        []() -> std::string {
          for (;;) pause();
        },
        {0, "", 0.5}, "wing.step");
    FAIL();
  } catch (const Error& e) {
    EXPECT_TRUE(says(e, "wing.step: not done within 0.5 s")) << e.what();
  }
}

TEST(ChildProcess, takes_an_exit_or_exhausted_memory_for_an_error) {
  EXPECT_EQ(error_of([]() -> std::string { _exit(0); }).code(), ExitCode::kInput);
  EXPECT_TRUE(says(error_of([]() -> std::string { throw std::bad_alloc(); }), "memory"));
}

}  // namespace
}  // namespace st
