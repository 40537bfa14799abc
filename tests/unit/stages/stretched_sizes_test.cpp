// --max-aspect through the whole chain.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "base/log.h"
#include "io/hdf5/sizing_artifact.h"
#include "stages/check_stage.h"
#include "stages/import_stage.h"
#include "stages/merge_stage.h"
#include "stages/mesh_stage.h"
#include "stages/prolong_stage.h"
#include "stages/raster_stage.h"
#include "support/shapes.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

using Json = nlohmann::json;

class StretchedSizes : public testing::Test {
 protected:
  StretchedSizes() { set_verbosity(Verbosity::kQuiet); }

  /// The report of st-check on the shape.
  Json checked(const std::string& shape, double aspect) {
    test::write_brep(shape, dir_ / "m.brep");
    import_shape();
    RasterStageOptions raster;
    raster.geometry = dir_ / "g.hdf";
    raster.output = dir_ / "r.hdf";
    raster.max_aspect = aspect;
    run_raster(raster, Communicator());
    ProlongStageOptions prolong;
    prolong.raster = raster.output;
    prolong.output = dir_ / "s.hdf";
    expected_ = Json::parse(run_prolong(prolong).json)["expected_triangles"];
    MeshStageOptions mesh;
    mesh.geometry = dir_ / "g.hdf";
    mesh.sizing = prolong.output;
    mesh.output = dir_ / "p.hdf";
    run_mesh(mesh, Communicator());
    MergeStageOptions merge;
    merge.patches = {mesh.output};
    merge.output = dir_ / "mesh.hdf";
    run_merge(merge);
    CheckStageOptions check;
    check.mesh = merge.output;
    check.geometry = dir_ / "g.hdf";
    check.sizing = prolong.output;
    const StageSummary summary = run_check(check);
    EXPECT_EQ(summary.code, ExitCode::kOk) << summary.line;
    return Json::parse(summary.json);
  }

  void import_shape() const {
    ImportStageOptions o;
    o.model = dir_ / "m.brep";
    o.output = dir_ / "g.hdf";
    run_import(o);
  }

  TemporaryDirectory dir_;
  double expected_ = 0;  // triangles, by st-prolong
};

TEST_F(StretchedSizes, a_wing_needs_at_most_a_third_of_the_triangles) {
  for (const char* shape : {"sharp_wing", "blunt_wing"}) {
    const Json plain = checked(shape, 1), stretched = checked(shape, 16);
    const double n = stretched["triangles"];
    EXPECT_LE(3 * n, plain["triangles"].get<double>()) << shape;
    EXPECT_NEAR(expected_, n, 0.15 * n) << shape;
    EXPECT_GE(stretched["quality"]["mean"].get<double>(), 0.9) << shape;
    EXPECT_GE(stretched["quality"]["p1"].get<double>(), 0.6) << shape;
    EXPECT_LE(stretched["quality"]["above_150_deg"].get<double>(), 0.002 * n) << shape;
  }
}

TEST_F(StretchedSizes, are_the_same_in_all_directions_on_a_sphere) {
  const Json plain = checked("sphere", 1), stretched = checked("sphere", 16);
  EXPECT_EQ(plain["triangles"], stretched["triangles"]);
}

TEST_F(StretchedSizes, need_samples_with_their_places) {
  test::write_brep("box", dir_ / "m.brep");
  import_shape();
  RasterStageOptions raster;
  raster.geometry = dir_ / "g.hdf";
  raster.output = dir_ / "r.hdf";
  raster.max_aspect = 4;
  raster.cell_per_length = 2;
  EXPECT_THROW(run_raster(raster, Communicator()), Error);
}

}  // namespace
}  // namespace st
