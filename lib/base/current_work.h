// What a thread is at, and for how long, so that a crash or an endless loop can be told where it happened.
#pragma once

#include <pthread.h>

#include <cstdint>
#include <limits>
#include <list>

namespace st {

/// A thread and when its work is late, seconds of the steady clock.
struct LateWatch {
  pthread_t thread;
  double deadline;
};

/// While it lives this thread works on, say, ("face", 12). Objects may be nested; the innermost one counts.
class CurrentWork {
 public:
  /// `kind`: a literal; `number`: as users count, from 1; `seconds`: after which it is late, > 0.
  CurrentWork(const char* kind, std::int64_t number, double seconds = std::numeric_limits<double>::infinity());
  ~CurrentWork();
  CurrentWork(const CurrentWork&) = delete;
  CurrentWork& operator=(const CurrentWork&) = delete;

 private:
  const char* kind_before_;
  std::int64_t number_before_;
  double deadline_before_;
  std::list<LateWatch>::iterator watch_;
};

/// Writes "face 12" into `text` (zero-terminated) for this thread; false, and nothing is written, while it works on
/// nothing that has a name. Async-signal-safe. Precondition: `size` is at least 2.
bool describe_current_work(char* text, int size);

/// Whether this thread's work is late. Async-signal-safe.
bool is_current_work_late();
/// Sends a signal to every thread whose work is late. It may arrive after that work ended: ask is_current_work_late().
void signal_late_work(int signal);

}  // namespace st
