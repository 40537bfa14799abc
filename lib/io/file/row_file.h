// Bytes at their places in a file that several processes write.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace st {

class RowFile {
 public:
  /// Opens an existing file, no link, for writing. `label`: what messages call it. Throws Error(kOutput).
  RowFile(const std::string& name, std::string label);
  ~RowFile();
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;

  /// Several threads may write at a time. Throws Error(kOutput), naming `what`.
  void write(std::uint64_t offset, std::span<const std::byte> bytes, const std::string& what) const;
  /// What was written can be read by others. Throws Error(kOutput). At most once, and nothing may be written after it.
  void close();

 private:
  [[noreturn]] void fail(const std::string& what) const;
  std::string label_;
  int file_ = -1;
};

}  // namespace st
