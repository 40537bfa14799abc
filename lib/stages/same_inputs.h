// Ranks on several machines must have read the same files.
#pragma once

#include <string>
#include <vector>

#include "base/executor.h"

namespace st {

/// A file that every rank reads by itself.
struct OpenedFile {
  std::string path;
  std::string content_hash;
};

/// Collective. Throws Error(kMismatch) on rank 0 when a rank read other contents than rank 0, such as an old copy on
/// another machine; the message names file, rank and host. `files`: the same on every rank but for the hashes.
void require_same_inputs(const Executor& executor, const std::vector<OpenedFile>& files);

}  // namespace st
