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

}  // namespace
}  // namespace st
