// What a plan makes of all faces, of some, and of some again.
#include "meshing/engine/mesh_plan.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/meshed.h"

namespace st {
namespace {

using test::Meshed;

bool has(const std::vector<std::int32_t>& list, std::int32_t id) {
  return std::binary_search(list.begin(), list.end(), id);
}

TEST(MeshPlan, of_all_has_every_edge_but_poles) {
  const Model ball = test::make_model("sphere");
  const MeshTopology topology(ball.tables());
  const MeshPlan plan = plan_all(topology);
  EXPECT_EQ(static_cast<FaceId>(plan.faces.size()), ball.tables().n_faces());
  ASSERT_EQ(ball.tables().n_edges(), 3);
  for (EdgeId e = 0; e < 3; ++e) EXPECT_EQ(has(plan.edges, e), !ball.tables().edge_is_degenerate[e]);
}

TEST(MeshPlan, of_a_part_has_the_edges_of_its_faces_that_have_no_nodes) {
  const Meshed m("box", 4);
  const ModelTables& t = m.model.tables();
  std::vector<EdgeId> of_both(t.edges_of(0).begin(), t.edges_of(0).end());
  of_both.insert(of_both.end(), t.edges_of(3).begin(), t.edges_of(3).end());
  std::sort(of_both.begin(), of_both.end());
  of_both.erase(std::unique(of_both.begin(), of_both.end()), of_both.end());
  EXPECT_EQ(plan_part(m.topology, {0, 3}, {}).edges, of_both);
  EXPECT_TRUE(plan_part(m.topology, {0}, m.result.edges).edges.empty());
  const EdgeId bare = t.edges_of(0)[1];
  EdgeMesh others;
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    e == bare ? others.append(EdgeMesh::of_edges(1)) : others.append(m.result.edges, e);
  EXPECT_EQ(plan_part(m.topology, {0}, others).edges, std::vector<EdgeId>{bare});
}

TEST(MeshPlan, of_a_part_meshed_alone_has_the_nodes_that_the_whole_has) {
  const Meshed m("drilled_cylinder", 1.5);
  for (FaceId f = 0; f < m.model.tables().n_faces(); ++f) {
    const MeshResult part =
        mesh_regions(m.model, m.topology, m.field, plan_part(m.topology, {f}, {}), {}, test::one_rank);
    for (const EdgeId e : m.model.tables().edges_of(f))
      EXPECT_TRUE(part.edges.n_nodes(e) == m.result.edges.n_nodes(e) && has_same_nodes(part.edges, m.result.edges, e));
    EXPECT_TRUE(part.patches[f].inner_xyz == m.result.patches[f].inner_xyz);
    for (FaceId g = 0; g < m.model.tables().n_faces(); ++g) EXPECT_TRUE(g == f || part.patches[g].triangles.empty());
  }
}

TEST(MeshPlan, again_keeps_edges_that_other_faces_share_and_those_of_a_group) {
  const Meshed m("box", 4);
  const ModelTables& t = m.model.tables();
  EXPECT_TRUE(plan_again(m.topology, {2}, m.result.edges, m.result.patches).edges.empty());
  std::vector<FaceId> all{0, 1, 2, 3, 4, 5};
  EXPECT_EQ(plan_again(m.topology, all, m.result.edges, m.result.patches).edges.size(), 12u);
  std::vector<char> keep(t.n_edges(), 0);
  keep[5] = 1;
  EXPECT_FALSE(has(plan_again(m.topology, all, m.result.edges, m.result.patches, keep).edges, 5));
}

}  // namespace
}  // namespace st
