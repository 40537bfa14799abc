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
