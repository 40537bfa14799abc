// Faces that cross each other beside their common edge, or themselves, are named at import.
#include <gtest/gtest.h>

#include <cmath>

#include "unit/geometry/broken_import.h"

namespace st {
namespace {

using test::findings_of;
using test::import_broken;

/// On the z axis, inside the sheet.
void expect_on_axis(Vec3 x) {
  EXPECT_NEAR(std::hypot(x.x, x.y), 0, 1e-6);
  EXPECT_GT(x.z, 0);
  EXPECT_LT(x.z, 10);
}

TEST(CrossingFaces, are_found_beside_their_common_edge) {
  const ImportResult r = import_broken("swallow_tail");
  ASSERT_EQ(r.tables.n_faces(), 2);
  const auto found = findings_of(r, "faces cross beside their common edge: face 1 and face 2");
  ASSERT_EQ(found.size(), 1u);
  expect_on_axis(found[0].xyz);
  EXPECT_NEAR(found[0].size, 1, 1e-6) << "the edge is at x = -1";
}

TEST(CrossingFaces, are_found_where_a_face_crosses_itself) {
  const auto found = findings_of(import_broken("looped_sheet"), "face crosses itself");
  ASSERT_EQ(found.size(), 1u);
  expect_on_axis(found[0].xyz);
}

TEST(CrossingFaces, that_lie_on_each_other_beside_their_common_edge_are_found) {
  const auto found = findings_of(import_broken("folded_flap"),
                                 "faces cross beside their common edge: face 1 and face 2, which lie on each other");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].xyz.z, 0, 1e-6);
  EXPECT_GT(found[0].size, 0.4) << "in the middle of the flap";
  EXPECT_LT(found[0].size, 1);
}

TEST(CrossingFaces, are_none_where_faces_go_on_or_turn_a_corner) {
  EXPECT_TRUE(findings_of(import_broken("offset_boxes"), "faces cross").empty());
  EXPECT_TRUE(findings_of(import_broken("pinched_block"), "faces cross").empty());
}

TEST(CrossingFaces, are_none_where_a_sheet_ends_before_it_comes_to_itself) {
  const ImportResult r = import_broken("open_loop");
  EXPECT_TRUE(findings_of(r, "face").empty());
}

TEST(CrossingFaces, names_an_offset_that_goes_back_on_itself) {
  const auto found = findings_of(test::import_damaged("folded_offset"), "face folds over itself");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].xyz.x, 0, 1e-6);
  EXPECT_GT(found[0].size, 20);
}

}  // namespace
}  // namespace st
