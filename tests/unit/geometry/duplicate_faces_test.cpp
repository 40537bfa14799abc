// Faces that are there twice.
#include <gtest/gtest.h>

#include "geometry/import/import.h"
#include "support/shapes.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

using test::findings_of;
using test::import_broken;

TEST(DuplicateFaces, removes_a_face_that_is_there_twice) {
  const ImportResult r = import_broken("doubled_face");
  EXPECT_EQ(r.tables.n_faces(), 6);
  EXPECT_TRUE(r.is_closed);
  EXPECT_EQ(r.n_nonmanifold_edges, 0);
  EXPECT_NEAR(r.volume, 48000, 1e-6);
  const auto found = findings_of(r, "duplicated face");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].is_repair);
  EXPECT_EQ(found[0].entity, "face 7 of the file");
}

TEST(DuplicateFaces, removes_sheets_that_lie_on_a_solid) {
  const ImportResult r = import_broken("sheet_on_solid");
  EXPECT_EQ(findings_of(r, "duplicated face").size(), 2u);
  EXPECT_EQ(r.tables.n_faces(), 6);
  EXPECT_EQ(r.tables.n_solids, 1);
  EXPECT_TRUE(r.is_closed);
  EXPECT_NEAR(r.volume, 48000, 1e-6);
}

TEST(DuplicateFaces, removes_a_solid_that_is_there_twice) {
  const ImportResult r = import_broken("box_twice");
  EXPECT_EQ(r.tables.n_solids, 1);
  EXPECT_EQ(r.tables.n_faces(), 6);
  EXPECT_NEAR(r.volume, 1000, 1e-6);
  const auto found = findings_of(r, "solid that is there twice, removed");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].entity, "solid 2 of the file");
  EXPECT_TRUE(found[0].is_repair);
}

TEST(DuplicateFaces, keeps_faces_of_solids_that_touch) {
  const ImportResult r = import_broken("touching_boxes");
  EXPECT_EQ(r.tables.n_faces(), 12);
  EXPECT_EQ(r.n_repairs, 0);
}

TEST(DuplicateFaces, are_not_faces_of_solids_that_touch_whatever_else_is_in_the_file) {
  const ImportResult r = import_broken("touching_boxes_and_sheet");
  EXPECT_EQ(r.tables.n_faces(), 13);
  EXPECT_TRUE(findings_of(r, "duplicated face").empty());
}

TEST(DuplicateFaces, are_not_faces_of_one_plane_side_by_side) {
  for (const char* shape : {"two_boxes", "stepped_box", "baffled_box", "t_junction", "loose_box"})
    EXPECT_TRUE(findings_of(test::import_shape(shape), "duplicated face").empty()) << shape;
}

}  // namespace
}  // namespace st
