#include "sizing/neighbours.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "unit/sizing/cases.h"

namespace st {
namespace {

TEST(Neighbours, are_exactly_the_cells_that_touch) {
  const RasterOctree raster = build_octree(test::kUnitBox, test::sphere_boxes(60));
  const OctreeView octree = raster.shape.view();
  const Neighbours neighbours(octree);
  for (std::int32_t a = 0; a < octree.n_leaves(); a += 7) {
    std::set<std::int32_t> found, expected;
    neighbours.for_each(a, [&](std::int32_t b, const CellStep&) { found.insert(b); });
    for (std::int32_t b = 0; b < octree.n_leaves(); ++b) {
      const Vec3 d = octree.leaf_center(a) - octree.leaf_center(b);
      const double reach =
          0.5000001 * (octree.cell_edge(octree.leaf_levels[a]) + octree.cell_edge(octree.leaf_levels[b]));
      if (a != b && std::abs(d.x) <= reach && std::abs(d.y) <= reach && std::abs(d.z) <= reach) expected.insert(b);
    }
    ASSERT_EQ(found, expected) << "leaf " << a;
  }
}

TEST(Neighbours, steps_lead_from_centre_to_centre) {
  const RasterOctree raster = build_octree(test::kUnitBox, test::sphere_boxes(300));
  const OctreeView octree = raster.shape.view();
  const Neighbours neighbours(octree);
  for (std::int32_t a = 0; a < octree.n_leaves(); ++a)
    neighbours.for_each(a, [&](std::int32_t b, const CellStep& step) {
      const double unit = 0.5 * octree.cell_edge(step.fine_level);
      const Vec3 to = octree.leaf_center(a) + unit * Vec3{double(step.x), double(step.y), double(step.z)};
      ASSERT_LT(distance(to, octree.leaf_center(b)), 1e-9);
      ASSERT_EQ(step.length2, step.x * step.x + step.y * step.y + step.z * step.z);
    });
}

/// Larger ones come once, though for_each() comes to them in several directions.
TEST(Neighbours, across_faces_are_numbered_as_among_all) {
  const RasterOctree raster = build_octree(test::kUnitBox, test::sphere_boxes(300));
  const Neighbours neighbours(raster.shape.view());
  for (std::int32_t a = 0; a < raster.shape.view().n_leaves(); ++a) {
    std::vector<std::int32_t> all, found;
    std::set<std::int32_t> expected;
    neighbours.for_each(a, [&](std::int32_t b, const CellStep& step) {
      if (test::is_across_face(step)) expected.insert(b);
      all.push_back(b);
    });
    neighbours.for_each_across_face_numbered(a, [&](std::int32_t b, const CellStep& step, int n) {
      found.push_back(b);
      ASSERT_TRUE(test::is_across_face(step));
      ASSERT_EQ(all[static_cast<std::size_t>(n)], b) << "leaf " << a;
    });
    ASSERT_EQ(std::set<std::int32_t>(found.begin(), found.end()), expected) << "leaf " << a;
    ASSERT_EQ(found.size(), expected.size()) << "leaf " << a;
  }
}

TEST(Neighbours, of_a_single_cell_are_none) {
  const RasterOctree raster = build_octree(test::kUnitBox, {});
  int n = 0;
  Neighbours(raster.shape.view()).for_each(0, [&](std::int32_t, const CellStep&) { ++n; });
  EXPECT_EQ(n, 0);
}

}  // namespace
}  // namespace st
