#include "mesh/edge_mesh.h"

#include <gtest/gtest.h>

namespace st {
namespace {

EdgeMesh nodes(double first, int n) {
  std::vector<double> t;
  std::vector<Vec3> xyz;
  for (int i = 0; i < n; ++i) {
    t.push_back(first + i);
    xyz.push_back({first + i, 0, 0});
  }
  return EdgeMesh::of_curve(t, xyz, std::vector<double>(n, 1));
}

TEST(EdgeMesh, has_the_nodes_of_its_edges_in_their_order) {
  EdgeMesh m;
  m.append(nodes(0, 3));
  m.append(nodes(10, 0));
  m.append(nodes(20, 2));
  ASSERT_EQ(m.n_edges(), 3);
  EXPECT_EQ(m.n_nodes(0), 3);
  EXPECT_TRUE(m.nodes(1).empty());
  EXPECT_EQ(m.first_node(2), 3);
  std::vector<double> t;
  for (const std::int32_t i : m.nodes(2)) t.push_back(m.node_t[i]);
  EXPECT_EQ(t, (std::vector<double>{20, 21}));
}

TEST(EdgeMesh, takes_an_edge_over_from_another_mesh_to_the_bit) {
  EdgeMesh a, b = EdgeMesh::of_edges(0);
  a.append(nodes(0, 3));
  a.append(nodes(0.1, 4));
  b.append(a, 0);
  b.append(a, 1);
  EXPECT_EQ(b.edge_offsets, a.edge_offsets);
  EXPECT_TRUE(has_same_nodes(a, b, 0));
  EXPECT_TRUE(has_same_nodes(a, b, 1));
  b.node_xyz.back().x += 1e-15;
  EXPECT_FALSE(has_same_nodes(a, b, 1));
}

TEST(EdgeMesh, without_nodes_has_none_on_any_edge) {
  const EdgeMesh m = EdgeMesh::of_edges(4);
  ASSERT_EQ(m.n_edges(), 4);
  for (EdgeId e = 0; e < 4; ++e) EXPECT_EQ(m.n_nodes(e), 0);
}

TEST(EdgeMesh, requests_are_the_sizes_unless_they_differ) {
  EdgeMesh m;
  m.append(nodes(0, 2));
  EXPECT_EQ(m.requests(), m.node_size);
  m.node_request = {5, 6};
  EXPECT_EQ(m.requests(), (std::vector<double>{5, 6}));
}

}  // namespace
}  // namespace st
