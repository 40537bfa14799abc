// Chains of mesh edges along CAD edges.
#include "meshing/associate/edge_chains.h"

#include "base/error.h"
#include "meshing/hole/hole_mesh.h"
#include "unit/meshing/shape_mesh.h"

namespace st::test {
namespace {

TEST(MeshEdges, know_their_sides_and_nodes) {
  const ShapeMesh box("box");
  const MeshEdges edges(box.mesh.triangles, box.mesh.n_nodes());
  ASSERT_EQ(edges.n_edges(), 3 * box.mesh.n_triangles() / 2);
  for (std::int32_t e = 0; e < edges.n_edges(); ++e) {
    EXPECT_LT(edges.low[e], edges.high[e]);
    EXPECT_EQ(edges.other(e, edges.low[e]), edges.high[e]);
    EXPECT_EQ(edges.sides_of(e).size(), 2u);
    for (const SideId s : edges.sides_of(e)) EXPECT_EQ(edges.edge_of_side[s], e);
    for (const NodeId n : {edges.low[e], edges.high[e]}) {
      const auto at = edges.at(n);
      EXPECT_TRUE(std::binary_search(at.begin(), at.end(), e));
    }
  }
}

TEST(MeshEdges, leave_out_triangles_with_a_repeated_node) {
  const MeshEdges edges({{{0, 1, 2}}, {{0, 0, 3}}}, 4);
  EXPECT_EQ(edges.n_edges(), 3);
  for (int k = 3; k < 6; ++k) EXPECT_EQ(edges.edge_of_side[k], kNone);
  EXPECT_TRUE(edges.at(3).empty());
}

NodeTolerance tolerance_of(const ShapeMesh& solid) {
  return {std::vector<double>(solid.mesh.node_xyz.size(), 1e-3 * solid.field.min_size()), true};
}

class ChainsOfSolid : public testing::TestWithParam<const char*> {};

TEST_P(ChainsOfSolid, are_the_nodes_that_the_mesh_was_made_with) {
  const ShapeMesh solid(GetParam());
  const ModelTables& t = solid.model.tables();
  const MeshEdges edges(solid.mesh.triangles, solid.mesh.n_nodes());
  const EdgeChains chains = find_edge_chains(solid.mesh, edges, solid.model, tolerance_of(solid));
  const HoleMesh made(solid.mesh, t);
  const ChainSegments segments(edges, chains);
  std::vector<EdgeId> expected(edges.n_edges(), kNone);
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    const EdgeChain& chain = chains.chain[e];
    const std::int32_t begin = made.edges.edge_offsets[e], end = made.edges.edge_offsets[e + 1];
    EXPECT_EQ(chain.node, std::vector<NodeId>(made.edge_node.begin() + begin, made.edge_node.begin() + end))
        << "edge " << e;
    for (std::size_t i = 0; i + 1 < chain.node.size(); ++i) {
      EXPECT_LT(chain.t[i], chain.t[i + 1]);
      EXPECT_EQ(edges.other(chain.edge[i], chain.node[i]), chain.node[i + 1]);
      expected[chain.edge[i]] = e;
      EXPECT_EQ(segments.index[chain.edge[i]], static_cast<std::int32_t>(i));
    }
  }
  EXPECT_EQ(segments.edge, expected);
  EXPECT_LE(chains.max_distance, 1e-6 * solid.field.min_size());
}

INSTANTIATE_TEST_SUITE_P(, ChainsOfSolid, testing::ValuesIn(kSolids),
                         [](const auto& info) { return std::string(info.param); });

TEST(EdgeChains, refuse_a_mesh_whose_nodes_are_farther_off_than_the_tolerance) {
  ShapeMesh box("box");
  for (Vec3& x : box.mesh.node_xyz) x = x + Vec3{0.1 * box.field.min_size(), 0, 0};
  const MeshEdges edges(box.mesh.triangles, box.mesh.n_nodes());
  try {
    find_edge_chains(box.mesh, edges, box.model, tolerance_of(box));
    ADD_FAILURE() << "accepted";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kMismatch) << e.what();
  }
}

TEST(EdgeChains, refuse_a_mesh_with_a_node_beside_its_edge) {
  ShapeMesh box("box");
  NodeId n = 0;
  while (box.mesh.node_entity_dim[n] != static_cast<std::uint8_t>(EntityDim::kEdge)) ++n;
  box.mesh.node_xyz[n] = box.mesh.node_xyz[n] + 0.05 * box.field.min_size() * Vec3{1, 1, 1};
  const MeshEdges edges(box.mesh.triangles, box.mesh.n_nodes());
  NodeTolerance tolerance = tolerance_of(box);
  EXPECT_THROW(find_edge_chains(box.mesh, edges, box.model, tolerance), Error);
  tolerance.of_node.assign(tolerance.of_node.size(), 0.1 * box.field.min_size());
  EXPECT_GT(find_edge_chains(box.mesh, edges, box.model, tolerance).max_distance, 0.05 * box.field.min_size());
}

TEST(ChainSegments, refuse_two_chains_with_a_mesh_edge_in_common) {
  const ShapeMesh box("box");
  const MeshEdges edges(box.mesh.triangles, box.mesh.n_nodes());
  EdgeChains chains = find_edge_chains(box.mesh, edges, box.model, tolerance_of(box));
  chains.chain[1] = chains.chain[0];
  EXPECT_THROW(ChainSegments(edges, chains), Error);
}

}  // namespace
}  // namespace st::test
