#include "sizing/face_cells.h"

#include <gtest/gtest.h>

#include <numeric>

#include "geometry/analytic.h"
#include "unit/sizing/cases.h"

namespace st {
namespace {

const Frame kFrame{{0, 0, 0.9}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

double total(const std::vector<CellArea>& cells) {
  return std::accumulate(cells.begin(), cells.end(), 0.0, [](double sum, const CellArea& c) { return sum + c.area; });
}

TEST(FaceCells, share_out_the_area_of_the_face) {
  const RasterOctree raster = build_octree(test::kUnitBox, test::sphere_boxes(3000));
  const PlaneSurface plane(kFrame, 0, 1, 0, 1);
  EXPECT_NEAR(total(locate_face(plane, {}, raster.shape.view(), 0)), 1, 1e-6);
  EXPECT_NEAR(total(locate_face(plane, {}, raster.shape.view(), 7)), 7, 1e-5);
}

TEST(FaceCells, put_each_part_where_it_lies) {
  const RasterOctree raster = build_octree(test::kUnitBox, test::sphere_boxes(3000));
  const OctreeView octree = raster.shape.view();
  const PlaneSurface plane(kFrame, 0, 1, 0, 1);
  for (const CellArea& c : locate_face(plane, {}, octree, 0)) {
    const double edge = octree.cell_edge(octree.leaf_levels[c.leaf]);
    ASSERT_LE(std::abs(octree.leaf_center(c.leaf).z - 0.9), 0.51 * edge);
    ASSERT_LE(c.area, 1.7 * 1.7 * edge * edge);
  }
}

TEST(FaceCells, respect_the_loops) {
  const RasterOctree raster = build_octree(test::kUnitBox, test::sphere_boxes(3000));
  const PlaneSurface plane(kFrame, 0, 1, 0, 1);
  const LoopPolygons half(std::vector<LoopSide>{{{0, 0}, {0.5, 0}}, {{0.5, 0}, {0.5, 1}}, {{0.5, 1}, {0, 1}}, {{0, 1}, {0, 0}}});
  const std::vector<CellArea> cells = locate_face(plane, half, raster.shape.view(), 0);
  EXPECT_NEAR(total(cells), 0.5, 0.03);
  for (const CellArea& c : cells) EXPECT_LT(raster.shape.view().leaf_center(c.leaf).x, 0.6);
}

TEST(FaceCells, give_a_sliver_its_whole_area) {
  const RasterOctree raster = build_octree(test::kUnitBox, test::sphere_boxes(100));
  const PlaneSurface plane(kFrame, 0, 1, 0, 1);
  const double v = 0.123456;
  const LoopPolygons sliver(
      std::vector<LoopSide>{{{0, v}, {1, v}}, {{1, v}, {1, v + 1e-9}}, {{1, v + 1e-9}, {0, v + 1e-9}}, {{0, v + 1e-9}, {0, v}}});
  EXPECT_NEAR(total(locate_face(plane, sliver, raster.shape.view(), 1e-9)), 1e-9, 1e-13);
}

TEST(FaceCells, weigh_area_by_squared_length) {
  FaceCells faces;
  faces.append_face(std::vector<CellArea>{{0, 2}, {1, 3}});
  faces.append_face({});
  const std::vector<CellLength> lengths{{0.5F, {}, 0.5F}, {1, {}, 1}};
  EXPECT_EQ(face_weights(faces, lengths, 1), (std::vector<double>{2 / 0.25 + 3, 0}));
  EXPECT_EQ(face_weights(faces, lengths, 2), (std::vector<double>{2 + 0.75, 0}));
}

}  // namespace
}  // namespace st
