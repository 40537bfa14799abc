// A program that runs as a child and is listened to.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace st {

struct ProgramEnd {
  int exit_code = 0;          ///< its own, or 128 + the signal that ended it
  bool is_signalled = false;  ///< a signal ended the program itself
  int passed_signal = 0;      ///< > 0: the signal that this process got meanwhile and passed on
};

/// Runs `words` (program and arguments, found along PATH) and waits for its end. `on_error_line` gets each line of its
/// stderr, with its end; stdin and stdout are those of this process. SIGINT, SIGTERM and SIGHUP to this process go to
/// the program, which also gets SIGTERM when this process dies. Throws Error(kInternal) when the program cannot be
/// started. Precondition: this process has no other threads.
ProgramEnd run_supervised(const std::vector<std::string>& words,
                          const std::function<void(const std::string& line)>& on_error_line);

/// "signal 9 (Killed)"
std::string signal_text(int signal);

}  // namespace st
