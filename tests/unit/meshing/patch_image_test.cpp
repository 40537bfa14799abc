#include "meshing/face/patch_image.h"

#include <gtest/gtest.h>

namespace st {
namespace {

/// A triangle of a vertex, a node on edge 4 and one inside.
FacePatch small_patch() {
  FacePatch p;
  p.face = 1;
  p.n_boundary = 2;
  p.boundary_dim = {0, 1};
  p.boundary_entity = {3, 4};
  p.boundary_index = {0, 2};
  p.inner_xyz = {{1, 2, 3}};
  p.inner_uv = {{0.5, 0.25}};
  p.inner_size = {0.1};
  p.triangles = {{{0, 1, 2}}};
  p.uv_corner = {0, 1};
  p.own_uv = {{0, 0}, {1, 0}};
  return p;
}

TEST(PatchImage, moves_inner_nodes_and_names_the_entities_of_the_other_face_in_order) {
  const auto other = [](const RimPlace& place) -> RimPlace {
    return std::get<0>(place) == 0 ? RimPlace{0, 7, 0} : RimPlace{1, 2, 5};
  };
  const FacePatch p = image_of(small_patch(), {9, Similarity{.translation = {10, 0, 0}}, false, other});
  EXPECT_EQ(p.face, 9);
  EXPECT_EQ(p.boundary_entity, (std::vector<std::int32_t>{7, 2}));
  EXPECT_EQ(p.boundary_index, (std::vector<std::int32_t>{0, 5}));
  EXPECT_EQ(p.inner_xyz[0].x, 11);
  EXPECT_EQ(p.triangles[0].n[1], 1);
}

TEST(PatchImage, sorts_the_boundary_and_turns_triangles_over) {
  // The vertex becomes the one of the higher place: the nodes change places, in triangles, too.
  const auto other = [](const RimPlace& place) -> RimPlace {
    return std::get<0>(place) == 0 ? RimPlace{1, 8, 1} : RimPlace{1, 2, 5};
  };
  const FacePatch p = image_of(small_patch(), {9, Similarity(), true, other});
  EXPECT_EQ(p.boundary_entity, (std::vector<std::int32_t>{2, 8}));
  EXPECT_EQ(p.triangles[0].n[0], 1);
  EXPECT_EQ(p.triangles[0].n[1], 2);
  EXPECT_EQ(p.triangles[0].n[2], 0);
  EXPECT_EQ(p.uv_corner, (std::vector<std::int32_t>{0, 2}));
  EXPECT_EQ(p.own_uv[1].x, 1);
}

}  // namespace
}  // namespace st
