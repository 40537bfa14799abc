// Solids that overlap become one.
#include <gtest/gtest.h>

#include <cmath>

#include "unit/geometry/broken_import.h"

namespace st {
namespace {

using test::findings_of;

ImportResult united(const std::string& shape) {
  ImportOptions options;
  options.unite = true;
  return test::import_broken(shape, options);
}

TEST(Unite, makes_boxes_that_cross_one_without_what_is_inside) {
  const ImportResult r = united("crossing_boxes");
  EXPECT_EQ(r.tables.n_solids, 1);
  EXPECT_TRUE(r.is_closed);
  EXPECT_EQ(r.tables.n_faces(), 12);
  EXPECT_NEAR(r.volume, 2000 - 125, 1e-6);
  EXPECT_NEAR(r.area, 1200 - 6 * 25, 1e-6);
  EXPECT_EQ(findings_of(r, "bodies that overlap united: 2 bodies before, 1 after").size(), 1u);
}

TEST(Unite, makes_a_wing_a_body_and_a_pylon_through_both_one) {
  const ImportResult r = united("wing_in_body");
  EXPECT_EQ(r.tables.n_solids, 1);
  EXPECT_EQ(r.tables.n_shells, 1);
  EXPECT_TRUE(r.is_closed);
  EXPECT_EQ(r.edge_uses.n_nonmanifold, 0);
  const double body = kPi * 4 * 20, wing = 4 * (30 - 4) * 0.5, pylon = 0.4 * 1.5;  // what is outside of the body
  EXPECT_NEAR(r.volume, body + wing + pylon, 0.01 * body);
}

TEST(Unite, takes_the_common_face_of_bodies_that_touch_away) {
  const ImportResult r = united("touching_boxes");
  EXPECT_EQ(r.tables.n_solids, 1);
  EXPECT_NEAR(r.area, 1000, 1e-6);
  EXPECT_NEAR(r.volume, 2000, 1e-6);
}

TEST(Unite, takes_a_body_inside_another_one_away) {
  const ImportResult r = united("box_in_box");
  EXPECT_EQ(r.tables.n_solids, 1);
  EXPECT_EQ(r.tables.n_faces(), 6);
}

TEST(Unite, leaves_bodies_that_only_share_an_edge_two) { EXPECT_EQ(united("boxes_along_edge").tables.n_solids, 2); }

TEST(Unite, ends_after_its_time_and_says_what_stays_apart) {
  ImportOptions options;
  options.unite = true;
  options.unite_seconds = 0;
  const ImportResult r = test::import_broken("crossing_boxes", options);
  EXPECT_EQ(r.tables.n_solids, 2);
  const auto found = findings_of(r, "bodies that overlap not united");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].what().find("the unions before took 0 s"), std::string::npos) << found[0].what();
}

TEST(Unite, is_done_only_where_asked) { EXPECT_EQ(test::import_broken("crossing_boxes").tables.n_solids, 2); }

}  // namespace
}  // namespace st
