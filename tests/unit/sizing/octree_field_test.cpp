#include "sizing/octree_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "unit/sizing/sampled_field.h"

namespace st {
namespace {

constexpr double kSlope = 0.2;
constexpr double kMaxLength = 0.06;

std::unique_ptr<OctreeField> make_field(double scale = 1) {
  const auto sampled = test::sample_field(test::sphere_boxes(4000), kSlope, kMaxLength);
  sampled->data.scale = scale;
  return std::make_unique<OctreeField>(sampled->data, sampled);
}

double cell_edge_at(const OctreeField& field, Vec3 x) { return field.explain(x).cell_edge; }

TEST(OctreeField, respects_the_slope_between_any_two_points) {
  const auto field = make_field();
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-0.01, 1.01);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 300000; ++i) {
    const Vec3 a{uniform(random), uniform(random), uniform(random)};
    Vec3 b{uniform(random), uniform(random), uniform(random)};
    if (i % 2) b = a + cell_edge_at(*field, a) * Vec3{normal(random), normal(random), normal(random)};
    const double allowed = kSlope * (distance(a, b) + cell_edge_at(*field, a) + cell_edge_at(*field, b)) * 1.15;
    ASSERT_LE(std::abs(field->size(a) - field->size(b)), allowed);
  }
}

TEST(OctreeField, stays_between_the_smallest_and_the_largest_length) {
  const auto field = make_field();
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-1, 2);
  for (int i = 0; i < 100000; ++i) {
    const double h = field->size(Vec3{uniform(random), uniform(random), uniform(random)});
    ASSERT_GE(h, field->min_size());
    ASSERT_LE(h, static_cast<double>(static_cast<float>(kMaxLength)) * (1 + 1e-7));
  }
}

TEST(OctreeField, answers_the_same_whatever_the_hint) {
  const auto field = make_field();
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(0, 1);
  const int n = field->data().octree.n_leaves();
  int coherent = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 x{uniform(random), uniform(random), uniform(random)};
    const double expected = field->size(x);
    for (int hint :
         {0, n - 1, n, -1, std::numeric_limits<int>::max(), static_cast<int>(random() % static_cast<unsigned>(n))})
      ASSERT_EQ(field->size(x, hint), expected);
    ASSERT_EQ(field->size(x, coherent), expected);
    ASSERT_EQ(field->size(x, coherent), expected);
  }
}

TEST(OctreeField, asks_the_nearest_leaf_outside_its_box) {
  const auto field = make_field();
  const double at_side = field->size(Vec3{field->data().octree.lo.x, 0.5, 0.5});
  EXPECT_NEAR(field->size(Vec3{-0.02, 0.5, 0.5}), at_side + 0.02 * kSlope, 0.02 * kSlope);
  EXPECT_FLOAT_EQ(static_cast<float>(field->size(Vec3{-100, 0.5, 0.5})), static_cast<float>(kMaxLength));
  EXPECT_TRUE(std::isfinite(field->size(Vec3{std::numeric_limits<double>::infinity(), 0, 0})));
  EXPECT_TRUE(std::isfinite(field->size(Vec3{std::numeric_limits<double>::quiet_NaN(), 0, 0})));
}

TEST(OctreeField, scale_multiplies_lengths_and_slope) {
  const auto field = make_field(), half = make_field(0.5);
  for (const Vec3 x : {Vec3{0.5, 0.5, 0.9}, Vec3{0.1, 0.2, 0.3}, Vec3{0.5, 0.5, 0.7}})
    EXPECT_DOUBLE_EQ(half->size(x), 0.5 * field->size(x));
  EXPECT_DOUBLE_EQ(half->min_size(), 0.5 * field->min_size());
  EXPECT_DOUBLE_EQ(half->slope(), 0.5 * kSlope);
}

TEST(OctreeField, interpolates_growth_from_a_wall) {
  const auto sampled = test::sample_field(test::wall_boxes(0.02F), kSlope, 10);
  const OctreeField field(sampled->data, sampled);
  for (double x = 0.05; x < 0.7; x += 0.01)
    EXPECT_NEAR(field.size(Vec3{x, 0.5, 0.5}), 0.02 + kSlope * x, 0.15 * (0.02 + kSlope * x));
}

TEST(OctreeField, has_one_length_in_each_cell_without_cones) {
  const RasterOctree raster = build_octree(test::kUnitBox, test::wall_boxes(0.1F));
  std::vector<CellLength> cells;
  for (std::size_t i = 0; i < raster.shape.leaf_keys.size(); ++i) {
    const float length = 1 + static_cast<float>(i);
    cells.push_back({length, {0, 0, 0}, length});
  }
  const OctreeField field({raster.shape.view(), cells, {}, kSlope, 2}, nullptr);
  for (const Vec3 x : {Vec3{0.01, 0.02, 0.03}, Vec3{0.5, 0.9, 0.2}, Vec3{0.51, 0.91, 0.21}}) {
    int leaf = 0;
    const double length = field.size(x, leaf);
    EXPECT_EQ(length, 2 * cells[leaf].length);
  }
}

}  // namespace
}  // namespace st
