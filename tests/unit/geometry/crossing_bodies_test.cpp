// Parts that cross are named at import.
#include <gtest/gtest.h>

#include "unit/geometry/broken_import.h"

namespace st {
namespace {

using test::findings_of;
using test::import_broken;

TEST(CrossingBodies, are_found_once_for_each_pair_at_a_place_of_both) {
  const auto found = findings_of(import_broken("crossing_boxes"), "parts cross: ");
  ASSERT_EQ(found.size(), 1u);
  for (const double x : {found[0].xyz.x, found[0].xyz.y, found[0].xyz.z}) {
    EXPECT_GE(x, 5 - 1e-6);
    EXPECT_LE(x, 10 + 1e-6);
  }
  EXPECT_EQ(findings_of(import_broken("wing_in_body"), "parts cross: ").size(), 3u);
}

TEST(CrossingBodies, are_not_those_that_touch_or_are_apart) {
  for (const char* shape : {"touching_boxes", "offset_boxes", "pin_in_plate", "boxes_along_edge", "box_twice",
                            "box_in_box", "stacked_boxes", "nested_shells"})
    EXPECT_TRUE(findings_of(import_broken(shape), "parts cross").empty()) << shape;
}

TEST(CrossingBodies, are_none_once_united) {
  ImportOptions options;
  options.unite = true;
  EXPECT_TRUE(findings_of(import_broken("wing_in_body", options), "parts cross").empty());
}

}  // namespace
}  // namespace st
