// Space curves away from both their faces are made again.
#include <gtest/gtest.h>

#include "support/shapes.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

TEST(SpaceCurves, that_no_face_agrees_with_are_made_again_from_the_faces) {
  const ImportResult r = test::import_broken("far_circle");
  EXPECT_EQ(test::findings_of(r, "edge away from its faces").size(), 1u);
  EXPECT_TRUE(r.is_closed);
  EXPECT_NEAR(r.area, 2 * kPi * 10 * 20 + 2 * kPi * 100, 1e-3);
  EXPECT_NEAR(r.volume, kPi * 100 * 20, 1e-2);
  EXPECT_NEAR(r.tables.box().hi.z, 20, 1e-4);
}

TEST(SpaceCurves, on_their_faces_stay_as_they_are) {
  for (const char* shape : {"cylinder", "cone", "torus", "drilled_cylinder", "sharp_wing", "t_junction", "loose_box"})
    EXPECT_TRUE(test::findings_of(test::import_shape(shape), "edge away").empty()) << shape;
}

}  // namespace
}  // namespace st
