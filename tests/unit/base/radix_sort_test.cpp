// Sorting of keys by digits: what std::sort and std::unique give.
#include "base/radix_sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace st {
namespace {

void expect_as_std(std::vector<std::uint64_t> keys) {
  std::vector<std::uint64_t> expected = keys;
  std::sort(expected.begin(), expected.end());
  expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
  sort_unique(keys);
  EXPECT_TRUE(keys == expected);
}

std::vector<std::uint64_t> random_keys(std::size_t n, std::uint64_t mask) {
  std::mt19937_64 random(n);
  std::vector<std::uint64_t> keys;
  for (std::size_t i = 0; i < n; ++i) keys.push_back(random() & mask);
  return keys;
}

TEST(RadixSort, sorts_keys_of_all_bits_few_and_many) {
  for (const std::size_t n : {0, 1, 2, 100, 127, 128, 500, 2047, 2048, 30000})
    expect_as_std(random_keys(n, ~std::uint64_t{0}));
}

TEST(RadixSort, sorts_keys_that_differ_in_few_digits) {
  for (int shift = 0; shift < 64; shift += 5) expect_as_std(random_keys(5000, std::uint64_t{0x3ff} << shift));
  expect_as_std(random_keys(5000, (std::uint64_t{1} << 63) | 0x7));
}

TEST(RadixSort, sorts_items_by_a_key_of_theirs) {
  struct Item {
    std::uint64_t key;
    int n;
  };
  std::vector<Item> other;
  for (const std::size_t n : {5000, 100, 3000}) {
    std::vector<Item> items;
    for (const std::uint64_t key : random_keys(n, 0xffff00ff)) items.push_back({key, static_cast<int>(key % 1000)});
    radix_sort(items, other, [](const Item& item) { return item.key; });
    ASSERT_EQ(items.size(), n);
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_EQ(items[i].n, static_cast<int>(items[i].key % 1000));
      EXPECT_TRUE(i == 0 || items[i - 1].key <= items[i].key);
    }
  }
}

TEST(RadixSort, keeps_the_order_of_items_of_one_key) {
  struct Item {
    std::uint64_t key;
    std::size_t n;
  };
  std::vector<Item> other;
  for (const std::size_t n : {5000, 1000}) {
    std::vector<Item> items;
    for (const std::uint64_t key : random_keys(n, 0x7001)) items.push_back({key, items.size()});
    radix_sort(items, other, [](const Item& item) { return item.key; });
    for (std::size_t i = 1; i < n; ++i)
      EXPECT_TRUE(items[i - 1].key < items[i].key || items[i - 1].n < items[i].n) << n << " " << i;
  }
}

TEST(RadixSort, keeps_one_of_equal_keys) {
  std::vector<std::uint64_t> keys(5000, 42);
  sort_unique(keys);
  EXPECT_EQ(keys, std::vector<std::uint64_t>{42});
}

TEST(RadixSort, has_keys_that_ascend_as_numbers_do) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<double> ascending{-kInfinity, -1e300, -2.5, -2, -1e-310, 0, 1e-310, 1, 1.5, 1e300, kInfinity};
  for (std::size_t i = 1; i < ascending.size(); ++i)
    EXPECT_LT(sort_key(ascending[i - 1]), sort_key(ascending[i])) << ascending[i];
  EXPECT_EQ(sort_key(-0.0), sort_key(0.0));
  const std::vector<float> singles{-std::numeric_limits<float>::infinity(), -2.5F, -2, 0, 1e-40F, 1, 3e38F};
  for (std::size_t i = 1; i < singles.size(); ++i)
    EXPECT_LT(sort_key(singles[i - 1]), sort_key(singles[i])) << singles[i];
  EXPECT_EQ(sort_key(-0.0F), sort_key(0.0F));
  const std::vector<std::int32_t> whole{std::numeric_limits<std::int32_t>::min(), -1, 0, 7};
  for (std::size_t i = 1; i < whole.size(); ++i) EXPECT_LT(sort_key(whole[i - 1]), sort_key(whole[i])) << whole[i];
}

TEST(RadixSort, sorts_large_items_by_a_number_of_theirs) {
  struct Item {
    double number;
    std::size_t n;
  };
  std::mt19937 random(1);
  std::uniform_int_distribution<int> few(-50, 50);
  for (const std::size_t n : {0, 1, 100, 5000}) {
    std::vector<Item> items;
    for (std::size_t i = 0; i < n; ++i) items.push_back({0.25 * few(random), i});
    std::vector<Item> expected = items;
    std::stable_sort(expected.begin(), expected.end(),
                     [](const Item& a, const Item& b) { return a.number < b.number; });
    sort_by_number(items, [](const Item& item) { return item.number; });
    ASSERT_EQ(items.size(), n);
    for (std::size_t i = 0; i < n; ++i) ASSERT_EQ(items[i].n, expected[i].n) << i;
  }
}

}  // namespace
}  // namespace st
