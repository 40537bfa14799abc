#include "base/nearest_name.h"

#include <gtest/gtest.h>

#include <vector>

namespace st {
namespace {

TEST(NearestName, is_the_one_that_was_meant_or_none) {
  const std::vector<std::string> names = {"wing", "flap", "flap_track", "fuselage"};
  EXPECT_EQ(nearest_name("flop", names), "flap");
  EXPECT_EQ(nearest_name("FLAP", names), "flap");
  EXPECT_EQ(nearest_name("fuselag", names), "fuselage");
  EXPECT_EQ(nearest_name("flaptrack", names), "flap_track");
  EXPECT_EQ(nearest_name("nacelle", names), "");
  EXPECT_EQ(nearest_name("x", {}), "");
}

TEST(NearestName, takes_two_letters_that_are_swapped_as_one_change) {
  EXPECT_EQ(nearest_name("wnig", std::vector<std::string>{"fan", "wing"}), "wing");
  EXPECT_EQ(nearest_name("tpi", std::vector<std::string>{"hub", "tip"}), "tip");
  EXPECT_EQ(nearest_name("itp", std::vector<std::string>{"hub", ""}), "");
}

TEST(NearestName, compares_a_pattern_with_beginnings) {
  const std::vector<std::string> names = {"fuselage_front", "wing_upper", "wing_lower"};
  EXPECT_EQ(nearest_name("wnig*", names), "wing_upper");
  EXPECT_EQ(nearest_name("nacelle*", names), "");
}

}  // namespace
}  // namespace st
