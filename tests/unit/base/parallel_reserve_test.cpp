#include "base/parallel_reserve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace st {
namespace {

TEST(ParallelReserve, KeepsWhatIsThere) {
  std::vector<std::int32_t> v{1, 2, 3};
  parallel_reserve(v, 1'000'000);
  EXPECT_EQ(v, (std::vector<std::int32_t>{1, 2, 3}));
  EXPECT_GE(v.capacity(), 1'000'000u);
}

TEST(ParallelReserve, WhatIsResizedAfterItStaysWhereItIsAndIsZero) {
  std::vector<std::int32_t> v{7};
  parallel_reserve(v, 500'001);
  const std::int32_t* first = v.data();
  v.resize(500'001);
  EXPECT_EQ(v.data(), first);
  EXPECT_EQ(v[0], 7);
  EXPECT_EQ(std::count(v.begin(), v.end(), 0), 500'000);
}

TEST(ParallelReserve, LessRoomChangesNothing) {
  std::vector<double> v(100, 1.5);
  const std::size_t before = v.capacity();
  parallel_reserve(v, 10);
  EXPECT_EQ(v.capacity(), before);
  EXPECT_EQ(v, std::vector<double>(100, 1.5));
}

TEST(ParallelReserve, PiecesAreAppendedInOrder) {
  std::vector<int> all{1};
  const std::vector<std::size_t> start = append_pieces<int>({{2, 3}, {}, {4}}, all);
  EXPECT_EQ(all, (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(start, (std::vector<std::size_t>{1, 3, 3}));
}

}  // namespace
}  // namespace st
