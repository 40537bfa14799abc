#include "meshing/face/row_layer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/meshing/row_case.h"

namespace st::test {
namespace {

const std::vector<Vec2> kLayerSquare{{0, 0}, {4, 0}, {4, 4}, {0, 4}};

MeshNode node_at(RowCase& face, Vec2 p) {
  MeshNode n;
  n.p = p;
  face.work.evaluate(n);
  face.work.ask_sizes(n);
  return n;
}

TEST(RowLayer, inserts_what_is_seen_and_not_crowded) {
  const WallField field(0.1, 0, 1);
  RowCase face({kLayerSquare, {{1, 1}, {1, 2}, {3, 2}, {3, 1}}}, field);
  RowLayer layer(face.work);
  const std::int32_t added = layer.insert(node_at(face, {0.5, 0.5}), 0);
  ASSERT_NE(added, kNone);
  EXPECT_EQ(face.work.mesh.nodes[added].x, (Vec3{0.5, 0.5, 0}));
  EXPECT_EQ(layer.insert(node_at(face, {0.6, 0.5}), 0), kNone) << "too near to the first";
  EXPECT_EQ(layer.insert(node_at(face, {3.5, 3.5}), 0), kNone) << "behind the hole";
  face.work.max_nodes = face.work.mesh.nodes.size();
  EXPECT_EQ(layer.insert(node_at(face, {0.5, 3}), 3), kNone) << "too many";
}

TEST(RowLayer, lays_all_triangles_or_none) {
  const WallField field(0.1, 0, 1);
  RowCase face({kLayerSquare}, field);
  RowLayer layer(face.work);
  const std::int32_t a = layer.insert(node_at(face, {1.1, 2}), 0), b = layer.insert(node_at(face, {2.9, 2}), 1);
  ASSERT_TRUE(a != kNone && b != kNone);
  EXPECT_FALSE(layer.lay({{0, 1, b}, {0, b, 3}})) << "a node is inside";
  EXPECT_EQ(face.n_laid(), 0);
  EXPECT_FALSE(face.work.mesh.is_fixed(0, b));
  EXPECT_TRUE(face.work.mesh.is_fixed(0, 1)) << "the boundary";
  EXPECT_TRUE(layer.lay({{0, 1, b}, {0, b, a}}));
  EXPECT_EQ(face.n_laid(), 2);
  EXPECT_TRUE(face.work.mesh.is_fixed(0, b));
}

TEST(RowLayer, settles_lengths_as_they_were_laid) {
  const WallField field(0.5, 0, 5);
  RowCase face({kLayerSquare}, field);
  RowLayer layer(face.work);
  const std::int32_t n = layer.insert(node_at(face, {2, 2}), 0);
  ASSERT_NE(n, kNone);
  layer.settle(n, 0.2, 0.5);
  const MeshNode& node = face.work.mesh.nodes[n];
  EXPECT_TRUE(node.is_laid && !node.is_kept);
  ASSERT_EQ(face.work.shortened.size(), 1U);
  EXPECT_EQ(face.work.shortened[0].first, n);
  EXPECT_NEAR(1 / std::sqrt(1 - norm2(face.work.shortened[0].second)), 10, 1e-9);
  EXPECT_NEAR(node.h, 0.25, 1e-12);
  EXPECT_NEAR(aspect_of(node), 1.3 * 0.5 / 0.25, 1e-9);
}

}  // namespace
}  // namespace st::test
