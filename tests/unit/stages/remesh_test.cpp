// st-remesh after the chain: it redoes what the new sizes ask for and nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "base/log.h"
#include "io/foreign/node_array.h"
#include "io/hdf5/artifact.h"
#include "io/hdf5/node_values.h"
#include "io/hdf5/sizing_artifact.h"
#include "mesh/checks.h"
#include "mesh/pair_match.h"
#include "stages/import_stage.h"
#include "stages/merge_stage.h"
#include "stages/mesh_stage.h"
#include "stages/prolong_stage.h"
#include "stages/raster_stage.h"
#include "stages/remesh_stage.h"
#include "support/shapes.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

const Communicator& single_rank() {
  static const Communicator comm;
  return comm;
}

nlohmann::json facts(const std::string& json) { return nlohmann::json::parse(json); }

class Remesh : public testing::Test {
 protected:
  void SetUp() override { set_verbosity(Verbosity::kQuiet); }

  void import(const std::string& shape, const std::string& geometry) {
    test::write_step(shape, dir_ / (shape + ".step"), "MM");
    ImportStageOptions o;
    o.model = dir_ / (shape + ".step");
    o.output = dir_ / geometry;
    run_import(o);
  }
  void size(const std::string& geometry, const std::string& sizing, double alpha_deg, double scale = 1,
            const std::string& lmin = "") {
    RasterStageOptions r;
    r.geometry = dir_ / geometry;
    r.output = dir_ / "raster.hdf";
    r.lmax = std::string("4");
    r.lmin = lmin;
    r.alpha_deg = alpha_deg;
    run_raster(r, single_rank());
    ProlongStageOptions p;
    p.raster = r.output;
    p.output = dir_ / sizing;
    p.scale = scale;
    run_prolong(p);
  }
  void mesh(const std::string& geometry, const std::string& sizing, const std::string& output,
            const std::string& pairs = "") {
    MeshStageOptions m;
    m.pairs = pairs;
    m.geometry = dir_ / geometry;
    m.sizing = dir_ / sizing;
    m.output = dir_ / "patches.hdf";
    EXPECT_EQ(run_mesh(m, single_rank()).code, ExitCode::kOk);
    merge("patches.hdf", output);
  }
  MeshArtifact merge(const std::string& patches, const std::string& output) {
    MergeStageOptions o;
    o.patches = {dir_ / patches};
    o.output = dir_ / output;
    const StageSummary s = run_merge(o);
    EXPECT_EQ(facts(s.json).at("closed"), true);
    return read_mesh(o.output);
  }
  RemeshStageOptions options(const std::string& sizing) const {
    RemeshStageOptions o;
    o.mesh = dir_ / "mesh.hdf";
    o.geometry = dir_ / "geometry.hdf";
    o.sizing = dir_ / sizing;
    o.output = dir_ / "remeshed.hdf";
    return o;
  }
  /// A drilled block, meshed.
  void prepare() {
    import("drilled_block", "geometry.hdf");
    size("geometry.hdf", "sizing.hdf", 20);
    mesh("geometry.hdf", "sizing.hdf", "mesh.hdf");
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(dir_ / name); }

  TemporaryDirectory dir_;
};

/// Triangles of each face, by the coordinates of their corners, sorted.
std::map<FaceId, std::vector<std::array<double, 9>>> triangles_by_face(const SurfaceMesh& m) {
  std::map<FaceId, std::vector<std::array<double, 9>>> faces;
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    std::array<double, 9> x;
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = m.node_xyz[m.triangles[i].n[k]];
      x[3 * k] = p.x, x[3 * k + 1] = p.y, x[3 * k + 2] = p.z;
    }
    faces[m.triangle_face[i]].push_back(x);
  }
  for (auto& [face, triangles] : faces) std::sort(triangles.begin(), triangles.end());
  return faces;
}

TEST_F(Remesh, with_unchanged_sizes_redoes_nothing_and_gives_the_same_mesh) {
  prepare();
  RemeshStageOptions o = options("sizing.hdf");
  o.dry_run = true;
  EXPECT_EQ(facts(run_remesh(o, single_rank()).json).at("faces_redone"), 0);
  EXPECT_FALSE(exists("remeshed.hdf"));
  o.dry_run = false;
  EXPECT_EQ(run_remesh(o, single_rank()).code, ExitCode::kOk);
  EXPECT_EQ(facts(read_patches(o.output).header.options_json).at("faces_redone"), 0);
  const SurfaceMesh before = read_mesh(o.mesh).mesh, after = merge("remeshed.hdf", "again.hdf").mesh;
  EXPECT_EQ(after.n_nodes(), before.n_nodes());
  EXPECT_TRUE(triangles_by_face(after) == triangles_by_face(before));
}

TEST_F(Remesh, with_smaller_sizes_at_the_hole_redoes_only_what_they_reach) {
  prepare();
  size("geometry.hdf", "finer.hdf", 6);
  RemeshStageOptions o = options("finer.hdf");
  EXPECT_EQ(run_remesh(o, single_rank()).code, ExitCode::kOk);
  const auto before = triangles_by_face(read_mesh(o.mesh).mesh),
             after = triangles_by_face(merge("remeshed.hdf", "finer_mesh.hdf").mesh);
  ASSERT_EQ(before.size(), 7u);
  ASSERT_EQ(after.size(), 7u);
  int n_mostly_kept = 0, n_finer = 0;
  for (const auto& [face, triangles] : before) {
    auto common = triangles;
    common.erase(std::set_intersection(triangles.begin(), triangles.end(), after.at(face).begin(), after.at(face).end(),
                                       common.begin()),
                 common.end());
    n_mostly_kept += 2 * common.size() > triangles.size();
    n_finer += after.at(face).size() > 2 * triangles.size();
  }
  EXPECT_EQ(n_mostly_kept, 4) << "the four sides, but for triangles beside what changed";
  EXPECT_EQ(n_finer, 3) << "the hole, top and bottom";
}

TEST_F(Remesh, with_smaller_sizes_everywhere_has_as_many_triangles_as_a_new_mesh) {
  prepare();
  size("geometry.hdf", "finer.hdf", 20, 0.5);
  EXPECT_EQ(run_remesh(options("finer.hdf"), single_rank()).code, ExitCode::kOk);
  const double redone = static_cast<double>(merge("remeshed.hdf", "redone.hdf").mesh.n_triangles());
  mesh("geometry.hdf", "finer.hdf", "fresh.hdf");
  EXPECT_NEAR(redone / static_cast<double>(read_mesh(dir_ / "fresh.hdf").mesh.n_triangles()), 1, 0.1);
}

TEST_F(Remesh, with_larger_sizes_makes_fewer_triangles) {
  prepare();
  size("geometry.hdf", "coarser.hdf", 20, 2.5);
  EXPECT_EQ(run_remesh(options("coarser.hdf"), single_rank()).code, ExitCode::kOk);
  EXPECT_LT(merge("remeshed.hdf", "coarser_mesh.hdf").mesh.n_triangles(),
            read_mesh(dir_ / "mesh.hdf").mesh.n_triangles() / 3);
}

TEST_F(Remesh, refuses_sizes_and_meshes_of_another_geometry) {
  prepare();
  import("box", "box.hdf");
  size("box.hdf", "box_sizing.hdf", 20);
  EXPECT_ERROR(run_remesh(options("box_sizing.hdf"), single_rank()), kMismatch, "box_sizing.hdf");
  MeshStageOptions m;
  m.geometry = dir_ / "geometry.hdf";
  m.sizing = dir_ / "box_sizing.hdf";
  m.output = dir_ / "wrong.hdf";
  EXPECT_ERROR(run_mesh(m, single_rank()), kMismatch, "box_sizing.hdf");
  RemeshStageOptions o = options("box_sizing.hdf");
  o.geometry = dir_ / "box.hdf";
  EXPECT_ERROR(run_remesh(o, single_rank()), kMismatch, "mesh.hdf");
  EXPECT_FALSE(exists("remeshed.hdf"));
  EXPECT_FALSE(exists("wrong.hdf"));
}

TEST_F(Remesh, refuses_limits_that_make_no_sense) {
  RemeshStageOptions o = options("sizing.hdf");
  o.too_long = 1;
  EXPECT_ERROR(run_remesh(o, single_rank()), kUsage, "--too-long");
  o = options("sizing.hdf");
  for (double bad : {0.0, 1.0, -0.5}) {
    o.too_short = bad;
    EXPECT_ERROR(run_remesh(o, single_rank()), kUsage, "--too-short");
  }
}

TEST_F(Remesh, limits_decide_what_is_redone) {
  prepare();
  size("geometry.hdf", "finer.hdf", 20, 0.8);
  RemeshStageOptions o = options("finer.hdf");
  o.dry_run = true;
  o.too_long = 10;
  o.too_short = 0.1;
  EXPECT_EQ(facts(run_remesh(o, single_rank()).json).at("faces_redone"), 0);
  o.too_long = 1.05;
  EXPECT_EQ(facts(run_remesh(o, single_rank()).json).at("faces_redone"), 7);
}

/// Old nodes inside a face that bound the holes of a remeshing: of triangles that stay and of such that go. `rest`:
/// those of triangles that stay only.
std::vector<NodeId> nodes_around_holes(const SurfaceMesh& old, const SurfaceMesh& remeshed, std::vector<NodeId>& rest) {
  std::vector<char> stays(old.triangles.size(), 0), at_kept(old.node_xyz.size(), 0), at_gone(old.node_xyz.size(), 0);
  for (TriangleId t : remeshed.triangle_previous)
    if (t != kNone) stays[t] = 1;
  for (std::size_t i = 0; i < old.triangles.size(); ++i)
    for (NodeId n : old.triangles[i].n) (stays[i] ? at_kept : at_gone)[n] = 1;
  std::vector<NodeId> around;
  for (std::size_t n = 0; n < at_kept.size(); ++n)
    if (at_kept[n] && old.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kFace))
      (at_gone[n] ? around : rest).push_back(static_cast<NodeId>(n));
  return around;
}

TEST_F(Remesh, grows_a_hole_that_cannot_be_filled) {
  prepare();
  size("geometry.hdf", "finer.hdf", 6);
  RemeshStageOptions o = options("finer.hdf");
  o.merged = dir_ / "merged.hdf";
  EXPECT_EQ(facts(run_remesh(o, single_rank()).json).at("holes_grown"), 0);
  MeshArtifact old = read_mesh(o.mesh);
  std::vector<NodeId> rest;
  const std::vector<NodeId> around = nodes_around_holes(old.mesh, read_mesh(o.merged).mesh, rest);
  ASSERT_FALSE(around.empty());
  ASSERT_FALSE(rest.empty());
  for (std::size_t c = 0; c < old.mesh.corner_uv.size(); ++c)  // the loop around the hole crosses itself
    if (old.mesh.triangles[c / 3].n[c % 3] == around[0])
      old.mesh.corner_uv[c] = old.mesh.corner_uv[c] + 1.5 * (old.mesh.corner_uv[c] - Vec2{30, 20});
  write_mesh(o.mesh, old);
  const StageSummary s = run_remesh(o, single_rank());
  EXPECT_GT(facts(s.json).at("holes_grown"), 0);
  const MeshArtifact after = read_mesh(o.merged);
  EXPECT_TRUE(check_topology(after.mesh, edges_of(after.mesh)).passes());
  EXPECT_TRUE(check_shape(after.mesh, edges_of(after.mesh)).passes());
  EXPECT_TRUE(check_crossings(after.mesh).passes());
}

TEST_F(Remesh, redoes_old_triangles_that_new_ones_cross) {
  prepare();
  size("geometry.hdf", "finer.hdf", 6);
  RemeshStageOptions o = options("finer.hdf");
  o.merged = dir_ / "merged.hdf";
  run_remesh(o, single_rank());
  MeshArtifact old = read_mesh(o.mesh);
  std::vector<NodeId> rest;
  nodes_around_holes(old.mesh, read_mesh(o.merged).mesh, rest);
  old.mesh.node_xyz[rest[0]] = {30, 25, 21};  // through the new triangles of the top
  old.mesh.node_size[rest[0]] = map_sizing(o.sizing).field->size(old.mesh.node_xyz[rest[0]]);  // no reason to redo it
  write_mesh(o.mesh, old);
  const StageSummary s = run_remesh(o, single_rank());
  EXPECT_EQ(facts(s.json).at("crossing_pairs"), 0) << s.json;
  EXPECT_GT(facts(s.json).at("refinements"), 0) << s.json;
  const MeshArtifact after = read_mesh(o.merged);
  EXPECT_TRUE(check_topology(after.mesh, edges_of(after.mesh)).passes());
  EXPECT_TRUE(check_crossings(after.mesh).passes());
}

TEST_F(Remesh, writes_the_merged_mesh_that_st_merge_would) {
  prepare();
  size("geometry.hdf", "finer.hdf", 6);
  RemeshStageOptions o = options("finer.hdf");
  run_remesh(o, single_rank());
  const MeshArtifact expected = merge("remeshed.hdf", "by_merge.hdf");
  o.merged = dir_ / "merged.hdf";
  run_remesh(o, single_rank());
  const MeshArtifact merged = read_mesh(o.merged);
  EXPECT_EQ(merged.header.content_hash, expected.header.content_hash);
  EXPECT_EQ(merged.mesh.node_previous, expected.mesh.node_previous);
  EXPECT_EQ(merged.mesh.triangle_previous, expected.mesh.triangle_previous);
  const SurfaceMesh old = read_mesh(o.mesh).mesh;
  for (std::size_t i = 0; i < merged.mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if (const TriangleId t = merged.mesh.triangle_previous[i]; t != kNone) {
        EXPECT_TRUE(merged.mesh.node_xyz[merged.mesh.triangles[i].n[k]] == old.node_xyz[old.triangles[t].n[k]])
            << "triangle " << t;
      }
}

TEST_F(Remesh, carries_values_to_the_new_nodes) {
  prepare();
  size("geometry.hdf", "finer.hdf", 6);
  const auto field = [](Vec3 x) { return 3 * x.x - 2 * x.y + 0.5 * x.z; };
  const MeshArtifact old = read_mesh(dir_ / "mesh.hdf");
  NodeValues p{"p", 1, {}}, c{"c", 1, std::vector<double>(old.mesh.node_xyz.size(), 7)};
  for (const Vec3 x : old.mesh.node_xyz) p.values.push_back(field(x));
  write_mesh_with(dir_ / "values.hdf", old, std::vector<NodeValues>{p, c});
  RemeshStageOptions o = options("finer.hdf");
  o.merged = dir_ / "merged.hdf";
  o.interpolate = dir_ / "values.hdf:p,c";
  EXPECT_EQ(run_remesh(o, single_rank()).code, ExitCode::kOk);
  const SurfaceMesh now = read_mesh(o.merged).mesh;
  const std::vector<double> got = read_node_values(o.merged, "p", now.node_xyz.size());
  int n_new = 0;
  for (std::size_t n = 0; n < got.size(); ++n) {
    const bool is_new = now.node_previous[n] == kNone;
    n_new += is_new;
    if (!is_new) {
      EXPECT_EQ(got[n], p.values[now.node_previous[n]]);
    }
    EXPECT_NEAR(got[n], field(now.node_xyz[n]), 0.5) << "linear in triangles; chords of the hole leave it";
  }
  EXPECT_GT(n_new, 100);
  for (const double v : read_node_values(o.merged, "c", now.node_xyz.size())) EXPECT_NEAR(v, 7, 1e-14);
}

TEST_F(Remesh, refuses_a_mesh_with_a_hole_on_no_face_and_says_where) {
  prepare();
  MeshArtifact broken = read_mesh(dir_ / "mesh.hdf");
  SurfaceMesh& m = broken.mesh;
  const std::size_t t = m.triangles.size() / 2;
  m.triangles.erase(m.triangles.begin() + t);
  m.triangle_face.erase(m.triangle_face.begin() + t);
  m.triangle_group.erase(m.triangle_group.begin() + t);
  m.corner_uv.erase(m.corner_uv.begin() + 3 * t, m.corner_uv.begin() + 3 * t + 3);
  write_mesh(dir_ / "broken.hdf", broken);
  RemeshStageOptions o = options("sizing.hdf");
  o.mesh = dir_ / "broken.hdf";
  try {
    run_remesh(o, single_rank());
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kInput);
    EXPECT_NE(std::string(e.what()).find("3 sides of triangles have no neighbour"), std::string::npos) << e.what();
  }
  EXPECT_FALSE(exists("remeshed.hdf"));
}

/// Its points' x stretched by `factor`.
void stretch_step(const std::string& from, const std::string& to, double factor) {
  std::ifstream in(from);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::regex point(R"((CARTESIAN_POINT\s*\('',\()([^,()]+)(,[^,()]+,[^,()]+\)))");
  std::ofstream out(to);
  std::size_t end = 0;
  for (std::sregex_iterator m(text.begin(), text.end(), point), last; m != last; ++m) {
    out << text.substr(end, m->position() - end) << (*m)[1] << std::to_string(factor * std::stod((*m)[2])) << (*m)[3];
    end = m->position() + m->length();
  }
  out << text.substr(end);
}

TEST_F(Remesh, of_periodic_faces_keeps_the_pairs_that_still_are_images) {
  import("box", "geometry.hdf");
  size("geometry.hdf", "sizing.hdf", 20);
  mesh("geometry.hdf", "sizing.hdf", "mesh.hdf", "auto");
  ASSERT_EQ(read_mesh(dir_ / "mesh.hdf").mesh.merged.pairs.size(), 3u);
  stretch_step(dir_ / "box.step", dir_ / "moved.step", 1.05);
  ImportStageOptions i;
  i.model = dir_ / "moved.step";
  i.output = dir_ / "moved.hdf";
  run_import(i);
  size("moved.hdf", "moved_sizing.hdf", 20);
  RemeshStageOptions o = options("moved_sizing.hdf");
  o.geometry = i.output;
  o.moved = true;
  EXPECT_EQ(run_remesh(o, single_rank()).code, ExitCode::kOk);
  const SurfaceMesh after = merge("remeshed.hdf", "after.hdf").mesh;
  EXPECT_EQ(after.merged.pairs.size(), 2u) << "63 apart along x instead of 60";
  for (const FacePair& p : after.merged.pairs) EXPECT_TRUE(match_pair(after, p, pair_tolerance(after)).alone.empty());
}

TEST_F(Remesh, of_a_mesh_with_closed_strips_follows_a_moved_geometry) {
  import("stepped_box", "geometry.hdf");
  size("geometry.hdf", "sizing.hdf", 20, 0.25, "4");
  mesh("geometry.hdf", "sizing.hdf", "mesh.hdf");
  ASSERT_FALSE(read_mesh(dir_ / "mesh.hdf").mesh.merged.strip_face.empty());
  for (const double factor : {1.05, 1.6}) {
    stretch_step(dir_ / "stepped_box.step", dir_ / "moved.step", factor);
    ImportStageOptions i;
    i.model = dir_ / "moved.step";
    i.output = dir_ / "moved.hdf";
    run_import(i);
    for (const double scale : {0.25, 0.12}) {
      size("moved.hdf", "moved_sizing.hdf", 20, scale, "4");
      RemeshStageOptions o = options("moved_sizing.hdf");
      o.geometry = i.output;
      o.moved = true;
      EXPECT_EQ(run_remesh(o, single_rank()).code, ExitCode::kOk);
      const SurfaceMesh after = merge("remeshed.hdf", "after.hdf").mesh;
      EXPECT_TRUE(check_topology(after, edges_of(after)).passes());
      EXPECT_TRUE(check_crossings(after).passes());
      EXPECT_NEAR(measure_mesh(after).volume, 501 * factor, 3);
    }
  }
}

}  // namespace
}  // namespace st
