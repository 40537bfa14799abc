// Faces between two long edges.
#include "features/strip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/tapered_strip.h"

namespace st {
namespace {

TEST(Strip, is_no_square_face_nor_one_with_a_seam) {
  EXPECT_TRUE(find_strips(test::make_model("box")).empty());
  EXPECT_TRUE(find_strips(test::make_model("cylinder")).empty());
}

TEST(Strip, knows_its_width_along_its_length) {
  const Strip strip = test::tapered_strip();
  ASSERT_NE(strip.face, kNone);
  for (const Strip::Station& s : strip.stations) EXPECT_NEAR(s.width, 0.02 + 0.98 * s.x.x / 20, 2e-3);
}

}  // namespace
}  // namespace st
