// Shares of a mesh on several ranks: together they are the whole, and mark what one rank marks.
#include <gtest/gtest.h>

#include <barrier>
#include <thread>

#include "base/log.h"
#include "io/hdf5/artifact.h"
#include "io/hdf5/mesh_part.h"
#include "io/hdf5/sizing_artifact.h"
#include "meshing/hole/hole_marks.h"
#include "stages/import_stage.h"
#include "stages/merge_stage.h"
#include "stages/mesh_stage.h"
#include "stages/prolong_stage.h"
#include "stages/raster_stage.h"
#include "support/shapes.h"
#include "unit/io/temporary_directory.h"
#include "unit/meshing/mark_holes.h"

namespace st {
namespace {

/// A meshed sphere: one face, or two, with a seam and poles, so that every share is a part of a face.
class MeshShares : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    set_verbosity(Verbosity::kQuiet);
    static const Communicator comm;
    dir_ = new TemporaryDirectory;
    const auto path = [](const char* name) { return *dir_ / name; };
    test::write_step("sphere", path("sphere.step"), "MM");
    ImportStageOptions i;
    i.model = path("sphere.step");
    i.output = path("geometry.hdf");
    run_import(i);
    RasterStageOptions r;
    r.geometry = i.output;
    r.output = path("raster.hdf");
    r.lmax = "4%";
    run_raster(r, comm);
    ProlongStageOptions p;
    p.raster = r.output;
    p.output = path("sizing.hdf");
    run_prolong(p);
    MeshStageOptions m;
    m.geometry = i.output;
    m.sizing = p.output;
    m.output = path("patches.hdf");
    run_mesh(m, comm);
    MergeStageOptions merge;
    merge.patches = {m.output};
    merge.output = path("mesh.hdf");
    run_merge(merge);
  }
  static void TearDownTestSuite() {
    delete dir_;
    dir_ = nullptr;
  }
  static std::string mesh_path() { return *dir_ / "mesh.hdf"; }
  static ModelTables tables() { return read_geometry(*dir_ / "geometry.hdf").tables; }

  static TemporaryDirectory* dir_;
};
TemporaryDirectory* MeshShares::dir_ = nullptr;

/// Half the length near one end: about a third of the mesh is marked.
std::vector<double> finer_at_one_end(const SurfaceMesh& m) {
  double least = 1e300, most = -1e300;
  for (const Vec3 x : m.node_xyz) {
    if (x.x < least) least = x.x;
    if (x.x > most) most = x.x;
  }
  std::vector<double> wanted = m.node_size;
  for (std::size_t n = 0; n < wanted.size(); ++n)
    if (m.node_xyz[n].x < least + 0.3 * (most - least)) wanted[n] *= 0.5;
  return wanted;
}

/// As finer_at_one_end() of the whole mesh.
std::vector<double> share_of_lengths(const std::vector<double>& whole, const MeshPart& part) {
  std::vector<double> wanted;
  for (const NodeId n : part.node_number) wanted.push_back(whole[n]);
  return wanted;
}

TEST_F(MeshShares, are_together_the_whole_mesh) {
  const SurfaceMesh whole = read_mesh(mesh_path()).mesh;
  for (const int n_parts : {1, 2, 3, 5, 40}) {
    TriangleId next = 0;
    for (int k = 0; k < n_parts; ++k) {
      const MeshPart part = read_mesh_part(mesh_path(), k, n_parts);
      const SurfaceMesh& m = part.artifact.mesh;
      EXPECT_EQ(part.first_triangle, next);
      for (std::size_t i = 0; i < m.triangles.size(); ++i, ++next) {
        EXPECT_EQ(m.triangle_face[i], whole.triangle_face[next]);
        for (int c = 0; c < 3; ++c) {
          const NodeId n = m.triangles[i].n[c], in_whole = part.node_number[n];
          ASSERT_EQ(in_whole, whole.triangles[next].n[c]);
          EXPECT_TRUE(m.node_xyz[n] == whole.node_xyz[in_whole]);
          EXPECT_EQ(m.node_size[n], whole.node_size[in_whole]);
          EXPECT_EQ(m.node_entity[n], whole.node_entity[in_whole]);
        }
      }
    }
    EXPECT_EQ(next, whole.n_triangles());
  }
}

TEST_F(MeshShares, hold_a_part_of_the_nodes_only) {
  const SurfaceMesh whole = read_mesh(mesh_path()).mesh;
  std::int64_t n = 0;
  for (int k = 0; k < 3; ++k) n += read_mesh_part(mesh_path(), k, 3).artifact.mesh.n_nodes();
  EXPECT_LT(4 * n, 9 * whole.n_nodes()) << "three parts with a few rings around each of a small mesh";
}

TEST_F(MeshShares, mark_what_one_rank_marks) {
  const SurfaceMesh whole = read_mesh(mesh_path()).mesh;
  const ModelTables t = tables();
  const HoleMesh holes(whole, t);
  const std::vector<double> wanted = finer_at_one_end(whole);
  HoleMarkOptions options;
  options.redo = {0, static_cast<TriangleId>(whole.triangles.size()) - 1,
                  static_cast<TriangleId>(whole.triangles.size()) / 2};
  const HoleMarks expected = test::mark_holes(holes, wanted, options);
  ASSERT_GT(expected.n_triangles(), whole.n_triangles() / 10);
  ASSERT_LT(expected.n_triangles(), whole.n_triangles() * 9 / 10);
  for (const int n_parts : {2, 3, 5, 40}) {
    std::vector<MeshPart> parts;  // read before: HDF5 is for one thread
    for (int k = 0; k < n_parts; ++k) parts.push_back(read_mesh_part(mesh_path(), k, n_parts));
    std::vector<std::vector<TouchedNode>> touched(n_parts);
    std::vector<char> marks(whole.triangles.size(), 0);
    std::barrier all(n_parts);
    const auto work = [&](int k) {
      const MeshPart& part = parts[k];
      const HoleMesh own(part.artifact.mesh, t);
      const MeshShare share{0, static_cast<TriangleId>(part.artifact.mesh.triangles.size()), part.first_triangle,
                            part.node_number};
      const HoleMarks m = mark_share(own, share, share_of_lengths(wanted, part), options, [&](const auto& mine) {
        touched[k] = mine;
        all.arrive_and_wait();
        std::vector<TouchedNode> together;
        for (const auto& some : touched) together.insert(together.end(), some.begin(), some.end());
        all.arrive_and_wait();
        return together;
      });
      std::copy(m.triangle.begin(), m.triangle.end(), marks.begin() + part.first_triangle);
      EXPECT_TRUE(m.segment == expected.segment);
    };
    std::vector<std::thread> ranks;
    for (int k = 0; k < n_parts; ++k) ranks.emplace_back(work, k);
    for (std::thread& rank : ranks) rank.join();
    EXPECT_TRUE(marks == expected.triangle) << n_parts << " parts";
  }
}

}  // namespace
}  // namespace st
