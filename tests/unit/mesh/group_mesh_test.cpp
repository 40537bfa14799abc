#include "mesh/group_mesh.h"

#include <gtest/gtest.h>

#include "unit/io/sample_artifacts.h"

namespace st {
namespace {

std::string group_of(const SurfaceMesh& mesh, std::span<const FaceId> faces) {
  std::vector<std::int64_t> count(mesh.labels.group_name.size());
  count_groups(mesh, faces, count);
  return main_group(mesh.labels, count);
}

TEST(GroupMesh, sorts_triangles_by_their_group) {
  const auto of_group = triangles_by_group(sample_mesh().mesh);
  EXPECT_EQ(of_group, (std::vector<std::vector<TriangleId>>{{0, 1}, {2, 3}}));
}

TEST(GroupMesh, has_one_main_group_of_faces) {
  SurfaceMesh m = sample_mesh().mesh;
  m.labels.group_name = {"wing", "default"};
  m.triangle_face = {0, 1, 2, 2}, m.triangle_group = {0, 0, 1, 1};
  const std::vector<FaceId> all{0, 1, 2}, most{0, 1}, named{1}, none{7};
  EXPECT_EQ(group_of(m, most), "wing");
  EXPECT_EQ(group_of(m, named), "wing");
  EXPECT_EQ(group_of(m, none), "");
  m.triangle_group = {0, 1, 1, 1};
  EXPECT_EQ(group_of(m, all), "") << "default is no name";
}

TEST(GroupMesh, has_the_nodes_of_its_triangles_in_their_order_and_the_segments_between_them) {
  SurfaceMesh m = sample_mesh().mesh;
  m.triangles.pop_back();
  const std::vector<TriangleId> wanted = {1, 2};
  const SurfaceMesh all = mesh_of_triangles(m, wanted);
  EXPECT_EQ(all.n_nodes(), 4);
  const std::vector<TriangleId> one = {1};  // nodes 0, 1, 3
  const SurfaceMesh part = mesh_of_triangles(m, one);
  ASSERT_EQ(part.n_nodes(), 3);
  EXPECT_TRUE(part.node_xyz[2] == m.node_xyz[3]);
  EXPECT_EQ(part.node_entity, (std::vector<std::int32_t>{0, 1, 3}));
  EXPECT_EQ(part.triangles[0].n[2], 2);
  EXPECT_EQ(part.triangle_face, (std::vector<FaceId>{1}));
  EXPECT_TRUE(part.corner_uv[0] == m.corner_uv[3]);
  EXPECT_EQ(part.segment_nodes, (std::vector<NodeId>{1, 0}));
  EXPECT_EQ(part.segment_edge, (std::vector<EdgeId>{3}));
  EXPECT_EQ(part.labels, m.labels);
}

TEST(GroupMesh, keeps_pairs_of_faces_that_are_both_in_it) {
  SurfaceMesh m = sample_mesh().mesh;
  m.triangle_face = {0, 1, 2, 3};
  m.merged.pairs = {{0, 1, {}}, {1, 2, {}}};
  EXPECT_EQ(mesh_of_triangles(m, std::vector<TriangleId>{0, 1}).merged.pairs, (std::vector<FacePair>{{0, 1, {}}}));
  EXPECT_EQ(mesh_of_triangles(m, std::vector<TriangleId>{0, 1, 2}).merged.pairs, m.merged.pairs);
}

}  // namespace
}  // namespace st
