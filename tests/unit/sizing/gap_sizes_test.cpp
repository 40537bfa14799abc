#include "sizing/gap_sizes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace st {
namespace {

/// A plate of 10 x 10 in z = `z`, as discs of squares of side 1, whose normal is `nz` ez.
void add_plate(double z, double nz, std::vector<FaceDisc>& discs, double length = 1, double min_length = 0.01) {
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j)
      discs.push_back({{i + 0.5, j + 0.5, z}, {0, 0, nz}, 0.75, length, min_length, static_cast<int>(discs.size())});
}

std::vector<RasterBox> gaps(const std::vector<FaceDisc>& discs, int n = 4) {
  std::vector<RasterBox> boxes;
  add_gap_boxes(discs, n, 2, boxes);
  return boxes;
}

TEST(GapSizes, put_n_lengths_between_two_plates_everywhere) {
  for (const double side : {1.0, -1.0}) {  // a slot, a thin wall
    std::vector<FaceDisc> discs;
    add_plate(0, side, discs);
    add_plate(0.4, -side, discs);
    const std::vector<RasterBox> boxes = gaps(discs);
    for (const RasterBox& b : boxes) EXPECT_NEAR(b.length, 0.1, 1e-6);
    for (double x = 0.05; x < 10; x += 0.3)
      for (const double z : {0.0, 0.4}) {
        const auto covers = [&](const RasterBox& b) {
          return std::abs(b.center.x - x) <= b.half && std::abs(b.center.y - 5.03) <= b.half && std::abs(b.center.z - z) <= b.half;
        };
        EXPECT_TRUE(std::any_of(boxes.begin(), boxes.end(), covers)) << x << " " << z;
      }
  }
}

TEST(GapSizes, ask_for_nothing_without_a_facing_surface) {
  std::vector<FaceDisc> discs;
  add_plate(0, 1, discs);
  EXPECT_TRUE(gaps(discs).empty()) << "alone";
  add_plate(0.4, 1, discs);
  EXPECT_TRUE(gaps(discs).empty()) << "normals alike";
  discs.clear();
  add_plate(0, 1, discs);
  add_plate(4.1, -1, discs);
  EXPECT_TRUE(gaps(discs).empty()) << "a gap that holds four lengths as it is";
  discs.clear();
  add_plate(0, 1, discs);
  add_plate(1e-6, -1, discs);
  EXPECT_TRUE(gaps(discs).empty()) << "touching surfaces";
}

TEST(GapSizes, stay_above_the_smallest_length) {
  std::vector<FaceDisc> discs;
  add_plate(0, 1, discs, 1, 0.2);
  add_plate(0.4, -1, discs, 1, 0.3);
  for (const RasterBox& b : gaps(discs)) EXPECT_NEAR(b.length, b.cause < 100 ? 0.2 : 0.3, 1e-6);
}

}  // namespace
}  // namespace st
