// Bodies that overlap or touch are said, or made one where a far field is around them.
#include "geometry/import/body_relations.h"

#include <gtest/gtest.h>
#include <cmath>

#include "unit/geometry/broken_import.h"

namespace st {
namespace {

using test::findings_of;

ImportResult import_in_air(const std::string& shape) {
  ImportOptions options;
  options.air.farfield = "box:3";
  return test::import_broken(shape, options);
}

TEST(BodyRelations, are_said_and_left_without_a_far_field) {
  const ImportResult touching = test::import_broken("touching_boxes");
  EXPECT_EQ(touching.tables.n_faces(), 12);
  EXPECT_EQ(findings_of(touching, "bodies touch").size(), 1u);
}

TEST(BodyRelations, bodies_that_touch_have_no_face_between_them_in_a_far_field) {
  const ImportResult r = import_in_air("touching_boxes");
  EXPECT_EQ(r.tables.n_faces(), 6 + 10);
  EXPECT_EQ(findings_of(r, "bodies that touch joined").size(), 1u);
  EXPECT_TRUE(findings_of(r, "bodies touch").empty());
  const double air = r.tables.box().diagonal() / std::sqrt(3.0);
  EXPECT_NEAR(r.volume, air * air * air - 2000, 1e-6 * r.volume);
}

TEST(BodyRelations, bodies_that_overlap_are_united_in_a_far_field) {
  const ImportResult apart = test::import_broken("wing_in_body"), r = import_in_air("wing_in_body");
  EXPECT_FALSE(findings_of(apart, "parts cross").empty());
  EXPECT_EQ(findings_of(r, "bodies that overlap united").size(), 1u);
  EXPECT_TRUE(r.is_closed);
}

}  // namespace
}  // namespace st
