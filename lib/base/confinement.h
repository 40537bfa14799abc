// What a process that reads files from strangers may still do.
#pragma once

#include <string>

namespace st {

/// What the kernel took on; false where it is too old, or forbids it.
struct Confinement {
  bool has_no_network = false;       ///< no sockets, no other program, no other process touched
  bool has_files_read_only = false;  ///< but for those of the folder
};

/// Takes from this process, for good: sockets, starting programs, looking into or ending other processes, and making,
/// changing or removing files outside `writable_folder` (empty: anywhere). Open files stay as they are, memory and
/// reading are not limited. Never fails. Linux: seccomp and Landlock.
Confinement confine_process(const std::string& writable_folder) noexcept;

}  // namespace st
