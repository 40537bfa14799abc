// What a thread is at, so that a crash can be told where it happened.
#pragma once

#include <cstdint>

namespace st {

/// While it lives this thread works on, say, ("face", 12). Objects may be nested; the innermost one counts.
class CurrentWork {
 public:
  /// `kind`: a literal; `number`: as users count, from 1.
  CurrentWork(const char* kind, std::int64_t number);
  ~CurrentWork();
  CurrentWork(const CurrentWork&) = delete;
  CurrentWork& operator=(const CurrentWork&) = delete;

 private:
  const char* kind_before_;
  std::int64_t number_before_;
};

/// Writes "face 12" into `text` (zero-terminated) for this thread; false, and nothing is written, while it works on
/// nothing that has a name. Async-signal-safe. Precondition: `size` is at least 2.
bool describe_current_work(char* text, int size);

}  // namespace st
