// Space curves away from both their faces are made again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

TEST(SpaceCurves, that_leave_their_faces_at_one_place_are_made_again) {
  const ImportResult r = test::import_damaged("bumped_seam");
  EXPECT_EQ(test::findings_of(r, "edge away from its faces").size(), 1u);
  for (const double tolerance : r.tables.edge_tolerance) EXPECT_LE(tolerance, 1e-4);
  EXPECT_LE(test::largest_gap(Model(r.tables, r.brep), 0), 1e-4);
}

TEST(SpaceCurves, too_far_from_a_face_to_be_a_matter_of_tolerance_are_named_and_no_tolerance_hides_it) {
  const ImportResult r = test::import_broken("edges_elsewhere");
  EXPECT_FALSE(test::findings_of(r, "trimming curve off its edge by more than a tolerance").empty());
  for (const double tolerance : r.tables.edge_tolerance) EXPECT_LE(tolerance, 1);
}

/// Closed, with this area and volume, each edge on its faces, and as many edges said to have been without a curve.
void expect_made(const std::string& shape, std::size_t n_edges, double area, double volume) {
  const ImportResult r = test::import_damaged(shape);
  EXPECT_EQ(test::findings_of(r, "edge without a curve in space").size(), n_edges) << shape;
  EXPECT_TRUE(r.is_closed) << shape;
  EXPECT_NEAR(r.area, area, 1e-4 * area) << shape;
  EXPECT_NEAR(r.volume, volume, 1e-4 * volume) << shape;
  const Model model(r.tables, r.brep);
  for (FaceId f = 0; f < r.tables.n_faces(); ++f) EXPECT_LE(test::largest_gap(model, f), 1e-3) << shape << f;
}

TEST(SpaceCurves, that_are_missing_are_made_from_the_trimming_curves) {
  expect_made("no_curve_ring", 2, 2 * kPi * 30 * 130, kPi * 900 * 100);
  expect_made("no_curve_ranges", 2, 2 * kPi * 30 * 130, kPi * 900 * 100);
  expect_made("no_curve_torus", 2, 4 * kPi * kPi * 400, 2 * kPi * kPi * 4000);
  expect_made("no_curve_box", 12, 8800, 48000);
  expect_made("no_curve_all", 8, 2697.12, 9145.24);
}

TEST(SpaceCurves, of_edges_between_two_planes_are_straight_without_any_curve) {
  expect_made("no_curve_at_all", 1, 8800, 48000);
}

TEST(SpaceCurves, are_missing_at_poles_alone) {
  expect_made("no_curve_pole", 2, 400 * kPi, 4000 * kPi / 3);
  expect_made("no_curve_false_pole", 1, 8800, 48000);
}

TEST(SpaceCurves, bend_where_their_trimming_curves_bend) {
  const ImportResult r = test::import_damaged("no_curve_bent");
  EXPECT_NEAR(r.area, 1600 - 150 * std::sqrt(3), 0.02);
  EXPECT_NEAR(*std::max_element(r.tables.edge_length.begin(), r.tables.edge_length.end()), 60, 1e-3);
}

TEST(SpaceCurves, follow_the_trimming_curve_that_lies_on_all_faces) {
  const ImportResult r = test::import_damaged("no_curve_disagree");
  EXPECT_TRUE(r.is_closed);
  const Model model(r.tables, r.brep);
  for (FaceId f = 0; f < r.tables.n_faces(); ++f) EXPECT_LE(test::largest_gap(model, f), 1e-3) << f;
}

}  // namespace
}  // namespace st
