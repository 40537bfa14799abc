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

bool same(const SurfaceMesh& a, const SurfaceMesh& b) {
  return a.node_xyz == b.node_xyz && a.node_entity_dim == b.node_entity_dim && a.node_entity == b.node_entity && a.node_t == b.node_t &&
         a.node_size == b.node_size &&
         std::equal(a.triangles.begin(), a.triangles.end(), b.triangles.begin(), b.triangles.end(),
                    [](const Triangle& x, const Triangle& y) { return std::equal(x.n, x.n + 3, y.n); }) &&
         a.triangle_face == b.triangle_face && a.triangle_group == b.triangle_group && a.corner_uv == b.corner_uv;
}

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
    EXPECT_LT(std::pair(m.node_entity_dim[n - 1], m.node_entity[n - 1]), std::pair(m.node_entity_dim[n], m.node_entity[n]));
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
    for (int k = 0; k < 3; ++k) EXPECT_EQ(m.corner_uv[3 * t + k], (Vec2{double(m.triangle_face[t]), double(3 * (t % 8) + k)}));
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
  for (std::size_t i = 0; i < c.edges.node_xyz.size(); ++i) c.edges.node_request.push_back(100 + static_cast<double>(i));
  const SurfaceMesh m = c.merge();
  for (NodeId n = 0; n < 8; ++n) {
    ASSERT_EQ(m.node_entity_dim[n], 0);
    const VertexId v = m.node_entity[n];
    const std::size_t end = std::find(c.edge_vertices.begin(), c.edge_vertices.end(), v) - c.edge_vertices.begin();
    EXPECT_EQ(m.node_size[n], 100 + static_cast<double>(3 * (end / 2) + (end % 2 ? 2 : 0)));
  }
  for (NodeId n = 8; n < 20; ++n) EXPECT_EQ(m.node_size[n], 100 + 3 * m.node_entity[n] + 1) << "requests, not the lengths it was made for";
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
  EXPECT_TRUE(fails([](FacePatch& p) { p.corner_uv.pop_back(); }));
  CubePatches twice;
  twice.patches.push_back(twice.patches[0]);
  EXPECT_THROW(twice.merge(), Error);
}

TEST(Orientation, of_a_consistent_cube_is_left_alone) {
  OrientationReport report;
  CubePatches().merge(report);
  EXPECT_TRUE(report.turned_faces.empty());
  EXPECT_EQ(report.turned_components, 0);
}

TEST(Orientation, turns_the_faces_that_disagree_with_their_neighbours) {
  CubePatches c;
  const SurfaceMesh expected = c.merge();
  c.turn(1);
  c.turn(4);
  OrientationReport report;
  const SurfaceMesh m = c.merge(report);
  EXPECT_EQ(report.turned_faces, (std::vector<FaceId>{1, 4}));
  EXPECT_TRUE(same(m, expected));
}

TEST(Orientation, of_a_face_follows_all_its_edges_whatever_one_triangle_says) {
  const SurfaceMesh good = shapes::cube(4);
  for (std::size_t t = 0; t < good.triangles.size(); ++t) {
    SurfaceMesh m = good;
    std::swap(m.triangles[t].n[1], m.triangles[t].n[2]);
    const OrientationReport report = orient_outward(m);
    EXPECT_TRUE(report.turned_faces.empty()) << t;
    EXPECT_EQ(report.n_one_sided, 0) << t;
  }
}

TEST(Orientation, turns_a_void_with_its_own_body_not_with_the_outermost) {
  SurfaceMesh m = shapes::cube(1);
  for (const auto& [lo, is_turned] : {std::pair(0.1, true), std::pair(0.2, true), std::pair(0.3, false)}) {
    SurfaceMesh next = shapes::cube(1, {lo, lo, lo}, 1 - 2 * lo);
    if (is_turned) shapes::turn(next);
    m = shapes::join(m, next);
  }
  // as it should be: body, void, body, void; the second body and its void are inside out
  EXPECT_EQ(orient_outward(m).turned_components, 2);
  EXPECT_NEAR(shapes::volume(m), 1 - 0.512 + 0.216 - 0.064, 1e-12);
}

TEST(Orientation, turns_a_body_that_is_inside_out) {
  CubePatches c;
  for (FaceId f = 0; f < 6; ++f) c.turn(f);
  OrientationReport report;
  const SurfaceMesh m = c.merge(report);
  EXPECT_TRUE(report.turned_faces.empty());
  EXPECT_EQ(report.turned_components, 1);
  EXPECT_EQ(report.inside_out_faces.size(), 6u);
  EXPECT_DOUBLE_EQ(shapes::volume(m), 1);
}

TEST(Orientation, leaves_a_void_pointing_inwards) {
  SurfaceMesh hole = shapes::cube(2, {0.25, 0.25, 0.25}, 0.5);
  shapes::turn(hole);
  SurfaceMesh m = shapes::join(shapes::cube(3), hole);
  EXPECT_EQ(orient_outward(m).turned_components, 0);
  EXPECT_NEAR(shapes::volume(m), 1 - 0.125, 1e-12);
}

TEST(Orientation, turns_a_body_inside_a_void_and_a_void_of_a_turned_body) {
  SurfaceMesh hole = shapes::cube(2, {0.25, 0.25, 0.25}, 0.5), core = shapes::cube(1, {0.4, 0.4, 0.4}, 0.2);
  shapes::turn(hole);
  SurfaceMesh m = shapes::join(shapes::join(shapes::cube(3), hole), core);
  const double expected = shapes::volume(m);
  shapes::turn(m);
  EXPECT_EQ(orient_outward(m).turned_components, 3);
  EXPECT_NEAR(shapes::volume(m), expected, 1e-12);
}

TEST(Orientation, turns_a_body_beside_another_even_when_they_touch) {
  SurfaceMesh beside = shapes::cube(2, {1, 0.25, 0.25}, 0.5);
  shapes::turn(beside);
  SurfaceMesh m = shapes::join(shapes::cube(4), beside);
  EXPECT_EQ(orient_outward(m).turned_components, 1);
  EXPECT_NEAR(shapes::volume(m), 1.125, 1e-12);
}

TEST(Orientation, of_an_open_surface_follows_the_larger_area) {
  SurfaceMesh m = shapes::cube(2);
  const auto keep = [&](FaceId removed) {
    SurfaceMesh open = m;
    open.triangles.clear();
    std::vector<FaceId> faces;
    for (std::int64_t t = 0; t < m.n_triangles(); ++t)
      if (m.triangle_face[t] != removed) open.triangles.push_back(m.triangles[t]), faces.push_back(m.triangle_face[t]);
    return shapes::from(open.node_xyz, open.triangles, faces);
  };
  SurfaceMesh open = keep(5);
  shapes::turn(open, 0);
  EXPECT_EQ(orient_outward(open).turned_faces, std::vector<FaceId>{0});
}

TEST(Orientation, of_a_one_sided_strip_is_reported_and_left) {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::vector<FaceId> faces;
  constexpr int n = 12;
  for (int i = 0; i < n; ++i) {
    const double u = 2 * kPi * i / n, w = u / 2;
    for (const double s : {-0.3, 0.3})
      points.push_back({(1 + s * std::cos(w)) * std::cos(u), (1 + s * std::cos(w)) * std::sin(u), s * std::sin(w)});
    const bool last = i == n - 1;
    const NodeId a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    triangles.push_back({{a, b, d}});
    triangles.push_back({{a, d, c}});
    faces.insert(faces.end(), {i / 4, i / 4});
  }
  SurfaceMesh m = shapes::from(points, triangles, faces);
  const OrientationReport report = orient_outward(m);
  EXPECT_EQ(report.n_one_sided, 1);
  EXPECT_TRUE(report.turned_faces.empty());
}

}  // namespace
}  // namespace st
