// Each value once, ascending.
#pragma once

#include <algorithm>
#include <vector>

namespace st {

template <typename T>
void sort_once(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace st
