// Requested lengths stored with a mesh.
#include "meshing/engine/mesh_result.h"

#include <gtest/gtest.h>

namespace st {
namespace {

const UniformField two(2);

MeshResult refined_edge() {
  MeshResult r;
  r.edges = EdgeMesh::of_curve({0, 1, 2}, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {2, 1, 2});
  return r;
}

TEST(MeshResult, stores_the_request_where_a_size_was_refined) {
  MeshResult r = refined_edge();
  store_requests(two, r);
  EXPECT_EQ(r.edges.node_request, (std::vector<double>{2, 2, 2}));
  EXPECT_EQ(r.edges.node_size, (std::vector<double>{2, 1, 2})) << "what it was made for stays";
}

TEST(MeshResult, stores_no_requests_where_they_are_the_sizes) {
  MeshResult r = refined_edge();
  r.edges.node_size[1] = 2;
  store_requests(two, r);
  EXPECT_TRUE(r.edges.node_request.empty());
}

TEST(MeshResult, leaves_nodes_of_the_mesh_before_as_they_are) {
  MeshResult r = refined_edge();
  r.edges.node_previous = {7, kNone, 9};
  r.edges.node_request = {5, 5, 5};
  r.patches.resize(1);
  r.patches[0].inner_xyz = {{1, 1, 0}, {1, 2, 0}};
  r.patches[0].inner_size = {3, 3};
  r.patches[0].inner_previous = {4, kNone};
  store_requests(two, r);
  EXPECT_EQ(r.edges.node_request, (std::vector<double>{5, 2, 5}));
  EXPECT_EQ(r.patches[0].inner_size, (std::vector<double>{3, 2}));
}

}  // namespace
}  // namespace st
