#include "sizing/moved_field.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace st {
namespace {

/// An octree of eight leaves in [0, 8]^3 with lengths that grow along x.
struct EightLeaves {
  OctreeShape shape;
  std::vector<CellLength> cells;
  std::vector<std::int32_t> cause = std::vector<std::int32_t>(8, kNone);

  EightLeaves() {
    const RasterBox box{{0.5, 0.5, 0.5}, 1.5f, 1.5f, 0};
    shape = build_octree({{0.08, 0.08, 0.08}, {7.92, 7.92, 7.92}}, std::vector{box}).shape;
    cause.assign(shape.leaf_keys.size(), 0);
    for (std::int32_t leaf = 0; leaf < shape.view().n_leaves(); ++leaf)
      cells.push_back({static_cast<float>(1 + 0.1 * shape.view().leaf_center(leaf).x), {0.1f, 0, 0}, 10});
  }
  OctreeFieldData data() const { return {shape.view(), cells, cause, 0.1, 1.5}; }
};

TEST(MovedField, asks_the_octree_where_the_point_was_and_scales_its_length) {
  const EightLeaves octree;
  const OctreeField still(octree.data(), nullptr);
  const Similarity motion =
      rotation_about({1, 2, 3}, 0.7).then(reflection_at({0, 1, 0})).then({.scale = 3, .translation = {5, -6, 7}});
  const std::unique_ptr<OctreeField> moved = make_octree_field(octree.data(), nullptr, 0, motion);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 9);
  int hint = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 x{uniform(random), uniform(random), uniform(random)};
    ASSERT_NEAR(moved->size(motion(x), hint), 3 * still.size(x), 1e-9);
    const SizeExplanation why = moved->explain(motion(x)), before = still.explain(x);
    ASSERT_NEAR(why.length, 3 * before.length, 1e-9);
    ASSERT_LE(distance(why.gradient, motion.rotated(before.gradient)), 1e-12);
    ASSERT_NEAR(why.cell_edge, 3 * before.cell_edge, 1e-9);
  }
  EXPECT_DOUBLE_EQ(moved->min_size(), 3 * still.min_size());
  EXPECT_EQ(moved->slope(), still.slope());
  EXPECT_EQ(moved->frame(), motion);
}

TEST(MovedField, is_the_plain_field_where_nothing_moved) {
  const EightLeaves octree;
  const std::unique_ptr<OctreeField> field = make_octree_field(octree.data(), nullptr, 0, {});
  EXPECT_EQ(dynamic_cast<MovedOctreeField*>(field.get()), nullptr);
}

TEST(MovedField, turns_the_direction_and_scales_both_lengths) {
  const EightLeaves octree;
  OctreeFieldData data = octree.data();
  const std::size_t n = octree.cells.size();
  ConeTable cones;  // one, that tells the lengths of all leaves
  cones.cone = {Cone({{4, 4, 4}, 1.0F}, 0.1F, octree.shape.lo)};
  cones.cause = {kNone};
  cones.of_site.assign(n, 0);
  for (std::size_t site = 0; site <= n; ++site) cones.first.push_back(static_cast<std::int32_t>(site));
  cones.stretch = {ConeStretch(SampleStretch{SmallNormal(Vec3{1, 0, 0}), 9})};
  cones.first_along.assign(n + 1, 0);
  data.set_cones(cones, 10);
  data.max_aspect = 5;
  const OctreeField still(data, nullptr);
  const Similarity motion = rotation_about({1, 2, 3}, 0.7).then({.scale = 3, .translation = {5, -6, 7}});
  const std::unique_ptr<OctreeField> moved = make_octree_field(data, nullptr, 0, motion);
  int hint = 0;
  for (const Vec3 x : {Vec3{1, 1, 1}, Vec3{7, 3, 2}}) {
    const LocalSize a = still.local(x, hint), b = moved->local(motion(x), hint);
    EXPECT_EQ(a.length, still.size(x));
    EXPECT_GT(a.along, 2 * a.length);
    EXPECT_NEAR(b.length, 3 * a.length, 1e-9);
    EXPECT_NEAR(b.along, 3 * a.along, 1e-9);
    EXPECT_LE(distance(b.direction, motion.rotated({1, 0, 0})), 1e-9);
    const SizeExplanation why = moved->explain(motion(x));
    EXPECT_NEAR(why.along, b.along, 1e-9);
    EXPECT_LE(distance(why.direction, b.direction), 1e-9);
  }
}

}  // namespace
}  // namespace st
