// Whether layers of prisms can grow from a mesh.
#include "mesh/layers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/mesh/shapes.h"

namespace st {
namespace {

using shapes::cube;
using shapes::from;

const std::vector<LayerRole> kWalls = {LayerRole::kWall};

TEST(SmallestCone, holds_all_directions_and_touches_the_outermost) {
  const std::vector<Vec3> axes = {
      {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, normalized(Vec3{1, 1, 1}), normalized(Vec3{2, 1, 1})};
  EXPECT_NEAR(distance(smallest_cone(axes), normalized(Vec3{1, 1, 1})), 0, 1e-12);
  const std::vector<Vec3> two = {{1, 0, 0}, normalized(Vec3{1, 1, 0}), {0, 1, 0}};
  EXPECT_NEAR(distance(smallest_cone(two), normalized(Vec3{1, 1, 0})), 0, 1e-12);
  const std::vector<Vec3> one = {{0, 0, 1}};
  EXPECT_EQ(smallest_cone(one).z, 1);
}

TEST(Layers, grow_from_a_cube_along_the_diagonals_of_its_corners) {
  const LayersReport r = check_layers(cube(4), kWalls, {0.1});
  EXPECT_EQ(r.n_nodes, 98);
  EXPECT_NEAR(r.widest, std::acos(1 / std::sqrt(3.0)), 1e-9);
  EXPECT_EQ(r.blind.count, 0);
  EXPECT_EQ(r.fans.count, 0) << "a right angle needs none";
  EXPECT_EQ(r.wedges.count, 0);
  EXPECT_EQ(r.tight.count, 0);
  EXPECT_EQ(r.room, 1);
}

TEST(Layers, inside_of_a_cube_find_its_walls_nearer_than_two_heights) {
  const SurfaceMesh mesh = cube(4);
  EXPECT_EQ(check_layers(mesh, kWalls, {0.4, true}).tight.count, 0) << "two of 0.4 fit into 1 but for corners";
  const LayersReport r = check_layers(mesh, kWalls, {0.8, true});
  EXPECT_GE(r.tight.count, 6 * 9);
  EXPECT_NEAR(r.room, 1 / 1.6, 1e-9);
}

TEST(Layers, fan_out_around_a_sharp_edge_and_collide_in_a_narrow_corner) {
  const SurfaceMesh split = from({{0, 0, 0}, {0, 1, 0}, {1, 0, 0.05}, {1, 0, -0.05}, {1, 1, 0.05}, {1, 1, -0.05}},
                                 {{{0, 2, 4}}, {{0, 4, 1}}, {{0, 5, 3}}, {{0, 1, 5}}}, {0, 0, 1, 1});
  const LayersReport fan = check_layers(split, kWalls, {0.001});
  EXPECT_EQ(fan.fans.count, 1);
  EXPECT_EQ(fan.wedges.count, 0);
  EXPECT_NEAR(fan.fan_length, 1, 1e-12);
  EXPECT_NEAR(fan.widest, kPi / 2 - std::atan(0.05), 1e-9);
  const LayersReport corner = check_layers(split, kWalls, {0.001, true});
  EXPECT_EQ(corner.fans.count, 0);
  EXPECT_EQ(corner.wedges.count, 1);
  EXPECT_NEAR(corner.wedge_length, 1, 1e-12);
}

TEST(Layers, have_no_direction_where_triangles_look_all_ways) {
  constexpr int kSides = 12;  // two cones, tip to tip
  std::vector<Vec3> points = {{0, 0, 0}};
  std::vector<Triangle> triangles;
  for (const int up : {0, 1})
    for (int k = 0; k < kSides; ++k) {
      const double a = 2 * kPi * k / kSides;
      points.push_back({std::cos(a), std::sin(a), up ? 1.0 : -1.0});
      const NodeId own = 1 + up * kSides + k, next = 1 + up * kSides + (k + 1) % kSides;
      triangles.push_back(up ? Triangle{{0, next, own}} : Triangle{{0, own, next}});
    }
  const LayersReport r = check_layers(from(points, triangles), kWalls, {0.01});
  EXPECT_EQ(r.fans.count + r.wedges.count, 0);
  ASSERT_EQ(r.blind.count, 1);
  EXPECT_EQ(r.blind.first[0].xyz.z, 0);
  EXPECT_GT(r.widest, kPi / 2);
}

TEST(Layers, run_along_a_plane_of_symmetry_and_do_not_grow_from_it) {
  SurfaceMesh mesh = from({{0, 0, 0}, {0, 1, 0}, {1, 1, 1}, {1, 0, 1}, {-1, 0, 0}, {-1, 1, 0}},
                          {{{0, 3, 2}}, {{0, 2, 1}}, {{0, 1, 5}}, {{0, 5, 4}}});
  mesh.triangle_group = {0, 0, 1, 1};
  const LayersReport r = check_layers(mesh, std::vector{LayerRole::kWall, LayerRole::kPlane}, {0.1});
  EXPECT_EQ(r.n_nodes, 4) << "two inside the plane have no wall";
  EXPECT_NEAR(r.widest, kPi / 4, 1e-9) << "between the wall's normal and the plane";
  EXPECT_EQ(check_layers(mesh, std::vector(2, LayerRole::kNone), {0.1}).n_nodes, 0);
}

TEST(Layers, run_along_the_line_between_two_planes) {
  SurfaceMesh mesh = from({{0, 0, 0}, {0, 1, 0}, {1, 1, 1}, {1, 0, 1}, {-1, 0, 0}, {-1, 1, 0}},
                          {{{0, 3, 2}}, {{0, 2, 1}}, {{0, 1, 5}}, {{0, 5, 4}}, {{0, 4, 3}}});
  mesh.triangle_group = {0, 0, 1, 1, 1};  // z = 0, and y = 0 by one triangle
  const LayersReport r = check_layers(mesh, std::vector{LayerRole::kWall, LayerRole::kPlane}, {0.1});
  EXPECT_NEAR(r.widest, kPi / 4, 1e-9) << "in node 0 along x, as both planes want";
}

TEST(Layers, do_not_mind_triangles_without_area) {
  const SurfaceMesh mesh = from({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0, 0}}, {{{0, 1, 2}}, {{0, 3, 1}}});
  const LayersReport r = check_layers(mesh, kWalls, {0.1});
  EXPECT_EQ(r.blind.count, 0);
  EXPECT_EQ(r.n_nodes, 3) << "one has no other triangle";
}

TEST(Layers, of_a_boundary_layer_are_as_high_as_the_plates) {
  EXPECT_NEAR(boundary_layer_thickness(1e6, 2), 0.37 * 2 / std::pow(10, 1.2), 1e-12);
}

}  // namespace
}  // namespace st
