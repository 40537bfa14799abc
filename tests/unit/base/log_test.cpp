#include "base/log.h"

#include <gtest/gtest.h>

namespace st {
namespace {

/// What `action` writes to stderr at one verbosity.
template <class Action>
std::string said_at(Verbosity v, const Action& action) {
  set_verbosity(v);
  testing::internal::CaptureStderr();
  action();
  set_verbosity(Verbosity::kNormal);
  return testing::internal::GetCapturedStderr();
}

TEST(Log, warnings_show_unless_quiet) {
  const auto warn = [] { log_warning("w"); };
  EXPECT_EQ(said_at(Verbosity::kQuiet, warn), "");
  EXPECT_EQ(said_at(Verbosity::kNormal, warn), "warning: w\n");
  EXPECT_EQ(said_at(Verbosity::kVerbose, warn), "warning: w\n");
}

TEST(Log, results_show_unless_quiet) {
  const auto report = [] { log_report("r"); };
  EXPECT_EQ(said_at(Verbosity::kQuiet, report), "");
  EXPECT_EQ(said_at(Verbosity::kNormal, report), "r\n");
}

TEST(Log, brief_leaves_out_results_and_keeps_steps_and_warnings) {
  EXPECT_EQ(said_at(Verbosity::kBrief, [] { log_report("r"), log_step("s"), log_warning("w"); }), "s\nwarning: w\n");
  EXPECT_EQ(said_at(Verbosity::kQuiet, [] { log_step("s"); }), "");
}

TEST(Log, folders_that_are_hidden_are_not_named) {
  hide_folder("/there/for/a/while");
  EXPECT_EQ(said_at(Verbosity::kNormal, [] { log_warning("/there/for/a/while/a.hdf: like /there/for/a/whole"); }),
            "warning: a.hdf: like /there/for/a/whole\n");
  EXPECT_EQ(without_hidden_folders("/there/for/a/while/a and /there/for/a/while/b"), "a and b");
}

TEST(Log, information_shows_only_when_verbose) {
  const auto inform = [] { log_info("i"); };
  EXPECT_EQ(said_at(Verbosity::kQuiet, inform), "");
  EXPECT_EQ(said_at(Verbosity::kNormal, inform), "");
  EXPECT_EQ(said_at(Verbosity::kVerbose, inform), "i\n");
}

}  // namespace
}  // namespace st
