// A merged mesh seen from the CAD again.
#include "meshing/hole/hole_mesh.h"

#include "base/error.h"
#include "unit/meshing/shape_mesh.h"

namespace st::test {
namespace {

class SolidAgain : public testing::TestWithParam<const char*> {};

TEST_P(SolidAgain, has_every_node_on_its_edge_and_every_triangle_on_its_face) {
  const ShapeMesh solid(GetParam());
  const ModelTables& t = solid.model.tables();
  const HoleMesh again(solid.mesh, t);
  const EdgeMesh made = discretise_edges(solid.model, solid.field);
  EXPECT_EQ(again.edges.edge_offsets, made.edge_offsets);
  EXPECT_EQ(again.edges.node_t, made.node_t);
  EXPECT_TRUE(again.edges.node_xyz == made.node_xyz);
  for (std::size_t i = 0; i < again.edge_node.size(); ++i)
    EXPECT_TRUE(solid.mesh.node_xyz[again.edge_node[i]] == again.edges.node_xyz[i]) << i;
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    ASSERT_GT(again.face_size(f), 0);
    for (TriangleId i = again.face_begin[f]; i < again.face_begin[f + 1]; ++i)
      EXPECT_EQ(solid.mesh.triangle_face[i], f);
    for (NodeId n = again.inner_begin[f]; n < again.inner_begin[f + 1]; ++n) EXPECT_EQ(solid.mesh.node_entity[n], f);
    EXPECT_EQ(again.face_is_turned[f] != 0, t.face_is_reversed[f] != 0) << "normals point out of the solid";
  }
}

TEST_P(SolidAgain, finds_the_segments_between_two_nodes_and_no_others) {
  const ShapeMesh solid(GetParam());
  const HoleMesh again(solid.mesh, solid.model.tables());
  std::size_t n_segments = 0;
  for (std::size_t i = 0; i + 1 < again.edge_node.size(); ++i) {
    const EdgeId e =
        static_cast<EdgeId>(std::upper_bound(again.edges.edge_offsets.begin(), again.edges.edge_offsets.end(),
                                             static_cast<std::int32_t>(i)) -
                            again.edges.edge_offsets.begin() - 1);
    if (static_cast<std::int32_t>(i) + 1 == again.edges.edge_offsets[e + 1]) continue;
    ++n_segments;
    const auto between = again.segments_between(again.edge_node[i + 1], again.edge_node[i]);
    EXPECT_TRUE(std::any_of(between.begin(), between.end(), [&](const CadSegment& s) {
      return s.edge == e && s.index == static_cast<std::int32_t>(i);
    })) << i;
  }
  EXPECT_EQ(again.segments.size(), n_segments);
  EXPECT_TRUE(again.segments_between(again.edge_node[0], solid.mesh.n_nodes() - 1).empty()) << "a node inside a face";
}

INSTANTIATE_TEST_SUITE_P(, SolidAgain, testing::ValuesIn(kSolids),
                         [](const auto& info) { return std::string(info.param); });

TEST(HoleMesh, refuses_nodes_of_an_edge_out_of_order) {
  BoxMesh box;
  NodeId n = 8;  // the first two nodes inside an edge
  while (box.mesh.node_entity[n] != box.mesh.node_entity[n + 1]) ++n;
  std::swap(box.mesh.node_t[n], box.mesh.node_t[n + 1]);
  EXPECT_THROW(HoleMesh(box.mesh, box.model.tables()), Error);
}

TEST(HoleMesh, refuses_sizes_that_are_no_numbers) {
  BoxMesh box;
  box.mesh.node_size[3] = std::nan("");
  EXPECT_THROW(HoleMesh(box.mesh, box.model.tables()), Error);
}

}  // namespace
}  // namespace st::test
