// Steps, strips and edges far below the sizes: merged for meshing, the mesh closed and without the small triangles they
// would force.
#include "meshing/topology/small_features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/log.h"
#include "geometry/model/edge_faces.h"
#include "mesh/checks.h"
#include "mesh/edge_segments.h"
#include "support/meshed.h"

namespace st {
namespace {

struct MergedMesh : test::Meshed {
  template <class Shape>
  MergedMesh(Shape shape, double length, double merge_below)
      : test::Meshed(std::move(shape), length, MeshOptions{.merge_below = merge_below}) {}
  double shortest_side() const {
    double shortest = 1e300;
    for (const Triangle& t : mesh.triangles)
      for (int k = 0; k < 3; ++k)
        shortest = std::min(shortest, distance(mesh.node_xyz[t.n[k]], mesh.node_xyz[t.n[(k + 1) % 3]]));
    return shortest;
  }
  std::size_t n_closed() const {
    return closed_faces(topology.merged(), result.edges, topology.tables().edge_vertices).size();
  }
};

void expect_sound(const MergedMesh& m, std::int64_t euler) {
  EXPECT_TRUE(m.result.failures.empty());
  const TopologyReport topology = check_topology(m.mesh, edges_of(m.mesh));
  EXPECT_TRUE(topology.passes());
  EXPECT_EQ(topology.euler, euler);
  EXPECT_TRUE(check_shape(m.mesh, edges_of(m.mesh)).passes());
  EXPECT_TRUE(check_crossings(m.mesh).passes());
}

TEST(SmallFeatures, a_step_far_below_the_sizes_is_closed_and_forces_no_small_triangles) {
  const MergedMesh m("stepped_box", 1, 0.05);
  expect_sound(m, 2);
  EXPECT_EQ(m.topology.merged().edge.size(), 4u);
  EXPECT_EQ(m.n_closed(), 4u) << "the step and the rims of the raised half";
  EXPECT_GT(m.shortest_side(), 0.4);
  EXPECT_NEAR(measure_mesh(m.mesh).volume, 501, 1);
}

TEST(SmallFeatures, a_step_is_meshed_when_nothing_is_to_be_merged) {
  const MergedMesh m("stepped_box", 1, 0);
  expect_sound(m, 2);
  EXPECT_TRUE(m.topology.merged().empty());
  EXPECT_NEAR(m.shortest_side(), 0.02, 1e-9);
}

TEST(SmallFeatures, a_step_above_the_bound_is_kept) {
  const MergedMesh m("stepped_box", 0.2, 0.05);
  expect_sound(m, 2);
  EXPECT_TRUE(m.topology.merged().empty());
}

TEST(SmallFeatures, a_strip_is_closed_only_where_it_is_narrow) {
  const MergedMesh m("wedge_strip", 1, 0.1);
  expect_sound(m, 2);
  ASSERT_EQ(m.topology.merged().strip_face.size(), 1u);
  EXPECT_EQ(m.n_closed(), 0u);
  const FaceId strip = m.topology.merged().strip_face[0];
  double from = 1e300;
  for (std::size_t t = 0; t < m.mesh.triangles.size(); ++t)
    if (m.mesh.triangle_face[t] == strip)
      for (const NodeId n : m.mesh.triangles[t].n) from = std::min(from, m.mesh.node_xyz[n].x);
  EXPECT_NEAR(from, (0.1 - 0.02) / 0.98 * 20, 1.5) << "the strip is 0.1 wide there";
}

TEST(SmallFeatures, a_ledge_around_a_hole_is_closed) {
  const MergedMesh m("ledge_in_hole", 1, 0.05);
  expect_sound(m, 0);
  EXPECT_EQ(m.topology.merged().strip_face.size(), 4u) << "one for each pair of edges";
  EXPECT_EQ(m.n_closed(), 1u);
  EXPECT_GT(m.shortest_side(), 0.3);
  EXPECT_NEAR(measure_mesh(m.mesh).volume, 500 - 16 * 5 - (4.04 * 4.04 - 16) * 2.5, 0.5);
  EXPECT_NEAR(MergedMesh("ledge_in_hole", 1, 0).shortest_side(), 0.02, 1e-9);
}

TEST(SmallFeatures, a_plate_thinner_than_the_bound_keeps_its_two_sides) {
  const MergedMesh m("thin_plate", 1, 0.05);
  expect_sound(m, 2);
  EXPECT_EQ(m.n_closed(), 2u) << "closing neighbouring rims would give both sides the same triangles in the corners";
}

/// Edges of a box that share no face, as if each were `length` long between the first vertex of the first and `end`.
MergedFeatures merged_edges_of_box(double length, bool is_closed) {
  const Model box = test::make_model("box");
  ModelTables t = box.tables();
  const EdgeFaces faces_at(t);
  const auto is_apart = [&](EdgeId e) {
    for (int i = 0; i < 2; ++i)
      for (int k = 0; k < 2; ++k)
        if (faces_at[e][i] == faces_at[0][k]) return false;
    return true;
  };
  EdgeId other = 1;
  while (!is_apart(other)) ++other;
  for (const EdgeId e : {0, other}) {
    t.edge_vertices[2 * e] = t.edge_vertices[0];
    t.edge_vertices[2 * e + 1] = t.edge_vertices[is_closed ? 0 : 1];
    t.edge_length[e] = length;
  }
  t.vertex_xyz[t.edge_vertices[1]] = t.vertex_xyz[t.edge_vertices[0]] + Vec3{length, 0, 0};
  t.vertex_tolerance.assign(t.n_vertices(), 1e-6);
  return find_merged_features(Model(t, box.brep()), UniformField(1), 0.05);
}

TEST(SmallFeatures, edges_shorter_than_their_vertices_are_exact_are_merged_even_where_they_close_on_themselves) {
  EXPECT_EQ(merged_edges_of_box(1e-7, true).edge.size(), 2u)
      << "a hole touches the rim: both loops run through an edge from a vertex to itself";
  EXPECT_EQ(merged_edges_of_box(1e-7, false).edge.size(), 2u) << "likewise between two vertices";
}

TEST(SmallFeatures, short_edges_that_form_a_ring_are_kept) {
  EXPECT_TRUE(merged_edges_of_box(1e-3, true).edge.empty());
  EXPECT_TRUE(merged_edges_of_box(1e-3, false).edge.empty()) << "a tube as narrow as that would be cut in two";
}

TEST(SmallFeatures, merged_features_that_do_not_fit_the_geometry_are_refused) {
  const Model model = test::make_model("box");
  MergedFeatures merged;
  merged.edge = {1000};
  EXPECT_THROW(MeshTopology(model.tables(), merged), Error);
}

/// stepped_box with all its faces in a group of this tolerance (0: without), the given ones left out of it.
Model stepped_box(double tolerance, const std::vector<FaceId>& outside = {}) {
  const Model box = test::make_model("stepped_box");
  ModelTables t = box.tables();
  t.labels.group_name = {"in", "out"};
  t.labels.group_role = {"wall", "wall"};
  t.labels.face_group.assign(t.n_faces(), 0);
  for (const FaceId f : outside) t.labels.face_group[f] = 1;
  if (tolerance > 0) t.labels.group_attributes = {"{\"tolerance\":" + std::to_string(tolerance) + "}", "{}"};
  return Model(std::move(t), box.brep());
}

TEST(SmallFeatures, in_a_group_with_a_tolerance_are_merged_by_it_and_not_by_the_sizes) {
  const auto merged = [](const Model& model, double size) {
    return find_merged_features(model, UniformField(size), 0.05);
  };
  const MergedFeatures fine = merged(stepped_box(0), 0.2), coarse = merged(stepped_box(0), 1);
  EXPECT_TRUE(fine.empty()) << "the step of 0.02 is above 5 %";
  EXPECT_FALSE(coarse.empty());
  EXPECT_EQ(merged(stepped_box(0.03), 0.2), coarse) << "a tolerance above the step merges it at any size";
  EXPECT_TRUE(merged(stepped_box(0.01), 1).empty()) << "one below keeps it";
  EXPECT_TRUE(merged(stepped_box(0.03), 0.03).empty()) << "what is longer than half of the requested length stays";
  EXPECT_TRUE(find_merged_features(stepped_box(0.03), UniformField(0.2), 0).empty()) << "--merge-below 0: none";
}

TEST(SmallFeatures, between_a_group_with_a_tolerance_and_the_rest_have_the_smaller_limit) {
  const Model model = stepped_box(0.03);
  const EdgeFaces faces_at(model.tables());
  const MergedFeatures all = find_merged_features(model, UniformField(0.2), 0.05);
  ASSERT_FALSE(all.edge.empty());
  const EdgeId e = all.edge[0];
  const MergedFeatures some = find_merged_features(stepped_box(0.03, {faces_at[e][0]}), UniformField(0.2), 0.05);
  EXPECT_FALSE(std::binary_search(some.edge.begin(), some.edge.end(), e));
}

TEST(SmallFeatures, strips_in_a_group_with_a_tolerance_are_closed_by_it) {
  const MergedMesh m(stepped_box(0.03), 0.2, 0.05);
  EXPECT_TRUE(m.result.failures.empty());
  EXPECT_EQ(m.n_closed(), 4u) << "the step and the rims of the raised half";
}

/// The mesh with every edge in one group, and how many of its segments are no side of a triangle.
std::int64_t segments_beside_the_mesh(MergedMesh& m) {
  m.mesh.labels.edge_groups = {{"all", "", "{}", std::vector<std::int32_t>(m.topology.tables().n_edges())}};
  std::vector<std::int32_t>& ids = m.mesh.labels.edge_groups[0].ids;
  std::iota(ids.begin(), ids.end(), 0);
  m.mesh.merged = m.topology.merged();
  add_segments(m.mesh, m.result.edges, m.topology.tables().edge_vertices);
  std::vector<std::pair<NodeId, NodeId>> sides;
  for (const Triangle& t : m.mesh.triangles)
    for (int k = 0; k < 3; ++k) sides.push_back(std::minmax(t.n[k], t.n[(k + 1) % 3]));
  std::sort(sides.begin(), sides.end());
  std::int64_t n_beside = 0;
  for (std::size_t i = 0; i < m.mesh.segment_nodes.size(); i += 2)
    n_beside += !std::binary_search(
        sides.begin(), sides.end(),
        std::pair<NodeId, NodeId>(std::minmax(m.mesh.segment_nodes[i], m.mesh.segment_nodes[i + 1])));
  return n_beside;
}

TEST(EdgeSegments, are_sides_of_triangles_on_seams_closed_edges_and_strips) {
  for (const char* shape : {"stepped_box", "wedge_strip", "drilled_cylinder"}) {
    MergedMesh m(shape, shape == std::string("drilled_cylinder") ? 5 : 1, 0.1);
    EXPECT_EQ(segments_beside_the_mesh(m), 0) << shape;
    const auto count = [&](EdgeId e) { return std::count(m.mesh.segment_edge.begin(), m.mesh.segment_edge.end(), e); };
    for (EdgeId e = 0; e < m.topology.tables().n_edges(); ++e) {
      const std::int32_t n = m.result.edges.n_nodes(e);
      EXPECT_EQ(count(e), std::max(0, n - 1)) << shape << " edge " << e + 1 << ": also where a strip is closed";
    }
  }
}

TEST(EdgeSegments, are_none_without_groups_of_edges) {
  MergedMesh m("stepped_box", 1, 0.05);
  add_segments(m.mesh, m.result.edges, m.topology.tables().edge_vertices);
  EXPECT_TRUE(m.mesh.segment_nodes.empty());
}

}  // namespace
}  // namespace st
