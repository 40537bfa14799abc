// orient_outward(): which faces and which closed parts are turned, and which are left alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "mesh/adjacency.h"
#include "mesh/merge.h"
#include "unit/mesh/cube_patches.h"
#include "unit/mesh/shapes.h"

namespace st {
namespace {

using shapes::CubePatches;
using shapes::same;

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

TEST(Orientation, done_twice_changes_nothing_more) {
  SurfaceMesh inner = shapes::cube(2, {0.25, 0.25, 0.25}, 0.5);
  SurfaceMesh m = shapes::join(shapes::cube(3), inner);
  shapes::turn(m, 3);
  shapes::turn(m, 8);
  orient_outward(m);
  const SurfaceMesh once = m;
  const OrientationReport again = orient_outward(m);
  EXPECT_TRUE(again.turned_faces.empty());
  EXPECT_EQ(again.turned_components, 0);
  EXPECT_TRUE(same(m, once));
}

TEST(Orientation, takes_the_uv_of_the_corners_along) {
  SurfaceMesh m = shapes::cube(2);
  for (std::size_t c = 0; c < m.corner_uv.size(); ++c)
    m.corner_uv[c] = {double(m.triangles[c / 3].n[c % 3]), double(c / 3)};
  shapes::turn(m, 2);
  for (std::size_t t = 0; t < m.triangles.size(); ++t)
    if (m.triangle_face[t] == 2) std::swap(m.corner_uv[3 * t + 1], m.corner_uv[3 * t + 2]);
  EXPECT_EQ(orient_outward(m).turned_faces, std::vector<FaceId>{2});
  for (std::size_t c = 0; c < m.corner_uv.size(); ++c)
    EXPECT_EQ(m.corner_uv[c], (Vec2{double(m.triangles[c / 3].n[c % 3]), double(c / 3)})) << c;
}

TEST(Orientation, names_the_faces_of_an_inside_out_body_and_no_others) {
  SurfaceMesh m = shapes::join(shapes::cube(2), shapes::cube(2, {3, 0, 0}, 1));
  for (FaceId f = 6; f < 12; ++f) shapes::turn(m, f);
  const OrientationReport report = orient_outward(m);
  EXPECT_EQ(report.inside_out_faces, (std::vector<FaceId>{6, 7, 8, 9, 10, 11}));
  EXPECT_TRUE(report.turned_faces.empty());
  EXPECT_EQ(report.turned_components, 1);
  EXPECT_NEAR(shapes::volume(m), 2, 1e-12);
}

TEST(Orientation, reports_a_face_that_disagreed_inside_a_body_that_is_inside_out) {
  SurfaceMesh m = shapes::cube(2);
  shapes::turn(m);
  shapes::turn(m, 4);  // the only one that is right
  const OrientationReport report = orient_outward(m);
  EXPECT_EQ(report.turned_faces, std::vector<FaceId>{4});
  EXPECT_EQ(report.turned_components, 1);
  EXPECT_NEAR(shapes::volume(m), 1, 1e-12);
}

TEST(Orientation, leaves_a_body_inside_a_body_alone) {
  SurfaceMesh m = shapes::join(shapes::cube(3), shapes::cube(2, {0.25, 0.25, 0.25}, 0.5));
  EXPECT_EQ(orient_outward(m).turned_components, 0)
      << "a sheet and a solid may overlap: nothing says that it is a void";
  EXPECT_NEAR(shapes::volume(m), 1.125, 1e-12);
}

TEST(Orientation, leaves_an_open_surface_of_negative_volume_alone) {
  SurfaceMesh all = shapes::cube(2, {5, 5, 5}, 1);
  SurfaceMesh m = all;
  m.triangles.pop_back();
  m.triangle_face.pop_back();
  m.triangle_group.pop_back();
  m.corner_uv.resize(3 * m.triangles.size());
  shapes::turn(m);
  const SurfaceMesh before = m;
  const OrientationReport report = orient_outward(m);
  EXPECT_EQ(report.turned_components, 0) << "one triangle is missing";
  EXPECT_TRUE(same(m, before));
}

/// Nodes at one place are one.
SurfaceMesh welded(const SurfaceMesh& m) {
  std::map<std::tuple<double, double, double>, NodeId> ids;
  std::vector<Vec3> points;
  std::vector<Triangle> triangles = m.triangles;
  for (Triangle& t : triangles)
    for (NodeId& n : t.n) {
      const Vec3 p = m.node_xyz[n];
      const auto [it, is_new] = ids.emplace(std::tuple(p.x, p.y, p.z), static_cast<NodeId>(points.size()));
      if (is_new) points.push_back(p);
      n = it->second;
    }
  return shapes::from(points, triangles, m.triangle_face);
}

TEST(Orientation, of_bodies_that_share_an_edge_is_that_of_each) {
  SurfaceMesh beside = shapes::cube(2, {1, 1, 0}, 1);  // its edge x = y = 1 is the first one's
  shapes::turn(beside);
  SurfaceMesh m = welded(shapes::join(shapes::cube(2), beside));
  ASSERT_EQ(m.n_nodes(), 2 * 26 - 3);
  const OrientationReport report = orient_outward(m);
  EXPECT_EQ(report.turned_components, 1);
  EXPECT_EQ(report.inside_out_faces, (std::vector<FaceId>{6, 7, 8, 9, 10, 11}));
  EXPECT_NEAR(shapes::volume(m), 2, 1e-12);
}

TEST(Orientation, does_not_pass_over_an_edge_of_three_faces) {
  SurfaceMesh m = shapes::from({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}},
                               {{{0, 1, 2}}, {{0, 1, 3}}, {{0, 1, 4}}}, {0, 1, 2});
  const SurfaceMesh before = m;
  EXPECT_TRUE(orient_outward(m).turned_faces.empty()) << "no two of three can be said to be neighbours";
  EXPECT_TRUE(same(m, before));
}

TEST(Orientation, of_a_tie_keeps_the_face_of_lowest_number) {
  SurfaceMesh m = shapes::from({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{{0, 2, 1}}, {{0, 2, 3}}}, {0, 1});
  EXPECT_EQ(orient_outward(m).turned_faces, std::vector<FaceId>{1});
  EXPECT_EQ(m.triangles[0].n[1], 2);
}

TEST(Orientation, of_nothing_is_nothing) {
  SurfaceMesh empty;
  const OrientationReport report = orient_outward(empty);
  EXPECT_TRUE(report.turned_faces.empty());
  EXPECT_EQ(report.n_one_sided, 0);
}

}  // namespace
}  // namespace st
