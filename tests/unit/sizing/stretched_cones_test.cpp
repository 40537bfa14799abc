#include "sizing/stretched_cones.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <random>

#include "base/threads.h"
#include "sizing/octree_field.h"
#include "unit/sizing/cases.h"

namespace st {
namespace {

constexpr double kSlope = 0.2, kLargest = 0.2, kAspect = 16;

struct Spread {
  RasterOctree raster;
  std::vector<LengthSample> samples;
  ConeTable cones;
  ProlongedLengths lengths;
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

std::unique_ptr<OctreeField> make_field(const std::vector<RasterBox>& boxes, std::shared_ptr<Spread>* out = nullptr) {
  const auto p = std::make_shared<Spread>();
  p->raster = build_octree(test::kUnitBox, boxes);
  const OctreeView view = p->raster.shape.view();
  const Neighbours neighbours(view);
  p->samples = sorted_samples(boxes);
  const std::vector<float> slope(p->samples.size(), static_cast<float>(kSlope));
  SampleSites sites;
  p->cones = spread_cones(neighbours, p->samples, slope, kLargest, nullptr, &sites);
  add_stretch(view, p->samples, slope, sites, p->cones);
  if (out) *out = p;
  OctreeFieldData data{view, {}, {}, kSlope, 1};
  data.set_cones(p->cones, kLargest);
  data.max_aspect = kAspect;
  p->lengths = lengths_at_centers(data, p->cones.at_center);
  data.cells = p->lengths.cells;
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

TEST(StretchedCones, gives_the_length_along_the_line_and_returns_to_one_length_away_from_it) {
  const auto field = make_field(line_along_x(0.05));
  const LocalSize on = local(*field, {0.5, 0.5, 0.5}), near = local(*field, {0.5, 0.54, 0.5}),
                  far = local(*field, {0.5, 0.95, 0.95});
  EXPECT_NEAR(on.in({1, 0, 0}), 0.05, 0.004);
  EXPECT_NEAR(on.in({0, 1, 0}), 0.004, 0.003);
  EXPECT_NEAR(near.in({1, 0, 0}), 0.05 + kSlope * 0.04, 0.006);
  EXPECT_NEAR(near.in({0, 1, 0}), 0.004 + kSlope * 0.04, 0.003);
  EXPECT_LT(far.in({1, 0, 0}) / far.in({0, 1, 0}), 2);
}

TEST(StretchedCones, is_none_without_samples_that_allow_it) {
  const auto field = make_field(line_along_x(0));
  for (const Vec3 x : {Vec3{0.5, 0.5, 0.5}, Vec3{0.3, 0.6, 0.5}, Vec3{0.9, 0.9, 0.9}}) {
    const LocalSize l = local(*field, x);
    EXPECT_EQ(l.along, l.length);
    EXPECT_EQ(l.length, field->size(x));
  }
}

TEST(StretchedCones, leaves_the_length_across_as_it_was) {
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

TEST(StretchedCones, a_line_across_ends_the_stretch_and_lets_it_grow_by_the_slope) {
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

/// The smallest that all samples ask for along `t`.
double exact_along(const Spread& p, Vec3 x, Vec3 t) {
  double least = kLargest;
  const float unit[3] = {static_cast<float>(t.x), static_cast<float>(t.y), static_cast<float>(t.z)};
  const Vec3 lo = p.raster.shape.lo;
  for (const LengthSample& s : p.samples) {
    const Cone cone(s, static_cast<float>(kSlope), lo);
    const auto rise = static_cast<float>(cone.length_at(x - lo) - cone.length);
    least = std::min<double>(least, test::length_in(ConeStretch(s.stretch), unit, cone.length, rise));
  }
  return least;
}

/// Lines that cross, and one without stretch.
std::vector<RasterBox> several_lines() {
  std::vector<RasterBox> boxes = line_along_x(0.06);
  add_line({0.2, 0.2, 0.5}, {0.8, 0.8, 0.6}, 0.006, 0.09, boxes);
  add_line({0.7, 0.3, 0.3}, {0.7, 0.3, 0.7}, 0.005, 0, boxes);
  return boxes;
}

TEST(StretchedCones, ask_for_the_smallest_along_of_all_samples) {
  std::shared_ptr<Spread> p;
  const auto field = make_field(several_lines(), &p);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> ratios;
  while (ratios.size() < 3000) {
    const LengthSample& from = p->samples[random() % p->samples.size()];
    const double far = 0.2 * uniform(random) * uniform(random);
    const Vec3 x = from.xyz + far * Vec3{uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5};
    const LocalSize at = local(*field, x);
    if (at.along > at.length) ratios.push_back(at.along / exact_along(*p, x, at.direction));
  }
  std::sort(ratios.begin(), ratios.end());
  EXPECT_GE(ratios.front(), 1 - 1e-5);
  EXPECT_LE(ratios[ratios.size() * 99 / 100], 1.02);
  EXPECT_LE(ratios.back(), 1.1);
}

TEST(StretchedCones, grow_by_the_slope_along_one_direction) {
  std::vector<RasterBox> boxes = line_along_x(0.06);
  add_line({0.2, 0.45, 0.5}, {0.8, 0.45, 0.5}, 0.006, 0.02, boxes);
  add_line({0.7, 0.3, 0.3}, {0.7, 0.3, 0.7}, 0.005, 0, boxes);
  const auto field = make_field(boxes);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  int n_steep = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 a = Vec3{0.5, 0.45, 0.5} + Vec3{uniform(random), 0.5 * uniform(random), 0.5 * uniform(random)},
               b = a + 0.02 * Vec3{uniform(random), uniform(random), uniform(random)};
    const double rise = std::abs(local(*field, a).in({1, 0, 0}) - local(*field, b).in({1, 0, 0}));
    n_steep += rise > 1.02 * kSlope * distance(a, b);
  }
  EXPECT_LE(n_steep, 400);
}

TEST(StretchedCones, do_not_depend_on_the_order_of_the_samples) {
  std::vector<RasterBox> boxes = several_lines();
  std::shared_ptr<Spread> a, b;
  make_field(boxes, &a);
  std::shuffle(boxes.begin(), boxes.end(), std::mt19937(5));
  make_field(boxes, &b);
  EXPECT_EQ(a->cones.of_site, b->cones.of_site);
  EXPECT_EQ(a->cones.first_along, b->cones.first_along);
  EXPECT_EQ(a->cones.along_of_site, b->cones.along_of_site);
  EXPECT_GT(a->cones.along_of_site.size(), 100);
}

TEST(StretchedCones, are_the_same_with_any_number_of_threads) {
  std::array<std::shared_ptr<Spread>, 3> made;
  for (std::size_t k = 0; k < made.size(); ++k) {
    set_thread_count(1 + 2 * static_cast<int>(k));
    make_field(several_lines(), &made[k]);
  }
  set_thread_count(1);
  for (const auto& other : made) {
    EXPECT_EQ(other->cones.sample, made[0]->cones.sample);
    EXPECT_EQ(other->cones.first_along, made[0]->cones.first_along);
    EXPECT_EQ(other->cones.along_of_site, made[0]->cones.along_of_site);
  }
}

}  // namespace
}  // namespace st
