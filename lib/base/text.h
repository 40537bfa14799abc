// Pieces of text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace st {

/// Without blanks, tabs and ends of lines around it.
std::string trimmed(std::string_view text);

/// "17" is 17 to 17, "17-20" is 17 to 20; nullopt: a name.
std::optional<std::pair<std::int64_t, std::int64_t>> as_range(const std::string& text);

}  // namespace st
