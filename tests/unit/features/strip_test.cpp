// Faces between two long edges.
#include "features/strip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/shapes.h"

namespace st {
namespace {

Strip tapered_strip() {
  for (const Strip& s : find_strips(test::make_model("wedge_strip")))
    if (std::abs(s.stations.front().width - s.stations.back().width) > 0.9 &&
        s.stations.front().width + s.stations.back().width < 1.1)
      return s;
  return {};
}

TEST(Strip, is_no_square_face_nor_one_with_a_seam) {
  EXPECT_TRUE(find_strips(test::make_model("box")).empty());
  EXPECT_TRUE(find_strips(test::make_model("cylinder")).empty());
}

TEST(Strip, knows_its_width_along_its_length) {
  const Strip strip = tapered_strip();
  ASSERT_NE(strip.face, kNone);
  for (const Strip::Station& s : strip.stations) EXPECT_NEAR(s.width, 0.02 + 0.98 * s.x.x / 20, 2e-3);
}

}  // namespace
}  // namespace st
