// Walls thinner than the cells, or than what samples lie off them: lengths stay on their side.
#include <gtest/gtest.h>

#include <cmath>

#include "sizing/cones.h"
#include "unit/sizing/cases.h"

namespace st {
namespace {

constexpr float kFineOfWall = 0.01F, kLargestAtWall = 0.5F, kSlopeAtWall = 0.2F;

/// Cells of one size, and a plate through all of them: `normal`, `lower` and `upper` (heights along it from the centre
/// of the cell in the middle, in edges of cells).
class WallInCells {
 public:
  WallInCells(Vec3 normal, double lower, double upper) : normal_(normalized(normal)) {
    std::vector<RasterBox> boxes;
    for (double x = 0.03; x < 1; x += 0.06)
      for (double y = 0.03; y < 1; y += 0.06)
        for (double z = 0.03; z < 1; z += 0.06) boxes.push_back({{x, y, z}, 0.03F, kLargestAtWall, 0});
    raster_ = build_octree(test::kUnitBox, boxes);
    const std::int32_t middle = leaf_at({0.5, 0.5, 0.5});
    center_ = octree().leaf_center(middle);
    edge_ = octree().cell_edge(octree().leaf_levels[middle]);
    add_plate(lower, upper);
    blanking_ = blank_cells(Neighbours(octree()), {points_, triangles_}, BlankSide::kInside);
    blanking_.flow_along_normals = 1;
  }

  OctreeView octree() const { return raster_.shape.view(); }
  std::int32_t leaf_at(Vec3 x) const { return octree().find_leaf(morton::encode(octree().grid_point(x))); }
  /// So many edges of cells above the centre of the cell in the middle.
  Vec3 at(double height) const { return center_ + height * edge_ * normal_; }

  void add_sample(double height, bool looks_down) {
    samples_.push_back({at(height), kFineOfWall, 1, SmallNormal((looks_down ? -1.0 : 1.0) * normal_), {}, {}});
  }

  /// Of the leaf there, of its part on the upper or lower side: how many samples tell lengths in it.
  std::int32_t n_cones(double height, bool is_upper) const {
    const std::vector<float> slope(samples_.size(), kSlopeAtWall);
    const ConeTable table = spread_cones(Neighbours(octree()), samples_, slope, kLargestAtWall, &blanking_);
    std::int32_t site = leaf_at(at(height));
    if (const std::int32_t split = blanking_.find_split(site); split != kNone) {
      const float* n = blanking_.split[split].normal;
      if ((dot(Vec3{n[0], n[1], n[2]}, normal_) > 0) != is_upper) site = octree().n_leaves() + split;
    }
    return table.first[site + 1] - table.first[site];
  }
  const Blanking& blanking() const { return blanking_; }

 private:
  /// Far beyond the cells to all sides.
  void add_plate(double lower, double upper) {
    const Vec3 u = normalized(cross(normal_, Vec3{0.1, 0.2, 0.9})), v = cross(normal_, u);
    for (const double height : {lower, upper})
      for (const auto& [a, b] : {std::pair(-3, -3), std::pair(3, -3), std::pair(3, 3), std::pair(-3, 3)})
        points_.push_back(at(height) + a * u + b * v);
    const auto quad = [&](NodeId a, NodeId b, NodeId c, NodeId d) {
      triangles_.push_back({{a, b, c}});
      triangles_.push_back({{a, c, d}});
    };
    quad(0, 3, 2, 1);
    quad(4, 5, 6, 7);
    for (const NodeId k : {0, 1, 2, 3}) quad(k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k);
  }

  Vec3 normal_, center_;
  double edge_ = 0;
  RasterOctree raster_;
  std::vector<Vec3> points_;
  std::vector<Triangle> triangles_;
  Blanking blanking_;
  std::vector<LengthSample> samples_;
};

// The plate fills the cell in the middle but for two of its edges, beyond all points that are looked at.
TEST(ThinWalls, separate_cells_of_which_they_leave_two_corners) {
  WallInCells wall({1, 1, 0}, -0.69, 0.69);
  const std::int32_t middle = wall.leaf_at(wall.at(0));
  EXPECT_EQ(wall.blanking().colour[middle], CellColour::kCut);
  EXPECT_NE(wall.blanking().find_split(middle), kNone);
  wall.add_sample(-1.5, true);
  EXPECT_GT(wall.n_cones(-1, false), 0);
  EXPECT_GT(wall.n_cones(0, false), 0);
  for (const double height : {0.0, 1.0, 2.0}) EXPECT_EQ(wall.n_cones(height, true), 0) << height;
}

// Lengths pass into what is blanked between the two sides, and not from there.
TEST(ThinWalls, do_not_hand_on_what_is_told_inside_them) {
  WallInCells wall({0, 0, 1}, -0.9, 0.9);
  ASSERT_EQ(wall.blanking().colour[wall.leaf_at(wall.at(0))], CellColour::kBlanked);
  wall.add_sample(-1.5, true);
  EXPECT_GT(wall.n_cones(-1, false), 0);
  EXPECT_GT(wall.n_cones(0, false), 0);
  for (const double height : {1.0, 2.0}) EXPECT_EQ(wall.n_cones(height, true), 0) << height;
}

// A sample of the lower side that lies so far off it that it is in a cell that holds the upper side alone.
TEST(ThinWalls, keep_samples_to_the_side_that_these_look_to) {
  WallInCells wall({0, 0, 1}, -0.7, -0.3);
  ASSERT_EQ(wall.blanking().colour[wall.leaf_at(wall.at(-1))], CellColour::kCut);
  ASSERT_EQ(wall.blanking().find_split(wall.leaf_at(wall.at(-1))), kNone);
  wall.add_sample(-0.45, true);
  EXPECT_GT(wall.n_cones(-1, false), 0);
  for (const double height : {0.0, 1.0}) EXPECT_EQ(wall.n_cones(height, true), 0) << height;
}

// Likewise one that lies in a cell that is all inside the wall: both sides lie beside it.
TEST(ThinWalls, keep_samples_that_lie_inside_them_to_their_side) {
  WallInCells wall({0, 0, 1}, -0.9, 0.9);
  ASSERT_EQ(wall.blanking().colour[wall.leaf_at(wall.at(-0.45))], CellColour::kBlanked);
  wall.add_sample(-0.45, true);
  EXPECT_GT(wall.n_cones(-1, false), 0);
  for (const double height : {1.0, 2.0}) EXPECT_EQ(wall.n_cones(height, true), 0) << height;
}

}  // namespace
}  // namespace st
