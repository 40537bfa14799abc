// Items that belong to keys, as cells to their nodes: all lists behind one another in one array.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace st {

/// The items of each key, in the order in which they were visited. Costs 4 bytes for each key beside the items.
template <class Item = std::int32_t>
class ListsByKey {
 public:
  ListsByKey() = default;
  /// `for_each(visit)` calls visit(key, item) for all items, twice the same ones. Keys are in [0, n_keys).
  template <class ForEach>
  ListsByKey(std::size_t n_keys, const ForEach& for_each) : offsets_(n_keys + 1, 0) {
    for_each([&](auto key, const Item&) { ++offsets_[static_cast<std::size_t>(key) + 1]; });
    std::partial_sum(offsets_.begin(), offsets_.end(), offsets_.begin());
    items_.resize(static_cast<std::size_t>(offsets_.back()));
    std::vector<std::int32_t> next(offsets_.begin(), offsets_.end() - 1);
    for_each([&](auto key, const Item& item) { items_[static_cast<std::size_t>(next[key]++)] = item; });
  }

  std::size_t n_keys() const { return offsets_.size() - 1; }
  std::span<const Item> operator[](std::size_t key) const { return std::span(items_).subspan(begin(key), n(key)); }
  std::span<Item> operator[](std::size_t key) { return std::span(items_).subspan(begin(key), n(key)); }

 private:
  std::size_t begin(std::size_t key) const { return static_cast<std::size_t>(offsets_[key]); }
  std::size_t n(std::size_t key) const { return static_cast<std::size_t>(offsets_[key + 1] - offsets_[key]); }

  std::vector<std::int32_t> offsets_ = {0};  // [n_keys + 1] into items_
  std::vector<Item> items_;
};

/// For each node the cells that have it, ascending; one that has it twice is there twice. A cell is an array of nodes,
/// or has it as `n`.
template <class Cells>
ListsByKey<> cells_of_nodes(const Cells& cells, std::size_t n_nodes) {
  return {n_nodes, [&](const auto& visit) {
            for (std::size_t c = 0; c < cells.size(); ++c) {
              const auto of_nodes = [&](const auto& nodes) {
                for (const std::int32_t node : nodes) visit(node, static_cast<std::int32_t>(c));
              };
              if constexpr (requires { cells[c].n; })
                of_nodes(cells[c].n);
              else
                of_nodes(cells[c]);
            }
          }};
}

}  // namespace st
