#include "meshing/topology/mesh_topology.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "support/shapes.h"

namespace st {
namespace {

TEST(MeshTopology, is_the_cad_where_nothing_is_merged) {
  const Model model = test::make_model("box");
  const MeshTopology topology(model.tables());
  EXPECT_EQ(topology.tables().edge_vertices, model.tables().edge_vertices);
  EXPECT_EQ(topology.tables().edge_is_degenerate, model.tables().edge_is_degenerate);
  for (FaceId f = 0; f < model.tables().n_faces(); ++f) EXPECT_EQ(topology.strip_of(f), nullptr);
}

TEST(MeshTopology, makes_the_vertices_of_a_merged_edge_one_and_the_edge_degenerate) {
  const Model model = test::make_model("box");
  const ModelTables& t = model.tables();
  MergedFeatures merged;
  merged.edge = {3};
  const MeshTopology topology(t, merged);
  const VertexId a = t.edge_vertices[6], b = t.edge_vertices[7];
  EXPECT_TRUE(topology.tables().edge_is_degenerate[3]);
  for (std::size_t i = 0; i < t.edge_vertices.size(); ++i) {
    const VertexId before = t.edge_vertices[i];
    EXPECT_EQ(topology.tables().edge_vertices[i], before == a || before == b ? std::min(a, b) : before);
  }
}

TEST(MeshTopology, knows_a_strip_by_its_face_and_both_its_edges) {
  const Model model = test::make_model("box");
  MergedFeatures merged;
  merged.strip_face = {2};
  merged.strip_kept = {4};
  merged.strip_closed = {7};
  merged.strip_is_opposed = {1};
  const MeshTopology topology(model.tables(), merged);
  ASSERT_NE(topology.strip_of(2), nullptr);
  EXPECT_EQ(topology.strip_of(2)->kept, 4);
  EXPECT_EQ(topology.strip_kept_at(4), topology.strip_of(2));
  EXPECT_EQ(topology.strip_closed_at(7), topology.strip_of(2));
  EXPECT_EQ(topology.strip_kept_at(7), nullptr);
  EXPECT_EQ(topology.strip_closed_at(4), nullptr);
  EXPECT_EQ(topology.strip_of(0), nullptr);
  EXPECT_EQ(topology.strip_of(2)->mirrored(0, 5), 4);
}

TEST(MeshTopology, refuses_features_of_another_model) {
  const Model model = test::make_model("box");
  MergedFeatures merged;
  merged.strip_face = {99};
  merged.strip_kept = merged.strip_closed = {0};
  merged.strip_is_opposed = {0};
  EXPECT_THROW(MeshTopology(model.tables(), merged), Error);
}

}  // namespace
}  // namespace st
