#include "stages/id_ranges.h"

#include <fmt/format.h>

namespace st {

std::string id_ranges(std::span<const std::int32_t> ids, char quote) {
  const std::string mark(quote ? 1 : 0, quote);
  std::string text;
  for (std::size_t i = 0, k; i < ids.size(); i = k) {
    for (k = i + 1; k < ids.size() && ids[k] == ids[k - 1] + 1;) ++k;
    if (!text.empty()) text += ", ";
    text += k - i > 1 ? fmt::format("{0}{1}-{2}{0}", mark, ids[i], ids[k - 1]) : fmt::format("{}", ids[i]);
  }
  return text;
}

}  // namespace st
