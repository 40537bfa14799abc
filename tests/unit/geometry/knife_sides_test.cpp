#include "geometry/facet/knife_sides.h"

#include <gtest/gtest.h>

#include <numeric>

#include "geometry/facet/facet_faces.h"
#include "unit/geometry/facet_inputs.h"

namespace st {
namespace {

FacetPatch patch_of(const FacetMesh& mesh) {
  std::vector<std::int32_t> all(mesh.corners.size());
  std::iota(all.begin(), all.end(), 0);
  return PatchFinder(mesh).find(all).front();
}

std::vector<double> heights_of(const FacetPatch& patch, Vec3 axis, double place) {
  std::vector<double> height;
  for (const Vec3 x : patch.x) height.push_back(dot(x, axis) - place);
  return height;
}

TEST(KnifeSides, of_a_skin_are_parted_by_planes_along_them_alone) {
  const FacetMesh mesh = find_smooth_faces(test::skin_facets(120, 6), radians(40));
  const FacetPatch patch = patch_of(mesh);
  ASSERT_EQ(patch.corners.size(), mesh.corners.size());
  const KnifeSides knives(patch);
  ASSERT_TRUE(knives.any());
  for (const double chord : {0.1, 0.5, 0.9}) EXPECT_TRUE(knives.are_parted_by(heights_of(patch, {1, 0, 0}, chord)));
  EXPECT_TRUE(knives.are_parted_by(heights_of(patch, {0, 0, 1}, 0)));  // through the edge itself
  EXPECT_FALSE(knives.are_parted_by(heights_of(patch, {0, 1, 0}, 2)));
  EXPECT_FALSE(knives.are_parted_by(heights_of(patch, {1, 0, 0}, 2)));  // beside it
}

TEST(KnifeSides, are_none_where_a_patch_ends_or_turns_less) {
  EXPECT_FALSE(KnifeSides(patch_of(find_smooth_faces(test::cube_facets(), radians(40)))).any());
  EXPECT_FALSE(KnifeSides(patch_of(find_smooth_faces(test::torus_facets(24, 12), radians(40)))).any());
}

}  // namespace
}  // namespace st
