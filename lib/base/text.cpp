#include "base/text.h"

#include <charconv>
#include <cmath>

namespace st {

std::string trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlanks), last = text.find_last_not_of(kBlanks);
  return first == std::string_view::npos ? "" : std::string(text.substr(first, last - first + 1));
}

std::string printable(std::string_view text) {
  std::string shown(text);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const auto c = static_cast<unsigned char>(shown[i]);
    if ((c < 0x20 && c != '\n' && c != '\t') || c == 0x7f) shown[i] = '?';
    const bool is_c1 = c == 0xc2 && i + 1 < shown.size() && (static_cast<unsigned char>(shown[i + 1]) & 0xe0) == 0x80;
    if (is_c1) shown.replace(i, 2, "?");  // U+0080 to U+009F: control characters, too
  }
  return shown;
}

std::string one_line(std::string_view text) {
  constexpr std::size_t kLongest = 2000, kEnds = 900;
  std::string line = text.size() <= kLongest
                         ? std::string(text)
                         : std::string(text.substr(0, kEnds)) + " ... " + std::string(text.substr(text.size() - kEnds));
  for (char& c : line)
    if (c == '\n' || c == '\r') c = ' ';
  return printable(line);
}

std::string counted(std::int64_t n, const std::string& one, const std::string& more) {
  return std::to_string(n) + " " + (n == 1 ? one : more.empty() ? one + "s" : more);
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

std::optional<double> as_number(std::string_view text) {
  double value = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace st
