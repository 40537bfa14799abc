// Sets of elements that were joined: union-find.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace st {

/// Elements 0 to n - 1, each in a set of its own at first; the representative of a set is its lowest element. Nearly
/// constant time for each call.
class DisjointSets {
 public:
  explicit DisjointSets(std::int64_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  std::int32_t find(std::int32_t element) {
    while (parent_[element] != element) element = parent_[element] = parent_[parent_[element]];
    return element;
  }
  void join(std::int32_t a, std::int32_t b) {
    a = find(a), b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  /// All sets by their lowest element, each ascending.
  std::vector<std::vector<std::int32_t>> groups() {
    std::vector<std::vector<std::int32_t>> all;
    std::vector<std::size_t> number(parent_.size());
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(parent_.size()); ++i) {
      if (find(i) == i) number[i] = all.size(), all.emplace_back();
      all[number[find(i)]].push_back(i);
    }
    return all;
  }

 private:
  std::vector<std::int32_t> parent_;
};

}  // namespace st
