#include "meshing/associate/curved_sides.h"

#include "geometry/shape/projection.h"

#include "mesh/edge_segments.h"
#include "unit/meshing/shape_mesh.h"

namespace st {
namespace {

struct Curved {
  explicit Curved(const std::string& shape) : of(shape) {
    add_all_segments(of.mesh, of.model.tables().edge_vertices);
    nodes = make_mid_nodes(of.mesh, all_triangles(of.mesh), of.model, n_straight);
  }
  test::ShapeMesh of;
  MidNodes nodes;
  std::int64_t n_straight = -1;
};

TEST(CurvedSides, have_one_node_each_on_the_sphere) {
  const Curved c("sphere");
  EXPECT_EQ(c.nodes.size(), 3 * c.of.mesh.n_triangles() / 2) << "closed: two triangles a side";
  EXPECT_EQ(c.n_straight, 0);
  const double radius = norm(c.of.mesh.node_xyz[0]);
  for (const Vec3& x : c.nodes.xyz) EXPECT_NEAR(norm(x), radius, 1e-9 * radius);
}

TEST(CurvedSides, lie_on_the_edges_that_they_follow_seams_too) {
  const Curved c("cylinder");
  EXPECT_EQ(c.n_straight, 0);
  std::int64_t n_on_edges = 0;
  for (std::int64_t k = 0; k < c.nodes.size(); ++k) {
    if (c.nodes.entity_dim[k] != static_cast<std::uint8_t>(EntityDim::kEdge)) continue;
    ++n_on_edges;
    EXPECT_LT(closest_point(*c.of.model.curve(c.nodes.entity[k]), c.nodes.xyz[k]).distance, 1e-9);
  }
  EXPECT_EQ(n_on_edges, static_cast<std::int64_t>(c.of.mesh.segment_edge.size()));
}

TEST(CurvedSides, are_in_the_middle_of_straight_ones) {
  const Curved c("box");
  for (std::int64_t k = 0; k < c.nodes.size(); ++k) {
    const auto [a, b] = c.nodes.ends[k];
    EXPECT_LT(distance(c.nodes.xyz[k], 0.5 * (c.of.mesh.node_xyz[a] + c.of.mesh.node_xyz[b])), 1e-9);
    EXPECT_EQ(c.nodes.between(b, a), k);
  }
}

TEST(AddAllSegments, follows_every_edge_from_its_first_vertex_to_its_last) {
  const Curved c("cylinder");
  const ModelTables& t = c.of.model.tables();
  const SurfaceMesh& m = c.of.mesh;
  std::vector<double> length(t.n_edges(), 0);
  for (std::size_t i = 0; i < m.segment_edge.size(); ++i) {
    length[m.segment_edge[i]] += distance(m.node_xyz[m.segment_nodes[2 * i]], m.node_xyz[m.segment_nodes[2 * i + 1]]);
    const bool is_next = i > 0 && m.segment_edge[i] == m.segment_edge[i - 1];
    EXPECT_TRUE(!is_next || m.segment_nodes[2 * i] == m.segment_nodes[2 * i - 1]) << i;
  }
  for (EdgeId e = 0; e < t.n_edges(); ++e) EXPECT_NEAR(length[e], t.edge_length[e], 0.05 * t.edge_length[e]) << e;
}

}  // namespace
}  // namespace st
