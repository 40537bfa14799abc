#include "mesh/corner_uv.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace st {
namespace {

/// Two triangles about one inner node (3), across a seam: node 0 has another (u,v) in each.
FacePatch seam_patch() {
  FacePatch p;
  p.n_boundary = 3;
  p.inner_xyz = {{1, 1, 0}};
  p.inner_uv = {{0.5, 0.25}};
  p.triangles = {{{0, 1, 3}}, {{3, 2, 0}}};
  return p;
}

const std::vector<Vec2> kAll = {{0, 0}, {1, 0}, {0.5, 0.25}, {0.5, 0.25}, {2, 0}, {6.28, 0}};

TEST(CornerUv, gives_back_what_was_set_and_keeps_that_of_boundaries_only) {
  FacePatch p = seam_patch();
  set_corner_uvs(kAll, p);
  EXPECT_EQ(p.uv_corner, (std::vector<std::int32_t>{0, 1, 4, 5}));
  EXPECT_TRUE(has_all_uv(p));
  EXPECT_EQ(corner_uvs(p), kAll);
  EXPECT_EQ(corner_uvs(p, 1, 2), (std::vector<Vec2>{kAll[3], kAll[4], kAll[5]}));
  for (std::size_t c = 0; c < kAll.size(); ++c) EXPECT_EQ(corner_uv(p, c), kAll[c]) << c;
}

TEST(CornerUv, keeps_a_corner_inside_that_differs_from_its_node) {
  FacePatch p = seam_patch();
  std::vector<Vec2> all = kAll;
  all[3].x += 6.28;
  set_corner_uvs(all, p);
  EXPECT_EQ(p.uv_corner.size(), 5u);
  EXPECT_EQ(corner_uvs(p), all);
}

TEST(CornerUv, is_missing_where_a_corner_on_the_boundary_has_none_or_numbers_are_no_corners) {
  FacePatch whole = seam_patch();
  set_corner_uvs(kAll, whole);
  const auto damaged = [&](const auto& change) {
    FacePatch p = whole;
    change(p);
    return !has_all_uv(p);
  };
  EXPECT_TRUE(damaged([](FacePatch& p) { p.uv_corner.pop_back(), p.own_uv.pop_back(); }));
  EXPECT_TRUE(damaged([](FacePatch& p) { p.own_uv.pop_back(); }));
  EXPECT_TRUE(damaged([](FacePatch& p) { p.uv_corner.push_back(6), p.own_uv.push_back({}); }));
  EXPECT_TRUE(damaged([](FacePatch& p) { std::swap(p.uv_corner[0], p.uv_corner[1]); }));
  EXPECT_TRUE(damaged([](FacePatch& p) { p.uv_corner[0] = -1; }));
  EXPECT_TRUE(damaged([](FacePatch& p) { p.uv_corner[1] = 0; }));
}

}  // namespace
}  // namespace st
