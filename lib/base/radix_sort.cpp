#include "base/radix_sort.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace st {
namespace {
constexpr int kDigitBits = 11;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
constexpr std::size_t kSmall = 2048;  // below, comparison sorting is faster than counting

void radix_sort(std::vector<std::uint64_t>& keys) {
  std::uint64_t varying = 0;
  for (const std::uint64_t key : keys) varying |= key ^ keys.front();
  std::vector<std::uint64_t> other(keys.size());
  for (int shift = 0; shift < 64 && varying >> shift != 0; shift += kDigitBits) {
    if (((varying >> shift) & (kDigits - 1)) == 0) continue;
    std::array<std::size_t, kDigits + 1> start{};
    for (const std::uint64_t key : keys) ++start[((key >> shift) & (kDigits - 1)) + 1];
    for (std::size_t d = 0; d < kDigits; ++d) start[d + 1] += start[d];
    for (const std::uint64_t key : keys) other[start[(key >> shift) & (kDigits - 1)]++] = key;
    keys.swap(other);
  }
}
}  // namespace

void sort_unique(std::vector<std::uint64_t>& keys) {
  if (keys.size() < kSmall) {
    std::sort(keys.begin(), keys.end());
  } else {
    radix_sort(keys);
  }
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

}  // namespace st
