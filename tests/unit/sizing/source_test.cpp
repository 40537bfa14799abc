#include "sizing/source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/box_tree.h"

namespace st {
namespace {

constexpr double kSourceSlope = 0.2;

SourceSpec point_source(SourceSpacing spacing) {
  SourceSpec spec;
  spec.kind = SourceKind::kPoint;
  spec.spacing[0] = spacing;
  return spec;
}

double size_at(const SourceSpec& spec, Vec3 x, double slope = kSourceSlope) {
  return static_cast<const SizeField&>(*make_source(spec, slope)).size(x);
}

std::vector<SourceSpec> one_of_each_kind() {
  std::vector<SourceSpec> all;
  for (const SourceKind kind : {SourceKind::kPoint, SourceKind::kLine, SourceKind::kTriangle, SourceKind::kBox,
                                SourceKind::kCylinder, SourceKind::kSphere, SourceKind::kDisc}) {
    SourceSpec s;
    s.kind = kind;
    s.point = {{{0.1, 0.2, 0.3}, {1.1, 0.3, -0.2}, {0.2, 0.9, 0.1}}};
    s.half_axis = {{{0.4, 0.3, 0}, {-0.15, 0.2, 0}, {0, 0, 0.5}}};
    s.extent = 0.4;
    s.spacing = {{{0.05, 0.1, 0.3}, {0.08, 0.02, 0.4}, {0.03, 0.2, 0.9}}};
    all.push_back(s);
  }
  return all;
}

TEST(Source, is_constant_inside_its_radius_and_twice_as_large_at_doubling) {
  const SourceSpec s = point_source({0.01, 1, 3});
  EXPECT_EQ(size_at(s, {0.7, 0.7, 0}), 0.01);
  EXPECT_NEAR(size_at(s, {3, 0, 0}), 0.02, 1e-15);
  EXPECT_NEAR(size_at(s, {0, 5, 0}), 0.04, 1e-15);
}

TEST(Source, grows_no_faster_than_the_slope) {
  const SourceSpec exponential = point_source({0.01, 0, 1}), steep = point_source({0.01, 0, 0.001});
  EXPECT_NEAR(size_at(exponential, {101, 0, 0}) - size_at(exponential, {100, 0, 0}), kSourceSlope, 1e-9);
  EXPECT_NEAR(size_at(steep, {1, 0, 0}), 0.01 + kSourceSlope, 1e-12);
}

TEST(Source, without_doubling_grows_by_the_slope) {
  EXPECT_NEAR(size_at(point_source({0.01, 0.5, 0}), {1.5, 0, 0}), 0.21, 1e-12);
}

TEST(Source, line_interpolates_between_its_ends) {
  SourceSpec s;
  s.kind = SourceKind::kLine;
  s.point = {{{0, 0, 0}, {2, 0, 0}, {}}};
  s.spacing = {{{0.1, 0, 0}, {0.3, 0, 0}, {}}};
  // the length at x grows from where the line's own gradient, 0.1, and the slope balance: sqrt(0.2^2 - 0.1^2) upwards
  EXPECT_NEAR(size_at(s, {1, 0.2, 0}), 0.2 + 0.2 * std::sqrt(0.03), 1e-12);
  EXPECT_NEAR(size_at(s, {1, 0, 0}), 0.2, 1e-12);
  EXPECT_NEAR(size_at(s, {-0.1, 0, 0}), 0.12, 1e-12);
  s.spacing = {{{0.1, 0.2, 1}, {0.3, 0.4, 1}, {}}};
  EXPECT_NEAR(size_at(s, {-0.1, 0, 0}), 0.1, 1e-12);
  EXPECT_LT(size_at(s, {1, 0.29, 0}), 0.2);  // less than at its foot: other points of the line are near, too
}

TEST(Source, triangle_interpolates_between_its_corners) {
  SourceSpec s;
  s.kind = SourceKind::kTriangle;
  s.point = {{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}};
  s.spacing = {{{0.1, 0, 0}, {0.2, 0, 0}, {0.4, 0, 0}}};
  const double g2 = (0.01 + 0.09) / 9;  // squared gradient of the lengths on it
  EXPECT_NEAR(size_at(s, {1, 1, 0.4}), 0.1 + 0.1 / 3 + 0.3 / 3 + 0.4 * std::sqrt(0.04 - g2), 1e-12);
  EXPECT_NEAR(size_at(s, {1, 1, 0}), 0.1 + 0.1 / 3 + 0.3 / 3, 1e-12);
  s.spacing[2].length = 2;  // steeper than the slope: what is near the first corner asks for less there, too
  EXPECT_NEAR(size_at(s, {0, 3, 0}), 0.1 + 3 * kSourceSlope, 1e-12);
}

TEST(Source, volumes_are_constant_inside) {
  for (const SourceSpec& s : one_of_each_kind()) {
    const double core = s.spacing[0].length;
    if (s.kind == SourceKind::kBox) {
      EXPECT_EQ(size_at(s, s.point[0] + 0.99 * (s.half_axis[0] - s.half_axis[1] + s.half_axis[2])), core);
      EXPECT_GT(size_at(s, s.point[0] + 1.5 * s.half_axis[0]), core);
    }
    if (s.kind == SourceKind::kCylinder) {
      EXPECT_EQ(size_at(s, 0.5 * (s.point[0] + s.point[1]) + Vec3{0, 0.38, 0}), core);
    }
    if (s.kind == SourceKind::kSphere) {
      EXPECT_EQ(size_at(s, s.point[0] + Vec3{0, 0, 0.49}), core);
    }
    if (s.kind == SourceKind::kDisc) {
      EXPECT_EQ(size_at(s, s.point[0] + Vec3{0, 0, 0.45}), core);
      EXPECT_GT(size_at(s, s.point[0] + 0.9 * normalized(s.half_axis[0])), core);
    }
  }
}

TEST(Source, asks_nowhere_for_less_than_its_growth_says) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-2, 2);
  for (const SourceSpec& spec : one_of_each_kind()) {
    const SourceGrowth growth = make_source(spec, kSourceSlope)->growth();
    double nearest = 10;
    for (int i = 0; i < 3000; ++i) {
      const Vec3 x{uniform(random), uniform(random), uniform(random)};
      const double bound = grown_length(growth.spacing, kSourceSlope, std::sqrt(distance2(x, growth.core)));
      ASSERT_GE(size_at(spec, x), bound * (1 - 1e-12)) << static_cast<int>(spec.kind);
      nearest = std::min(nearest, size_at(spec, x) / bound);
    }
    EXPECT_LT(nearest, 1.2) << static_cast<int>(spec.kind);
  }
}

TEST(Source, moves_with_its_frame) {
  const Similarity motion = rotation_about({0, 0, 1}, radians(90)).then({.scale = 2}).then({.translation = {1, 2, 3}});
  EXPECT_NEAR(distance(motion({1, 0, 0}), {1, 4, 3}), 0, 1e-12);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-2, 2);
  for (const SourceSpec& spec : one_of_each_kind()) {
    SourceSpec moved = spec;
    transform(motion, moved);
    for (int i = 0; i < 100; ++i) {
      const Vec3 x{uniform(random), uniform(random), uniform(random)};
      ASSERT_NEAR(size_at(moved, motion(x)), 2 * size_at(spec, x), 1e-9);
    }
  }
}

TEST(Source, has_lengths_along_its_direction_that_grow_by_the_slope_too) {
  SourceSpec spec;
  spec.spacing[0] = {0.1, 0, 0};
  spec.aspect = 5;
  spec.direction = {0, 1, 0};
  const auto source = make_source(spec, 0.2);
  int hint = 0;
  for (const double r : {0.0, 0.5, 3.0}) {
    const LocalSize at = source->local({r, 0, 0}, hint);
    EXPECT_NEAR(at.length, 0.1 + 0.2 * r, 1e-9);
    EXPECT_NEAR(at.along, 0.5 + 0.2 * r, 1e-9);
  }
}

TEST(Source, may_be_stretched_along_a_direction_that_turns_with_it) {
  SourceSpec spec = point_source({0.1, 0.5, 0});
  spec.aspect = 5;
  spec.direction = {1, 0, 0};
  const auto local = [](const SourceSpec& s, Vec3 x) {
    int hint = 0;
    return make_source(s, kSourceSlope)->local(x, hint);
  };
  EXPECT_DOUBLE_EQ(local(spec, {0.2, 0, 0}).in({1, 0, 0}), 0.5);
  EXPECT_DOUBLE_EQ(local(spec, {0.2, 0, 0}).in({0, 1, 0}), 0.1);
  EXPECT_NEAR(local(spec, {0, 1, 0}).in({1, 0, 0}), 5 * 0.1 + 0.5 * kSourceSlope, 1e-12);
  transform(parse_similarity("rotate 0 0 1 90", ""), spec);
  EXPECT_NEAR(local(spec, {0.2, 0, 0}).in({0, 1, 0}), 0.5, 1e-9);
}

TEST(Source, without_extent_becomes_what_it_is) {
  SourceSpec line;
  line.kind = SourceKind::kLine;
  line.point = {{{5, 5, 5}, {5, 5, 5}, {}}};
  line.spacing = {{{0.2, 1, 0}, {0.1, 2, 0}, {}}};
  EXPECT_TRUE(simplify(line));
  EXPECT_EQ(line.kind, SourceKind::kPoint);
  EXPECT_EQ(line.spacing[0].length, 0.1);
  EXPECT_FALSE(simplify(line));
  SourceSpec triangle;
  triangle.kind = SourceKind::kTriangle;
  triangle.point = {{{1, 0, 0}, {0, 0, 0}, {3, 0, 0}}};
  triangle.spacing = {{{0.3, 0, 0}, {0.1, 0, 0}, {0.2, 0, 0}}};
  EXPECT_TRUE(simplify(triangle));
  EXPECT_EQ(triangle.kind, SourceKind::kLine);
  EXPECT_EQ(norm(triangle.point[0] - triangle.point[1]), 3);
  EXPECT_DOUBLE_EQ(triangle.spacing[0].length + triangle.spacing[1].length, 0.3);
  for (SourceSpec sound : one_of_each_kind()) EXPECT_FALSE(simplify(sound));
}

TEST(Source, has_a_core_in_which_its_length_is_constant) {
  for (const SourceSpec& s : one_of_each_kind()) {
    const Box3 box = core_box(s);
    ASSERT_FALSE(box.is_empty());
    const Vec3 out = box.hi - box.lo;
    for (const Vec3 x : {box.lo - 0.01 * out, box.hi + 0.01 * out}) {
      const double least = std::min({s.spacing[0].length, s.spacing[1].length, s.spacing[2].length});
      EXPECT_GT(size_at(s, x), least) << static_cast<int>(s.kind);
    }
    EXPECT_LE(box.lo.x, s.point[0].x);
    EXPECT_GE(box.hi.x, s.point[0].x);
  }
}

TEST(Source, has_a_bound_over_a_triangle_that_is_never_above_and_near_far_away) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1, 1), length(0.1, 0.3);
  const auto point = [&](double scale) { return scale * Vec3{place(random), place(random), place(random)}; };
  for (int i = 0; i < 20000; ++i) {
    const Vec3 x = point(1), centre = x + point(1);
    const double size = 0.05 * distance(x, centre);
    const std::array<Vec3, 3> p{centre + point(size), centre + point(size), i % 4 ? centre + point(size) : x};
    const std::array<double, 3> lengths{length(random), length(random), length(random)};
    const double exact = least_over_triangle(x, p, lengths, kSourceSlope),
                 bound = bound_over_triangle(x, p, lengths, kSourceSlope);
    ASSERT_LE(bound, exact * (1 + 1e-9));
    if (i % 4) {
      ASSERT_GT(bound, exact - 0.01 * kSourceSlope * distance(x, centre));
    }
  }
}

}  // namespace
}  // namespace st
