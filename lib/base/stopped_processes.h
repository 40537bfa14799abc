// Processes that a signal has stopped (SIGSTOP), which wait for somebody to let them go on; and those that are
// deaf to the end of their children.
#pragma once

#include <sys/types.h>

#include <map>
#include <vector>

namespace st {

/// Whether a child of the process has ended and the process has not taken note of it. False where there is no /proc.
bool has_unreaped_child(pid_t process);

/// Looks at a process and all below it. Counts looks, not seconds: who looks may have been stopped as well, and then
/// nobody was waited for.
class StoppedProcesses {
 public:
  /// `n_looks`: > 0, at which a process has to be stopped, one after the other.
  StoppedProcesses(pid_t root, int n_looks) : root_(root), n_looks_(n_looks) {}

  /// To be called at equal intervals. All that are stopped, once one has been at so many looks, that one first; nothing
  /// before, and where there is no /proc. One that a debugger holds is not stopped.
  std::vector<pid_t> look();

 private:
  pid_t root_;
  int n_looks_;
  std::map<pid_t, int> looks_;  // at which each was stopped
};

}  // namespace st
