#include "stages/mesh_stage.h"

#include <gtest/gtest.h>

#include <utility>

#include "io/hdf5/artifact.h"
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

/// Triangles in the middle of each chart are laid onto the CAD the other way round.
void fold_charts(Composites& c) {
  for (std::int32_t i = 0; i < c.size(); ++i) {
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
  fold_charts(g.composites);
  write_geometry(m.raster.geometry, g);
  const nlohmann::json summary = meshed(m);
  EXPECT_EQ(summary["faces"], 10);
  EXPECT_EQ(summary["crossing_pairs"], 0);
  EXPECT_TRUE(summary["folds"].empty());
  EXPECT_TRUE(read_patches(m.mesh.output).composites.empty());
}

}  // namespace
}  // namespace st
