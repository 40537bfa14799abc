#include "stages/wing_triangles.h"

#include <gtest/gtest.h>

#include "io/file/json_text.h"
#include "stages/wing_table.h"
#include "unit/io/temporary_directory.h"
#include "unit/mesh/shapes.h"
#include "unit/stages/plank.h"

namespace st {
namespace {

/// A plank of cells of 0.01, with a base of its own.
SurfaceMesh fine_plank() {
  std::vector<double> x;
  for (int i = 0; i <= 100; ++i) x.push_back(0.01 * i);
  const SurfaceMesh plank = test::plank_of(x, 400, 0.1);
  return shapes::from(plank.node_xyz, plank.triangles, plank.triangle_face);
}

TEST(WingTriangles, are_enough_to_measure_a_surface) {
  const TemporaryDirectory dir;
  MeshArtifact artifact;
  artifact.header.schema = "mesh";
  artifact.header.tool = "test";
  artifact.header.options_json = "{}";
  artifact.mesh = fine_plank();
  artifact.mesh.labels.group_name = {"tail", "wing"};
  artifact.mesh.triangle_group.assign(artifact.mesh.triangles.size(), 1);
  write_mesh(dir / "m.hdf", artifact);
  const WingRecord wing = test::record(0.01);
  const std::vector<WingMeasure> of_file = measure_wings(MeshFile(dir / "m.hdf"), {&wing, 1});
  const std::vector<WingMeasure> of_mesh = measure_wings(artifact.mesh, {&wing, 1});
  EXPECT_EQ(of_mesh[0].group, "wing");
  EXPECT_EQ(json_text(wing_measures_json(of_file), 1), json_text(wing_measures_json(of_mesh), 1));
}

TEST(WingTriangles, are_few_of_a_fine_mesh) {
  const SurfaceMesh mesh = fine_plank();
  WingRecord wing = test::record(0.01);
  wing.stations.resize(3);
  WingReach reach(wing);
  reach.look_at(mesh);
  const std::size_t n = reach.within(mesh).size();
  EXPECT_GT(n, 1'000u);
  EXPECT_LT(n, mesh.triangles.size() / 10);
}

}  // namespace
}  // namespace st
