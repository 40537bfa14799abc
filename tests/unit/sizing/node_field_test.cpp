// Lengths on the nodes of a mesh as a size field.
#include "sizing/node_field.h"

#include <gtest/gtest.h>

#include "unit/mesh/shapes.h"

namespace st {
namespace {

/// The side z = 0 of a cube of edge 1 by 8 x 8 quads, and the others.
const SurfaceMesh kCube = shapes::cube(8);

TEST(NodeField, gives_nodes_their_lengths_and_is_linear_between) {
  std::vector<double> size;
  for (const Vec3 x : kCube.node_xyz) size.push_back(1 + 0.3 * x.x + 0.2 * x.y);
  const NodeField field(kCube, size, 10);
  for (std::size_t n = 0; n < size.size(); ++n) EXPECT_NEAR(field.size(kCube.node_xyz[n]), size[n], 1e-12);
  for (const Triangle& t : kCube.triangles) {
    const Vec3 x = (kCube.node_xyz[t.n[0]] + kCube.node_xyz[t.n[1]] + kCube.node_xyz[t.n[2]]) / 3;
    EXPECT_NEAR(field.size(x), 1 + 0.3 * x.x + 0.2 * x.y, 1e-12);
  }
  EXPECT_NEAR(field.min_size(), 1, 1e-12);
}

TEST(NodeField, reduces_lengths_that_grow_faster_than_the_slope) {
  std::vector<double> size(kCube.node_xyz.size(), 5);
  size[0] = 0.1;
  const NodeField field(kCube, size, 0.2);
  EXPECT_EQ(field.size(kCube.node_xyz[0]), 0.1);
  double largest = 0;
  for (const Triangle& t : kCube.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = kCube.node_xyz[t.n[k]], b = kCube.node_xyz[t.n[(k + 1) % 3]];
      EXPECT_LE(std::abs(field.size(a) - field.size(b)), 0.2 * distance(a, b) + 1e-12);
      largest = std::max(largest, field.size(a));
    }
  EXPECT_LT(largest, 0.1 + 0.2 * 4) << "by way of the edges of the mesh to the far corner";
  EXPECT_GT(largest, 0.1 + 0.2 * std::sqrt(3.0));
}

TEST(NodeField, does_not_depend_on_the_hint) {
  std::vector<double> size;
  for (std::size_t n = 0; n < kCube.node_xyz.size(); ++n) size.push_back(1 + 0.01 * static_cast<double>(n % 7));
  const NodeField field(kCube, size, 1);
  const Vec3 x{0.31, 0.47, 0.02};
  const double expected = field.size(x);
  for (int hint : {-5, 0, 1, 100, 1000000}) EXPECT_EQ(field.size(x, hint), expected);
}

}  // namespace
}  // namespace st
