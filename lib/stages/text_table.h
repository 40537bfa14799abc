// Tables of text: columns that stand below each other.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace st {

/// Cells of a line, UTF-8.
using TableRow = std::vector<std::string>;

/// One line per row: the first column is aligned left, the next `n_numbers` right, a further one stays as it is. Every
/// row has 1 + n_numbers cells or one more.
std::vector<std::string> aligned_columns(const std::vector<TableRow>& rows, std::size_t n_numbers);

}  // namespace st
