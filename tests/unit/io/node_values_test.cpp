#include "io/hdf5/node_values.h"

#include <gtest/gtest.h>

#include "io/export/export.h"
#include "io/foreign/node_array.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

TEST(NodeValues, stand_in_the_mesh_and_readers_pass_over_them) {
  const TemporaryDirectory dir;
  const MeshArtifact mesh = sample_mesh();
  const std::size_t n = mesh.mesh.node_xyz.size();
  std::vector<double> p(n), u(3 * n);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] = p[i / 3] = 0.1 * static_cast<double>(i);
  write_mesh(dir / "without.hdf", mesh);
  write_mesh_with(dir / "with.hdf", mesh, std::vector<NodeValues>{{"p", 1, p}, {"u", 3, u}});
  const MeshArtifact back = read_mesh(dir / "with.hdf");
  EXPECT_EQ(back.mesh.node_size, mesh.mesh.node_size);
  EXPECT_NE(back.header.content_hash, read_mesh(dir / "without.hdf").header.content_hash);
  EXPECT_EQ(read_node_values(dir / "with.hdf", "p", n), p);
  EXPECT_EQ(read_node_values(dir / "with.hdf", "u", n), u);
  const std::vector<NodeValues> stored = read_stored_values(dir / "with.hdf");
  ASSERT_EQ(stored.size(), 2u);  // without those that all meshes have
  EXPECT_EQ(stored[0].name, "p");
  EXPECT_EQ(stored[0].values, p);
  EXPECT_EQ(stored[1].n_components, 3u);
  EXPECT_EQ(stored[1].values, u);
  EXPECT_TRUE(read_stored_values(dir / "without.hdf").empty());
}

TEST(NodeValues, of_nodes_on_sides_are_exported_as_the_mean_of_the_ends) {
  const TemporaryDirectory dir;
  const SurfaceMesh m = sample_mesh().mesh;
  MidNodes mid;
  mid.ends = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  mid.xyz.resize(6), mid.entity_dim.resize(6), mid.entity.resize(6);
  const std::vector<NodeValues> values{{"v", 2, {0, 10, 1, 20, 2, 40, 4, 80}}};
  export_mesh(dir / "m.vtu", {m, all_triangles(m), mid, {}, values}, {});
  const std::vector<double> back = read_node_values(dir / "m.vtu", "v", 10);
  EXPECT_EQ(std::vector<double>(back.begin() + 8, back.end()),
            (std::vector<double>{0.5, 15, 1, 25, 2, 45, 1.5, 30, 2.5, 50, 3, 60}));
}

TEST(NodeValues, have_names_that_meshes_do_not_have) {
  require_free_name("pressure");
  for (const char* name : {"size", "previous_id", "edge_group_table", ""})
    EXPECT_ERROR(require_free_name(name), kUsage, "array '");
}

}  // namespace
}  // namespace st
