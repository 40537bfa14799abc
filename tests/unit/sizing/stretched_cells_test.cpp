#include "sizing/stretched_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>

#include "sizing/octree_field.h"
#include "unit/sizing/cases.h"

namespace st {
namespace {

constexpr double kSlope = 0.2, kLargest = 0.2, kAspect = 16;

struct Prolonged {
  RasterOctree raster;
  ProlongedLengths lengths;
  StretchedCells stretched;
};

/// Samples on the line from a to b that allow `along` in its direction (0: none).
void add_line(Vec3 a, Vec3 b, double across, double along, std::vector<RasterBox>& boxes) {
  const auto n = static_cast<int>(distance(a, b) / across);
  const SampleStretch stretch{SmallNormal(normalized(b - a)), static_cast<float>(along)};
  for (int i = 0; i <= n; ++i)
    boxes.push_back({a + (static_cast<double>(i) / n) * (b - a),
                     static_cast<float>(2 * across),
                     static_cast<float>(across),
                     4,
                     {},
                     along > 0 ? stretch : SampleStretch{}});
}

std::unique_ptr<OctreeField> make_field(const std::vector<RasterBox>& boxes,
                                        std::shared_ptr<Prolonged>* out = nullptr) {
  const auto p = std::make_shared<Prolonged>();
  p->raster = build_octree(test::kUnitBox, boxes);
  const OctreeView view = p->raster.shape.view();
  const Neighbours neighbours(view);
  const std::vector<LengthSample> samples = sorted_samples(boxes);
  forget_samples(p->raster);
  seed_lengths(samples, kSlope, p->raster);
  const ProlongOptions options{kSlope, kLargest};
  p->lengths = prolong(neighbours, p->raster.stored_length, p->raster.stored_cause, options);
  p->stretched = prolong_stretch(neighbours, {samples}, p->raster.stored_length, p->lengths, options, kAspect, nullptr);
  if (out) *out = p;
  OctreeFieldData data{view, p->lengths.cells, p->lengths.cause, kSlope, 1};
  data.along = p->stretched.along;
  data.direction = p->stretched.direction;
  data.max_aspect = kAspect;
  return std::make_unique<OctreeField>(data, p);
}

LocalSize local(const SizeField& field, Vec3 x) {
  int hint = 0;
  return field.local(x, hint);
}

std::vector<RasterBox> line_along_x(double along) {
  std::vector<RasterBox> boxes;
  add_line({0.1, 0.5, 0.5}, {0.9, 0.5, 0.5}, 0.004, along, boxes);
  return boxes;
}

TEST(ProlongStretch, gives_the_length_along_the_line_and_returns_to_one_length_away_from_it) {
  const auto field = make_field(line_along_x(0.05));
  const LocalSize on = local(*field, {0.5, 0.5, 0.5}), near = local(*field, {0.5, 0.54, 0.5}),
                  far = local(*field, {0.5, 0.95, 0.95});
  EXPECT_NEAR(on.in({1, 0, 0}), 0.05, 0.004);
  EXPECT_NEAR(on.in({0, 1, 0}), 0.004, 0.003);
  EXPECT_NEAR(near.in({1, 0, 0}), 0.05 + kSlope * 0.04, 0.006);
  EXPECT_NEAR(near.in({0, 1, 0}), 0.004 + kSlope * 0.04, 0.003);
  EXPECT_LT(far.in({1, 0, 0}) / far.in({0, 1, 0}), 2);
}

TEST(ProlongStretch, is_none_without_samples_that_allow_it) {
  const auto field = make_field(line_along_x(0));
  for (const Vec3 x : {Vec3{0.5, 0.5, 0.5}, Vec3{0.3, 0.6, 0.5}, Vec3{0.9, 0.9, 0.9}}) {
    const LocalSize l = local(*field, x);
    EXPECT_EQ(l.along, l.length);
    EXPECT_EQ(l.length, field->size(x));
  }
}

TEST(ProlongStretch, leaves_the_length_across_as_it_was) {
  const auto plain = make_field(line_along_x(0)), stretched = make_field(line_along_x(0.06));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 x{uniform(random), uniform(random), uniform(random)};
    ASSERT_EQ(stretched->size(x), plain->size(x));
    ASSERT_EQ(local(*stretched, x).length, plain->size(x));
    ASSERT_LE(local(*stretched, x).along, kAspect * plain->size(x) * (1 + 1e-12));
  }
}

TEST(ProlongStretch, a_line_across_ends_the_stretch_and_lets_it_grow_by_the_slope) {
  std::vector<RasterBox> boxes = line_along_x(0.06);
  add_line({0.5, 0.3, 0.5}, {0.5, 0.7, 0.5}, 0.004, 0.06, boxes);
  const auto field = make_field(boxes);
  EXPECT_LT(local(*field, {0.5, 0.5, 0.5}).in({1, 0, 0}), 0.012);
  for (const double d : {0.05, 0.1, 0.15, 0.3}) {
    const double along = local(*field, {0.5 + d, 0.5, 0.5}).in({1, 0, 0});
    EXPECT_LE(along, std::min(0.06, 0.004 + kSlope * d) * 1.15 + 0.002) << d;
    EXPECT_GE(along, std::min(0.06, 0.004 + kSlope * d) * 0.6) << d;
  }
}

TEST(ProlongStretch, no_cell_allows_more_than_its_neighbours_and_the_slope) {
  std::vector<RasterBox> boxes = line_along_x(0.06);
  add_line({0.2, 0.2, 0.5}, {0.8, 0.8, 0.6}, 0.006, 0.09, boxes);
  std::shared_ptr<Prolonged> p;
  make_field(boxes, &p);
  const OctreeView view = p->raster.shape.view();
  const Neighbours neighbours(view);
  int n_stretched = 0;
  for (std::int32_t a = 0; a < view.n_leaves(); ++a) {
    const Vec3 t = normalized(Vec3(p->stretched.direction[a]));
    if (t == Vec3{}) continue;
    ++n_stretched;
    ASSERT_GE(p->stretched.along[a].length, p->lengths.cells[a].at_centre());
    neighbours.for_each(a, [&](std::int32_t b, const CellStep&) {
      const LocalSize other{p->lengths.cells[b].at_centre(), p->stretched.along[b].length,
                            normalized(Vec3(p->stretched.direction[b]))};
      const double limit = other.in(t) + kSlope * distance(view.leaf_center(a), view.leaf_center(b));
      ASSERT_LE(p->stretched.along[a].length, std::max<double>(limit, p->lengths.cells[a].at_centre()) * (1 + 1e-5));
    });
  }
  EXPECT_GT(n_stretched, 1000);
}

TEST(ProlongStretch, does_not_depend_on_the_order_of_the_samples) {
  std::vector<RasterBox> boxes = line_along_x(0.06);
  add_line({0.2, 0.2, 0.5}, {0.8, 0.8, 0.6}, 0.006, 0.09, boxes);
  std::shared_ptr<Prolonged> a, b;
  make_field(boxes, &a);
  std::shuffle(boxes.begin(), boxes.end(), std::mt19937(5));
  make_field(boxes, &b);
  ASSERT_EQ(a->stretched.along.size(), b->stretched.along.size());
  for (std::size_t i = 0; i < a->stretched.along.size(); ++i) {
    ASSERT_EQ(a->stretched.along[i].length, b->stretched.along[i].length);
    ASSERT_TRUE(Vec3(a->stretched.direction[i]) == Vec3(b->stretched.direction[i]));
  }
}

}  // namespace
}  // namespace st
