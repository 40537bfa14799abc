#include "stages/coarse_surface.h"

#include <gtest/gtest.h>

#include "base/log.h"
#include "comm/communicator.h"
#include "stages/import_stage.h"
#include "stages/raster_stage.h"
#include "support/shapes.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

class CoarseSurface : public testing::Test {
 protected:
  BlankSurface surface_of(const std::string& shape) {
    set_verbosity(Verbosity::kQuiet);
    test::write_brep(shape, dir_ / "m.brep");
    ImportStageOptions import;
    import.model = dir_ / "m.brep";
    import.output = dir_ / "g.hdf";
    run_import(import);
    RasterStageOptions raster;
    raster.geometry = dir_ / "g.hdf";
    raster.output = dir_ / "r.hdf";
    run_raster(raster, Communicator());
    return read_raster(dir_ / "r.hdf").surface;
  }
  TemporaryDirectory dir_;
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
    const double volume = *read_geometry(dir_ / "g.hdf").tables.volume;
    EXPECT_NEAR(enclosed(surface), volume, 0.1 * volume) << shape;
    EXPECT_EQ(surface.side, BlankSide::kInside);
  }
}

TEST_F(CoarseSurface, of_an_open_model_is_empty) { EXPECT_TRUE(surface_of("helical_ribbon").triangles.empty()); }

}  // namespace
}  // namespace st
