// What ids and offsets of a table must be, so that none leads beyond it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

namespace st {

/// Begin and end of `n_rows` rows of `n` entries altogether.
inline bool are_offsets(std::span<const std::int32_t> offsets, std::size_t n_rows, std::size_t n) {
  return offsets.size() == n_rows + 1 && offsets.front() == 0 && std::is_sorted(offsets.begin(), offsets.end()) &&
         static_cast<std::size_t>(offsets.back()) == n;
}

inline bool are_below(std::span<const std::int32_t> ids, std::int32_t n) {
  return std::all_of(ids.begin(), ids.end(), [&](std::int32_t id) { return id >= 0 && id < n; });
}

}  // namespace st
