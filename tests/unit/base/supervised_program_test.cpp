// run_supervised(): the end of a program, its stderr, and signals that are passed on.
#include "base/supervised_program.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <thread>
#include <vector>

#include "base/error.h"

namespace st {
namespace {

ProgramEnd run_shell(const std::string& script, std::string* errors = nullptr) {
  return run_supervised({"sh", "-c", script}, [&](const std::string& line) {
    if (errors) *errors += "[" + line + "]";
  });
}

TEST(SupervisedProgram, gives_exit_code_and_lines_of_stderr) {
  std::string errors;
  const ProgramEnd end = run_shell("echo one >&2; printf two >&2; exit 5", &errors);
  EXPECT_EQ(end.exit_code, 5);
  EXPECT_FALSE(end.is_signalled);
  EXPECT_EQ(errors, "[one\n][two]");
}

TEST(SupervisedProgram, tells_of_the_signal_that_ended_it) {
  const ProgramEnd end = run_shell("kill -KILL $$");
  EXPECT_EQ(end.exit_code, 128 + SIGKILL);
  EXPECT_TRUE(end.is_signalled);
}

TEST(SupervisedProgram, passes_signals_on) {
  const ProgramEnd end = run_shell("trap 'exit 3' TERM; kill -TERM $PPID; while :; do sleep 0.01; done");
  EXPECT_EQ(end.exit_code, 3);
  EXPECT_EQ(end.passed_signal, SIGTERM);
}

/// Runs a shell script that is watched; how often a process was found to stand still.
int n_stops(const std::string& script, double seconds) {
  int n = 0;
  run_supervised({"sh", "-c", script}, [](const std::string&) {}, {seconds, [&](pid_t) { ++n; }});
  return n;
}

TEST(SupervisedProgram, is_ended_when_it_or_a_process_below_stands_still) {
  EXPECT_EQ(n_stops("kill -STOP $$; exec sleep 60", 0.06), 1);
  EXPECT_EQ(n_stops("sleep 60 & kill -STOP $!; wait", 0.06), 1);
}

TEST(SupervisedProgram, goes_on_when_its_stop_ends_in_time) {
  EXPECT_EQ(n_stops("(sleep 0.01; kill -CONT $$) & kill -STOP $$; echo >&2", 30), 0);
}

TEST(SupervisedProgram, is_not_ended_for_being_silent) { EXPECT_EQ(n_stops("sleep 0.05", 0.01), 0); }

TEST(SupervisedProgram, is_killed_when_it_takes_no_note_of_the_end_of_a_child) {
  const auto run = [](const std::string& script) {
    return run_supervised({"sh", "-c", script}, [](const std::string&) {}, {0.06, [](pid_t) {}});
  };
  const ProgramEnd deaf = run("sleep 0.01 & exec sleep 60");
  EXPECT_TRUE(deaf.was_deaf);
  EXPECT_EQ(deaf.exit_code, 128 + SIGKILL);
  const ProgramEnd attentive = run("sleep 0.01; sleep 0.05; exit 4");
  EXPECT_FALSE(attentive.was_deaf);
  EXPECT_EQ(attentive.exit_code, 4);
}

TEST(SupervisedProgram, cannot_be_one_that_does_not_exist) {
  try {
    run_supervised({"/no/such/program"}, [](const std::string&) {});
    FAIL() << "started";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kUsage);
    EXPECT_NE(std::string(e.what()).find("/no/such/program cannot be started"), std::string::npos) << e.what();
  }
}

TEST(SupervisedProgram, a_fork_ends_with_what_its_work_returns) {
  const ProgramEnd end = run_forked([] { return 7; });
  EXPECT_EQ(end.exit_code, 7);
  EXPECT_FALSE(end.is_signalled);
}

TEST(SupervisedProgram, a_fork_that_a_signal_ends_is_told_of) {
  const ProgramEnd end = run_forked([] { return raise(SIGKILL); });
  EXPECT_EQ(end.exit_code, 128 + SIGKILL);
  EXPECT_TRUE(end.is_signalled);
}

/// A fork that sends a signal to its parent gets it.
void expect_signal_passed_on_to_a_fork() {
  const ProgramEnd end = run_forked([] {
    signal(SIGTERM, [](int) { _exit(3); });
    kill(getppid(), SIGTERM);
    for (;;) pause();
    return 0;
  });
  EXPECT_EQ(end.exit_code, 3);
  EXPECT_EQ(end.passed_signal, SIGTERM);
}

TEST(SupervisedProgram, signals_are_passed_on_to_a_fork) { expect_signal_passed_on_to_a_fork(); }

/// A signal goes to any thread that does not hold it back.
TEST(SupervisedProgram, signals_are_passed_on_whatever_thread_takes_them) {
  std::atomic<bool> is_done = false;
  std::vector<std::thread> busy;  // so that the process waits for its turn between any two steps
  for (int i = 0; i < 8; ++i)
    busy.emplace_back([&] {
      while (!is_done) std::this_thread::yield();
    });
  for (int i = 0; i < 500; ++i) expect_signal_passed_on_to_a_fork();
  is_done = true;
  for (std::thread& t : busy) t.join();
}

TEST(SupervisedProgram, its_end_is_seen_where_a_daemon_left_ends_of_children_ignored) {
  signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(run_shell("exit 5").exit_code, 5);
  signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(run_forked([] { return 7; }).exit_code, 7);
  signal(SIGCHLD, SIG_DFL);
}

TEST(SupervisedProgram, children_that_a_fork_leaves_have_ended_as_it_returns) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  run_forked([&] {
    if (fork() == 0) {
      usleep(100'000);
      _exit(write(ends[1], "x", 1) == 1 ? 0 : 1);
    }
    return 0;
  });
  close(ends[1]);
  char end = 0;
  EXPECT_EQ(read(ends[0], &end, 1), 1);
  close(ends[0]);
}

}  // namespace
}  // namespace st
