#include "meshing/face/blunt_swaps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "mesh/corner_uv.h"

namespace st {
namespace {

/// A flat triangle of 151 degrees at `apex` over the side of another, whose apex is `below` it.
struct Pair {
  std::vector<FaceNode> nodes;
  std::vector<Triangle> triangles{{{0, 1, 2}}, {{1, 0, 3}}};

  explicit Pair(Vec3 apex = {0, 0.25, 0}, Vec3 below = {0, -1, 0}) {
    for (const Vec3 x : {Vec3{-1, 0, 0}, Vec3{1, 0, 0}, apex, below}) nodes.push_back({.uv = {x.x, x.y}, .x = x});
  }
};

/// Triangles of four nodes on the boundary, and others inside, as a patch; and what its functions want beside it.
struct BluntPatch {
  FacePatch patch;
  std::vector<Vec3> xyz;
  std::vector<Vec2> uv;  // of all corners

  BluntPatch(const std::vector<FaceNode>& nodes, const std::vector<Triangle>& triangles) {
    patch.face = 0;
    patch.n_boundary = 4;
    patch.triangles = triangles;
    for (const FaceNode& n : nodes) xyz.push_back(n.x);
    for (std::size_t n = 4; n < nodes.size(); ++n) {
      patch.inner_xyz.push_back(nodes[n].x);
      patch.inner_uv.push_back(nodes[n].uv);
      patch.inner_size.push_back(static_cast<double>(n));
    }
    for (const Triangle& t : triangles) {
      patch.triangle_previous.push_back(static_cast<TriangleId>(5 + patch.triangle_previous.size()));
      for (const NodeId n : t.n) uv.push_back(nodes[n].uv);
    }
    set_corner_uvs(uv, patch);
  }
};

std::vector<std::array<NodeId, 3>> corners(const std::vector<Triangle>& triangles) {
  std::vector<std::array<NodeId, 3>> all;
  for (const Triangle& t : triangles) all.push_back(std::to_array(t.n));
  return all;
}

TEST(BluntSwaps, make_two_triangles_of_a_flat_one_and_its_neighbour) {
  Pair pair;
  EXPECT_EQ(mend_blunt(pair.nodes, pair.triangles), 1);
  EXPECT_EQ(corners(pair.triangles), (std::vector<std::array<NodeId, 3>>{{2, 0, 3}, {2, 3, 1}}));
  EXPECT_EQ(mend_blunt(pair.nodes, pair.triangles), 0) << "neither is flat now";
}

TEST(BluntSwaps, leave_what_is_not_flat) {
  Pair pair({0, 0.5, 0});
  EXPECT_EQ(mend_blunt(pair.nodes, pair.triangles), 0);
}

TEST(BluntSwaps, join_no_twins_of_a_seam_and_no_poles) {
  Pair twins;
  twins.nodes[2].id = twins.nodes[3].id = 7;
  EXPECT_EQ(mend_blunt(twins.nodes, twins.triangles), 0);
  Pair pole;
  pole.nodes[3].is_pole = true;
  EXPECT_EQ(mend_blunt(pole.nodes, pole.triangles), 0);
}

TEST(BluntSwaps, make_no_edge_that_is_there) {
  Pair pair;
  pair.nodes.push_back({.uv = {0, -0.4}, .x = {0, -0.4, 3}});
  pair.triangles.push_back({{3, 2, 4}});
  EXPECT_EQ(mend_blunt(pair.nodes, pair.triangles), 0);
}

TEST(BluntSwaps, fold_nothing) {
  Pair pair({1.5, 0.1, 0});  // beyond the end of the side: the new edge would pass outside both
  pair.nodes[3].x = {0.9, -0.02, 0};
  const auto before = corners(pair.triangles);
  mend_blunt(pair.nodes, pair.triangles);
  EXPECT_EQ(corners(pair.triangles), before);
}

TEST(BluntSwaps, make_an_edge_sharper_for_the_largest_angles_alone_where_one_is_sharp) {
  for (const auto& [height, n_swaps] : {std::pair{0.1, 1}, std::pair{0.3, 0}}) {
    Pair pair({0, height, 0}, {0, -0.3, -1});
    pair.nodes.push_back({.uv = {-1, 1}, .x = {-1, 1, -1}});
    pair.triangles.push_back({{0, 2, 4}});
    EXPECT_EQ(mend_blunt(pair.nodes, pair.triangles), n_swaps) << height;
  }
}

TEST(BluntSwaps, keep_the_parameters_of_a_patch) {
  const Pair pair;
  auto [patch, xyz, uv] = BluntPatch(pair.nodes, pair.triangles);
  EXPECT_EQ(mend_blunt(xyz, patch), 1);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_TRUE(corner_uv(patch, i) == pair.nodes[patch.triangles[i / 3].n[i % 3]].uv);
  EXPECT_EQ(patch.triangle_previous, (std::vector<TriangleId>{kNone, kNone}));
  uv[2] = {9, 9};  // the side between both is on a seam
  uv[0] = {8, 8};
  patch.triangles = pair.triangles;
  set_corner_uvs(uv, patch);
  EXPECT_EQ(mend_blunt(xyz, patch), 0);
}

/// Two nodes inside four; the lower one, 169 degrees over a side of the boundary, has three neighbours.
struct Dent {
  std::vector<FaceNode> nodes;
  std::vector<Triangle> triangles{{{0, 1, 4}}, {{1, 5, 4}}, {{5, 0, 4}}, {{1, 2, 5}}, {{2, 3, 5}}, {{3, 0, 5}}};

  explicit Dent(Vec3 corner = {1, 2, 0}) {
    for (const Vec3 x : {Vec3{-1, 0, 0}, Vec3{1, 0, 0}, corner, Vec3{-1, 2, 0}, Vec3{0, 0.1, 0}, Vec3{0, 1, 0}})
      nodes.push_back({.uv = {x.x, x.y}, .x = x});
    for (std::int32_t i = 0; i < 4; ++i) nodes[i].id = i;
  }
};

TEST(BluntSwaps, put_a_node_over_the_boundary_onto_another) {
  Dent dent;
  EXPECT_EQ(mend_blunt(dent.nodes, dent.triangles), 1);
  ASSERT_EQ(dent.triangles.size(), 4u);
  for (const Triangle& t : dent.triangles) EXPECT_EQ(std::ranges::count(t.n, 4), 0);
  EXPECT_EQ(mend_blunt(dent.nodes, dent.triangles), 0);
}

TEST(BluntSwaps, keep_what_is_not_above_the_angle_given) {
  Dent dent;
  EXPECT_EQ(mend_blunt(dent.nodes, dent.triangles, radians(170)), 0);
  EXPECT_EQ(mend_blunt(dent.nodes, dent.triangles, radians(168)), 1);
}

TEST(BluntSwaps, keep_nodes_that_others_are_not_to_be_put_on) {
  Dent fixed;
  fixed.nodes[4].id = 4;
  EXPECT_EQ(mend_blunt(fixed.nodes, fixed.triangles), 0) << "a node outside the face";
  Dent growing({1.1, 0.05, 0});
  growing.nodes[3].x = {-1, 4, 0};
  EXPECT_EQ(mend_blunt(growing.nodes, growing.triangles, radians(160)), 0) << "beside a triangle a tenth as large";
  Dent sharp({1, 2, 0});
  sharp.nodes[2].x = {0.4, 0.5, -2};
  sharp.nodes[4].x = {0, 0.1, 0.3};
  EXPECT_EQ(mend_blunt(sharp.nodes, sharp.triangles), 0) << "not flat";
}

TEST(BluntSwaps, keep_what_the_nodes_and_triangles_of_a_patch_were) {
  const Dent dent;
  auto [patch, xyz, uv] = BluntPatch(dent.nodes, dent.triangles);
  EXPECT_EQ(mend_blunt(xyz, patch), 1);
  EXPECT_EQ(patch.inner_size, std::vector<double>{5});
  ASSERT_EQ(patch.triangles.size(), 4u);
  for (std::size_t i = 0; i < 12; ++i) {
    const NodeId n = patch.triangles[i / 3].n[i % 3];
    EXPECT_TRUE(corner_uv(patch, i) == dent.nodes[n == 4 ? 5 : n].uv);
  }
  EXPECT_EQ(std::ranges::count(patch.triangle_previous, kNone), 1);
  EXPECT_EQ(std::ranges::count(patch.triangle_previous, 8), 1) << "beside the place";
}

}  // namespace
}  // namespace st
