#include "io/toml/toml_slips.h"

#include <cctype>
#include <charconv>
#include <sstream>
#include <string_view>

#include "base/text.h"

namespace st {

std::string say_toml_slip(const std::string& text, std::size_t line_number) {
  std::istringstream lines(text);
  std::string line;
  for (std::size_t i = 0; i < line_number; ++i) std::getline(lines, line);
  const std::size_t equals = line.find('=');
  if (equals == std::string::npos) return "";
  const std::string value = trimmed(std::string_view(line).substr(equals + 1));
  double number = 0;
  const char* const unit = std::from_chars(value.data(), value.data() + value.size(), number).ptr;
  if (unit == value.data() || unit == value.data() + value.size()) return "";
  const std::string first = trimmed(std::string_view(unit, value.data() + value.size())).substr(0, 1);
  if (first != "%" && !std::isalpha(static_cast<unsigned char>(first[0]))) return "";
  return "; a length with a unit stands in quotes, such as \"2%\" or \"5mm\"";
}

}  // namespace st
