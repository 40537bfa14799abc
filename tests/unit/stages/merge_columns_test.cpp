// st-merge writes what merge_patches() makes, though it never has all of it.
#include "stages/merge_columns.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>

#include "mesh/edge_segments.h"
#include "stages/merge_stage.h"
#include "unit/mesh/cube_patches.h"

namespace st {
namespace {

namespace fs = std::filesystem;

class MergeColumns : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "st_merge_columns_XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  static PatchesArtifact artifact(const shapes::CubePatches& cube) {
    PatchesArtifact a;
    a.header.tool = "test";
    a.edges = cube.edges;
    a.vertex_xyz = cube.vertices;
    a.edge_vertices = cube.edge_vertices;
    a.patches = cube.patches;
    a.labels.face_name = {"left", "right", "front", "", "bottom", "top"};
    a.labels.group_name = {"a", "b", "c"};
    a.labels.face_group = cube.groups;
    a.labels.part_name = {"p", "q"};
    a.labels.part_path = {"p#1", "q#1"};
    a.labels.face_part = {0, 1, -1, 0, 0, 1};
    a.labels.edge_groups = {{"te", "", "{}", {1, 3}}};
    a.labels.vertex_groups = {{"tip", "", "{}", {1}}};
    a.face_shell.assign(6, 0);
    a.face_area.assign(6, 1);
    return a;
  }

  /// The content hash of both ways of merging.
  void expect_same(const PatchesArtifact& a) const {
    write_patches(path("p.hdf"), a);
    MergeStageOptions o;
    o.patches = {path("p.hdf")};
    o.output = path("m.hdf");
    o.allow_incomplete = true;
    run_merge(o);
    MeshArtifact whole;
    OrientationReport report;
    whole.mesh = merge_patches({a.edges, a.vertex_xyz, a.edge_vertices, a.patches, a.labels.face_group}, report);
    whole.mesh.labels = read_patches(path("p.hdf")).labels;
    whole.is_complete = a.is_complete;
    add_segments(whole.mesh, a.edges, a.edge_vertices);
    EXPECT_EQ(read_header(o.output).content_hash, write_mesh(path("whole.hdf"), whole));
    const SurfaceMesh read = read_mesh(o.output).mesh;
    EXPECT_EQ(read.node_previous, whole.mesh.node_previous);
    EXPECT_EQ(read.triangle_previous, whole.mesh.triangle_previous);
  }

  fs::path folder_;
};

TEST_F(MergeColumns, are_those_of_the_whole_mesh) { expect_same(artifact({})); }

TEST_F(MergeColumns, of_faces_that_are_turned_and_of_parts) {
  shapes::CubePatches c;
  c.turn(4);
  c.patches.erase(c.patches.begin() + 1);
  PatchesArtifact a = artifact(c);
  a.is_complete = false;
  expect_same(a);
}

TEST_F(MergeColumns, with_numbers_of_the_mesh_before) {
  shapes::CubePatches c;
  for (std::size_t i = 0; i < c.edges.node_t.size(); ++i)
    c.edges.node_previous.push_back(static_cast<NodeId>(i % 5) - 1);
  for (FacePatch& p : c.patches) {
    p.inner_previous = {70 + p.face, 80};
    for (std::size_t t = 0; t < p.triangles.size(); ++t)
      p.triangle_previous.push_back(8 * p.face + static_cast<int>(t));
  }
  expect_same(artifact(c));
}

}  // namespace
}  // namespace st
