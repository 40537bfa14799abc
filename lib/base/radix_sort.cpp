#include "base/radix_sort.h"

#include <algorithm>

namespace st {

void sort_unique(std::vector<std::uint64_t>& keys) {
  std::vector<std::uint64_t> other;
  radix_sort(keys, other, [](std::uint64_t key) { return key; });
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

}  // namespace st
