// Work that may crash or never end, in a process of its own.
#pragma once

#include <functional>
#include <string>

namespace st {

struct ChildLimits {
  double cpu_seconds = 0;         ///< > 0: the child is ended after this much processor time
  std::string writable_folder{};  ///< files are made and changed there alone, see confine_process(); empty: nowhere
  double wall_seconds = 0;        ///< > 0: the child is ended after this wall time, in whole seconds
};

/// Runs `work` in a forked child and returns its string; an Error thrown there is thrown here with its code and
/// message. A child that crashes or exceeds its time, and one that runs out of memory (that of the machine is the
/// limit), is an Error(kInput): "`subject`: ...". The child dies with its parent, and is confined. What `work` prints
/// to stderr appears there. Where the process has other threads, set wall_seconds: a lock that one of them holds stays
/// locked in the child for ever (not those of malloc).
std::string run_in_child(const std::function<std::string()>& work, const ChildLimits& limits,
                         const std::string& subject);

}  // namespace st
