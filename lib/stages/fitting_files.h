// Whether artifacts belong together, told by their headers: before anything long is read.
#pragma once

#include <string>
#include <vector>

namespace st {

/// A file that is given as an artifact of a kind.
struct GivenFile {
  std::string path;  ///< empty: none is given
  std::string schema;
};

/// Throws Error(kMismatch) unless all go back to the same geometry as the first; the message names both files. Files of
/// another kind, or none of ours, are passed over: who reads them refuses them. Throws Error(kInput) for a file that
/// cannot be opened. Local; milliseconds.
void require_fitting(const std::vector<GivenFile>& files);

}  // namespace st
