#include "sizing/loop_tracer.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace st {
namespace {

TEST(LoopTracer, refines_polygons_until_loops_that_nearly_touch_do_not_cross) {
  const Model model = test::make_model("thin_crescent");
  const ModelLimits limits = model_limits(model.tables(), face_roles(model.tables()), {0.5, 5, radians(30), 2});
  const LoopPolygons loops = loop_polygons(model, 0, limits);
  EXPECT_TRUE(crossing_sides(loops.sides()).empty());
  EXPECT_FALSE(loops.contains({9.5, 0})) << "the hole";
  EXPECT_TRUE(loops.contains({-9.9, 0}));
}

}  // namespace
}  // namespace st
