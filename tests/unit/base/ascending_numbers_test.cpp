#include "base/ascending_numbers.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "base/packer.h"

namespace st {
namespace {

using Numbers = std::vector<std::int32_t>;

TEST(AscendingNumbers, come_back_as_they_were) {
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
  for (const Numbers& numbers : {Numbers{}, Numbers{0}, Numbers{kMost}, Numbers{0, 0, 1, 1, kMost},
                                 Numbers{127, 254, 382, 16766, 33150, 2130302, 270565758}})
    EXPECT_EQ(AscendingNumbers(numbers).all(), numbers);
}

TEST(AscendingNumbers, take_a_byte_where_they_are_dense) {
  Numbers numbers;
  for (std::int32_t i = 0; i < 1000; ++i) numbers.push_back(100'000 + 7 * i);
  EXPECT_LE(AscendingNumbers(numbers).n_bytes(), numbers.size() + 2);
}

TEST(AscendingNumbers, are_sent) {
  AscendingNumbers back;
  unpack(packed(AscendingNumbers(Numbers{3, 500, 70000})), back);
  EXPECT_EQ(back.all(), (Numbers{3, 500, 70000}));
}

}  // namespace
}  // namespace st
