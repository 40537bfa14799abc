#include "sizing/octree_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "sizing/prolong.h"
#include "unit/sizing/cases.h"

namespace st {
namespace {

constexpr double kSlope = 0.2;
constexpr double kMaxLength = 0.06;

struct Storage {
  RasterOctree raster;
  ProlongedLengths lengths;
};

std::unique_ptr<OctreeField> make_field(double scale = 1) {
  auto storage = std::make_shared<Storage>();
  storage->raster = build_octree(test::kUnitBox, test::sphere_boxes(4000));
  const OctreeView view = storage->raster.shape.view();
  storage->lengths =
      prolong(Neighbours(view), storage->raster.stored_length, storage->raster.stored_cause, {kSlope, kMaxLength});
  const OctreeFieldData data{view, storage->lengths.cells, storage->lengths.cause, kSlope, scale};
  return std::make_unique<OctreeField>(data, storage);
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

TEST(OctreeField, clamps_points_outside_to_its_box) {
  const auto field = make_field();
  EXPECT_EQ(field->size(Vec3{-100, 0.5, 0.5}), field->size(Vec3{field->data().octree.lo.x, 0.5, 0.5}));
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
  auto storage = std::make_shared<Storage>();
  storage->raster = build_octree(test::kUnitBox, test::wall_boxes(0.02F));
  const OctreeView view = storage->raster.shape.view();
  storage->lengths =
      prolong(Neighbours(view), storage->raster.stored_length, storage->raster.stored_cause, {kSlope, 10});
  const OctreeField field({view, storage->lengths.cells, storage->lengths.cause, kSlope, 1}, storage);
  for (double x = 0.05; x < 0.7; x += 0.01)
    EXPECT_NEAR(field.size(Vec3{x, 0.5, 0.5}), 0.02 + kSlope * x, 0.15 * (0.02 + kSlope * x));
}

}  // namespace
}  // namespace st
