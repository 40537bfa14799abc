#include "stages/coarse_surface.h"

#include <gtest/gtest.h>

#include "support/staged.h"

namespace st {
namespace {

class CoarseSurface : public testing::Test {
 protected:
  BlankSurface surface_of(const std::string& shape) {
    staged_.make_raster(shape);
    return read_raster(staged_.raster.output).surface;
  }
  test::StagedModel staged_;
};

double enclosed(const BlankSurface& s) {
  double six = 0;
  for (const Triangle& t : s.triangles) six += dot(s.points[t.n[0]], cross(s.points[t.n[1]], s.points[t.n[2]]));
  return six / 6;
}

TEST_F(CoarseSurface, of_a_solid_is_closed_and_encloses_it) {
  for (const char* shape : {"sphere", "drilled_block", "torus"}) {
    const BlankSurface surface = surface_of(shape);
    ASSERT_FALSE(surface.triangles.empty()) << shape;
    EXPECT_TRUE(find_open_edges(surface.view()).empty()) << shape;
    const double volume = *read_geometry(staged_.raster.geometry).tables.volume;
    EXPECT_NEAR(enclosed(surface), volume, 0.1 * volume) << shape;
    EXPECT_EQ(surface.side, BlankSide::kInside);
  }
}

TEST_F(CoarseSurface, of_an_open_model_is_empty) { EXPECT_TRUE(surface_of("helical_ribbon").triangles.empty()); }

}  // namespace
}  // namespace st
