#include "stages/text_table.h"

#include <algorithm>
#include <utility>

namespace st {
namespace {

/// Characters of UTF-8 text.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

}  // namespace

std::vector<std::string> aligned_columns(const std::vector<TableRow>& rows, std::size_t n_numbers) {
  std::vector<std::size_t> width(1 + n_numbers, 0);
  for (const TableRow& row : rows)
    for (std::size_t c = 0; c < width.size(); ++c) width[c] = std::max(width[c], width_of(row[c]));
  std::vector<std::string> lines;
  for (const TableRow& row : rows) {
    std::string line = "  ";
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string blanks(c < width.size() ? width[c] - width_of(row[c]) : 0, ' ');
      if (c > 0) line += "  ";
      line += c == 0 ? row[c] + blanks : blanks + row[c];
    }
    line.erase(line.find_last_not_of(' ') + 1);
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace st
