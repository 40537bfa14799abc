#include "sizing/size_origin.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sizing/prolong.h"
#include "unit/sizing/cases.h"

namespace st {
namespace {

TEST(SizeOrigin, leads_back_to_the_sample_that_asked_for_it) {
  const std::vector<RasterBox> boxes{{{0.1, 0.1, 0.1}, 0.01F, 0.01F, pack_cause(CauseKind::kEdge, 7)},
                                     {{0.9, 0.9, 0.9}, 0.02F, 0.02F, pack_cause(CauseKind::kFace, 3)}};
  const RasterOctree raster = build_octree(test::kUnitBox, boxes);
  const OctreeView octree = raster.shape.view();
  const ProlongedLengths lengths = prolong(Neighbours(octree), raster.stored_length, raster.stored_cause, {0.2, 1});
  const OctreeFieldData field{octree, lengths.cells, lengths.cause, 0.2, 1};
  const Neighbours neighbours(octree);
  for (std::int32_t leaf = 0; leaf < octree.n_leaves(); ++leaf) {
    const SizeOrigin origin = find_origin(field, neighbours, leaf);
    ASSERT_EQ(raster.stored_cause[origin.leaf], lengths.cause[leaf]);
    const RasterBox& box = boxes[cause_kind(lengths.cause[leaf]) == CauseKind::kEdge ? 0 : 1];
    ASSERT_EQ(static_cast<float>(origin.length), box.length);
    ASSERT_LT(distance(origin.xyz, box.center), 0.1);
  }
}

TEST(SizeOrigin, of_the_largest_length_is_the_cell_itself) {
  const RasterOctree raster = build_octree(test::kUnitBox, {});
  const ProlongedLengths lengths =
      prolong(Neighbours(raster.shape.view()), raster.stored_length, raster.stored_cause, {0.2, 1});
  const SizeOrigin origin =
      find_origin({raster.shape.view(), lengths.cells, lengths.cause, 0.2, 3}, Neighbours(raster.shape.view()), 0);
  EXPECT_EQ(origin.leaf, 0);
  EXPECT_EQ(origin.length, 3);
}

}  // namespace
}  // namespace st
