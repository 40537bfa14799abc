// Files read and written whole.
#pragma once

#include <fstream>
#include <memory>
#include <string>
#include <string_view>

namespace st {

/// Throws Error(kInput) for a pipe, a socket or a device: reading it might never end.
void refuse_pipe(const std::string& path);

/// Throws Error(kInput) for a folder, as refuse_pipe(), and for what cannot be read.
std::ifstream open_to_read(const std::string& path);

/// UTF-8 of Windows may begin with a byte order mark, which is none of the text.
std::string without_byte_order_mark(std::string text);

/// The bytes of the file, without_byte_order_mark(). Throws as open_to_read().
std::string read_text_file(const std::string& path);

/// Bytes of a file without a copy of them, while an object of it lives. Precondition: the file stays as it is
/// meanwhile.
class MappedBytes {
 public:
  /// Throws as open_to_read().
  explicit MappedBytes(const std::string& path);
  std::string_view bytes() const { return bytes_; }

 private:
  std::shared_ptr<const void> mapping_;
  std::string copy_;  // where a file cannot be mapped
  std::string_view bytes_;
};

/// Writes `text` to `path` by way of a temporary name. Throws Error(kOutput).
void write_text_file(const std::string& path, const std::string& text);

}  // namespace st
