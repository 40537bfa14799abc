#include "io/export/hole_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace st {
namespace {

/// Adds the surface of a cube, its normals outward or inward, as triangles of one group.
void add_cube(Vec3 centre, double half, double outward, std::int32_t group, SurfaceMesh& mesh) {
  const auto first = static_cast<NodeId>(mesh.node_xyz.size());
  for (int k = 0; k < 8; ++k)
    mesh.node_xyz.push_back(centre + half * Vec3{k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0});
  const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : quads)
    for (const auto& [a, b, c] : {std::tuple{0, 1, 2}, std::tuple{0, 2, 3}}) {
      Triangle t{{first + q[a], first + q[b], first + q[c]}};
      if (outward < 0) std::swap(t.n[1], t.n[2]);
      mesh.triangles.push_back(t);
      mesh.triangle_group.push_back(group);
      mesh.triangle_face.push_back(group);
    }
}

/// Each pair of triangles, which is a side of a cube, as four about the side's middle.
void split_sides(std::size_t first, SurfaceMesh& mesh) {
  for (std::size_t t = first, n = mesh.triangles.size(); t < n; t += 2) {
    const Triangle a = mesh.triangles[t], b = mesh.triangles[t + 1];
    const auto apart = [](const Triangle& own, const Triangle& other) {  // the corner that the other one has not
      int k = 0;
      while (std::count(std::begin(other.n), std::end(other.n), own.n[k]) != 0) ++k;
      return k;
    };
    const int k = apart(a, b);
    const NodeId around[4] = {a.n[k], a.n[(k + 1) % 3], b.n[apart(b, a)], a.n[(k + 2) % 3]};
    const auto middle = static_cast<NodeId>(mesh.node_xyz.size());
    mesh.node_xyz.push_back(0.5 * (mesh.node_xyz[around[1]] + mesh.node_xyz[around[3]]));
    mesh.triangles[t] = {{around[0], around[1], middle}};
    mesh.triangles[t + 1] = {{around[1], around[2], middle}};
    for (const int i : {2, 3}) {
      mesh.triangles.push_back({{around[i], around[(i + 1) % 4], middle}});
      mesh.triangle_group.push_back(mesh.triangle_group[t]);
      mesh.triangle_face.push_back(mesh.triangle_face[t]);
    }
  }
}

SurfaceMesh with_groups() {
  SurfaceMesh mesh;
  mesh.labels.group_name = {"farfield", "body"};
  return mesh;
}

bool is_in_cube(Vec3 x, Vec3 centre, double half) {
  const Vec3 d = x - centre;
  return std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)}) < half;
}

TEST(HolePoints, a_cavity_gets_one_whatever_the_names) {
  SurfaceMesh mesh;
  mesh.labels.group_name = {"a", "b"};
  add_cube({0, 0, 0}, 10, 1, 0, mesh);
  add_cube({3, 1, 2}, 1, -1, 1, mesh);
  const HolePoints holes = find_hole_points(mesh);
  ASSERT_EQ(holes.points.size(), 1U);
  EXPECT_TRUE(is_in_cube(holes.points[0], {3, 1, 2}, 1));
}

TEST(HolePoints, bodies_within_the_far_field_get_one_each) {
  SurfaceMesh mesh = with_groups();
  add_cube({0, 0, 0}, 10, 1, 0, mesh);
  add_cube({3, 1, 2}, 1, 1, 1, mesh);
  add_cube({-4, 0, 0}, 0.5, 1, 1, mesh);
  const HolePoints holes = find_hole_points(mesh);
  ASSERT_EQ(holes.points.size(), 2U);
  EXPECT_TRUE(is_in_cube(holes.points[0], {3, 1, 2}, 1));
  EXPECT_TRUE(is_in_cube(holes.points[1], {-4, 0, 0}, 0.5));
}

TEST(HolePoints, lie_inside_where_the_other_side_is_just_as_deep_as_is_tried) {
  SurfaceMesh mesh = with_groups();
  add_cube({0, 0, 0}, 10, 1, 0, mesh);
  const std::size_t first = mesh.triangles.size();
  add_cube({3, 1, 2}, 1, 1, 1, mesh);
  split_sides(first, mesh);
  const HolePoints holes = find_hole_points(mesh);
  ASSERT_EQ(holes.points.size(), 1U);
  EXPECT_TRUE(is_in_cube(holes.points[0], {3, 1, 2}, 0.99));
}

TEST(HolePoints, parts_without_a_far_field_and_one_part_alone_have_none) {
  SurfaceMesh mesh;
  mesh.labels.group_name = {"a", "b"};
  add_cube({0, 0, 0}, 1, 1, 0, mesh);
  add_cube({5, 0, 0}, 1, 1, 1, mesh);
  EXPECT_TRUE(find_hole_points(mesh).points.empty());
  SurfaceMesh one = with_groups();
  add_cube({0, 0, 0}, 1, 1, 0, one);
  EXPECT_TRUE(find_hole_points(one).points.empty());
}

TEST(HolePoints, an_open_body_has_no_inside) {
  SurfaceMesh mesh = with_groups();
  add_cube({0, 0, 0}, 10, 1, 0, mesh);
  add_cube({3, 1, 2}, 1, 1, 1, mesh);
  mesh.triangles.pop_back();
  mesh.triangle_group.pop_back();
  mesh.triangle_face.pop_back();
  EXPECT_TRUE(find_hole_points(mesh).points.empty());
}

TEST(HolePoints, a_flat_body_keeps_its_point_inside) {
  SurfaceMesh mesh = with_groups();
  add_cube({0, 0, 0}, 10, 1, 0, mesh);
  const std::size_t first = mesh.node_xyz.size();
  add_cube({0, 0, 0}, 1, 1, 1, mesh);
  for (std::size_t n = first; n < mesh.node_xyz.size(); ++n) mesh.node_xyz[n].z *= 0.004;
  const HolePoints holes = find_hole_points(mesh);
  ASSERT_EQ(holes.points.size(), 1U);
  EXPECT_LT(std::fabs(holes.points[0].z), 0.004);
}

}  // namespace
}  // namespace st
