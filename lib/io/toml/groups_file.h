// Groups of faces, edges and vertices, as TOML.
#pragma once

#include <string>
#include <vector>

#include "geometry/model/groups.h"

namespace st {

/// Entries of a groups file, in its order.
struct GroupsFile {
  std::vector<GroupRule> rules;
  std::string hash;  ///< of the file's bytes
};

/// Reads the tables [[group]] and [[st-import.group]] of a file (docs/groups.md); what else an option file may hold
/// is passed over. Throws Error(kInput) for a file that cannot be read, Error(kUsage) with file, line and key for
/// anything that is not understood.
GroupsFile read_groups(const std::string& path);

}  // namespace st
