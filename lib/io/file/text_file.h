// Files read and written whole.
#pragma once

#include <string>

namespace st {

/// The bytes of the file. Throws Error(kInput) for a folder and for what cannot be read.
std::string read_text_file(const std::string& path);

/// Writes `text` to `path` by way of a temporary name. Throws Error(kOutput).
void write_text_file(const std::string& path, const std::string& text);

}  // namespace st
