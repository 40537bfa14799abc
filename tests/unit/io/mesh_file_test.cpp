#include "io/hdf5/mesh_file.h"

#include <gtest/gtest.h>

#include <set>

#include "unit/io/temporary_directory.h"
#include "unit/mesh/shapes.h"

namespace st {
namespace {

/// A cube of 6 x 16 x 16 x 2 triangles, whose first five nodes are on edges.
MeshArtifact cube_mesh() {
  MeshArtifact artifact;
  artifact.header.schema = "mesh";
  artifact.header.tool = "test";
  artifact.header.options_json = "{}";
  artifact.mesh = shapes::cube(16);
  for (int n = 0; n < 5; ++n) artifact.mesh.node_entity_dim[n] = 1;
  for (std::int64_t n = 0; n < artifact.mesh.n_nodes(); ++n) artifact.mesh.node_size[n] = 1 + 0.001 * n;
  return artifact;
}

constexpr std::array<std::int64_t, 3> kEntities{10, 10, 6};

class MeshRows : public testing::Test {
 protected:
  MeshRows() : whole(cube_mesh().mesh) { write_mesh(path, cube_mesh()); }
  const TemporaryDirectory dir;
  const std::string path = dir / "m.hdf";
  const SurfaceMesh whole;
};

TEST_F(MeshRows, of_a_share_are_its_triangles_and_all_that_touch_them) {
  const MeshFile file(path);
  const MeshSelection share = file.share(500, 900);
  ASSERT_EQ(share.end - share.begin, 400);
  EXPECT_EQ(share.triangle_number[share.begin], 500);
  std::set<NodeId> own;
  for (TriangleId t = 500; t < 900; ++t) own.insert(std::begin(whole.triangles[t].n), std::end(whole.triangles[t].n));
  std::vector<TriangleId> expected;
  for (TriangleId t = 0; t < whole.n_triangles(); ++t)
    if (std::ranges::any_of(whole.triangles[t].n, [&](NodeId n) { return own.contains(n); })) expected.push_back(t);
  EXPECT_EQ(share.triangle_number, expected);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(share.mesh.triangle_face[i], whole.triangle_face[expected[i]]);
    for (int k = 0; k < 3; ++k) {
      const NodeId n = share.mesh.triangles[i].n[k];
      EXPECT_EQ(share.node_number[n], whole.triangles[expected[i]].n[k]);
      EXPECT_EQ(share.mesh.node_xyz[n], whole.node_xyz[share.node_number[n]]);
      EXPECT_EQ(share.mesh.node_size[n], whole.node_size[share.node_number[n]]);
    }
  }
  for (NodeId n = 0; n < 5; ++n) EXPECT_EQ(share.node_number[n], n);  // all on edges
}

TEST_F(MeshRows, of_faces_come_alone) {
  MeshSelection sides;
  MeshFile(path).for_faces([](FaceId f) { return f == 2 || f == 4; }, [&](const MeshSelection& some) { sides = some; });
  EXPECT_EQ(sides.mesh.n_triangles(), 2 * 512);
  EXPECT_EQ(std::set<FaceId>(sides.mesh.triangle_face.begin(), sides.mesh.triangle_face.end()),
            (std::set<FaceId>{2, 4}));
  EXPECT_TRUE(sides.mesh.node_size.empty());
}

TEST_F(MeshRows, are_sound_in_every_part) {
  const MeshFile file(path);
  for (int part = 0; part < 3; ++part) EXPECT_TRUE(file.is_sound(part, 3, kEntities));
  EXPECT_FALSE(file.is_sound(0, 1, {10, 10, 0}));
}

TEST_F(MeshRows, are_not_sound_where_a_part_is_not) {
  const std::vector<std::function<void(SurfaceMesh&)>> breaks = {
      [](SurfaceMesh& m) { m.node_xyz.back().x = std::numeric_limits<double>::quiet_NaN(); },
      [](SurfaceMesh& m) { m.node_size.back() = -1; },
      [](SurfaceMesh& m) { m.node_entity_dim.back() = 0; },
      [](SurfaceMesh& m) { m.triangles.back().n[1] = static_cast<NodeId>(m.n_nodes()); },
      [](SurfaceMesh& m) { m.triangle_face.back() = 6; },
      [](SurfaceMesh& m) { m.triangle_group.back() = 1; }};
  for (const auto& break_it : breaks) {
    MeshArtifact broken = cube_mesh();
    break_it(broken.mesh);
    write_mesh(path, broken);
    const MeshFile file(path);
    EXPECT_FALSE(file.is_sound(0, 2, kEntities) && file.is_sound(1, 2, kEntities));
  }
}

}  // namespace
}  // namespace st
