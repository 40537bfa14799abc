#include "geometry/model/chart_alignment.h"

#include <gtest/gtest.h>

#include "unit/geometry/joined_models.h"

namespace st {
namespace {

TEST(ChartAlignment, has_u_where_faces_bend_least) {
  const test::Joined joined("wing_of_8");
  const Chart chart = joined.composites.chart(0);
  for (const Corners& c : chart.corners) {  // ruled along z
    const Vec2 a = chart.uv[c[1]] - chart.uv[c[0]];
    const Vec3 x = chart.x[c[1]] - chart.x[c[0]];
    EXPECT_NEAR(std::abs(a.x), std::abs(x.z), 0.02 * norm(x));
  }
}

}  // namespace
}  // namespace st
