#include "meshing/face/patch_refill.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "mesh/corner_uv.h"
#include "unit/meshing/grid_patch.h"

namespace st {
namespace {

constexpr NodeId kMiddle = 4 * 9 + 4;  // of a grid of 8 x 8

FacePatch moved(Vec3 to) {
  FacePatch patch = test::grid_patch(8);
  patch.inner_xyz[kMiddle] = to;
  return patch;
}

double area(const FacePatch& p) {
  double sum = 0;
  for (const Triangle& t : p.triangles)
    sum += 0.5 * norm(cross(p.inner_xyz[t.n[1]] - p.inner_xyz[t.n[0]], p.inner_xyz[t.n[2]] - p.inner_xyz[t.n[0]]));
  return sum;
}

/// Sides used once, by the places of their ends.
std::map<std::pair<double, double>, int> rim(const FacePatch& p) {
  std::map<std::pair<double, double>, int> uses, once;
  const auto key = [&](NodeId n) { return 100 * p.inner_xyz[n].x + p.inner_xyz[n].y; };
  for (const Triangle& t : p.triangles)
    for (int k = 0; k < 3; ++k) ++uses[std::minmax(key(t.n[k]), key(t.n[(k + 1) % 3]))];
  for (const auto& [side, n] : uses)
    if (n == 1) once[side] = 1;
  return once;
}

TEST(Refill, unfolds_what_a_misplaced_node_folds) {
  FacePatch patch = moved({6.3, 4.2, 0});
  const auto before = rim(patch);
  const auto flawed = find_flawed(patch.inner_xyz, patch);
  ASSERT_FALSE(flawed.empty());
  EXPECT_GT(refill(patch.inner_xyz, flawed, patch), 0);
  EXPECT_TRUE(find_flawed(patch.inner_xyz, patch).empty());
  EXPECT_NEAR(area(patch), 64, 1e-9);
  EXPECT_EQ(rim(patch), before) << "what is around stays";
  EXPECT_TRUE(has_all_uv(patch));
  EXPECT_EQ(patch.inner_uv.size(), patch.inner_xyz.size());
  EXPECT_LT(patch.inner_xyz.size(), 81u) << "nodes inside are gone";
  for (std::size_t t = 0; t < patch.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_TRUE(corner_uv(patch, 3 * t + k) == patch.inner_uv[patch.triangles[t].n[k]]);
}

TEST(Refill, removes_triangles_without_area) {
  FacePatch patch = moved({5, 5, 0});  // onto a neighbour
  const auto flawed = find_flawed(patch.inner_xyz, patch);
  ASSERT_FALSE(flawed.empty());
  refill(patch.inner_xyz, flawed, patch);
  EXPECT_TRUE(find_flawed(patch.inner_xyz, patch).empty());
  EXPECT_NEAR(area(patch), 64, 1e-9);
}

TEST(Refill, finds_nothing_in_a_sound_patch_and_changes_nothing_without_bad_triangles) {
  FacePatch patch = test::grid_patch(8);
  EXPECT_TRUE(find_flawed(patch.inner_xyz, patch).empty());
  EXPECT_EQ(refill(patch.inner_xyz, {}, patch), 0);
  EXPECT_EQ(patch.triangles.size(), 128u);
}

TEST(Refill, keeps_numbers_of_what_stays) {
  FacePatch patch = moved({6.3, 4.2, 0});
  for (NodeId n = 0; n < 81; ++n) patch.inner_previous.push_back(1000 + n);
  for (TriangleId t = 0; t < 128; ++t) patch.triangle_previous.push_back(5000 + t);
  const FacePatch before = patch;
  refill(patch.inner_xyz, find_flawed(patch.inner_xyz, patch), patch);
  ASSERT_EQ(patch.inner_previous.size(), patch.inner_xyz.size());
  ASSERT_EQ(patch.triangle_previous.size(), patch.triangles.size());
  for (std::size_t n = 0; n < patch.inner_xyz.size(); ++n)
    EXPECT_TRUE(patch.inner_xyz[n] == before.inner_xyz[static_cast<std::size_t>(patch.inner_previous[n] - 1000)]);
  EXPECT_EQ(patch.triangle_previous.front(), 5000);
  EXPECT_EQ(patch.triangle_previous.back(), kNone);
}

TEST(Refill, tries_no_more_than_some_hundred_places) {
  constexpr int kApart = 6, kAcross = 18, n = kApart * kAcross;
  for (const int n_hopeless : {299, 300}) {
    FacePatch patch = test::grid_patch(n);
    std::vector<std::size_t> bad;
    for (int i = 0; i < n_hopeless; ++i) {
      bad.push_back(static_cast<std::size_t>(2 * kApart * (i / kAcross * n + i % kAcross)) + 2 * (2 * n + 2));
      std::swap(patch.triangles[bad[i]].n[0], patch.triangles[bad[i]].n[1]);  // what is around it is no loop
    }
    bad.push_back(patch.triangles.size() - 5);
    EXPECT_EQ(refill(patch.inner_xyz, bad, patch), n_hopeless == 299 ? 1 : 0) << n_hopeless;
  }
}

/// Both ends may be nodes of another face, which has a side between them, too.
TEST(Refill, makes_no_side_again_between_two_nodes_of_the_rim) {
  FacePatch patch = test::grid_patch(1);
  std::vector<Vec3> xyz = std::exchange(patch.inner_xyz, {});
  xyz[3] = {0.8, 0.8, 0};  // the side from 0 to 3 is the shorter one
  const std::vector<Vec2> uv = corner_uvs(patch);
  patch.n_boundary = 4;
  patch.inner_uv.clear();
  patch.inner_size.clear();
  set_corner_uvs(uv, patch);
  EXPECT_EQ(refill(xyz, std::vector<std::size_t>{0}, patch), 1);
  ASSERT_EQ(patch.triangles.size(), 2u);
  for (const Triangle& t : patch.triangles)
    EXPECT_EQ(std::ranges::count(t.n, 1) + std::ranges::count(t.n, 2), 2) << "the other diagonal";
  EXPECT_TRUE(has_all_uv(patch));
}

TEST(Refill, leaves_alone_what_would_still_be_folded) {
  FacePatch patch = test::grid_patch(1);  // two triangles on a rim, one turned over the other
  patch.inner_xyz[2] = {0.9, 0.2, 0};
  const auto flawed = find_flawed(patch.inner_xyz, patch);
  ASSERT_FALSE(flawed.empty());
  const FacePatch before = patch;
  refill(patch.inner_xyz, flawed, patch);
  EXPECT_EQ(patch.triangles.size(), 2u);
  EXPECT_EQ(rim(patch), rim(before));
}

}  // namespace
}  // namespace st
