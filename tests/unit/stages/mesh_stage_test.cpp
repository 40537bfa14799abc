#include "stages/mesh_stage.h"

#include <gtest/gtest.h>

#include <utility>

#include "io/hdf5/artifact.h"
#include "stages/check_stage.h"
#include "stages/merge_stage.h"
#include "support/staged.h"

namespace st {
namespace {

/// A wing whose skins of four faces each are joined, as geometry.hdf of the model.
GeometryArtifact joined_wing(const test::StagedModel& m) {
  test::write_brep("wing_of_8", m.dir / "model.brep");
  ImportStageOptions o;
  o.model = m.dir / "model.brep";
  o.output = m.raster.geometry;
  o.composite = "smooth";
  run_import(o);
  return read_geometry(o.output);
}

/// Summary of st-mesh, after the other stages.
nlohmann::json meshed(test::StagedModel& m) {
  m.raster.lmin = m.raster.lmax = "5%";
  run_raster(m.raster, Communicator());
  m.make_sizing();
  return m.make_patches();
}

/// Triangles in the middle of the first `n` charts are laid onto the CAD the other way round.
void fold_charts(Composites& c, std::int32_t n_folded) {
  for (std::int32_t i = 0; i < n_folded; ++i) {
    const std::int32_t first = c.triangle_offsets[i], n = c.triangle_offsets[i + 1] - first;
    for (std::int32_t t = first + n / 3; t < first + 2 * n / 3; ++t)
      std::swap(c.triangle_uv[static_cast<std::size_t>(t)][0], c.triangle_uv[static_cast<std::size_t>(t)][1]);
  }
}

TEST(MeshStage, keeps_faces_joined_that_can_be_meshed) {
  test::StagedModel m;
  joined_wing(m);
  EXPECT_LT(meshed(m)["faces"], 10);
  EXPECT_FALSE(read_patches(m.mesh.output).composites.empty());
}

TEST(MeshStage, meshes_the_faces_of_the_cad_where_joined_ones_fold) {
  test::StagedModel m;
  GeometryArtifact g = joined_wing(m);
  fold_charts(g.composites, g.composites.size());
  write_geometry(m.raster.geometry, g);
  const nlohmann::json summary = meshed(m);
  EXPECT_EQ(summary["faces"], 10);
  EXPECT_EQ(summary["crossing_pairs"], 0);
  EXPECT_TRUE(summary["folds"].empty());
  EXPECT_TRUE(read_patches(m.mesh.output).composites.empty());
}

TEST(MeshStage, keeps_what_else_is_joined) {
  test::StagedModel m;
  GeometryArtifact g = joined_wing(m);
  fold_charts(g.composites, 1);
  write_geometry(m.raster.geometry, g);
  const nlohmann::json summary = meshed(m);
  EXPECT_EQ(summary["faces"], 7) << "10 of the CAD, 4 are one";
  EXPECT_TRUE(summary["folds"].empty());
  const Composites left = read_patches(m.mesh.output).composites;
  ASSERT_EQ(left.size(), 1);
  EXPECT_EQ(left.members(0).front(), g.composites.members(1).front());
  run_merge({{m.mesh.output}, m.dir / "mesh.hdf", {}, false});
  const StageSummary check = run_check({m.dir / "mesh.hdf", m.raster.geometry, "", 0.01, {}, {}});
  EXPECT_EQ(check.code, ExitCode::kOk) << check.line << ": faces are those of the mesh, each with its area";
}

}  // namespace
}  // namespace st
