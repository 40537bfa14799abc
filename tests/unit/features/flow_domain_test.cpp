// The flow around a body is told from a machine part without a name.
#include "features/flow_domain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "features/face_roles.h"
#include "support/shapes.h"
#include "unit/geometry/broken_import.h"

namespace st {
namespace {

class FlowDomain : public testing::TestWithParam<const char*> {};

TEST_P(FlowDomain, is_told_from_the_body_in_it_of_a_fifth_to_a_thousandth) {
  for (const char* size : {"5", "50", "1000"})
    for (const bool is_half : {false, true}) {
      const std::string shape = std::string("pod_in_") + GetParam() + "_" + size + (is_half ? "_half" : "");
      const ImportResult r = test::import_broken(shape);
      const FaceRoles roles = face_roles(r.tables);
      EXPECT_FALSE(roles.guessed.empty()) << shape;
      const double pod = std::sqrt(6. * 6 + 2 * 2 + (is_half ? 0.6 * 0.6 : 1.2 * 1.2));
      EXPECT_NEAR(roles.reference_diagonal, pod, 0.05 * pod) << shape;
      const auto n_planes = std::count(roles.role.begin(), roles.role.end(), FaceRole::kSymmetry);
      EXPECT_EQ(n_planes > 0, is_half) << shape;
      EXPECT_GT(std::count(roles.role.begin(), roles.role.end(), FaceRole::kFarfield), 0) << shape;
      EXPECT_TRUE(face_roles(r.tables, RoleGuess::kForbidden).guessed.empty());
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, FlowDomain, testing::Values("box", "sphere", "cylinder", "c"));

TEST(FlowDomainOf, machine_parts_is_none) {
  for (const char* shape : {"blind_hole", "housing", "moulded_block", "pin_in_plate", "crossing_boxes"})
    EXPECT_TRUE(face_roles(test::import_broken(shape).tables).guessed.empty()) << shape;
  for (const char* shape :
       {"sphere", "torus", "drilled_block", "stepped_box", "two_boxes", "wing_with_pod", "thin_pipe"}) {
    const ModelTables t = test::import_shape(shape).tables;
    EXPECT_TRUE(find_flow_domain(t, t.face_box).empty()) << shape;
  }
}

}  // namespace
}  // namespace st
