// A folder that one run works in at a time.
#pragma once

#include <string>

namespace st {

/// Holds a folder, which exists, for as long as this lives; children hold it, too, and its end needs no file to go.
/// Throws Error(kOutput) where another run holds it. File systems without locks are not guarded.
class FolderLock {
 public:
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
};

}  // namespace st
