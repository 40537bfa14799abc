// Strips closed for meshing.
#include "mesh/surface_mesh.h"

#include <gtest/gtest.h>

namespace st {
namespace {

/// A strip (face 5) between edge 0, which is kept, and edge 1, against it, which has the same nodes.
struct ClosedStrip {
  MergedFeatures merged;
  EdgeMesh edges;
  std::vector<VertexId> edge_vertices{0, 1, 1, 0};

  ClosedStrip() {
    merged.strip_face = {5};
    merged.strip_kept = {0};
    merged.strip_closed = {1};
    merged.strip_is_opposed = {1};
    edges.edge_offsets = {0, 4, 8};
    for (const double x : {0, 1, 2, 3, 3, 2, 1, 0}) edges.node_xyz.push_back({x, 0, 0});
  }
  std::vector<FaceId> find() const { return closed_faces(merged, edges, edge_vertices); }
};

TEST(ClosedFaces, are_those_whose_long_edges_have_all_nodes_in_common) {
  ClosedStrip strip;
  EXPECT_EQ(strip.find(), std::vector<FaceId>{5});
  strip.merged.strip_is_opposed = {0};
  EXPECT_TRUE(strip.find().empty()) << "against each other";
}

TEST(ClosedFaces, are_none_where_the_strip_is_open_at_an_end) {
  ClosedStrip strip;
  strip.edge_vertices = {0, 1, 2, 0};
  EXPECT_TRUE(strip.find().empty());
}

TEST(ClosedFaces, are_none_where_the_strip_is_open_in_the_middle) {
  ClosedStrip strip;
  strip.edges.node_xyz[5].y = 1e-9;
  EXPECT_TRUE(strip.find().empty());
}

TEST(ClosedFaces, are_none_where_an_edge_has_no_nodes_or_others) {
  ClosedStrip strip;
  strip.edges.edge_offsets = {0, 4, 7};
  EXPECT_TRUE(strip.find().empty());
  strip.edges.edge_offsets = {0, 0, 0};
  EXPECT_TRUE(strip.find().empty());
}

}  // namespace
}  // namespace st
