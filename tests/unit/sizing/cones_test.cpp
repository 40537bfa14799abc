// The size field by the samples themselves, against the smallest over all of them.
#include "sizing/cones.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <set>
#include <utility>

#include "base/threads.h"
#include "sizing/cone_kernels.h"
#include "sizing/octree_field.h"
#include "unit/sizing/cases.h"

namespace st {
namespace {

constexpr double kConeSlope = 0.2, kConeLargest = 0.3;

/// Samples about one length apart on a turned ellipsoid and on a line through it, as a raster has them.
std::vector<RasterBox> samples_of_body(double cell_per_length) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<RasterBox> boxes;
  const auto add = [&](Vec3 x, double length, std::int32_t cause, const SampleReach& reach = {}) {
    boxes.push_back(
        {x, static_cast<float>(0.5 * cell_per_length * length), static_cast<float>(length), cause, {}, {}, reach});
  };
  for (int i = 0; i < 4000; ++i) {
    const double phi = 2 * kPi * unit(random), z = 2 * unit(random) - 1, r = std::sqrt(1 - z * z);
    const Vec3 x = Vec3{0.5, 0.5, 0.5} + Vec3{0.3 * r * std::cos(phi) + 0.1 * z, 0.2 * r * std::sin(phi), 0.1 * z};
    const double length = 0.006 + 0.03 * std::abs(x.x - 0.3);
    const Vec3 along = normalized(Vec3{-0.3 * r * std::sin(phi), 0.2 * r * std::cos(phi), 0});
    add(x, length, i, i % 2 == 0 ? SampleReach{} : reach_of(0.7 * length * along, 0.4 * length * Vec3{0, 0, 1}));
  }
  for (int i = 0; i < 200; ++i)
    add({0.3 + 0.002 * i, 0.5 + 0.001 * i, 0.52}, 0.004, 4000 + i, reach_of({0.001, 0.0005, 0}));
  return boxes;
}

/// From the rectangle of a sample, found by walking over it.
double distance_from(const LengthSample& s, Vec3 x) {
  Vec3 way = x - s.xyz;
  for (const auto* side : {&s.reach.u, &s.reach.v}) {
    const Vec3 half{(*side)[0], (*side)[1], (*side)[2]};
    if (norm2(half) > 0) way -= std::clamp(dot(way, half) / norm2(half), -1.0, 1.0) * half;
  }
  return norm(way);
}

struct Case {
  RasterOctree raster;
  std::vector<LengthSample> samples;
  std::vector<float> slope;
  ConeTable cones;
  std::vector<CellLength> cells;
  std::vector<std::int32_t> cause;

  explicit Case(double cell_per_length, bool has_two_slopes = false) {
    const std::vector<RasterBox> boxes = samples_of_body(cell_per_length);
    raster = build_octree(test::kUnitBox, boxes);
    samples = sorted_samples(boxes);
    for (const LengthSample& s : samples)
      slope.push_back(has_two_slopes && s.cause < 2000 ? 0.1F : static_cast<float>(kConeSlope));
    cones = spread_cones(Neighbours(raster.shape.view()), samples, slope, kConeLargest, nullptr);
    cells.assign(raster.shape.leaf_keys.size(), {1, {}, 1});
    cause.assign(cells.size(), kNone);
  }
  OctreeField field() const {
    OctreeFieldData data{raster.shape.view(), cells, cause, kConeSlope, 1};
    data.set_cones(cones, kConeLargest);
    return OctreeField(data, nullptr, 1e-3);
  }
  double exact(Vec3 x) const {
    double least = kConeLargest;
    for (std::size_t i = 0; i < samples.size(); ++i)
      least = std::min(least, samples[i].length + slope[i] * distance_from(samples[i], x));
    return least;
  }
};

std::vector<Vec3> places(const Case& c) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec3> x;
  for (int i = 0; i < 3000; ++i) x.push_back({unit(random), unit(random), unit(random)});
  for (std::size_t i = 0; i < c.samples.size(); i += 2) {
    const double reach = 8 * c.samples[i].length;
    x.push_back(c.samples[i].xyz + reach * (unit(random) - 0.5) * Vec3{unit(random), unit(random), unit(random)});
  }
  return x;
}

/// Within a ratio at 99 % of the places, and at most 1.1 times.
void expect_exact(const Case& c, double within) {
  const OctreeField field = c.field();
  int n_within = 0, n = 0;
  double worst = 0;
  for (const Vec3& x : places(c)) {
    const double ratio = field.size(x) / c.exact(x);
    EXPECT_GT(ratio, 1 - 1e-5);
    worst = std::max(worst, ratio);
    n_within += ratio < within;
    ++n;
  }
  EXPECT_GT(n_within, 0.99 * n);
  EXPECT_LT(worst, 1.1);
}

TEST(Cones, tell_the_smallest_of_all_samples) {
  expect_exact(Case(2), 1.01);
  expect_exact(Case(4), 1.01);
}

TEST(Cones, tell_it_with_slopes_of_their_own) { expect_exact(Case(3, true), 1.03); }

TEST(Cones, are_the_same_with_any_number_of_threads) {
  const auto with_threads = [](int n) {
    set_thread_count(n);
    Case made(2);
    set_thread_count(1);
    return made;
  };
  const Case one = with_threads(1);
  EXPECT_GT(one.cells.size(), 10'000U);
  for (const int n : {2, 5}) {
    const ConeTable other = with_threads(n).cones;
    EXPECT_EQ(other.sample, one.cones.sample);
    EXPECT_EQ(other.first, one.cones.first);
    EXPECT_EQ(other.of_site, one.cones.of_site);
    EXPECT_EQ(other.at_center, one.cones.at_center);
  }
}

TEST(Cones, reach_every_cell_but_beyond_the_largest_length) {
  const Case c(4);
  const OctreeField field = c.field();
  int n_largest = 0;
  for (const Vec3& x : places(c)) n_largest += field.size(x) == kConeLargest;
  EXPECT_EQ(n_largest, 0) << "0.87 from the farthest sample at most: less than the largest length everywhere";
  EXPECT_LT(c.cones.of_site.size(), 12 * c.cells.size()) << "no more cones than tell something";
}

TEST(Cones, change_by_no_more_than_the_slope_across_cells) {
  const Case c(4);
  const OctreeField field = c.field();
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const Vec3& x : places(c)) {
    const Vec3 y = x + 0.02 * Vec3{unit(random), unit(random), unit(random)};
    const double h = field.size(x), other = field.size(y);
    EXPECT_LE(std::abs(h - other), kConeSlope * distance(x, y) + 0.03 * std::min(h, other));
  }
}

/// By the cones of a leaf, which may lie beside the place.
double length_in_leaf(const Case& c, std::int32_t leaf, Vec3 x) {
  double least = kConeLargest;
  for (std::int32_t k = c.cones.first[leaf]; k < c.cones.first[leaf + 1]; ++k)
    least = std::min(least, c.cones.cone[c.cones.of_site[k]].length_at(x - c.raster.shape.view().lo));
  return least;
}

TEST(Cones, step_between_centres_of_cells_by_no_more_than_the_slope) {
  const Case c(4);
  const OctreeView octree = c.raster.shape.view();
  int n_steps = 0;
  for (std::int32_t a = 0; a < octree.n_leaves(); ++a)
    Neighbours(octree).for_each_across_face(a, [&](std::int32_t b, const CellStep&) {
      const Vec3 from = octree.leaf_center(a), to = octree.leaf_center(b);
      EXPECT_LE(length_in_leaf(c, b, to) - length_in_leaf(c, a, from), (1 + 1e-5) * kConeSlope * distance(from, to));
      ++n_steps;
    });
  EXPECT_GT(n_steps, 10'000);
}

TEST(Cones, tell_the_same_on_both_sides_of_a_face_where_the_model_lies) {
  const Case c(4);
  const OctreeView octree = c.raster.shape.view();
  const Neighbours neighbours(octree);
  std::set<std::int32_t> holds_sample;
  for (const LengthSample& s : c.samples)
    holds_sample.insert(octree.find_leaf(morton::encode(octree.grid_point(s.xyz))));
  int n_places = 0;
  for (const std::int32_t a : holds_sample)
    neighbours.for_each_across_side(a, [&](std::int32_t b, int side) {
      if (octree.leaf_levels[b] > octree.leaf_levels[a]) return;  // the face is that of b
      const double half = 0.5 * octree.cell_edge(octree.leaf_levels[a]);
      const std::array<Vec3, 3> unit{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
      const Vec3 face = octree.leaf_center(a) + (side % 2 == 0 ? -half : half) * unit[side / 2];
      for (const auto& [u, v] : {std::pair{-1.0, 0.0}, {1.0, 0.0}, {0.0, -1.0}, {0.0, 1.0}, {0.5, 0.5}, {-0.5, 0.5}}) {
        const Vec3 x = face + half * u * unit[(side / 2 + 1) % 3] + half * v * unit[(side / 2 + 2) % 3];
        const double here = length_in_leaf(c, a, x), there = length_in_leaf(c, b, x);
        EXPECT_LT(std::abs(here - there), 0.0021 * std::min(here, there));
        ++n_places;
      }
    });
  EXPECT_GT(n_places, 5'000);
}

TEST(Cones, name_the_sample_that_tells_the_length) {
  const Case c(4);
  const OctreeField field = c.field();
  for (const Vec3& x : places(c)) {
    const SizeExplanation why = field.explain(x);
    EXPECT_NEAR(why.length, why.origin_length + kConeSlope * distance(x, why.origin), 1e-6);
    if (distance(x, why.origin) > 1e-6) {
      EXPECT_NEAR(norm(why.gradient), kConeSlope, 1e-6);
    }
    EXPECT_EQ(c.samples[static_cast<std::size_t>(why.cause)].cause, why.cause);
  }
}

TEST(Cones, ask_for_the_length_of_a_sample_all_over_its_rectangle) {
  const std::vector<RasterBox> boxes{
      {{0.5, 0.5, 0.5}, 0.02F, 0.01F, 1, {}, {}, reach_of({0.09, 0.03, 0}, {-0.02, 0.06, 0})}};
  const RasterOctree raster = build_octree(test::kUnitBox, boxes);
  const std::vector<float> slope{0.2F};
  const ConeTable cones = spread_cones(Neighbours(raster.shape.view()), sorted_samples(boxes), slope, 0.25, nullptr);
  const std::vector<CellLength> cells(raster.shape.leaf_keys.size(), CellLength{1, {}, 1});
  const std::vector<std::int32_t> cause(cells.size(), kNone);
  OctreeFieldData data{raster.shape.view(), cells, cause, 0.2, 1};
  data.set_cones(cones, 0.25);
  const OctreeField field(data, nullptr, 1e-3);
  for (const double a : {-1.0, -0.3, 0.6, 1.0})
    for (const double b : {-1.0, 0.2, 1.0}) {
      const Vec3 x = Vec3{0.5, 0.5, 0.5} + a * Vec3{0.09, 0.03, 0} + b * Vec3{-0.02, 0.06, 0};
      EXPECT_NEAR(static_cast<const SizeField&>(field).size(x), 0.01, 1e-6);
      EXPECT_NEAR(static_cast<const SizeField&>(field).size(x + Vec3{0, 0, 0.1}), 0.03, 1e-6);
    }
  EXPECT_NEAR(static_cast<const SizeField&>(field).size(Vec3{0.5, 0.5, 0.5} + 2 * Vec3{0.09, 0.03, 0}),
              0.01 + 0.2 * std::hypot(0.09, 0.03), 1e-6);
}

TEST(Cones, tell_the_same_at_once_far_from_the_root) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vec = [&] { return Vec3{unit(random), unit(random), unit(random)}; };
  for (int i = 0; i < 500; ++i) {
    const Vec3 middle = 0.9 * vec() + Vec3{1, 1, 1};  // from the root: far, against the lengths
    std::vector<Cone> cones;
    for (int k = 0; k < 4; ++k) {
      const Vec3 u = 1e-4 * vec(), v = 0.5 * cross(u, normalized(vec()));
      cones.emplace_back(LengthSample{middle + 3e-4 * vec(), 1e-4F, 0, {}, {}, k == 3 ? SampleReach{} : reach_of(u, v)},
                         0.1F * static_cast<float>(k + 1), Vec3{});
    }
    const Vec3 x = middle + 2e-4 * vec();
    for (std::int32_t k = 0; k < 4; ++k) {
      const double length = cones[k].length_at(x);
      ASSERT_NEAR(cone_kernels().least(cones[0].numbers(), &k, 1, SplitPlace(x).numbers(), 1, nullptr), length,
                  1e-6 * length);
    }
  }
}

TEST(Cones, go_on_beyond_the_root) {
  const Case c(4);
  const OctreeField field = c.field();
  const Vec3 x{1.3, 0.5, 0.5};
  EXPECT_NEAR(field.size(x), std::min(kConeLargest, c.exact(x)), 0.03 * c.exact(x));
  EXPECT_GT(field.size(x), field.size({1, 0.5, 0.5}));
}

TEST(Cones, are_none_where_nothing_asks_for_less_than_the_largest_length) {
  const std::vector<RasterBox> boxes{{{0.5, 0.5, 0.5}, 0.1F, 0.3F, 1}};
  const RasterOctree raster = build_octree(test::kUnitBox, boxes);
  const std::vector<float> slope{0.2F};
  const ConeTable table = spread_cones(Neighbours(raster.shape.view()), sorted_samples(boxes), slope, 0.25, nullptr);
  EXPECT_TRUE(table.cone.empty());
  EXPECT_EQ(table.first.size(), raster.shape.leaf_keys.size() + 1);
}

}  // namespace
}  // namespace st
