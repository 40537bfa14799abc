// Files read and written whole.
#pragma once

#include <fstream>
#include <string>

namespace st {

/// Throws Error(kInput) for a pipe, a socket or a device: reading it might never end.
void refuse_pipe(const std::string& path);

/// Throws Error(kInput) for a folder, as refuse_pipe(), and for what cannot be read.
std::ifstream open_to_read(const std::string& path);

/// The bytes of the file. Throws as open_to_read().
std::string read_text_file(const std::string& path);

/// Writes `text` to `path` by way of a temporary name. Throws Error(kOutput).
void write_text_file(const std::string& path, const std::string& text);

}  // namespace st
