// Bodies from tip to tip whose faces have a point for their outer loop in STEP files.
#include "geometry/import/vertex_loops.h"

#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "geometry/brep/faces_of.h"
#include "support/shapes.h"
#include "unit/geometry/broken_import.h"
#include "unit/geometry/occt_shapes.h"

namespace st {
namespace {

class BodiesWithHoles : public testing::TestWithParam<const char*> {};

TEST_P(BodiesWithHoles, are_whole_in_step_files) {
  const TemporaryDirectory dir;
  test::expect_whole_in_step(GetParam(), dir);
  std::ostringstream text;
  text << std::ifstream(dir / "a.step").rdbuf();
  EXPECT_NE(text.str().find("VERTEX_LOOP"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(, BodiesWithHoles, testing::Values("spindle_with_fin_beside", "lemon_with_fin_beside"),
                         [](const auto& info) { return std::string(info.param); });

TEST(VertexLoops, other_faces_stay) {
  for (const char* name : {"sphere", "torus", "cylinder", "cone", "two_balls", "ball_with_socket", "spindle_with_fin",
                           "spindle_with_fin_beside", "periodic_tube", "closed_tube", "square"}) {
    EXPECT_EQ(occt::bound_whole_surfaces(occt::faces_of(test::occt_shape(name))), 0) << name;
  }
}

}  // namespace
}  // namespace st
