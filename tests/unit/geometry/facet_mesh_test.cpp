#include "geometry/facet/facet_mesh.h"

#include <gtest/gtest.h>

#include <numeric>

#include "geometry/facet/facet_faces.h"
#include "unit/geometry/facet_inputs.h"

namespace st {
namespace {

std::vector<std::int32_t> all_triangles(const FacetMesh& mesh) {
  std::vector<std::int32_t> all(mesh.corners.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// The triangles of a piece and those that cuts of others made of them.
std::vector<std::int32_t> all_of_face(const FacetMesh& mesh, const FacetPatch& piece) {
  for (FacetPatch& p : PatchFinder(mesh).find(all_triangles(mesh)))
    if (std::ranges::binary_search(p.triangles, piece.triangles.front())) return p.triangles;
  return {};
}

TEST(FacetPatches, are_what_lines_do_not_part) {
  const FacetMesh mesh = find_smooth_faces(test::cube_facets(), radians(40));
  const std::vector<FacetPatch> patches = PatchFinder(mesh).find(all_triangles(mesh));
  ASSERT_EQ(patches.size(), 6u);
  for (const FacetPatch& p : patches) EXPECT_EQ(p.x.size(), 4u);
}

TEST(FacetPatches, have_two_nodes_for_one_on_both_sides_of_a_line) {
  FacetMesh mesh = find_smooth_faces(test::torus_facets(12, 8), radians(60));
  const FacetPatch whole = std::move(PatchFinder(mesh).find(all_triangles(mesh)).front());
  EXPECT_EQ(whole.x.size(), 96u);
  std::vector<double> height;
  for (const Vec3 x : whole.x) height.push_back(x.z);
  PatchDivider(mesh).divide(whole, height);
  const std::vector<FacetPatch> halves = PatchFinder(mesh).find(all_triangles(mesh));
  ASSERT_EQ(halves.size(), 2u);
  EXPECT_EQ(find_topology(halves[0].x, halves[0].corners).loops.size(), 2u);
}

TEST(FacetPatches, have_the_neighbours_that_their_corners_tell) {
  FacetMesh mesh = find_smooth_faces(test::torus_facets(12, 8), radians(60));
  const FacetPatch whole = std::move(PatchFinder(mesh).find(all_triangles(mesh)).front());
  std::vector<double> height;
  for (const Vec3 x : whole.x) height.push_back(x.z - 0.1);
  PatchDivider(mesh).divide(whole, height);
  for (const FacetPatch& p : PatchFinder(mesh).find(all_triangles(mesh)))
    EXPECT_TRUE(p.neighbours == find_neighbours(p.corners));
}

TEST(FacetDivide, of_pieces_again_and_again_leaves_no_gap) {
  FacetMesh mesh = find_smooth_faces(test::sphere_facets(12), radians(60));
  PatchFinder finder(mesh);
  PatchDivider divider(mesh);
  const double area = test::area_of(mesh);
  for (const Vec3 axis : {Vec3{1, 0.2, 0.1}, Vec3{-0.3, 1, 0.2}, Vec3{0.1, -0.2, 1}}) {
    const std::vector<FacetPatch> pieces = finder.find(all_triangles(mesh));
    for (const FacetPatch& piece : pieces) {  // as it is after the cuts of others
      const FacetPatch now = std::move(finder.find(all_of_face(mesh, piece)).front());
      std::vector<double> height;
      for (const Vec3 x : now.x) height.push_back(dot(x, axis) - 0.05);
      divider.divide(now, height);
    }
    for (const Corners& c : find_neighbours(mesh.corners)) EXPECT_EQ(std::count(c.begin(), c.end(), kNone), 0);
  }
  EXPECT_NEAR(test::area_of(mesh), area, 1e-12);
  EXPECT_EQ(finder.find(all_triangles(mesh)).size(), 8u);
}

TEST(FacetDivide, keeps_the_surface_and_its_neighbours_whole) {
  FacetMesh mesh = find_smooth_faces(test::cube_facets(), radians(40));
  const double area = test::area_of(mesh);
  const FacetPatch side = std::move(PatchFinder(mesh).find(all_triangles(mesh))[4]);
  std::vector<double> height;
  for (const Vec3 x : side.x) height.push_back(x.x - 0.3 + 0.1 * x.y);
  PatchDivider(mesh).divide(side, height);
  EXPECT_NEAR(test::area_of(mesh), area, 1e-14);
  EXPECT_EQ(PatchFinder(mesh).find(all_triangles(mesh)).size(), 7u);
  for (const Corners& c : find_neighbours(mesh.corners)) EXPECT_EQ(std::count(c.begin(), c.end(), kNone), 0);
}

TEST(FacetDivide, gives_new_nodes_the_normal_and_parameters_between) {
  FacetMesh mesh = find_smooth_faces(test::sphere_facets(16), radians(40));
  for (std::size_t t = 0; t < mesh.corners.size(); ++t)
    for (int k = 0; k < 3; ++k) mesh.uv[t][k] = {mesh.x[mesh.corners[t][k]].x, mesh.x[mesh.corners[t][k]].y};
  const FacetPatch whole = std::move(PatchFinder(mesh).find(all_triangles(mesh)).front());
  std::vector<double> height;
  for (const Vec3 x : whole.x) height.push_back(x.y + 0.31 * x.x - 0.2);
  PatchDivider(mesh).divide(whole, height);
  for (std::size_t t = 0; t < mesh.corners.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Vec3 x = mesh.x[mesh.corners[t][k]];
      EXPECT_GT(dot(mesh.normal[mesh.corner_normal[t][k]], normalized(x)), 0.999);
      EXPECT_NEAR(mesh.uv[t][k].x, x.x, 1e-15);
      EXPECT_NEAR(mesh.uv[t][k].y, x.y, 1e-15);
    }
}

}  // namespace
}  // namespace st
