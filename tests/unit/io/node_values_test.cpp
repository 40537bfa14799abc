#include "io/hdf5/node_values.h"

#include <gtest/gtest.h>

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
}

TEST(NodeValues, have_names_that_meshes_do_not_have) {
  require_free_name("pressure");
  for (const char* name : {"size", "previous_id", "edge_group_table", ""})
    EXPECT_ERROR(require_free_name(name), kUsage, "array '");
}

}  // namespace
}  // namespace st
