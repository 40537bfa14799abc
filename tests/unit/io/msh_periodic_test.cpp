#include "io/export/msh_periodic.h"

#include <gtest/gtest.h>

namespace st {
namespace {

/// A triangle and its image above; its first node is a vertex, its second on an edge.
SurfaceMesh paired_triangles() {
  SurfaceMesh m;
  m.node_xyz = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 0, 1}, {0, 1, 0}, {0, 1, 1}};
  m.node_entity_dim = {0, 0, 1, 1, 2, 2};
  m.node_entity = {0, 1, 4, 7, 0, 1};
  m.triangles = {{{0, 2, 4}}, {{1, 5, 3}}};
  m.triangle_face = {0, 1};
  m.merged.pairs = {{0, 1, {.translation = {0, 0, 1}}}};
  return m;
}

TEST(MshPeriodic, links_vertices_edges_and_faces_once_each) {
  const std::vector<PeriodicLink> links = periodic_links(paired_triangles());
  ASSERT_EQ(links.size(), 3u);
  EXPECT_EQ(links[0].dim, 0);
  EXPECT_EQ(links[0].slave, 1);
  EXPECT_EQ(links[0].master, 0);
  EXPECT_EQ(links[1].slave, 7);
  EXPECT_EQ(links[1].master, 4);
  EXPECT_EQ(links[1].nodes, (std::vector<std::pair<NodeId, NodeId>>{{3, 2}}));
  EXPECT_EQ(links[2].dim, 2);
  EXPECT_EQ(links[2].nodes.size(), 3u);
  EXPECT_EQ(links[2].motion.translation.z, 1);
}

TEST(MshPeriodic, links_nothing_to_itself_and_nothing_without_pairs) {
  SurfaceMesh m = paired_triangles();
  m.node_entity[3] = 4;  // an edge of its own image
  EXPECT_EQ(periodic_links(m).size(), 2u);
  m.merged.pairs.clear();
  EXPECT_TRUE(periodic_links(m).empty());
}

}  // namespace
}  // namespace st
