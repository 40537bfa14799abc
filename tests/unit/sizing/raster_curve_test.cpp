#include "sizing/raster_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/shape/analytic.h"

namespace st {
namespace {

const Frame kFrame{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const SamplingLimits kLimits{0.01, 10, radians(10), 2};

std::vector<RasterBox> raster(const Curve& curve, const SamplingLimits& limits = kLimits) {
  std::vector<RasterBox> boxes;
  raster_curve(curve, limits, pack_cause(CauseKind::kEdge, 3), boxes);
  return boxes;
}

/// Every point of the curve must lie in a box.
void expect_covered(const Curve& curve, const std::vector<RasterBox>& boxes) {
  for (int i = 0; i <= 2000; ++i) {
    const Vec3 x = curve.point(curve.t_min() + (curve.t_max() - curve.t_min()) * i / 2000);
    ASSERT_TRUE(std::any_of(boxes.begin(), boxes.end(),
                            [&](const RasterBox& b) {
                              const double half = b.half * (1 + 1e-6);
                              return std::abs(x.x - b.center.x) <= half && std::abs(x.y - b.center.y) <= half &&
                                     std::abs(x.z - b.center.z) <= half;
                            }))
        << "hole at sample " << i;
  }
}

/// Two straight legs that meet at the origin under a right angle.
class CornerCurve : public Curve {
 public:
  CornerCurve() { t_min_ = -1, t_max_ = 1.5; }
  Vec3 point(double t) const override { return t < 0 ? Vec3{t, 0, 0} : Vec3{0, t, 0}; }
  CurvePoint evaluate(double t) const override { return {point(t), t < 0 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, {}}; }
};

/// A nearly straight curve with a bend of radius 0.02 in the middle: straight, arc of 90 degrees, straight; by arc
/// length.
class BendCurve : public Curve {
 public:
  BendCurve() { t_min_ = -1, t_max_ = 1; }
  Vec3 point(double t) const override {
    const double a = std::clamp(t / kRadius, 0.0, kPi / 2);
    const Vec3 arc{kRadius * std::sin(a), kRadius * (1 - std::cos(a)), 0};
    if (t < 0) return {t, 0, 0};
    return a < kPi / 2 ? arc : arc + (t - kRadius * kPi / 2) * Vec3{0, 1, 0};
  }
  CurvePoint evaluate(double t) const override {
    const double a = std::clamp(t / kRadius, 0.0, kPi / 2);
    return {point(t), {std::cos(a), std::sin(a), 0}, {}};
  }
  static constexpr double kRadius = 0.02;
};

TEST(RasterCurve, gives_a_circle_its_radius_times_alpha) {
  for (const double radius : {0.1, 1.0, 7.0}) {
    const EllipseCurve circle(kFrame, radius, radius, 0, 2 * kPi);
    const std::vector<RasterBox> boxes = raster(circle);
    EXPECT_NEAR(static_cast<double>(boxes.size()), 36, 1);
    for (const RasterBox& b : boxes) EXPECT_NEAR(b.length, radius * kLimits.alpha, 0.02 * radius * kLimits.alpha);
    expect_covered(circle, boxes);
  }
}

TEST(RasterCurve, keeps_a_chord_error_where_it_asks_for_less_than_the_angle) {
  const EllipseCurve circle(kFrame, 2, 2, 0, 2 * kPi);
  SamplingLimits limits = kLimits;
  limits.chord = 0.0005;
  const std::vector<RasterBox> boxes = raster(circle, limits);
  const double length = 2 * std::sqrt(2 * 2 * limits.chord - limits.chord * limits.chord);
  for (const RasterBox& b : boxes) EXPECT_NEAR(b.length, length, 0.02 * length);
  expect_covered(circle, boxes);
  limits.chord = 0.1;
  EXPECT_EQ(raster(circle, limits).size(), raster(circle).size());
}

TEST(RasterCurve, gives_an_arc_too_small_for_alpha_the_smallest_length) {
  for (const double radius : {0.05, 0.001, 1e-6}) {
    const EllipseCurve circle(kFrame, radius, radius, 0, 2 * kPi);
    const std::vector<RasterBox> boxes = raster(circle);
    ASSERT_FALSE(boxes.empty());
    for (const RasterBox& b : boxes) EXPECT_FLOAT_EQ(b.length, 0.01F);
    EXPECT_LE(boxes.size(), std::max(1.0, 2 * kPi * radius / 0.01 + 1)) << "segments shorter than the smallest length";
    expect_covered(circle, boxes);
  }
}

TEST(RasterCurve, cuts_a_line_into_the_largest_length) {
  const LineCurve line({0, 0, 0}, {2, 0, 0}, 0, 50);
  const std::vector<RasterBox> boxes = raster(line);
  EXPECT_EQ(boxes.size(), 10u);
  for (const RasterBox& b : boxes) EXPECT_FLOAT_EQ(b.length, 10);
  expect_covered(line, boxes);
}

TEST(RasterCurve, is_never_longer_than_the_curve) {
  const LineCurve line({0, 0, 0}, {1, 0, 0}, 0, 0.3);
  const std::vector<RasterBox> boxes = raster(line);
  ASSERT_EQ(boxes.size(), 1u);
  EXPECT_NEAR(boxes[0].length, 0.3, 1e-6);
}

TEST(RasterCurve, is_cut_into_as_many_lengths_as_asked_down_to_the_smallest) {
  SamplingLimits limits = kLimits;
  const LineCurve line({0, 0, 0}, {1, 0, 0}, 0, 0.9);
  for (const int n : {2, 5, 30}) {
    limits.edge_cells = n;
    std::vector<RasterBox> boxes;
    raster_curve(line, limits, 0, boxes);
    EXPECT_EQ(boxes.size(), static_cast<std::size_t>(n));
    for (const RasterBox& b : boxes) EXPECT_NEAR(b.length, 0.9 / n, 1e-6);
  }
  limits.min_length = 0.25;
  std::vector<RasterBox> boxes;
  raster_curve(line, limits, 0, boxes);
  for (const RasterBox& b : boxes) EXPECT_NEAR(b.length, 0.25, 1e-6);
}

TEST(RasterCurve, does_not_count_the_jump_at_a_corner) {
  const CornerCurve corner;
  const std::vector<RasterBox> boxes = raster(corner, {0.01, 0.25, radians(10), 2});
  for (const RasterBox& b : boxes) EXPECT_NEAR(b.length, 0.25, 0.005);
  EXPECT_LE(boxes.size(), 12u);
  expect_covered(corner, boxes);
}

TEST(RasterCurve, finds_a_small_bend_between_straight_legs) {
  const BendCurve bend;
  const SamplingLimits limits{0.001, 0.1, radians(10), 2};
  const std::vector<RasterBox> boxes = raster(bend, limits);
  const auto smallest = std::min_element(boxes.begin(), boxes.end(),
                                         [](const RasterBox& a, const RasterBox& b) { return a.length < b.length; });
  EXPECT_NEAR(smallest->length, BendCurve::kRadius * limits.alpha, 0.1 * BendCurve::kRadius * limits.alpha);
  EXPECT_NEAR(boxes.front().length, 0.1, 1e-6);
  expect_covered(bend, boxes);
}

TEST(RasterCurve, follows_the_curvature_of_an_ellipse) {
  const EllipseCurve ellipse(kFrame, 4, 1, 0, 2 * kPi);
  for (const RasterBox& b : raster(ellipse)) {
    const double t = std::atan2(b.center.y, b.center.x / 4);
    const double radius = std::pow(16 * std::sin(t) * std::sin(t) + std::cos(t) * std::cos(t), 1.5) / 4;
    EXPECT_NEAR(b.length / (radius * kLimits.alpha), 1, 0.25);
  }
}

TEST(RasterCurve, gives_a_curve_without_length_no_box) {
  const LineCurve point({1, 2, 3}, {0, 0, 0}, 0, 1);
  EXPECT_TRUE(raster(point).empty());
}

TEST(RasterCurve, boxes_grow_with_cell_per_length_and_still_cover) {
  const EllipseCurve circle(kFrame, 1, 1, 0, 2 * kPi);
  for (const double ratio : {1.0, 2.0, 8.0}) {
    const std::vector<RasterBox> boxes = raster(circle, {0.01, 10, radians(10), ratio});
    for (const RasterBox& b : boxes) EXPECT_FLOAT_EQ(2 * b.half, static_cast<float>(ratio) * b.length);
    expect_covered(circle, boxes);
  }
}

TEST(RasterCurve, is_stretched_along_itself_where_a_rule_says_so) {
  const LineCurve line({0, 0, 0}, {0, 1, 0}, 0, 20);
  SamplingLimits limits;
  limits.min_length = 0.1;
  limits.max_length = 0.5;
  limits.max_aspect = 8;
  limits.max_along = 3;
  std::vector<RasterBox> plain, stretched;
  raster_curve(line, limits, 0, plain);
  limits.stretches_curve = true;
  raster_curve(line, limits, 0, stretched);
  ASSERT_EQ(plain.size(), stretched.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_EQ(plain[i].stretch.along, 0);
    EXPECT_EQ(stretched[i].length, plain[i].length);
    EXPECT_FLOAT_EQ(stretched[i].stretch.along, 3);
    EXPECT_NEAR(std::abs(Vec3(stretched[i].stretch.direction).y), 1, 1e-12);
  }
}

}  // namespace
}  // namespace st
