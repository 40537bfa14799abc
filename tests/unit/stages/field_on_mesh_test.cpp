#include "stages/field_on_mesh.h"

#include <gtest/gtest.h>

#include "unit/mesh/shapes.h"

namespace st {
namespace {

/// Along z as long as asked on walls that stand, everywhere else 1.
class WallMetric : public UniformField {
 public:
  WallMetric() : UniformField(1) {}
  bool is_stretched() const override { return true; }
  bool has_metrics() const override { return true; }
  LocalSize local_on(Vec3, Vec3 normal, int&) const override {
    return std::abs(normal.z) < 0.1 ? LocalSize{1, 3, {0, 0, 1}} : LocalSize{1, 1, {}};
  }
};

TEST(FieldOnMesh, asks_for_lengths_along_edges_where_planes_matter) {
  const WallMetric field;
  int hint = 0;
  EXPECT_NEAR(lengths_along(field)({0, 0, 0}, {0, 0, 2}, hint), 3, 1e-12);
  EXPECT_FALSE(lengths_along(UniformField(1)));
}

TEST(FieldOnMesh, squeezes_nodes_in_their_planes) {
  const SurfaceMesh cube = shapes::cube(4);
  const WallMetric field;
  const std::vector<Vec3> squeeze = squeeze_of_nodes(cube, &field);
  ASSERT_EQ(squeeze.size(), cube.node_xyz.size());
  Box3 box;
  for (const Vec3 x : cube.node_xyz) box.add(x);
  const auto is_inside = [](double v, double lo, double hi) { return v > lo + 1e-9 && v < hi - 1e-9; };
  int n_walls = 0;
  for (std::size_t n = 0; n < squeeze.size(); ++n) {
    const Vec3 x = cube.node_xyz[n];
    const bool in_x = is_inside(x.x, box.lo.x, box.hi.x), in_y = is_inside(x.y, box.lo.y, box.hi.y);
    const bool is_on_floor_or_roof = in_x && in_y, is_on_wall = is_inside(x.z, box.lo.z, box.hi.z) && in_x != in_y;
    if (is_on_floor_or_roof) {
      EXPECT_EQ(squeeze[n], Vec3{});
    } else if (is_on_wall) {
      EXPECT_GT(squeeze[n].z, 0.9);
      ++n_walls;
    }
  }
  EXPECT_GT(n_walls, 0);
  EXPECT_TRUE(squeeze_of_nodes(cube, nullptr).empty());
}

}  // namespace
}  // namespace st
