#include "sizing/octree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "base/threads.h"
#include "sizing/octree_nodes.h"
#include "unit/sizing/cases.h"
#include "unit/sizing/octree_balance.h"

namespace st {
namespace {

using test::kUnitBox;
using test::sphere_boxes;

RasterBox box_at(Vec3 center, float length, std::int32_t cause = pack_cause(CauseKind::kFace, 0)) {
  return {center, length, length, cause};
}

bool meets(const RasterOctree& octree, std::int32_t leaf, const RasterBox& box, double margin) {
  const Vec3 c = octree.shape.view().leaf_center(leaf);
  const double reach = 0.5 * octree.shape.view().cell_edge(octree.shape.leaf_levels[leaf]) + box.half + margin;
  return std::abs(c.x - box.center.x) < reach && std::abs(c.y - box.center.y) < reach &&
         std::abs(c.z - box.center.z) < reach;
}

TEST(Octree, is_one_empty_cell_without_boxes) {
  const RasterOctree octree = build_octree(kUnitBox, {});
  EXPECT_STREQ(test::octree_defect(octree.shape.view()), "");
  ASSERT_EQ(octree.shape.leaf_keys.size(), 1u);
  EXPECT_TRUE(std::isinf(octree.stored_length[0]));
  EXPECT_EQ(octree.stored_cause[0], kNone);
}

TEST(Octree, is_balanced_across_corners) {
  const RasterOctree octree = build_octree(kUnitBox, sphere_boxes(3000));
  EXPECT_STREQ(test::octree_defect(octree.shape.view()), "");
  const auto [lo, hi] = std::minmax_element(octree.shape.leaf_levels.begin(), octree.shape.leaf_levels.end());
  EXPECT_GE(*hi - *lo, 4) << "the case must have unlike levels to mean anything";
}

TEST(Octree, is_balanced_around_one_tiny_box_beside_the_middle) {
  // next to the root's centre: the coarsest neighbours are across a face, an edge and a corner of the root's children
  const RasterOctree octree = build_octree(kUnitBox, std::vector<RasterBox>{box_at({0.5001, 0.5001, 0.5001}, 1e-5F)});
  EXPECT_STREQ(test::octree_defect(octree.shape.view()), "");
}

TEST(Octree, has_no_cell_larger_than_a_box_it_meets) {
  const std::vector<RasterBox> boxes = sphere_boxes(500);
  const RasterOctree octree = build_octree(kUnitBox, boxes);
  for (const RasterBox& box : boxes)
    for (std::int32_t leaf = 0; leaf < octree.shape.view().n_leaves(); ++leaf) {
      if (!meets(octree, leaf, box, -1e-5)) continue;
      ASSERT_LE(octree.shape.view().cell_edge(octree.shape.leaf_levels[leaf]), 2.0 * box.half);
    }
}

TEST(Octree, stores_the_same_on_any_number_of_threads_as_box_by_box) {
  std::vector<RasterBox> boxes = sphere_boxes(1000);
  for (const double half : {0.4, 0.11, 0.06, 0.03})  // larger than the subtrees that threads fill, and as large
    for (const double x : {0.2, 0.5, 0.8})
      boxes.push_back({{x, 0.5, 0.35}, static_cast<float>(half), static_cast<float>(0.1 * half), 7});
  const OctreeShape shape = make_shape(kUnitBox, split_cells(kUnitBox, boxes));
  PackedLengths expected(shape.leaf_keys.size(), ~std::uint64_t{0});
  for (const RasterBox& box : boxes) {
    const PackedLengths own = store_boxes(shape, std::span(&box, 1));
    for (std::size_t i = 0; i < own.size(); ++i) expected[i] = std::min(expected[i], own[i]);
  }
  for (const int n_threads : {1, 2, 7}) {
    set_thread_count(n_threads);
    EXPECT_EQ(store_boxes(shape, boxes), expected) << n_threads << " threads";
  }
  set_thread_count(1);
}

TEST(Octree, stores_the_smallest_length_that_met_each_cell_and_its_cause) {
  const std::vector<RasterBox> boxes = sphere_boxes(400);
  const RasterOctree octree = build_octree(kUnitBox, boxes);
  for (std::int32_t leaf = 0; leaf < octree.shape.view().n_leaves(); ++leaf) {
    float surely = std::numeric_limits<float>::infinity(), perhaps = surely;
    for (const RasterBox& box : boxes) {
      if (meets(octree, leaf, box, -1e-5)) surely = std::min(surely, box.length);
      if (meets(octree, leaf, box, 1e-5)) perhaps = std::min(perhaps, box.length);
    }
    const float stored = octree.stored_length[leaf];
    ASSERT_LE(stored, surely);
    ASSERT_GE(stored, perhaps);
    const std::int32_t cause = octree.stored_cause[leaf];
    ASSERT_EQ(std::isinf(stored), cause == kNone);
    if (cause == kNone) continue;
    ASSERT_TRUE(std::any_of(boxes.begin(), boxes.end(),
                            [&](const RasterBox& b) { return b.length == stored && b.cause == cause; }));
  }
}

TEST(Octree, does_not_depend_on_the_order_of_boxes) {
  std::vector<RasterBox> boxes = sphere_boxes(5000);
  for (std::size_t i = 0; i < 1000; ++i)
    boxes.push_back({boxes[i].center, boxes[i].half, boxes[i].length, pack_cause(CauseKind::kEdge, 3)});
  const RasterOctree a = build_octree(kUnitBox, boxes);
  std::shuffle(boxes.begin(), boxes.end(), std::mt19937(7));
  const RasterOctree b = build_octree(kUnitBox, boxes);
  EXPECT_EQ(a.shape.leaf_keys, b.shape.leaf_keys);
  EXPECT_EQ(a.shape.leaf_levels, b.shape.leaf_levels);
  EXPECT_EQ(a.shape.node_children, b.shape.node_children);
  EXPECT_EQ(a.stored_length, b.stored_length);
  EXPECT_EQ(a.stored_cause, b.stored_cause);
}

/// Large boxes over small ones, and a crowd of equal lengths, so that cells keep lengths as a whole and ties decide.
std::vector<RasterBox> mixed_boxes(std::mt19937& random, int n) {
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  std::vector<RasterBox> boxes;
  for (int i = 0; i < n; ++i) {
    const float length = 0.004F * static_cast<float>(1 << (random() % 6));
    boxes.push_back(
        box_at({uniform(random), uniform(random), 0.3 * uniform(random)}, length, pack_cause(CauseKind::kFace, i % 7)));
  }
  return boxes;
}

TEST(Octree, stores_in_every_cell_the_smallest_length_of_all_boxes_that_meet_it) {
  std::mt19937 random(11);
  const std::vector<RasterBox> boxes = mixed_boxes(random, 300);
  const RasterOctree octree = build_octree(kUnitBox, boxes);
  for (std::int32_t leaf = 0; leaf < octree.shape.view().n_leaves(); ++leaf) {
    std::pair<float, std::int32_t> surely{std::numeric_limits<float>::infinity(), kNone}, perhaps = surely;
    for (const RasterBox& box : boxes) {
      if (meets(octree, leaf, box, -1e-5)) surely = std::min(surely, {box.length, box.cause});
      if (meets(octree, leaf, box, 1e-5)) perhaps = std::min(perhaps, {box.length, box.cause});
    }
    const std::pair<float, std::int32_t> stored{octree.stored_length[leaf], octree.stored_cause[leaf]};
    ASSERT_TRUE(stored == surely || stored == perhaps)
        << "leaf " << leaf << " stores " << stored.first << " of " << stored.second;
  }
}

TEST(Octree, of_parts_of_the_boxes_is_that_of_all_boxes) {
  std::mt19937 random(5);
  const std::vector<RasterBox> boxes = mixed_boxes(random, 400);
  std::array<std::vector<RasterBox>, 4> parts;  // one stays empty
  for (const RasterBox& box : boxes) parts[random() % 3].push_back(box);
  NodeLevels nodes;
  for (const auto& part : parts) unite_nodes(nodes, split_cells(kUnitBox, part));
  OctreeShape shape = make_shape(kUnitBox, nodes);
  PackedLengths packed = store_boxes(shape, parts[3]);
  for (const auto& part : parts) {
    const PackedLengths more = store_boxes(shape, part);
    for (std::size_t i = 0; i < packed.size(); ++i) packed[i] = std::min(packed[i], more[i]);
  }
  const RasterOctree united = unpack_octree(std::move(shape), packed), whole = build_octree(kUnitBox, boxes);
  EXPECT_EQ(united.shape.leaf_keys, whole.shape.leaf_keys);
  EXPECT_EQ(united.shape.leaf_levels, whole.shape.leaf_levels);
  EXPECT_EQ(united.shape.node_children, whole.shape.node_children);
  EXPECT_EQ(united.stored_length, whole.stored_length);
  EXPECT_EQ(united.stored_cause, whole.stored_cause);
}

TEST(Octree, of_more_boxes_than_a_thread_takes_at_once_is_that_of_a_few_at_a_time) {
  const std::vector<RasterBox> boxes = sphere_boxes(30'000);
  NodeLevels nodes;
  for (std::size_t first = 0; first < boxes.size(); first += 1'000)
    unite_nodes(nodes, split_cells(kUnitBox, std::span(boxes).subspan(first, 1'000)));
  const OctreeShape shape = make_shape(kUnitBox, nodes);
  EXPECT_STREQ(test::octree_defect(shape.view()), "");
  PackedLengths stored(shape.leaf_keys.size(), ~std::uint64_t{0});
  for (std::size_t first = 0; first < boxes.size(); first += 1'000) {
    const PackedLengths own = store_boxes(shape, std::span(boxes).subspan(first, 1'000));
    for (std::size_t i = 0; i < own.size(); ++i) stored[i] = std::min(stored[i], own[i]);
  }
  for (const int n_threads : {1, 3}) {
    set_thread_count(n_threads);
    EXPECT_EQ(split_cells(kUnitBox, boxes), nodes);
    EXPECT_EQ(make_shape(kUnitBox, nodes).node_children, shape.node_children);
    EXPECT_EQ(store_boxes(shape, boxes), stored) << n_threads << " threads";
  }
  set_thread_count(1);
}

TEST(Octree, ignores_boxes_outside_and_clips_boxes_that_stick_out) {
  const RasterOctree octree =
      build_octree(kUnitBox, std::vector<RasterBox>{box_at({9, 0.5, 0.5}, 0.01F), box_at({-5, -5, -5}, 0.01F)});
  EXPECT_EQ(octree.shape.leaf_keys.size(), 1u);
  const RasterOctree clipped = build_octree(kUnitBox, std::vector<RasterBox>{box_at({1.05, 0.5, 0.5}, 0.1F)});
  EXPECT_STREQ(test::octree_defect(clipped.shape.view()), "");
  EXPECT_GT(clipped.shape.leaf_keys.size(), 1u);
}

TEST(Octree, stops_at_the_deepest_level) {
  const RasterOctree octree = build_octree(kUnitBox, std::vector<RasterBox>{box_at({0.3, 0.3, 0.3}, 1e-12F)});
  EXPECT_STREQ(test::octree_defect(octree.shape.view()), "");
  EXPECT_EQ(*std::max_element(octree.shape.leaf_levels.begin(), octree.shape.leaf_levels.end()), kMaxLevel);
}

TEST(Octree, defect_finds_a_broken_link_and_a_gap) {
  RasterOctree octree = build_octree(kUnitBox, sphere_boxes(50));
  OctreeShape broken = octree.shape;
  std::swap(broken.node_children[1], broken.node_children[2]);
  EXPECT_STRNE(test::octree_defect(broken.view()), "");
  broken = octree.shape;
  broken.leaf_keys[5] += 1;
  EXPECT_STRNE(test::octree_defect(broken.view()), "");
  broken = octree.shape;
  broken.leaf_levels.pop_back();
  EXPECT_STRNE(test::octree_defect(broken.view()), "");
}

TEST(Octree, finds_the_leaf_whose_box_holds_the_point) {
  const RasterOctree octree = build_octree(kUnitBox, sphere_boxes(2000));
  const OctreeView view = octree.shape.view();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 x{uniform(random), uniform(random), uniform(random)};
    const std::int32_t leaf = view.find_leaf(morton::encode(view.grid_point(x)));
    const Vec3 c = view.leaf_center(leaf);
    const double half = 0.5000001 * view.cell_edge(view.leaf_levels[leaf]);
    ASSERT_TRUE(std::abs(x.x - c.x) <= half && std::abs(x.y - c.y) <= half && std::abs(x.z - c.z) <= half);
  }
}

TEST(Morton, round_trips) {
  std::mt19937 random(5);
  for (int i = 0; i < 1000; ++i) {
    const GridPoint p{static_cast<std::uint32_t>(random()) % kCoordinateEnd,
                      static_cast<std::uint32_t>(random()) % kCoordinateEnd,
                      static_cast<std::uint32_t>(random()) % kCoordinateEnd};
    const GridPoint q = morton::decode(morton::encode(p));
    ASSERT_TRUE(p.x == q.x && p.y == q.y && p.z == q.z);
  }
}

}  // namespace
}  // namespace st
