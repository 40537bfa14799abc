// Boxes of patches, and what of two patches is near each other.
#include "mesh/patch_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <set>

#include "mesh/crossing.h"
#include "mesh/patch_crossing.h"
#include "mesh/patch_section.h"

namespace st {
namespace {

/// A square of n x n x 2 triangles, unit length of its sides, all nodes inside but those with v = 0, which are nodes
/// 1, 2, ... of edge 0.
FacePatch square(FaceId face, int n, const std::function<Vec3(double, double)>& place) {
  FacePatch p;
  p.face = face;
  p.n_boundary = n + 1;
  const auto node = [&](int i, int j) { return j * (n + 1) + i; };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      if (j > 0) p.inner_xyz.push_back(place(double(i) / n, double(j) / n));
      if (j > 0) continue;
      p.boundary_dim.push_back(1);
      p.boundary_entity.push_back(0);
      p.boundary_index.push_back(i + 1);
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      p.triangles.push_back({{node(i, j), node(i + 1, j), node(i + 1, j + 1)}});
      p.triangles.push_back({{node(i, j), node(i + 1, j + 1), node(i, j + 1)}});
    }
  std::shuffle(p.triangles.begin(), p.triangles.end(), std::mt19937(face));  // boxes do not rely on their order
  return p;
}

/// Edge 0 from (0,0,0) to (1,0,0), n + 3 nodes: those of the squares are 1 to n + 1.
EdgeMesh edge_of(int n) {
  EdgeMesh edges = EdgeMesh::of_edges(1);
  edges.edge_offsets = {0, n + 3};
  for (int i = -1; i <= n + 1; ++i) edges.node_xyz.push_back({double(i) / n, 0, 0});
  edges.node_t.resize(n + 3);
  edges.node_size.resize(n + 3);
  return edges;
}

class TwoSquares : public testing::Test {
 protected:
  static constexpr int kN = 40;
  const EdgeMesh edges = edge_of(kN);
  // one flat, one that rises from the common edge and comes down through the first
  const FacePatch flat = square(0, kN,
                                [](double u, double v) {
                                  return Vec3{u, v, 0};
                                }),
                  wave = square(1, kN, [](double u, double v) {
                    return Vec3{u, v, 0.3 * std::sin(5 * v)};
                  });
};

TEST_F(TwoSquares, have_boxes_of_neighbours) {
  const PatchBlocks blocks(edges, {}, wave);
  EXPECT_EQ(blocks.size(), 2 * kN * kN / PatchBlocks::kTriangles);
  std::set<std::int32_t> all;
  double sum = 0;
  for (std::int32_t b = 0; b < blocks.size(); ++b) {
    for (const std::int32_t t : blocks.triangles(b)) {
      all.insert(t);
      for (const NodeId n : wave.triangles[t].n) {
        const Vec3 x = node_place(edges, {}, wave, n);
        EXPECT_TRUE(x.x >= blocks[b].lo.x && x.x <= blocks[b].hi.x && x.z >= blocks[b].lo.z && x.z <= blocks[b].hi.z);
      }
    }
    sum += blocks[b].diagonal();
  }
  EXPECT_EQ(all.size(), wave.triangles.size());
  EXPECT_LT(sum, 0.35 * blocks.size() * blocks.box().diagonal());
}

TEST_F(TwoSquares, meet_in_the_blocks_whose_boxes_meet) {
  const PatchBlocks a(edges, {}, flat), b(edges, {}, wave);
  std::set<std::int32_t> found;
  for (const PatchBlocks::Meeting& m : a.meeting(b)) found.insert(m.block);
  for (std::int32_t i = 0; i < a.size(); ++i) {
    bool meets = false;
    for (std::int32_t j = 0; j < b.size(); ++j) {
      const Box3 &p = a[i], &q = b[j];
      meets |= p.lo.x <= q.hi.x && q.lo.x <= p.hi.x && p.lo.y <= q.hi.y && q.lo.y <= p.hi.y && p.lo.z <= q.hi.z &&
               q.lo.z <= p.hi.z;
    }
    EXPECT_EQ(found.contains(i), meets) << i;
  }
  EXPECT_GT(found.size(), 0u);
  EXPECT_LT(found.size(), static_cast<std::size_t>(a.size()));
}

TEST_F(TwoSquares, cross_in_the_triangles_that_the_whole_mesh_has) {
  const PatchBlocks a(edges, {}, flat), b(edges, {}, wave);
  const SectionPart of_b = part_of(edges, {}, wave, b, b.meeting(a)), of_a = part_of(edges, {}, flat, a, a.meeting(b));
  EXPECT_LT(of_a.patch.triangles.size() + of_b.patch.triangles.size(), flat.triangles.size());
  const SurfaceMesh both = weld_parts(edges, {}, of_a.patch, of_b.patch);
  const auto n_first = static_cast<std::int32_t>(of_a.patch.triangles.size());
  std::set<std::pair<std::int32_t, std::int32_t>> found, expected;
  bool was_ended = false;
  for (const TrianglePair& pair : find_crossings_between(both.node_xyz, both.triangles, n_first, was_ended))
    if (pair.n_shared != 1) found.insert({of_a.triangle_number[pair.a], of_b.triangle_number[pair.b - n_first]});
  std::vector<Vec3> points = node_places(edges, {}, flat);
  std::vector<Triangle> triangles = flat.triangles;
  const auto n_flat = static_cast<NodeId>(points.size());
  for (const Vec3& x : wave.inner_xyz) points.push_back(x);
  for (Triangle t : wave.triangles) {
    for (NodeId& n : t.n)
      if (n >= wave.n_boundary) n += n_flat - wave.n_boundary;
    triangles.push_back(t);
  }
  for (const TrianglePair& pair : find_crossing_triangles(points, triangles))
    if (pair.n_shared != 1) expected.insert({pair.a, pair.b - static_cast<std::int32_t>(flat.triangles.size())});
  EXPECT_GT(expected.size(), 2u * kN);
  EXPECT_EQ(found, expected);
}

TEST(PatchBlocks, list_each_pair_of_boxes_that_meet_once) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0, 1), size(0, 0.2);
  std::vector<Box3> boxes(60);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (i % 10 == 9) continue;  // empty
    boxes[i].add(Vec3{place(random), place(random), 3 * place(random)});
    boxes[i].add(boxes[i].lo + Vec3{size(random), size(random), size(random)});
  }
  std::set<std::pair<std::int32_t, std::int32_t>> expected;
  for (std::int32_t i = 0; i < 60; ++i)
    for (std::int32_t j = i + 1; j < 60; ++j) {
      const Box3 &p = boxes[i], &q = boxes[j];
      if (!p.is_empty() && !q.is_empty() && p.lo.x <= q.hi.x && q.lo.x <= p.hi.x && p.lo.y <= q.hi.y &&
          q.lo.y <= p.hi.y && p.lo.z <= q.hi.z && q.lo.z <= p.hi.z)
        expected.insert({i, j});
    }
  const auto found = meeting_pairs(boxes);
  EXPECT_EQ(found.size(), expected.size());
  EXPECT_EQ((std::set(found.begin(), found.end())), expected);
}

TEST(PatchBlocks, of_a_patch_without_triangles_meet_nothing) {
  const PatchBlocks none(EdgeMesh::of_edges(0), {}, FacePatch());
  EXPECT_EQ(none.size(), 0);
  EXPECT_TRUE(none.box().is_empty());
  EXPECT_TRUE(none.meeting(Box3{{0, 0, 0}, {1, 1, 1}}).empty());
}

}  // namespace
}  // namespace st
