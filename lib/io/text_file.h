// Text files written whole or not at all.
#pragma once

#include <string>

namespace st {

/// Writes `text` to `path` by way of a temporary name. Throws Error(kOutput).
void write_text_file(const std::string& path, const std::string& text);

}  // namespace st
