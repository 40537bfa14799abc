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

/// For a terminal: control characters become '?', so that names from files cannot steer it; lines may end, and tabs
/// stay.
std::string printable(std::string_view text);

/// For a message of one line: printable(), ends of lines become blanks, and the middle of what is longer than 2000
/// bytes is left out.
std::string one_line(std::string_view text);

/// "1 face", "2 faces"; `more`: the word for several, empty: with an s.
std::string counted(std::int64_t n, const std::string& one, const std::string& more = "");

/// "17" is 17 to 17, "17-20" is 17 to 20; nullopt: a name.
std::optional<std::pair<std::int64_t, std::int64_t>> as_range(const std::string& text);

/// A number that the whole text is; nullopt: it is none, or not finite.
std::optional<double> as_number(std::string_view text);

}  // namespace st
