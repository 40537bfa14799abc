// What a thread is at, and for how long, so that a crash or an endless loop can be told where it happened.
#pragma once

#include <pthread.h>

#include <cstdint>
#include <limits>
#include <list>
#include <new>
#include <string>

#include "base/error.h"

namespace st {

/// A thread and when its work is late, seconds of the steady clock.
struct LateWatch {
  pthread_t thread;
  double deadline;
};

/// What happens to late work.
enum class WhenLate {
  kSignal,  ///< whoever watches sends a signal, see signal_late_work()
  kThrow    ///< it gives up by itself, see throw_if_late()
};

/// How long a piece of work may take.
struct WorkLimit {
  double seconds = std::numeric_limits<double>::infinity();  ///< > 0
  WhenLate when_late = WhenLate::kSignal;
};

/// While it lives this thread works on, say, ("face", 12). Objects may be nested; the innermost one counts.
class CurrentWork {
 public:
  /// `kind`: a literal; `number`: as users count, from 1.
  CurrentWork(const char* kind, std::int64_t number, const WorkLimit& limit = {});
  ~CurrentWork();
  CurrentWork(const CurrentWork&) = delete;
  CurrentWork& operator=(const CurrentWork&) = delete;

 private:
  int n_exceptions_before_;
  double seconds_before_;
  bool throws_before_;
  const char* kind_before_;
  std::int64_t number_before_;
  double deadline_before_;
  std::list<LateWatch>::iterator watch_;
};

/// Writes "face 12" into `text` (zero-terminated) for this thread; false, and nothing is written, while it works on
/// nothing that has a name. Async-signal-safe. Precondition: `size` is at least 2.
bool describe_current_work(char* text, int size);

/// The innermost work of this thread that an exception has ended: "face 12: ". "" when forgotten, or when other work
/// has begun since.
std::string ended_work();
void forget_ended_work();

/// What `compute()` returns. A std::bad_alloc out of it becomes an Error(kMemory) that begins with the innermost work
/// of this thread that it has ended: "face 12: out of memory; ...".
template <class Compute>
auto with_memory_named(const Compute& compute) {
  forget_ended_work();
  try {
    return compute();
  } catch (const std::bad_alloc&) {
    throw out_of_memory(ended_work());
  }
}

/// Whether this thread's work is late. Async-signal-safe.
bool is_current_work_late();
/// Sends a signal to every thread whose work is late. It may arrive after that work ended: ask is_current_work_late().
void signal_late_work(int signal);

/// A piece of work gave up.
class LateWork : public Error {
 public:
  explicit LateWork(double seconds);
};

/// To be called in loops that damaged surfaces may keep going. Throws LateWork when this thread's work is late and
/// WhenLate::kThrow; a few nanoseconds else.
void throw_if_late();

}  // namespace st
