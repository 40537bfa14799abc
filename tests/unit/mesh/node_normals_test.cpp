#include "mesh/node_normals.h"

#include <gtest/gtest.h>

namespace st {
namespace {

TEST(NodeNormals, are_means_by_area_and_zero_without_triangles) {
  const std::vector<Vec3> xyz{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 2}, {5, 5, 5}};
  const std::vector<Triangle> triangles{{{0, 1, 2}}, {{0, 2, 3}}};  // areas 1/2 and 1
  const std::vector<Vec3> normal = node_normals(xyz, triangles);
  EXPECT_EQ(normal[1], (Vec3{0, 0, 1}));
  EXPECT_EQ(normal[3], (Vec3{1, 0, 0}));
  EXPECT_NEAR(normal[0].x, 2 / std::sqrt(5), 1e-12);
  EXPECT_NEAR(normal[0].z, 1 / std::sqrt(5), 1e-12);
  EXPECT_EQ(normal[4], Vec3{});
}

}  // namespace
}  // namespace st
