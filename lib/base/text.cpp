#include "base/text.h"

#include <charconv>

namespace st {

std::string trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlanks), last = text.find_last_not_of(kBlanks);
  return first == std::string_view::npos ? "" : std::string(text.substr(first, last - first + 1));
}

std::optional<std::pair<std::int64_t, std::int64_t>> as_range(const std::string& text) {
  const char *const begin = text.data(), *const end = begin + text.size();
  std::int64_t first = 0, last = 0;
  const auto a = std::from_chars(begin, end, first);
  if (a.ec != std::errc() || first < 0) return std::nullopt;
  if (a.ptr == end) return std::pair(first, first);
  const auto b = std::from_chars(a.ptr + 1, end, last);
  if (*a.ptr != '-' || b.ec != std::errc() || b.ptr != end || last < 0) return std::nullopt;
  return std::pair(first, last);
}

}  // namespace st
