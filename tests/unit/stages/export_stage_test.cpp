#include "stages/export_stage.h"

#include <gtest/gtest.h>

#include "base/log.h"
#include "io/foreign/triangulation_file.h"
#include "io/hdf5/node_values.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

class ExportStage : public testing::Test {
 protected:
  void SetUp() override {
    write_mesh(dir_ / "m.hdf", sample_mesh());
    o_.artifact = dir_ / "m.hdf";
    o_.output = dir_ / "m.off";
  }
  TemporaryDirectory dir_;
  ExportStageOptions o_;
};

TEST_F(ExportStage, refuses_options_that_contradict_each_other_or_lack_the_geometry) {
  o_.ascii = o_.binary = true;
  EXPECT_ERROR(run_export(o_), kUsage, "exclude each other");
  o_.ascii = o_.binary = false;
  o_.quadratic = true;
  EXPECT_ERROR(run_export(o_), kUsage, "give --geometry geometry.hdf");
  o_.quadratic = false;
  o_.geometry = dir_ / "g.hdf";
  EXPECT_ERROR(run_export(o_), kUsage, "--geometry is for --quadratic, --parametric");
  EXPECT_EQ(dir_.files().size(), 1u);
}

TEST_F(ExportStage, refuses_a_geometry_that_the_mesh_is_not_of) {
  write_geometry(dir_ / "g.hdf", sample_geometry());
  o_.geometry = dir_ / "g.hdf";
  o_.parametric = true;
  o_.output = dir_ / "m.msh";
  EXPECT_ERROR(run_export(o_), kMismatch, "g.hdf");
}

TEST_F(ExportStage, scales_from_the_models_unit) {
  o_.unit = "in";
  run_export(o_);
  const std::string text = read_bytes(o_.output);
  EXPECT_NE(text.find("\n0.039370078740157"), std::string::npos) << "1 mm: " << text;
  o_.unit = "parsec";
  EXPECT_ERROR(run_export(o_), kUsage, "'parsec' is no unit");
  MeshArtifact plain = sample_mesh();
  plain.header.unit.clear();
  plain.header.unit_in_m.reset();
  write_mesh(o_.artifact, plain);
  o_.unit = "m";
  EXPECT_ERROR(run_export(o_), kUsage, "st-import --unit");
}

TEST_F(ExportStage, writes_one_file_for_each_group) {
  o_.split_groups = true;
  run_export(o_);
  EXPECT_EQ(read_bytes(dir_ / "m_body.off").substr(0, 10), "OFF\n4 2 0\n");
  EXPECT_EQ(read_bytes(dir_ / "m_wing.off").substr(0, 10), "OFF\n4 2 0\n");
  EXPECT_EQ(dir_.files().size(), 3u);
}

/// Whether the array "place" of a .vtu is where its nodes are.
void expect_places(const std::string& path, std::size_t n_nodes) {
  const std::string bytes = read_bytes(path);
  const std::vector<Vec3> nodes = parse_vtu(path, bytes).node_xyz;
  const std::vector<double> place = parse_vtu_point_array(path, bytes, "place");
  ASSERT_EQ(nodes.size(), n_nodes) << path;
  ASSERT_EQ(place.size(), 3 * n_nodes) << path;
  for (std::size_t i = 0; i < n_nodes; ++i)
    EXPECT_EQ(nodes[i], (Vec3{place[3 * i], place[3 * i + 1], place[3 * i + 2]})) << path << " " << i;
}

TEST_F(ExportStage, shows_the_values_that_remeshing_carried) {
  MeshArtifact mesh = sample_mesh();
  mesh.mesh.triangle_group = {1, 1, 0, 1};  // the body has nodes 1, 2, 3 alone
  NodeValues place{"place", 3, {}};
  for (const Vec3 x : mesh.mesh.node_xyz) place.values.insert(place.values.end(), {x.x, x.y, x.z});
  write_mesh_with(o_.artifact, mesh, std::vector{NodeValues{"p", 1, {4, 3, 2, 1}}, place});
  o_.output = dir_ / "m.vtu";
  run_export(o_);
  expect_places(o_.output, 4);
  EXPECT_EQ(parse_vtu_point_array(o_.output, read_bytes(o_.output), "p"), (std::vector<double>{4, 3, 2, 1}));
  o_.output = dir_ / "b.vtm";
  run_export(o_);
  expect_places(dir_ / "b/b_body.vtu", 3);
  expect_places(dir_ / "b/b_wing.vtu", 4);
  o_.output = dir_ / "m.off";
  set_verbosity(Verbosity::kNormal);
  testing::internal::CaptureStderr();
  run_export(o_);
  set_verbosity(Verbosity::kQuiet);  // as other tests of stages want it
  EXPECT_NE(testing::internal::GetCapturedStderr().find("arrays of values at nodes (2)"), std::string::npos);
}

TEST_F(ExportStage, refuses_options_of_meshes_for_other_artifacts) {
  write_geometry(dir_ / "g.hdf", sample_geometry());
  o_.artifact = dir_ / "g.hdf";
  o_.split_groups = true;
  EXPECT_ERROR(run_export(o_), kUsage, "--split-groups is for meshes; this is a geometry artifact");
}

TEST(RunExport, exports_meshes_and_refuses_what_has_no_export) {
  TemporaryDirectory dir;
  write_mesh(dir / "m.hdf", sample_mesh());
  write_patches(dir / "p.hdf", sample_patches());
  EXPECT_EQ(run_export({.artifact = dir / "m.hdf", .output = dir / "m.stl"}).code, ExitCode::kOk);
  EXPECT_EQ(read_bytes(dir / "m.stl").size(), 84u + 4 * 50);
  EXPECT_ERROR(run_export({.artifact = dir / "m.hdf", .output = dir / "m.xyz"}), kUsage, "unknown suffix");
  EXPECT_ERROR(run_export({.artifact = dir / "m.hdf", .output = dir / "none/m.stl"}), kOutput, "create it first");
  EXPECT_ERROR(run_export({.artifact = dir / "p.hdf", .output = dir / "p.stl"}), kInput,
               "is a patches artifact, which has no export");
  EXPECT_ERROR(run_export({.artifact = dir / "m.hdf", .output = dir / "m.stl", .quads = true}), kUsage,
               "triangles only");
  EXPECT_ERROR(run_export({.artifact = dir / "m.hdf", .output = dir / "m.sol"}), kUsage, "give --sizing");
  EXPECT_ERROR(run_export({.artifact = dir / "m.hdf", .output = dir / "m.stl", .sizing = dir / "s.hdf"}), kUsage,
               "for .sol only");
  EXPECT_ERROR(run_export({.artifact = dir / "p.hdf", .output = dir / "p.vtu", .quads = true}), kUsage,
               "--quads is for meshes");
  EXPECT_EQ(dir.files().size(), 3u);
}

}  // namespace
}  // namespace st
