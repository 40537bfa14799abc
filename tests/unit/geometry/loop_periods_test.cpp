// Loops that lie in another period of their surface.
#include <gtest/gtest.h>

#include "support/shapes.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

using test::findings_of;
using test::import_damaged;

constexpr const char* kMoved = "loop in another period of its surface, moved";

TEST(LoopPeriods, holes_in_another_period_are_moved_to_their_face) {
  const ImportResult sound = import_damaged("rod_hole");
  EXPECT_TRUE(findings_of(sound, kMoved).empty());
  for (const char* shape : {"rod_hole_p1", "rod_hole_m3", "rod_outer_off", "rod_hole_reversed", "rod_hole_spline",
                            "rod_hole_closed", "rod_hole_nearly_closed", "rod_all_beyond"}) {
    const ImportResult r = import_damaged(shape);
    EXPECT_EQ(findings_of(r, kMoved).size(), 1u) << shape;
    EXPECT_TRUE(r.is_closed) << shape;
    EXPECT_NEAR(r.area, sound.area, 1e-4 * sound.area) << shape;
    EXPECT_NEAR(r.volume, sound.volume, 1e-4 * sound.volume) << shape;
    EXPECT_LE(r.tables.face_uv_bounds[1] - r.tables.face_uv_bounds[0], 2 * kPi + 1e-6) << shape << ": one turn";
  }
}

TEST(LoopPeriods, only_the_hole_that_is_off_is_moved) {
  const ImportResult r = import_damaged("rod_holes_one_off");
  ASSERT_EQ(findings_of(r, kMoved).size(), 1u);
  EXPECT_EQ(findings_of(r, kMoved)[0].what(), "loop in another period of its surface, moved by -1 in u");
}

TEST(LoopPeriods, of_both_directions_are_found) {
  const ImportResult sound = import_damaged("torus_hole"), r = import_damaged("torus_hole_off");
  ASSERT_EQ(findings_of(r, kMoved).size(), 1u);
  EXPECT_EQ(findings_of(r, kMoved)[0].what(), "loop in another period of its surface, moved by -1 in u, 1 in v");
  EXPECT_NEAR(r.volume, sound.volume, 1e-4 * sound.volume);
}

TEST(LoopPeriods, bands_without_a_seam_get_one) {
  const ImportResult sound = import_damaged("rod_hole");
  for (const char* shape : {"rod_hole_no_seam", "rod_hole_no_seam_p1"}) {
    const ImportResult r = import_damaged(shape);
    EXPECT_EQ(findings_of(r, "loops rebuilt from their edges").size(), 2u) << shape << ": the side, the hole";
    EXPECT_TRUE(r.is_closed) << shape;
    EXPECT_NEAR(r.area, sound.area, 1e-4 * sound.area) << shape;
    EXPECT_NEAR(r.volume, sound.volume, 1e-4 * sound.volume) << shape;
  }
}

TEST(LoopPeriods, a_hole_that_no_period_brings_into_its_face_is_left_out) {
  const ImportResult r = import_damaged("stray_hole");
  const auto found = findings_of(r, "hole outside its face");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].entity, "face 1");
  EXPECT_EQ(found[0].what(), "hole outside its face, left out");
  EXPECT_TRUE(found[0].is_repair);
  EXPECT_NEAR(r.area, 30 * 1.5 * 100, 1e-6 * r.area);
  EXPECT_EQ(r.tables.n_edges(), 4);
}

TEST(LoopPeriods, a_hole_at_the_rim_of_a_disc_stays) {
  const ImportResult r = import_damaged("rim_hole");
  EXPECT_TRUE(findings_of(r, "hole outside its face").empty());
  EXPECT_EQ(r.tables.n_edges(), 2);
}

TEST(LoopPeriods, a_hole_beside_a_plane_face_is_left_out) {
  const ImportResult r = import_damaged("box_stray_hole");
  ASSERT_EQ(findings_of(r, "hole outside its face").size(), 1u);
  EXPECT_TRUE(r.is_closed);
  EXPECT_NEAR(r.area, 8800, 1e-6);
  EXPECT_NEAR(r.volume, 48000, 1e-6);
}

TEST(LoopPeriods, faces_that_begin_at_a_hole_beside_its_face_are_named_and_open) {
  const ImportResult r = import_damaged("box_stray_tube");
  const auto found = findings_of(r, "hole outside its face");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FALSE(found[0].is_repair);
  EXPECT_EQ(found[0].what(), "hole outside its face, left out; open there: face 7");
  EXPECT_FALSE(r.is_closed);
  EXPECT_EQ(r.edge_uses.n_free, 2);
  EXPECT_NEAR(r.area, 8800 + 2 * kPi * 5 * 30, 1e-3);
}

TEST(LoopPeriods, loops_that_run_the_wrong_way_are_turned) {
  for (const char* shape : {"turned_hole", "turned_outer"}) {
    const ImportResult r = import_damaged(shape);
    EXPECT_EQ(findings_of(r, "loop that ran the wrong way").size(), 1u) << shape;
    EXPECT_TRUE(r.is_closed) << shape;
    EXPECT_NEAR(r.volume, 48000 - kPi * 64 * 20, 1e-3) << shape;
  }
}

TEST(LoopPeriods, that_are_right_stay_as_they_are) {
  for (const char* shape :
       {"sphere", "cone", "torus", "drilled_cylinder", "mirrored_cylinder", "periodic_tube", "closed_tube",
        "tube_window", "rational_torus", "plate_with_hole", "drilled_block", "sphere_octant"}) {
    const ImportResult r = test::import_shape(shape);
    EXPECT_TRUE(findings_of(r, kMoved).empty()) << shape;
    EXPECT_TRUE(findings_of(r, "hole outside").empty()) << shape;
  }
}

}  // namespace
}  // namespace st
