#include "base/number_option.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"

namespace st {
namespace {

constexpr NumberOption kAngle{"--angle", "DEG", "(0, 90]", "an angle"};

TEST(NumberOption, accepts_what_its_interval_contains) {
  for (const double inside : {1e-300, 45.0, 90.0}) EXPECT_EQ(kAngle.refusal(inside), "");
  for (const double outside : {0.0, -1.0, 90.0001, HUGE_VAL, std::nan("")}) EXPECT_NE(kAngle.refusal(outside), "");
}

TEST(NumberOption, bounds_belong_to_the_interval_where_it_says_so) {
  const NumberOption share{"--share", "F", "[0, 1)", "a share"};
  EXPECT_EQ(share.refusal(0), "");
  EXPECT_EQ(share.refusal(1), "must be in [0, 1), not 1");
}

TEST(NumberOption, error_names_flag_interval_and_value) {
  try {
    kAngle.require(91);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kUsage);
    EXPECT_STREQ(e.what(), "--angle: must be in (0, 90], not 91");
  }
}

TEST(NumberOption, absent_values_are_accepted) {
  kAngle.require(std::optional<int>());
  EXPECT_THROW(kAngle.require(std::optional<int>(0)), Error);
}

}  // namespace
}  // namespace st
