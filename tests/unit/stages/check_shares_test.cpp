#include "stages/check_shares.h"

#include <gtest/gtest.h>

#include "unit/stages/shared_cube.h"

namespace st {
namespace {

TEST(CheckShares, leave_small_meshes_to_one_process) {
  const test::SharedCube cube;
  EXPECT_FALSE(is_worth_sharing(cube.options, SerialExecutor()));
  EXPECT_FALSE(cube.measure(kTrianglesPerShare));
}

TEST(CheckShares, leave_meshes_whose_triangles_do_not_come_face_by_face) {
  const test::SharedCube cube([](SurfaceMesh& m) { std::swap(m.triangle_face.front(), m.triangle_face.back()); });
  EXPECT_FALSE(cube.measure(kTrianglesPerPiece));
}

TEST(CheckShares, say_what_a_mesh_in_memory_says) {
  for (const std::int64_t per_share : {40'000, 16'384}) {
    const test::SharedCube cube;
    EXPECT_EQ(cube.report_of_shares(per_share), cube.report());
  }
}

TEST(CheckShares, find_nodes_at_one_place_in_different_shares) {
  const test::SharedCube cube([](SurfaceMesh& m) { m.node_xyz[900] = Vec3(m.node_xyz[30'000]); });
  ASSERT_EQ(cube.measure(kTrianglesPerPiece)->parts.shape.duplicate_nodes.count, 1);
  EXPECT_EQ(cube.report_of_shares(kTrianglesPerPiece), cube.report());
}

TEST(CheckShares, find_a_body_of_its_own_and_a_common_node) {
  const test::SharedCube cube([](SurfaceMesh& m) {
    m.triangles[70'000].n[0] = m.triangles[100].n[0];
    const auto n = static_cast<NodeId>(m.n_nodes());
    for (int k = 0; k < 3; ++k) {
      m.node_xyz.push_back({5.0 + k, k == 2 ? 1.0 : 0.0, 5});
      m.node_entity_dim.push_back(2), m.node_entity.push_back(0), m.node_t.push_back(0), m.node_size.push_back(1);
    }
    m.triangles[50'000] = {{n, n + 1, n + 2}};
  });
  EXPECT_EQ(cube.measure(kTrianglesPerPiece)->parts.topology.n_components, 2);
  EXPECT_EQ(cube.report_of_shares(kTrianglesPerPiece), cube.report());
}

}  // namespace
}  // namespace st
