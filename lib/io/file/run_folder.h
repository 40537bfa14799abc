// A place for files that one run needs for itself: in memory while they are small, on the disk beyond.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace st {

/// Folders of a run, removed with what is in them at the end of their scope. A run that was killed leaves them: the
/// next one removes them, which it knows by a lock that nobody holds.
class RunFolder {
 public:
  static constexpr std::uint64_t kMostInMemory = 2'000'000'000;  ///< bytes of all files; see heuristics.md
  /// Where the memory's own file system is on Linux.
  static constexpr const char* kMemory = "/dev/shm";

  /// `disk`: an existing folder, in which one is made. Throws Error(kOutput) when that cannot be.
  explicit RunFolder(const std::string& disk, const std::string& memory = kMemory);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  /// Path for a new file of this name, of which about so many bytes are expected. May be called by a fork of the
  /// process that made this object.
  std::string place(const std::string& name, std::uint64_t expected_bytes);
  /// Where a file of this name is, or the journal of one that is not finished; empty: nowhere.
  std::string find(const std::string& name) const;
  /// Where files are placed.
  std::vector<std::string> folders() const;

 private:
  std::string in_memory_, on_disk_;  // in_memory_ is empty where there is no room
  std::vector<int> locks_;
};

}  // namespace st
