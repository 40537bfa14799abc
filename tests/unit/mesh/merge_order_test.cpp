// find_merge_order(): what merge_patches(), check_topology() and measure_mesh() say of the whole mesh.
#include "mesh/merge_order.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/checks.h"
#include "unit/mesh/cube_patches.h"

namespace st {
namespace {

using shapes::CubePatches;

PatchSource source_of(const std::vector<FacePatch>& patches) {
  PatchSource source;
  for (const FacePatch& p : patches) {
    source.face.push_back(p.face);
    source.n_triangles.push_back(static_cast<std::int64_t>(p.triangles.size()));
  }
  source.shape = [&patches](std::size_t i) { return patches[i]; };
  return source;
}

void expect_same_as_merged(const CubePatches& cube) {
  OrientationReport report;
  const SurfaceMesh mesh = cube.merge(report);
  const MergeOrder order = find_merge_order(cube.input(), source_of(cube.patches));
  EXPECT_EQ(order.numbers.n_nodes(), mesh.n_nodes());
  EXPECT_EQ(order.numbers.n_triangles(), mesh.n_triangles());
  EXPECT_EQ(order.orientation.turned_faces, report.turned_faces);
  EXPECT_EQ(order.orientation.inside_out_faces, report.inside_out_faces);
  EXPECT_EQ(order.orientation.turned_components, report.turned_components);
  EXPECT_EQ(order.orientation.n_one_sided, report.n_one_sided);
  const SurfaceMesh& head = order.boundary;
  ASSERT_LE(head.n_nodes(), mesh.n_nodes());
  EXPECT_TRUE(std::equal(head.node_xyz.begin(), head.node_xyz.end(), mesh.node_xyz.begin()));
  EXPECT_TRUE(std::equal(head.node_size.begin(), head.node_size.end(), mesh.node_size.begin()));
  const TopologyReport topology = check_topology(mesh, edges_of(mesh));
  EXPECT_EQ(order.facts.n_components, topology.n_components);
  EXPECT_EQ(order.facts.n_boundary_edges, topology.boundary_edges.count);
  EXPECT_EQ(order.facts.n_nonmanifold_edges, topology.nonmanifold_edges.count);
  EXPECT_EQ(order.facts.n_misoriented_edges, topology.misoriented_edges.count);
  const MeshMeasure measure = measure_mesh(mesh);
  EXPECT_EQ(order.facts.area, measure.area);
  EXPECT_NEAR(order.facts.volume, measure.volume, 1e-12);
  ASSERT_EQ(order.is_turned.size(), cube.patches.size());
  for (std::size_t i = 0; i < cube.patches.size(); ++i)
    EXPECT_EQ(order.is_turned[i] != 0,
              mesh.corner_uv[3 * order.numbers.triangle_begin[i] + 1] != corner_uv(cube.patches[i], 1));
}

TEST(MergeOrder, is_that_of_the_merged_mesh) { expect_same_as_merged({}); }

TEST(MergeOrder, turns_faces_that_disagree_and_bodies_that_are_inside_out) {
  CubePatches one, all, five;
  one.turn(3);
  for (FaceId f = 0; f < 6; ++f) all.turn(f);
  for (FaceId f = 0; f < 5; ++f) five.turn(f);
  for (const CubePatches& c : {one, all, five}) expect_same_as_merged(c);
  EXPECT_EQ(find_merge_order(all.input(), source_of(all.patches)).orientation.turned_components, 1);
}

TEST(MergeOrder, counts_open_misoriented_and_nonmanifold_edges_on_boundaries_and_inside) {
  CubePatches missing, hole, twice, turned, repeated, apart;
  missing.patches.erase(missing.patches.begin() + 2);
  std::vector<Triangle> seven = hole.patches[1].triangles;
  seven.pop_back();
  shapes::set_triangles(hole.patches[1], seven);
  const auto add = [](FacePatch& p, const Triangle& t) {
    std::vector<Triangle> triangles = p.triangles;
    triangles.push_back(t);
    shapes::set_triangles(p, triangles);
  };
  add(twice.patches[4], {twice.patches[4].triangles[2]});
  std::swap(turned.patches[5].triangles[3].n[0], turned.patches[5].triangles[3].n[1]);
  repeated.patches[0].triangles[0].n[1] = repeated.patches[0].triangles[0].n[0];
  FacePatch& p = apart.patches[3];  // a triangle of nodes inside: a component of its own
  for (const Vec3 x : {Vec3{3, 0, 0}, Vec3{4, 0, 0}, Vec3{3, 1, 0}}) p.inner_xyz.push_back(x);
  p.inner_uv.resize(5);
  p.inner_size.resize(5, 1);
  add(p, {{10, 11, 12}});
  for (const CubePatches& c : {missing, hole, twice, turned, repeated, apart}) expect_same_as_merged(c);
  EXPECT_EQ(find_merge_order(apart.input(), source_of(apart.patches)).facts.n_components, 2);
}

TEST(MergeOrder, takes_two_boundary_nodes_with_one_name_for_one_node) {
  CubePatches c;
  FacePatch& p = c.patches[2];
  p.boundary_dim.push_back(p.boundary_dim[1]);
  p.boundary_entity.push_back(p.boundary_entity[1]);
  p.boundary_index.push_back(p.boundary_index[1]);
  ++p.n_boundary;
  for (Triangle& t : p.triangles)
    for (NodeId& n : t.n) n = n >= 8 ? n + 1 : n;
  for (NodeId& n : p.triangles[0].n) n = n == 1 ? 8 : n;
  expect_same_as_merged(c);
}

TEST(MergeOrder, of_no_patches_is_an_empty_mesh) {
  CubePatches c;
  c.patches.clear();
  expect_same_as_merged(c);
}

}  // namespace
}  // namespace st
