// Edges, sides and components of triangulations.
#include "mesh/adjacency.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/mesh/shapes.h"

namespace st {
namespace {

TEST(EdgeTable, visits_every_edge_once_in_ascending_order_with_both_its_sides) {
  const SurfaceMesh m = shapes::cube(3);
  std::pair<NodeId, NodeId> last{-1, -1};
  std::vector<int> seen(3 * m.triangles.size(), 0);
  std::int64_t n_edges = 0;
  EdgeTable(m.triangles, m.n_nodes()).for_each_edge([&](NodeId low, NodeId high, std::span<const SideId> sides) {
    EXPECT_LT(low, high);
    EXPECT_LT(last, std::pair(low, high));
    last = {low, high};
    ++n_edges;
    ASSERT_EQ(sides.size(), 2u);
    EXPECT_LT(sides[0], sides[1]);
    EXPECT_FALSE(run_alike(m.triangles, sides[0], sides[1]));
    for (const SideId s : sides) {
      ++seen[s];
      const Triangle& t = m.triangles[s / 3];
      EXPECT_EQ(std::minmax(t.n[s % 3], t.n[(s + 1) % 3]), std::minmax(low, high));
    }
  });
  EXPECT_EQ(n_edges, 3 * m.n_triangles() / 2);
  EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), 3 * m.n_triangles());
}

TEST(EdgeTable, has_all_sides_of_an_edge_of_three_triangles_and_none_of_a_triangle_with_a_repeated_node) {
  const std::vector<Triangle> triangles{{{0, 1, 2}}, {{1, 0, 3}}, {{0, 1, 4}}, {{0, 1, 1}}};
  int n_edges = 0;
  EdgeTable(triangles, 5).for_each_edge([&](NodeId low, NodeId high, std::span<const SideId> sides) {
    ++n_edges;
    EXPECT_EQ(sides.size(), low == 0 && high == 1 ? 3u : 1u);
    if (sides.size() == 3) {
      EXPECT_TRUE(run_alike(triangles, sides[0], sides[2]));
      EXPECT_FALSE(run_alike(triangles, sides[0], sides[1]));
    }
  });
  EXPECT_EQ(n_edges, 7);
}

TEST(EdgeTable, of_nothing_has_no_edge) {
  EdgeTable({}, 0).for_each_edge([](NodeId, NodeId, std::span<const SideId>) { ADD_FAILURE(); });
}

std::vector<SideId> fans_of(const std::vector<Triangle>& triangles, std::int64_t n_nodes) {
  return find_fans(triangles, EdgeTable(triangles, n_nodes));
}

TEST(Fans, are_one_for_each_node_of_a_closed_mesh) {
  const SurfaceMesh m = shapes::cube(3);
  const std::vector<SideId> fan = find_fans(m.triangles, edges_of(m));
  std::vector<SideId> lowest(m.n_nodes(), kNone);
  for (SideId c = 0; c < static_cast<SideId>(fan.size()); ++c) {
    SideId& first = lowest[side_start(m.triangles, c)];
    if (first == kNone) first = c;
    EXPECT_EQ(fan[c], first);
  }
}

TEST(Fans, have_the_lowest_corner_whichever_way_around_an_open_fan_it_is) {
  EXPECT_EQ(fans_of({{{0, 1, 2}}, {{0, 2, 3}}, {{0, 3, 4}}}, 5), (std::vector<SideId>{0, 1, 2, 0, 2, 5, 0, 5, 8}));
  EXPECT_EQ(fans_of({{{0, 3, 4}}, {{0, 2, 3}}, {{0, 1, 2}}}, 5), (std::vector<SideId>{0, 1, 2, 0, 4, 1, 0, 7, 4}));
}

TEST(Fans, end_where_triangles_meet_in_a_node_alone) {
  EXPECT_EQ(fans_of({{{0, 1, 2}}, {{0, 3, 4}}}, 5), (std::vector<SideId>{0, 1, 2, 3, 4, 5}));
}

TEST(Fans, go_on_over_edges_of_three_triangles_and_of_triangles_that_run_alike) {
  EXPECT_EQ(fans_of({{{0, 1, 2}}, {{1, 0, 3}}, {{0, 1, 4}}}, 5), (std::vector<SideId>{0, 1, 2, 1, 0, 5, 0, 1, 8}));
  EXPECT_EQ(fans_of({{{0, 1, 2}}, {{0, 1, 3}}, {{0, 3, 4}}}, 5), (std::vector<SideId>{0, 1, 2, 0, 1, 5, 0, 5, 8}));
}

TEST(NodeComponents, are_numbered_by_their_lowest_node) {
  std::int32_t n = 0;
  const std::vector<Triangle> triangles{{{6, 7, 8}}, {{1, 2, 3}}, {{3, 4, 1}}};
  EXPECT_EQ(node_components(triangles, 9, n), (std::vector<std::int32_t>{kNone, 0, 0, 0, 0, kNone, 1, 1, 1}));
  EXPECT_EQ(n, 2);
  EXPECT_EQ(node_components({}, 2, n), (std::vector<std::int32_t>{kNone, kNone}));
  EXPECT_EQ(n, 0);
}

}  // namespace
}  // namespace st
