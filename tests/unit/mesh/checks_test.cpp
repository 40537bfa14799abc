#include "mesh/checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "unit/mesh/shapes.h"

namespace st {
namespace {

/// Every count of every check by name, zero counts left out: "nothing else is found" is one comparison.
using Found = std::map<std::string, std::int64_t>;

Found find_all(const SurfaceMesh& m, const CadEdges& cad = {}) {
  const TopologyReport t = check_topology(m, edges_of(m), cad);
  const ShapeReport s = check_shape(m, edges_of(m));
  const CrossingReport c = check_crossings(m);
  Found found{{"boundary", t.boundary_edges.count},
              {"nonmanifold", t.nonmanifold_edges.count},
              {"misoriented", t.misoriented_edges.count},
              {"repeated", t.repeated_nodes.count},
              {"duplicate", t.duplicate_triangles.count},
              {"pinched", t.pinched_nodes.count},
              {"zero_area", s.zero_area.count},
              {"duplicate_node", s.duplicate_nodes.count},
              {"fold", s.folds.count},
              {"crossing", c.crossings.count},
              {"overlap", c.overlapping_neighbours.count},
              {"contact", c.contacts.count}};
  std::erase_if(found, [](const auto& entry) { return entry.second == 0; });
  return found;
}

/// Node nearest to p.
NodeId node_at(const SurfaceMesh& m, Vec3 p) {
  NodeId best = 0;
  for (NodeId n = 1; n < m.n_nodes(); ++n)
    if (distance(m.node_xyz[n], p) < distance(m.node_xyz[best], p)) best = n;
  return best;
}

void remove_triangle(SurfaceMesh& m, TriangleId t) {
  std::vector<Triangle> triangles = m.triangles;
  std::vector<FaceId> faces = m.triangle_face;
  triangles.erase(triangles.begin() + t);
  faces.erase(faces.begin() + t);
  m = shapes::from(m.node_xyz, triangles, faces);
}

TEST(Checks, find_nothing_in_clean_meshes) {
  for (const SurfaceMesh& m : {shapes::cube(5), shapes::sphere(6), shapes::torus(20, 10)}) {
    EXPECT_EQ(find_all(m), Found{});
    EXPECT_TRUE(check_topology(m, edges_of(m)).passes() && check_shape(m, edges_of(m)).passes() &&
                check_crossings(m).passes());
  }
}

TEST(Checks, know_genus_components_volume_and_area) {
  EXPECT_EQ(check_topology(shapes::cube(3), edges_of(shapes::cube(3))).genus, 0);
  EXPECT_EQ(check_topology(shapes::sphere(4), edges_of(shapes::sphere(4))).euler, 2);
  EXPECT_EQ(check_topology(shapes::torus(20, 10), edges_of(shapes::torus(20, 10))).genus, 1);
  const SurfaceMesh pair = shapes::join(shapes::torus(12, 8), shapes::torus(12, 8, 2, 0.5, {9, 0, 0}));
  EXPECT_EQ(check_topology(pair, edges_of(pair)).genus, 2);
  EXPECT_EQ(check_topology(pair, edges_of(pair)).n_components, 2);
  const MeshMeasure cube = measure_mesh(shapes::cube(4, {5, 6, 7}, 2));
  EXPECT_NEAR(cube.volume, 8, 1e-12);
  EXPECT_NEAR(cube.area, 24, 1e-12);
  ASSERT_EQ(cube.face_area.size(), 6u);
  for (const double a : cube.face_area) EXPECT_NEAR(a, 4, 1e-12);
  EXPECT_NEAR(measure_mesh(shapes::sphere(60)).volume, 4 * kPi / 3, 0.005);
}

TEST(Checks, count_a_lone_triangle_as_one_component) {
  const TopologyReport t = check_topology(shapes::from({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}}}),
                                          edges_of(shapes::from({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}}})));
  EXPECT_EQ(t.n_components, 1);
  EXPECT_EQ(t.euler, 1);
}

TEST(Checks, do_not_let_a_triangle_that_names_a_node_twice_change_the_genus) {
  SurfaceMesh m = shapes::sphere(4);
  m.triangles.push_back({{0, 0, 1}});
  m = shapes::from(m.node_xyz, m.triangles);
  EXPECT_EQ(check_topology(m, edges_of(m)).euler, 2);
  EXPECT_EQ(check_topology(m, edges_of(m)).genus, 0);
}

TEST(Checks, find_a_hole_and_its_place) {
  SurfaceMesh m = shapes::cube(4);
  remove_triangle(m, 0);
  EXPECT_EQ(find_all(m), (Found{{"boundary", 3}}));
  const TopologyReport t = check_topology(m, edges_of(m));
  ASSERT_EQ(t.boundary_edges.first.size(), 3u);
  EXPECT_EQ(t.boundary_edges.first[0].xyz.x, 0);
  EXPECT_EQ(t.boundary_edges.first[0].face_b, kNone);
  EXPECT_FALSE(t.passes());
}

/// A square of two triangles with its nodes on these vertices of the CAD.
SurfaceMesh square_on(std::vector<std::int32_t> vertices) {
  SurfaceMesh m = shapes::from({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{{0, 1, 2}}, {{0, 2, 3}}});
  m.node_entity_dim.assign(4, 0);
  m.node_entity = std::move(vertices);
  return m;
}

TEST(Checks, know_where_the_cad_is_open_beside_edges_drawn_together) {
  const std::vector<VertexId> edge_vertices{0, 1, 1, 2, 2, 3, 3, 4, 4, 0};
  const std::vector<std::uint8_t> all(5, 1);
  SurfaceMesh m = square_on({0, 1, 3, 4});
  EXPECT_EQ(find_all(m, {edge_vertices, all, {}}), (Found{{"boundary", 1}})) << "from vertex 1 to 3";
  m.merged.edge = {1};
  EXPECT_EQ(find_all(m, {edge_vertices, all, {}}), Found{});
}

TEST(Checks, know_where_the_cad_is_open_beside_closed_strips) {
  const std::vector<VertexId> edge_vertices{0, 1, 1, 2, 2, 3, 3, 0, 0, 1};
  const std::vector<std::uint8_t> but_kept{0, 1, 1, 1, 1};
  SurfaceMesh m = square_on({0, 0, 2, 3});
  m.node_entity_dim[1] = 1;  // on the kept edge
  EXPECT_EQ(find_all(m, {edge_vertices, but_kept, {}}).at("boundary"), 2);
  m.merged.strip_kept = {0}, m.merged.strip_closed = {4};
  EXPECT_EQ(find_all(m, {edge_vertices, but_kept, {}}), Found{});
}

TEST(Checks, find_a_fin_on_a_manifold_edge) {
  SurfaceMesh m = shapes::cube(2);
  std::vector<Vec3> points = m.node_xyz;
  std::vector<Triangle> triangles = m.triangles;
  std::vector<FaceId> faces = m.triangle_face;
  points.push_back({-3, 0.2, 0.1});
  triangles.push_back({{node_at(m, {0, 0, 0}), node_at(m, {0, 0.5, 0}), static_cast<NodeId>(points.size() - 1)}});
  faces.push_back(9);
  EXPECT_EQ(find_all(shapes::from(points, triangles, faces)), (Found{{"boundary", 2}, {"nonmanifold", 1}}));
}

TEST(Checks, find_a_triangle_turned_over) {
  SurfaceMesh m = shapes::cube(4);
  std::swap(m.triangles[7].n[0], m.triangles[7].n[1]);
  EXPECT_EQ(find_all(m), (Found{{"misoriented", 3}}));
}

TEST(Checks, find_a_triangle_that_names_a_node_twice) {
  SurfaceMesh m = shapes::cube(4);
  std::vector<Triangle> triangles = m.triangles;
  std::vector<FaceId> faces = m.triangle_face;
  triangles.push_back({{4, 4, 5}});
  faces.push_back(2);
  EXPECT_EQ(find_all(shapes::from(m.node_xyz, triangles, faces)), (Found{{"repeated", 1}}));
}

TEST(Checks, find_a_triangle_without_area) {
  SurfaceMesh m = shapes::cube(2);
  // The middle of the diagonal of a quad is put between its two triangles as a node of a third one.
  std::vector<Vec3> points = m.node_xyz;
  std::vector<Triangle> triangles = m.triangles;
  std::vector<FaceId> faces = m.triangle_face;
  const Triangle first = triangles[0];
  const auto middle = static_cast<NodeId>(points.size());
  const Triangle second = triangles[1];
  std::vector<NodeId> common;
  for (const NodeId a : first.n)
    if (std::count(second.n, second.n + 3, a)) common.push_back(a);
  ASSERT_EQ(common.size(), 2u);
  points.push_back(0.5 * (points[common[0]] + points[common[1]]));
  // first is split at the middle, second is not: the gap between them is a triangle without area.
  int k = 0;
  while (!(std::count(common.begin(), common.end(), first.n[k]) &&
           std::count(common.begin(), common.end(), first.n[(k + 1) % 3])))
    ++k;
  const NodeId a = first.n[k], b = first.n[(k + 1) % 3], c = first.n[(k + 2) % 3];
  triangles[0] = {{a, middle, c}};
  triangles.push_back({{middle, b, c}});
  triangles.push_back({{a, b, middle}});
  faces.insert(faces.end(), {faces[0], faces[0]});
  const Found found = find_all(shapes::from(points, triangles, faces));
  EXPECT_EQ(found.at("zero_area"), 1);
  EXPECT_EQ(found.count("boundary") + found.count("nonmanifold") + found.count("misoriented") + found.count("fold") +
                found.count("duplicate_node"),
            0u);
}

TEST(Checks, find_a_triangle_present_twice) {
  SurfaceMesh m = shapes::cube(4);
  std::vector<Triangle> triangles = m.triangles;
  std::vector<FaceId> faces = m.triangle_face;
  triangles.push_back({{triangles[3].n[1], triangles[3].n[0], triangles[3].n[2]}});
  faces.push_back(7);
  EXPECT_EQ(find_all(shapes::from(m.node_xyz, triangles, faces)), (Found{{"duplicate", 1}, {"nonmanifold", 3}}));
}

TEST(Checks, find_two_nodes_at_one_place) {
  SurfaceMesh m = shapes::cube(4);
  const NodeId original = node_at(m, {0, 0.5, 0.5});
  std::vector<Vec3> points = m.node_xyz;
  points.push_back(points[original]);
  const auto copy = static_cast<NodeId>(points.size() - 1);
  std::vector<Triangle> triangles = m.triangles;
  const auto user = std::find_if(triangles.begin(), triangles.end(),
                                 [&](const Triangle& t) { return std::count(t.n, t.n + 3, original); });
  std::replace(user->n, user->n + 3, original, copy);
  const Found found = find_all(shapes::from(points, triangles, m.triangle_face));
  EXPECT_EQ(found.at("duplicate_node"), 1);
  EXPECT_EQ(found.at("boundary"), 4) << "the slit";
  EXPECT_EQ(found.count("nonmanifold") + found.count("misoriented") + found.count("fold") + found.count("zero_area"),
            0u);
}

TEST(Checks, ignore_nodes_of_different_parts_at_one_place) {
  const Found found = find_all(shapes::join(shapes::cube(2), shapes::cube(2, {1, 1, 1})));
  EXPECT_EQ(found.count("duplicate_node"), 0u);
  EXPECT_EQ(found.count("crossing"), 0u);
  EXPECT_GT(found.at("contact"), 0);
}

TEST(Checks, find_parts_that_hang_together_by_one_node) {
  SurfaceMesh m = shapes::join(shapes::cube(2), shapes::cube(2, {1, 1, 1}));
  const NodeId a = node_at(m, {1, 1, 1});
  for (Triangle& t : m.triangles)
    for (NodeId& n : t.n)
      if (n != a && m.node_xyz[n] == m.node_xyz[a]) n = a;
  EXPECT_EQ(find_all(m), (Found{{"pinched", 1}}));
}

TEST(Checks, find_a_fold) {
  SurfaceMesh m = shapes::cube(8);
  // A node of a flat side pulled across its neighbours' far edge in the same plane, and a little up so that nothing is
  // exactly flat.
  const NodeId n = node_at(m, {0.5, 0.5, 1});
  m.node_xyz[n] = {0.5 + 0.19, 0.5 + 0.03, 1 + 1e-3};
  const Found found = find_all(m);
  ASSERT_EQ(found.count("fold"), 1u);
  EXPECT_EQ(check_shape(m, edges_of(m)).folds.first[0].face_a, 5);
  for (const char* other : {"boundary", "nonmanifold", "misoriented", "repeated", "duplicate", "pinched", "zero_area",
                            "duplicate_node", "contact"})
    EXPECT_EQ(found.count(other), 0u) << other;
}

TEST(Checks, do_not_take_a_sharp_edge_of_the_cad_for_a_fold) {
  SurfaceMesh m = shapes::cube(4);
  for (Vec3& p : m.node_xyz)
    p.z = p.x * (p.z - 0.5) * 0.05;  // a wedge with an edge of 3 degrees, which collapses at x = 0
  const ShapeReport s = check_shape(m, edges_of(m));
  EXPECT_EQ(s.folds.count, 0);
}

TEST(Checks, do_not_take_a_sharp_seam_for_a_fold) {
  // one face about a thin wedge, closed at a seam from node 0 to node 1
  SurfaceMesh m =
      shapes::from({{0, 0, 0}, {0, 1, 0}, {1, 0.5, 0.02}, {1, 0.5, -0.02}}, {{{0, 2, 1}}, {{0, 1, 3}}}, {0, 0});
  m.node_entity_dim = {1, 1, 2, 2};
  m.corner_uv = {{0, 0}, {0.4, 0.5}, {0, 1}, {1, 0}, {1, 1}, {0.6, 0.5}};
  EXPECT_EQ(check_shape(m, edges_of(m)).folds.count, 0);
  m.corner_uv = {{0, 0}, {0.4, 0.5}, {0, 1},
                 {0, 0}, {0, 1},     {0.6, 0.5}};  // no seam: the same place of (u,v) on both sides
  EXPECT_EQ(check_shape(m, edges_of(m)).folds.count, 1);
}

TEST(Checks, do_not_take_a_sharp_seam_that_ends_at_a_pole_for_a_fold) {
  SurfaceMesh m =
      shapes::from({{0, 0, 0}, {0, 1, 0}, {1, 0.5, 0.02}, {1, 0.5, -0.02}}, {{{0, 2, 1}}, {{0, 1, 3}}}, {0, 0});
  m.node_entity_dim = {0, 1, 2, 2};
  m.corner_uv = {{0, 0}, {0.4, 0.5}, {0, 1}, {0, 0}, {1, 1}, {0.6, 0.5}};  // node 0 has one (u,v) on both sides
  EXPECT_EQ(check_shape(m, edges_of(m)).folds.count, 0);
}

TEST(Checks, find_crossing_triangles_within_one_part) {
  SurfaceMesh m = shapes::cube(8);
  m.node_xyz[node_at(m, {0.5, 0.5, 1})].z = -0.2;  // a spike through the opposite side
  const Found found = find_all(m);
  ASSERT_EQ(found.count("crossing"), 1u);
  for (const auto& [name, count] : found) EXPECT_TRUE(name == "crossing") << name;
  const CrossingReport c = check_crossings(m);
  EXPECT_EQ(std::minmax({c.crossings.first[0].face_a, c.crossings.first[0].face_b}), (std::pair<FaceId, FaceId>{4, 5}));
}

TEST(Checks, set_crossings_apart_where_the_cad_touches_itself) {
  SurfaceMesh m = shapes::cube(8);
  m.node_xyz[node_at(m, {0.5, 0.5, 1})].z = -0.2;
  const std::int64_t n = check_crossings(m).crossings.count;
  TriangleId excused = kNone;
  const auto touches_itself = [&](const TrianglePair& pair) {
    if (excused == kNone) excused = pair.a;
    return pair.a == excused;
  };
  const CrossingReport c = check_crossings(m, {touches_itself});
  EXPECT_GT(c.cad_contacts.count, 0);
  EXPECT_GT(c.crossings.count, 0);
  EXPECT_EQ(c.cad_contacts.count + c.crossings.count, n);
  const CrossingReport sheet = check_crossings(m, {touches_itself, {}, {}, [](const TrianglePair&) { return true; }});
  EXPECT_EQ(sheet.contacts.count, c.cad_contacts.count) << "a sheet that ends on a body";
  EXPECT_EQ(sheet.cad_contacts.count, 0);
}

TEST(Checks, take_vertices_of_the_cad_at_one_place_as_they_are) {
  SurfaceMesh m = shapes::cube(2);
  m.node_entity_dim.assign(m.n_nodes(), 2);
  const NodeId a = node_at(m, {0.5, 0.5, 1}), b = node_at(m, {0.5, 0.5, 0});
  m.node_xyz[b] = m.node_xyz[a];
  EXPECT_EQ(check_shape(m, edges_of(m)).duplicate_nodes.count, 1);
  m.node_entity_dim[a] = 0;
  EXPECT_EQ(check_shape(m, edges_of(m)).duplicate_nodes.count, 1);
  m.node_entity_dim[b] = 0;
  EXPECT_EQ(check_shape(m, edges_of(m)).duplicate_nodes.count, 0);
}

TEST(Checks, find_neighbours_that_lie_on_each_other) {
  SurfaceMesh m = shapes::cube(4);
  const NodeId n = node_at(m, {0.5, 0.5, 1});
  m.node_xyz[n] = {0.5 + 0.3, 0.5 + 0.05, 1};  // in the plane of the side, beyond the neighbours
  const Found found = find_all(m);
  EXPECT_EQ(found.count("overlap"), 1u);
  EXPECT_EQ(found.count("fold"), 1u);
}

TEST(Checks, allow_open_and_nonmanifold_edges_only_where_the_cad_has_them) {
  // One quad of two triangles on the vertices 0-3 and the nodes of edge 0 = (0, 1).
  SurfaceMesh m =
      shapes::from({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {1, 0, 0}}, {{{0, 4, 3}}, {{4, 2, 3}}, {{4, 1, 2}}});
  m.node_entity_dim = {0, 0, 0, 0, 1};
  m.node_entity = {0, 1, 2, 3, 0};
  const std::vector<VertexId> edge_vertices{0, 1, 1, 2, 2, 3, 3, 0};
  std::vector<std::uint8_t> open{1, 1, 1, 1};
  EXPECT_EQ(find_all(m, {edge_vertices, open, {}}), Found{});
  EXPECT_EQ(check_topology(m, edges_of(m), {edge_vertices, open, {}}).n_cad_boundary_edges, 5);
  open[0] = 0;
  EXPECT_EQ(find_all(m, {edge_vertices, open, {}}), (Found{{"boundary", 2}}));
  open = {1, 0, 1, 1};
  EXPECT_EQ(find_all(m, {edge_vertices, open, {}}), (Found{{"boundary", 1}}));
  EXPECT_EQ(find_all(m), (Found{{"boundary", 5}}));
}

TEST(Checks, do_not_allow_a_hole_between_two_open_edges_of_the_cad) {
  // A square cut off at a corner: nodes 3 and 4 lie inside the open edges 1 and 2, but nothing of the CAD runs from one
  // to the other.
  SurfaceMesh m =
      shapes::from({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 1, 0}, {1, 2, 0}}, {{{0, 1, 3}}, {{0, 3, 4}}, {{0, 4, 2}}});
  m.node_entity_dim = {0, 0, 0, 1, 1};
  m.node_entity = {0, 1, 3, 1, 2};
  const std::vector<VertexId> edge_vertices{0, 1, 1, 2, 2, 3, 3, 0};
  const std::vector<std::uint8_t> open{1, 1, 1, 1};
  EXPECT_EQ(find_all(m, {edge_vertices, open, {}}), (Found{{"boundary", 1}}));
}

TEST(Checks, give_at_most_ten_places) {
  SurfaceMesh m = shapes::cube(4);
  std::vector<Triangle> triangles;
  std::vector<FaceId> faces;
  for (std::size_t t = 0; t < m.triangles.size(); ++t)
    if (m.triangle_face[t] != 5) triangles.push_back(m.triangles[t]), faces.push_back(m.triangle_face[t]);
  const TopologyReport r =
      check_topology(shapes::from(m.node_xyz, triangles, faces), edges_of(shapes::from(m.node_xyz, triangles, faces)));
  EXPECT_EQ(r.boundary_edges.count, 16);
  EXPECT_EQ(r.boundary_edges.first.size(), Defects::kMaxPlaces);
}

TEST(Checks, of_a_mesh_without_triangles_find_nothing) { EXPECT_EQ(find_all(shapes::from({}, {})), Found{}); }

}  // namespace
}  // namespace st
