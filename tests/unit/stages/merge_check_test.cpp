// st-merge and st-check on patches made by hand: what they accept, what they refuse, what they report.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

#include "io/hdf5/artifact.h"
#include "stages/check_stage.h"
#include "stages/merge_stage.h"
#include "unit/mesh/cube_patches.h"

namespace st {
namespace {

namespace fs = std::filesystem;

class MergeCheck : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "st_merge_check_XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  static PatchesArtifact artifact(const shapes::CubePatches& cube) {
    PatchesArtifact a;
    a.header.schema = "patches";
    a.header.tool = "test";
    a.header.options_json = "{}";
    a.header.geometry_hash = "0123456789abcdef0123456789abcdef";
    a.edges = cube.edges;
    a.vertex_xyz = cube.vertices;
    a.edge_vertices = cube.edge_vertices;
    a.patches = cube.patches;
    a.labels.face_name = {"left", "right", "front", "", "bottom", "top"};
    a.labels.group_name = {"a", "b", "c"};
    a.labels.face_group = cube.groups;
    a.face_shell.assign(6, 0);
    a.face_area.assign(6, 1);
    return a;
  }
  std::string write(const std::string& name, const PatchesArtifact& a) const {
    write_patches(path(name), a);
    return path(name);
  }
  /// Keeps the patches of some faces.
  static PatchesArtifact part(std::vector<FaceId> faces) {
    PatchesArtifact a = artifact({});
    std::erase_if(a.patches,
                  [&](const FacePatch& p) { return std::find(faces.begin(), faces.end(), p.face) == faces.end(); });
    a.is_complete = false;
    a.failures.push_back({5, "its loop crosses itself", "", {}});
    return a;
  }
  MergeStageOptions options(std::vector<std::string> patches) const {
    MergeStageOptions o;
    o.patches = std::move(patches);
    o.output = path("mesh.hdf");
    return o;
  }
  ExitCode code_of(const std::function<void()>& action, const std::string& says) const {
    try {
      action();
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
      return e.code();
    }
    return ExitCode::kOk;
  }
  StageSummary check() const { return run_check({path("mesh.hdf"), "", "", 0.01, {}, {}}); }

  fs::path folder_;
};

TEST_F(MergeCheck, makes_a_mesh_that_passes) {
  const StageSummary merged = run_merge(options({write("p.hdf", artifact({}))}));
  EXPECT_EQ(merged.code, ExitCode::kOk);
  const auto facts = nlohmann::json::parse(merged.json);
  EXPECT_EQ(facts.at("triangles"), 48);
  EXPECT_EQ(facts.at("nodes"), 26);
  EXPECT_EQ(facts.at("closed"), true);
  for (const char* defect : {"boundary_edges", "nonmanifold_edges", "misoriented_edges"})
    EXPECT_EQ(facts.at(defect), 0) << defect;
  EXPECT_NEAR(facts.at("volume").get<double>(), 1, 1e-12);
  EXPECT_NEAR(facts.at("area").get<double>(), 6, 1e-12);
  const MeshArtifact mesh = read_mesh(path("mesh.hdf"));
  EXPECT_EQ(mesh.mesh.n_triangles(), 48);
  EXPECT_EQ(mesh.mesh.labels.face_name[1], "right");
  EXPECT_TRUE(mesh.is_complete);
  ASSERT_EQ(mesh.header.inputs.size(), 1u);
  EXPECT_EQ(mesh.header.inputs[0].role, "patches");
  EXPECT_EQ(mesh.header.geometry_hash, "0123456789abcdef0123456789abcdef");
  const StageSummary checked = check();
  EXPECT_EQ(checked.code, ExitCode::kOk) << checked.line;
  EXPECT_EQ(nlohmann::json::parse(checked.json).at("passes"), true);
}

TEST_F(MergeCheck, gives_the_same_bytes_whatever_the_order_of_patches) {
  PatchesArtifact a = artifact({});
  const PatchesArtifact b = a;
  std::reverse(a.patches.begin(), a.patches.end());
  MergeStageOptions o = options({write("p.hdf", a)});
  run_merge(o);
  const std::string first = read_mesh(o.output).header.content_hash;
  write("p.hdf", b);
  run_merge(o);
  EXPECT_EQ(read_mesh(o.output).header.content_hash, first);
}

TEST_F(MergeCheck, refuses_incomplete_patches_unless_allowed_and_flags_the_mesh) {
  MergeStageOptions o = options({write("p.hdf", part({0, 1, 2, 3, 4}))});
  EXPECT_EQ(code_of([&] { run_merge(o); }, "crosses itself"), ExitCode::kIncomplete);
  EXPECT_FALSE(fs::exists(o.output));
  o.allow_incomplete = true;
  EXPECT_NE(run_merge(o).line.find("INCOMPLETE"), std::string::npos);
  EXPECT_FALSE(read_mesh(o.output).is_complete);
  const StageSummary checked = check();
  EXPECT_EQ(checked.code, ExitCode::kIncomplete);
  EXPECT_EQ(nlohmann::json::parse(checked.json).at("failed"), nlohmann::json({"complete", "closed"}));
}

TEST_F(MergeCheck, joins_parts_that_were_meshed_apart) {
  const MergeStageOptions whole = options({write("p.hdf", artifact({}))});
  run_merge(whole);
  const std::string expected = read_mesh(whole.output).header.content_hash;
  const MergeStageOptions parts = options({write("a.hdf", part({0, 4, 5})), write("b.hdf", part({1, 2, 3}))});
  run_merge(parts);
  const MeshArtifact joined = read_mesh(parts.output);
  EXPECT_EQ(joined.header.content_hash, expected);
  EXPECT_EQ(joined.header.inputs.size(), 2u);
}

TEST_F(MergeCheck, refuses_parts_that_do_not_belong_together) {
  PatchesArtifact other = part({1, 2, 3});
  other.header.geometry_hash = "fedcba9876543210fedcba9876543210";
  const std::string a = write("a.hdf", part({0, 4, 5}));
  EXPECT_EQ(code_of([&] { run_merge(options({a, write("b.hdf", other)})); }, "b.hdf"), ExitCode::kMismatch);
  PatchesArtifact moved = part({1, 2, 3});
  moved.edges.node_xyz[4].x += 1e-9;
  EXPECT_EQ(code_of([&] { run_merge(options({a, write("b.hdf", moved)})); }, "edge 2"), ExitCode::kMismatch);
  EXPECT_EQ(code_of([&] { run_merge(options({a, write("b.hdf", part({3, 4}))})); }, "face 5"), ExitCode::kMismatch);
  EXPECT_FALSE(fs::exists(path("mesh.hdf")));
}

TEST_F(MergeCheck, says_which_check_failed_how_often_and_where) {
  PatchesArtifact a = artifact({});
  std::vector<Triangle> triangles = a.patches[1].triangles;
  triangles.pop_back();
  shapes::set_triangles(a.patches[1], triangles);
  run_merge(options({write("p.hdf", a)}));
  const StageSummary checked = check();
  EXPECT_EQ(checked.code, ExitCode::kIncomplete);
  const std::string verdict = checked.line.substr(checked.line.rfind('\n') + 1);
  EXPECT_NE(verdict.find("FAILS: 3 open edges, first at (1 "), std::string::npos) << verdict;
  EXPECT_NE(verdict.find("face 3 \"front\""), std::string::npos) << verdict;
}

TEST_F(MergeCheck, exports_beside_the_mesh_and_refuses_unknown_suffixes_before_the_work) {
  MergeStageOptions o = options({write("p.hdf", artifact({}))});
  o.exports = {path("m.stl"), path("m.xyz")};
  EXPECT_EQ(code_of([&] { run_merge(o); }, ".xyz"), ExitCode::kUsage);
  EXPECT_FALSE(fs::exists(o.output) || fs::exists(path("m.stl")));
  o.exports = {path("m.stl")};
  run_merge(o);
  EXPECT_EQ(fs::file_size(path("m.stl")), 84u + 50u * 48u);
}

TEST_F(MergeCheck, of_nothing_is_an_error) {
  EXPECT_EQ(code_of([&] { run_merge(options({})); }, "no patches"), ExitCode::kUsage);
}

}  // namespace
}  // namespace st
