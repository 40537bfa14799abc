// StoppedProcesses: what a signal has stopped, below a process, at several looks.
#include "base/stopped_processes.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace st {
namespace {

/// A child that waits for signals, stopped or not, as long as the object lives.
class Child {
 public:
  Child() : id_(fork()) {
    while (id_ == 0) pause();
  }
  ~Child() {
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  pid_t id() const { return id_; }
  void stop() const {
    kill(id_, SIGSTOP);
    waitpid(id_, nullptr, WUNTRACED);
  }
  void go_on() const {
    kill(id_, SIGCONT);
    waitpid(id_, nullptr, WCONTINUED);
  }

 private:
  pid_t id_;
};

TEST(StoppedProcesses, finds_a_child_that_was_stopped_at_every_look) {
  const Child child, other;
  StoppedProcesses processes(getpid(), 3);
  child.stop();
  EXPECT_TRUE(processes.look().empty());
  EXPECT_TRUE(processes.look().empty());
  other.stop();
  EXPECT_EQ(processes.look(), (std::vector{child.id(), other.id()})) << "the other one in its wake";
}

TEST(StoppedProcesses, begins_anew_when_it_goes_on) {
  const Child child;
  StoppedProcesses processes(child.id(), 2);
  child.stop();
  EXPECT_TRUE(processes.look().empty());
  child.go_on();
  EXPECT_TRUE(processes.look().empty());
  child.stop();
  EXPECT_TRUE(processes.look().empty());
  EXPECT_EQ(processes.look(), std::vector{child.id()});
}

TEST(StoppedProcesses, are_not_those_that_ended_unnoticed) {
  EXPECT_FALSE(has_unreaped_child(getpid()));
  const Child child;
  EXPECT_FALSE(has_unreaped_child(getpid())) << "it lives";
  kill(child.id(), SIGKILL);
  siginfo_t end;
  waitid(P_PID, child.id(), &end, WEXITED | WNOWAIT);
  EXPECT_TRUE(has_unreaped_child(getpid()));
}

TEST(StoppedProcesses, finds_none_where_there_is_none) {
  EXPECT_TRUE(StoppedProcesses(getpid(), 1).look().empty());
  EXPECT_TRUE(StoppedProcesses(0x7ffffff0, 1).look().empty()) << "no such process";
}

}  // namespace
}  // namespace st
