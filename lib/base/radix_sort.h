// Sorting of 64-bit keys by digits.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace st {

/// Sorts ascending by key_of(item), a 64-bit number; items of one key keep their order. O(n) per digit that
/// differs. `other` is overwritten: who sorts often keeps it.
template <class Item, class KeyOf>
void radix_sort(std::vector<Item>& items, std::vector<Item>& other, const KeyOf& key_of) {
  constexpr int kDigitBits = 11, kShortDigitBits = 8;
  constexpr std::size_t kSmall = 128, kShort = 2048;  // below, comparisons are faster; short digits are
  if (items.size() < kSmall)
    return std::stable_sort(items.begin(), items.end(),
                            [&](const Item& a, const Item& b) { return key_of(a) < key_of(b); });
  std::uint64_t varying = 0;
  for (const Item& item : items) varying |= key_of(item) ^ key_of(items.front());
  other.resize(items.size(), items.front());
  const int digit_bits = items.size() < kShort ? kShortDigitBits : kDigitBits;
  const std::size_t n_digits = std::size_t{1} << digit_bits;
  for (int shift = 0; shift < 64 && varying >> shift != 0; shift += digit_bits) {
    if (((varying >> shift) & (n_digits - 1)) == 0) continue;
    const auto digit_of = [&](const Item& item) { return (key_of(item) >> shift) & (n_digits - 1); };
    std::array<std::size_t, (std::size_t{1} << kDigitBits) + 1> start;
    std::fill_n(start.begin(), n_digits + 1, std::size_t{0});
    for (const Item& item : items) ++start[digit_of(item) + 1];
    for (std::size_t d = 0; d < n_digits; ++d) start[d + 1] += start[d];
    for (const Item& item : items) other[start[digit_of(item)]++] = item;
    items.swap(other);
  }
}

/// The key of a number that is none of NaN: ascending as numbers are, -0 as 0.
inline std::uint64_t sort_key(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x + 0.0);
  return bits >> 63 ? ~bits : bits | std::uint64_t{1} << 63;
}

inline std::uint32_t sort_key(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x + 0.0F);
  return bits >> 31 ? ~bits : bits | std::uint32_t{1} << 31;
}
inline std::uint32_t sort_key(std::int32_t x) { return static_cast<std::uint32_t>(x) ^ std::uint32_t{1} << 31; }

/// Sorts ascending by number_of(item), which is never NaN; items of one number keep their order. For large items: each
/// moves once.
template <class Item, class NumberOf>
void sort_by_number(std::vector<Item>& items, const NumberOf& number_of) {
  struct Place {
    std::uint64_t key;
    std::size_t item;
  };
  std::vector<Place> places, other;
  places.reserve(items.size());
  for (const Item& item : items) places.push_back({sort_key(number_of(item)), places.size()});
  radix_sort(places, other, [](const Place& p) { return p.key; });
  std::vector<Item> sorted;
  sorted.reserve(items.size());
  for (const Place& p : places) sorted.push_back(std::move(items[p.item]));
  items = std::move(sorted);
}

/// Sorts ascending and removes duplicates. O(n) per digit that differs; needs a second array of the same size.
void sort_unique(std::vector<std::uint64_t>& keys);

}  // namespace st
