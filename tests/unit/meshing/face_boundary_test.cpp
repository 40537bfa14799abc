#include "meshing/face/face_boundary.h"

#include <gtest/gtest.h>

#include "unit/meshing/faces.h"

namespace st {
namespace {

using test::FaceCase;

class Boundary : public testing::TestWithParam<const char*> {};

TEST_P(Boundary, is_a_set_of_closed_loops) {
  const FaceCase c(GetParam(), UniformField(1.5));
  std::vector<int> out(c.boundary.nodes.size(), 0), in(c.boundary.nodes.size(), 0);
  for (const auto& [a, b] : c.boundary.segments) {
    ++out[a];
    ++in[b];
  }
  for (std::size_t i = 0; i < out.size(); ++i) EXPECT_TRUE(out[i] == 1 && in[i] == 1) << i;
}

TEST_P(Boundary, has_the_interior_on_its_left) {
  const FaceCase c(GetParam(), UniformField(1.5));
  double area = 0;
  for (const auto& [a, b] : c.boundary.segments) area += 0.5 * cross(c.boundary.nodes[a].uv, c.boundary.nodes[b].uv);
  EXPECT_GT(area, 0);
}

TEST_P(Boundary, lies_on_the_surface) {
  const FaceCase c(GetParam(), UniformField(1.5));
  for (const auto& n : c.boundary.nodes) {
    EXPECT_LE(distance(c.surface->point(n.uv), n.x), 1e-5);
    EXPECT_GT(n.h, 0);
    EXPECT_GE(n.id, 0);
  }
}

TEST_P(Boundary, uses_every_node_of_an_edge_as_often_as_the_loops_use_the_edge) {
  const FaceCase c(GetParam(), UniformField(1.5));
  const ModelTables& t = c.model.tables();
  const MeshTopology topology(t);
  const BoundaryNumbering numbering(topology, c.edges);
  std::map<std::int32_t, int> uses;
  for (const auto& n : c.boundary.nodes) ++uses[n.id];
  std::vector<int> edge_uses(t.n_edges(), 0);
  for (const LoopId l : t.loops(0))
    for (const CoedgeId k : t.loop_coedges(l)) ++edge_uses[t.coedge_edge[k]];
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    for (std::int32_t i = 1; i + 1 < c.edges.n_nodes(e); ++i)
      EXPECT_EQ(uses[numbering.edge_node(e, i)], edge_uses[e]) << "edge " << e << " node " << i;
}

TEST_P(Boundary, joins_coedges_in_one_node) {
  const FaceCase c(GetParam(), UniformField(1.5));
  for (const auto& [a, b] : c.boundary.segments) {
    const auto &n = c.boundary.nodes[a], &m = c.boundary.nodes[b];
    if (n.id == m.id) {
      EXPECT_TRUE(n.is_pole && m.is_pole) << a << " - " << b;
    } else {
      EXPECT_GT(distance(n.x, m.x), 0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, Boundary,
                         testing::Values("square", "disc", "annulus", "sphere", "torus", "cone_side", "cylinder",
                                         "drilled_cylinder", "mirrored_cylinder", "periodic_tube", "closed_tube",
                                         "tube_window", "rational_torus", "plate_with_hole", "sphere_octant",
                                         "revolution"),
                         [](const auto& info) { return std::string(info.param); });

TEST(FaceBoundary, cuts_a_pole_into_nodes_of_one_point) {
  const FaceCase c("sphere", UniformField(1.5));
  std::map<std::int32_t, std::vector<FaceNode>> poles;
  for (const auto& n : c.boundary.nodes)
    if (n.is_pole) poles[n.id].push_back(n);
  ASSERT_EQ(poles.size(), 2u);
  for (const auto& [id, nodes] : poles) {
    EXPECT_GE(nodes.size(), 7u);  // a turn of 360 degrees in steps of at most 60
    EXPECT_LE(nodes.size(), 8u);
    double lo = 1e300, hi = -1e300;
    for (const auto& n : nodes) {
      EXPECT_TRUE(n.x == nodes[0].x);
      EXPECT_NEAR(std::abs(n.x.z), 10, 1e-12);
      lo = std::min(lo, n.uv.x);
      hi = std::max(hi, n.uv.x);
    }
    EXPECT_NEAR(hi - lo, 2 * kPi, 1e-12);
  }
}

TEST(FaceBoundary, has_a_seam_twice_with_the_same_ids_a_period_apart) {
  const FaceCase c("torus", UniformField(1.5));
  std::map<std::int32_t, std::vector<Vec2>> places;
  for (const auto& n : c.boundary.nodes) {
    EXPECT_FALSE(n.is_pole);
    places[n.id].push_back(n.uv);
  }
  int n_corners = 0;
  for (const auto& [id, uv] : places) {
    if (uv.size() == 4) {
      ++n_corners;
      continue;
    }
    ASSERT_EQ(uv.size(), 2u);
    EXPECT_NEAR(norm(uv[0] - uv[1]), 2 * kPi, 1e-9);
  }
  EXPECT_EQ(n_corners, 1);
}

TEST(FaceBoundary, does_not_take_an_apex_of_a_thin_part_for_a_size) {
  const FaceCase c("cone_side", UniformField(1.5));
  for (const auto& n : c.boundary.nodes) EXPECT_LE(n.h, 1.5 + 1e-12);
}

TEST(FaceBoundary, gives_nodes_of_short_segments_a_size_of_their_own) {
  const FaceCase c("strip", UniformField(5));  // 0.2 wide
  for (const auto& n : c.boundary.nodes)
    if (n.x.x > 10 && n.x.x < 90) {
      EXPECT_NEAR(n.h, 5, 1e-12);
    }
  const FaceCase tube("thin_tube", UniformField(5));
  for (const auto& n : tube.boundary.nodes)
    if (std::abs(n.x.z - 15) < 14 ? false : std::abs(n.uv.x - kPi) < 1) {
      EXPECT_LT(n.h, 0.3);
    }
}

TEST(FaceBoundary, judges_a_node_by_the_segments_on_both_sides) {
  const FaceCase c("strip", UniformField(0.5));  // at the corners one segment is 0.2 long, the other 0.5
  for (const auto& n : c.boundary.nodes) EXPECT_NEAR(n.h, 0.5, 1e-12);
}

TEST(FaceBoundary, does_not_run_back_within_the_tolerance_of_a_vertex) {
  const FaceCase c("slipped_side", UniformField(1));
  EXPECT_EQ(c.boundary.nodes.size(), 40u) << "ten on each side, and none twice";
  EXPECT_EQ(mesh_face(*c.surface, c.boundary, UniformField(1), {}).cause, FailureCause::kNone)
      << "no segments cross or touch";
}

TEST(MinSegments, are_three_for_a_closed_edge_two_for_a_pair_one_else) {
  for (int n : min_segments_per_edge(test::make_model("box").tables())) EXPECT_EQ(n, 1);
  EXPECT_EQ(min_segments_per_edge(test::make_model("disc").tables()), std::vector<int>{3});
  const Model cylinder = test::make_model("cylinder");
  const ModelTables& t = cylinder.tables();
  const std::vector<int> least = min_segments_per_edge(t);
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    EXPECT_EQ(least[e], t.edge_vertices[2 * e] == t.edge_vertices[2 * e + 1] ? 3 : 1);
  const Model sphere = test::make_model("sphere");
  for (EdgeId e = 0; e < 3; ++e)
    if (!sphere.tables().edge_is_degenerate[e]) {
      EXPECT_EQ(min_segments_per_edge(sphere.tables())[e], 2);
    }
}

TEST(BoundaryNumbering, names_every_node_once) {
  const Model model = test::make_model("drilled_cylinder");
  const ModelTables& t = model.tables();
  const EdgeMesh edges = test::discretise_edges(model, UniformField(2));
  const MeshTopology topology(t);
  const BoundaryNumbering numbering(topology, edges);
  std::set<std::int32_t> inner;
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    const std::int32_t n = edges.n_nodes(e);
    if (n == 0) continue;
    EXPECT_EQ(numbering.edge_node(e, 0), t.edge_vertices[2 * e]);
    EXPECT_EQ(numbering.edge_node(e, n - 1), t.edge_vertices[2 * e + 1]);
    for (std::int32_t i = 1; i + 1 < n; ++i) {
      const std::int32_t id = numbering.edge_node(e, i);
      EXPECT_TRUE(inner.insert(id).second);
      const auto back = numbering.entity(id);
      EXPECT_EQ(back.dim, EntityDim::kEdge);
      EXPECT_EQ(back.entity, e);
      EXPECT_EQ(back.index, i);
    }
  }
  for (VertexId v = 0; v < t.n_vertices(); ++v) EXPECT_EQ(numbering.entity(v).entity, v);
  EXPECT_GE(*inner.begin(), t.n_vertices());
  EXPECT_LT(*inner.rbegin(), numbering.end());
}

}  // namespace
}  // namespace st
