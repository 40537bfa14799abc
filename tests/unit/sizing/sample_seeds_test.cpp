#include "sizing/sample_seeds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <utility>

#include "unit/sizing/sampled_field.h"

namespace st {
namespace {

constexpr double kSeedSlope = 0.2, kSeedLargest = 0.2;

TEST(SampleSeeds, keep_their_places_however_far_from_the_origin) {
  const Vec3 far{3e5, -2e5, 1e5};
  std::vector<RasterBox> boxes, moved;
  for (int i = 0; i < 100; ++i) {
    boxes.push_back({{0.01 * i, std::sin(i), 0.3}, 0.02F, 0.01F, i});
    moved.push_back(boxes.back());
    moved.back().center += far;
  }
  const Box3 near_box{{0, -1, 0}, {1, 1, 1}}, far_box{near_box.lo + far, near_box.hi + far};
  EXPECT_EQ(origin_of_places(near_box), Vec3{});
  const std::vector<LengthSample> here = sorted_samples(boxes, origin_of_places(near_box)),
                                  there = sorted_samples(moved, origin_of_places(far_box));
  for (std::size_t i = 0; i < here.size(); ++i) EXPECT_LT(distance(here[i].xyz + far, there[i].xyz), 1e-6) << i;
}

TEST(SampleSeeds, lie_where_single_precision_puts_them) {
  std::vector<RasterBox> boxes;
  for (int i = 0; i < 5000; ++i) boxes.push_back({{std::cos(7 * i), std::sin(i), std::cos(3 * i)}, 0.02F, 0.01F, 1});
  for (const LengthSample& s : sorted_samples(boxes))
    for (const double x : {s.xyz.x, s.xyz.y, s.xyz.z}) ASSERT_EQ(static_cast<double>(static_cast<float>(x)), x);
}

TEST(SampleSeeds, merged_are_as_if_they_had_been_sorted_together) {
  std::vector<RasterBox> boxes;
  for (int i = 0; i < 100; ++i) boxes.push_back({{std::cos(7 * i), std::sin(i), 0.3}, 0.02F, 0.01F, i % 7});
  std::vector<std::vector<LengthSample>> parts;
  for (const auto& [first, n] : {std::pair<std::size_t, std::size_t>(0, 50), {50, 0}, {50, 13}, {63, 37}})
    parts.push_back(sorted_samples(std::span(boxes).subspan(first, n)));
  const std::vector<LengthSample> together = sorted_samples(boxes), merged = merged_samples(std::move(parts));
  ASSERT_EQ(merged.size(), together.size());
  for (std::size_t i = 0; i < merged.size(); ++i) {
    EXPECT_EQ(merged[i].xyz, together[i].xyz) << i;
    EXPECT_EQ(merged[i].cause, together[i].cause) << i;
  }
  EXPECT_TRUE(merged_samples({}).empty());
}

/// Samples about one length apart on a sphere of radius 0.4: `finest` at the top, growing by `growth` per distance from
/// there.
std::vector<RasterBox> graded_sphere(double finest, double growth, double cell_per_length) {
  std::vector<RasterBox> boxes;
  for (double theta = 0; theta <= kPi;) {
    const double length = finest + growth * 0.8 * std::sin(0.5 * theta);
    const int n = std::max(1, static_cast<int>(2 * kPi * 0.4 * std::sin(theta) / length));
    for (int i = 0; i < n; ++i) {
      const double phi = 2 * kPi * i / n;
      const Vec3 x = Vec3{0.5, 0.5, 0.5} +
                     0.4 * Vec3{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
      boxes.push_back({x, static_cast<float>(0.5 * cell_per_length * length), static_cast<float>(length), 1});
    }
    theta += length / 0.4;
  }
  return boxes;
}

std::unique_ptr<OctreeField> make_field(const std::vector<RasterBox>& boxes) {
  const auto sampled = test::sample_field(boxes, kSeedSlope, kSeedLargest);
  return std::make_unique<OctreeField>(sampled->data, sampled);
}

/// Mean of |log(length / exact length)| at the samples.
double mean_error(const SizeField& field, const std::vector<RasterBox>& boxes) {
  double sum = 0;
  int n = 0;
  for (std::size_t i = 0; i < boxes.size(); i += 7, ++n) {
    double exact = kSeedLargest;
    for (const RasterBox& b : boxes)
      exact = std::min(exact, b.length + kSeedSlope * distance(b.center, boxes[i].center));
    sum += std::abs(std::log(field.size(boxes[i].center) / exact));
  }
  return sum / n;
}

TEST(SampleSeeds, keep_the_length_of_a_sphere_in_cells_many_times_as_large) {
  for (const double cell_per_length : {4.0, 8.0}) {
    const std::vector<RasterBox> boxes = graded_sphere(0.01, 0, cell_per_length);
    const auto field = make_field(boxes);
    for (const RasterBox& b : boxes) ASSERT_NEAR(static_cast<const SizeField&>(*field).size(b.center), 0.01, 0.0002);
  }
}

TEST(SampleSeeds, are_as_exact_in_large_cells_as_in_small_ones) {
  const auto fine = make_field(graded_sphere(0.004, 0.1, 1));
  for (const double cell_per_length : {1.0, 4.0, 8.0}) {
    const std::vector<RasterBox> boxes = graded_sphere(0.004, 0.1, cell_per_length);
    const auto field = make_field(boxes);
    EXPECT_LT(mean_error(*field, boxes), 0.002) << cell_per_length;
    EXPECT_LE(field->data().octree.n_leaves(), 1.5 / cell_per_length * fine->data().octree.n_leaves());
  }
}

TEST(SampleSeeds, never_let_a_sample_have_more_than_its_length) {
  std::vector<RasterBox> boxes = test::sphere_boxes(3000);
  for (RasterBox& b : boxes) b.half *= 3;
  const auto field = make_field(boxes);
  for (const RasterBox& b : boxes)
    ASSERT_LE(static_cast<const SizeField&>(*field).size(b.center), b.length * (1 + 0.0031));  // kClearlyNearby
}

TEST(SampleSeeds, do_not_depend_on_the_order_of_boxes) {
  std::vector<RasterBox> boxes = test::sphere_boxes(2000);
  for (RasterBox& b : boxes) b.half *= 2;
  const auto a = make_field(boxes);
  std::shuffle(boxes.begin(), boxes.end(), std::mt19937(3));
  const auto b = make_field(boxes);
  for (std::size_t i = 0; i < a->data().cells.size(); ++i) {
    ASSERT_EQ(a->data().cells[i].length, b->data().cells[i].length);
    ASSERT_EQ(a->data().cells[i].gradient[0], b->data().cells[i].gradient[0]);
    ASSERT_EQ(a->data().cause[i], b->data().cause[i]);
  }
}

}  // namespace
}  // namespace st
