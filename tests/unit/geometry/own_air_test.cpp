// The air around a body is told from a machine part without a name.
#include "geometry/import/own_air.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "geometry/import/import.h"
#include "support/shapes.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

class OwnAir : public testing::TestWithParam<const char*> {};

TEST_P(OwnAir, is_told_from_the_body_in_it_of_a_fifth_to_a_thousandth) {
  for (const char* size : {"5", "50", "1000"})
    for (const bool is_half : {false, true}) {
      const std::string shape = std::string("pod_in_") + GetParam() + "_" + size + (is_half ? "_half" : "");
      const ImportResult r = test::import_broken(shape);
      EXPECT_GT(r.air.n_farfield, 0) << shape;
      EXPECT_EQ(r.air.n_symmetry, is_half ? 1 : 0) << shape;
      EXPECT_TRUE(r.air.is_by_shape);
      const double pod = std::sqrt(6. * 6 + 2 * 2 + (is_half ? 0.6 * 0.6 : 1.2 * 1.2));
      EXPECT_NEAR(r.tables.reference_diagonal(), pod, 0.05 * pod) << shape;
    }
}

TEST_P(OwnAir, of_half_a_body_of_analytic_faces_is_told_by_the_axis_in_the_plane) {
  for (const char* body : {"capsule", "cone"})
    for (const char* size : {"5", "50", "1000"}) {
      const std::string shape = std::string(body) + "_in_" + GetParam() + "_" + size;
      const ImportResult r = test::import_broken(shape);
      EXPECT_EQ(r.air.n_symmetry, 1) << shape;
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, OwnAir, testing::Values("box", "sphere", "cylinder", "c"));

TEST(OwnAirOf, machine_parts_is_none) {
  for (const char* shape :
       {"blind_hole", "housing", "moulded_block", "pin_in_plate", "crossing_boxes", "box_in_box", "spot"})
    EXPECT_EQ(test::import_broken(shape).air.n_farfield, 0) << shape;
  for (const char* shape :
       {"sphere", "torus", "drilled_block", "stepped_box", "two_boxes", "wing_with_pod", "thin_pipe"})
    EXPECT_EQ(test::import_shape(shape).air.n_farfield, 0) << shape;
}

TEST(OwnAirOf, what_looks_like_air_and_may_be_a_part_is_said_and_taken_where_it_is_asked_for) {
  EXPECT_NE(test::import_broken("blind_hole").air.doubt.find("pocket"), std::string::npos);
  ImportOptions asked;
  asked.air.flow_domain = "yes";
  const ImportResult r = test::import_broken("blind_hole", asked);
  EXPECT_EQ(r.air.n_farfield, 5);
  EXPECT_EQ(r.air.n_symmetry, 1);
  asked.air.flow_domain = "no";
  EXPECT_EQ(test::import_broken("pod_in_box_50", asked).air.n_farfield, 0);
}

}  // namespace
}  // namespace st
