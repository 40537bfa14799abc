#include "mesh/merge.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "mesh/adjacency.h"
#include "unit/mesh/cube_patches.h"
#include "unit/mesh/shapes.h"

namespace st {
namespace {

using shapes::CubePatches;
using shapes::same;

bool is_closed_and_alike(const SurfaceMesh& m) {
  bool ok = true;
  EdgeTable(m.triangles, m.n_nodes()).for_each_edge([&](NodeId, NodeId, std::span<const SideId> s) {
    ok = ok && s.size() == 2 && !run_alike(m.triangles, s[0], s[1]);
  });
  return ok;
}

TEST(Merge, welds_the_patches_of_a_cube_to_a_closed_mesh) {
  const SurfaceMesh m = CubePatches().merge();
  EXPECT_EQ(m.n_triangles(), 48);
  EXPECT_EQ(m.n_nodes(), 8 + 12 + 6);
  EXPECT_TRUE(is_closed_and_alike(m));
  EXPECT_DOUBLE_EQ(shapes::volume(m), 1);
}

TEST(Merge, orders_nodes_by_dimension_entity_and_index_and_triangles_by_face) {
  const SurfaceMesh m = CubePatches().merge();
  for (std::int64_t n = 1; n < m.n_nodes(); ++n)
    EXPECT_LT(std::pair(m.node_entity_dim[n - 1], m.node_entity[n - 1]),
              std::pair(m.node_entity_dim[n], m.node_entity[n]));
  EXPECT_TRUE(std::is_sorted(m.triangle_face.begin(), m.triangle_face.end()));
  for (std::int64_t t = 0; t < m.n_triangles(); ++t) EXPECT_EQ(m.triangle_group[t], m.triangle_face[t] / 2);
}

TEST(Merge, does_not_depend_on_the_order_of_the_patches) {
  CubePatches a, b;
  std::rotate(b.patches.begin(), b.patches.begin() + 2, b.patches.end());
  std::swap(b.patches[0], b.patches[3]);
  EXPECT_TRUE(same(a.merge(), b.merge()));
}

TEST(Merge, keeps_the_uv_of_each_corner_and_the_parameter_and_size_of_each_node) {
  const CubePatches c;
  const SurfaceMesh m = c.merge();
  for (std::int64_t t = 0; t < m.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(m.corner_uv[3 * t + k], (Vec2{double(m.triangle_face[t]), double(3 * (t % 8) + k)}));
  for (std::int64_t n = 0; n < m.n_nodes(); ++n) {
    EXPECT_EQ(m.node_t[n], m.node_entity_dim[n] == 1 ? 0.5 : 0);
    EXPECT_GE(m.node_size[n], 0.25);
  }
}

TEST(Merge, welds_by_ids_and_never_by_coordinates) {
  CubePatches c;
  c.edges.node_xyz[1] = c.vertices[3];  // an edge node that happens to lie on a vertex stays a node of its own
  EXPECT_EQ(c.merge().n_nodes(), 26);
}

TEST(Merge, gives_a_vertex_the_request_of_the_edge_of_lowest_id_at_the_end_that_is_there) {
  CubePatches c;
  for (std::size_t i = 0; i < c.edges.node_xyz.size(); ++i)
    c.edges.node_request.push_back(100 + static_cast<double>(i));
  const SurfaceMesh m = c.merge();
  for (NodeId n = 0; n < 8; ++n) {
    ASSERT_EQ(m.node_entity_dim[n], 0);
    const VertexId v = m.node_entity[n];
    const std::size_t end = std::find(c.edge_vertices.begin(), c.edge_vertices.end(), v) - c.edge_vertices.begin();
    EXPECT_EQ(m.node_size[n], 100 + static_cast<double>(3 * (end / 2) + (end % 2 ? 2 : 0)));
  }
  for (NodeId n = 8; n < 20; ++n)
    EXPECT_EQ(m.node_size[n], 100 + 3 * m.node_entity[n] + 1) << "requests, not the lengths it was made for";
}

TEST(Merge, keeps_triangles_with_a_repeated_node) {
  CubePatches c;
  c.patches[2].triangles[0].n[1] = c.patches[2].triangles[0].n[0];
  EXPECT_EQ(c.merge().n_triangles(), 48);
}

TEST(Merge, of_a_part_of_the_faces_gives_their_nodes_only) {
  CubePatches c;
  c.patches.resize(1);
  const SurfaceMesh m = c.merge();
  EXPECT_EQ(m.n_nodes(), 9);
  EXPECT_EQ(m.n_triangles(), 8);
  c.patches.clear();
  EXPECT_EQ(c.merge().n_nodes(), 0);
}

TEST(Merge, refuses_patches_that_name_what_does_not_exist) {
  const auto fails = [](auto change) {
    CubePatches c;
    change(c.patches[3]);
    try {
      c.merge();
    } catch (const Error& e) {
      return e.code() == ExitCode::kInput && std::string(e.what()).find("face 4") == 0;
    }
    return false;
  };
  EXPECT_TRUE(fails([](FacePatch& p) { p.boundary_entity[0] = 99; }));
  EXPECT_TRUE(fails([](FacePatch& p) { p.boundary_entity[1] = -1; }));
  EXPECT_TRUE(fails([](FacePatch& p) { p.boundary_index[1] = 2; })) << "an end node is the vertex";
  EXPECT_TRUE(fails([](FacePatch& p) { p.boundary_dim[1] = 2; }));
  EXPECT_TRUE(fails([](FacePatch& p) { p.triangles[5].n[2] = 10; }));
  EXPECT_TRUE(fails([](FacePatch& p) { p.own_uv.erase(p.own_uv.begin()), p.uv_corner.erase(p.uv_corner.begin()); }));
  CubePatches twice;
  twice.patches.push_back(twice.patches[0]);
  EXPECT_THROW(twice.merge(), Error);
}

}  // namespace
}  // namespace st
