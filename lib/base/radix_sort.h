// Sorting of 64-bit keys by digits.
#pragma once

#include <cstdint>
#include <vector>

namespace st {

/// Sorts ascending and removes duplicates. O(n) per digit that differs; needs a second array of the same size.
void sort_unique(std::vector<std::uint64_t>& keys);

}  // namespace st
