// A program that runs as a child and is listened to.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

namespace st {

struct ProgramEnd {
  int exit_code = 0;          ///< its own, or 128 + the signal that ended it
  bool is_signalled = false;  ///< a signal ended the program itself
  bool was_deaf = false;      ///< was killed: it took no note of the end of a child
  int passed_signal = 0;      ///< > 0: the signal that this process got meanwhile and passed on
};

/// For programs whose processes wait for each other: what happens where a signal has stopped one of them. A
/// program that takes no note of the end of a child for a third of that time is killed.
struct StopWatch {
  double seconds = 30;                              ///< > 0, that it may stand still while this process runs
  std::function<void(pid_t process)> on_stopped{};  ///< called once, before the program is ended; empty: nobody looks
};

/// Runs `words` (program and arguments, found along PATH) and waits for its end. `on_error_line` gets each line of its
/// stderr, with its end; stdin and stdout are those of this process. SIGINT, SIGTERM and SIGHUP to this process go to
/// the program, which also gets SIGTERM when this process dies. Throws Error(kUsage) when the program cannot be
/// started. Precondition: this process has no other threads.
ProgramEnd run_supervised(const std::vector<std::string>& words,
                          const std::function<void(const std::string& line)>& on_error_line,
                          const StopWatch& watch = {});

/// Runs `work` in a fork of this process and waits for its end, and for that of the processes it leaves; what it
/// returns is its exit code. Signals as in run_supervised(). Throws Error(kInternal) when there can be no more
/// processes. Precondition: this process has no other threads.
ProgramEnd run_forked(const std::function<int()>& work);

/// "signal 9 (Killed)"
std::string signal_text(int signal);

}  // namespace st
