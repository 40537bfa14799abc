#include "meshing/engine/stretch_flaws.h"

#include <gtest/gtest.h>

#include "unit/meshing/faces.h"

namespace st {
namespace {

constexpr double kSlope140 = 0.3;  // of the sides of a triangle of base 2, less high: its angle is above 140 degrees

TEST(StretchFlaws, are_obtuse_triangles) {
  const test::StretchedField field({0.1, 4, {1, 0, 0}});
  const std::vector<Triangle> one{{{0, 1, 2}}};
  const std::vector<Vec3> right{{0, 0, 0}, {2, 0, 0}, {0, 0.1, 0}}, obtuse{{0, 0, 0}, {2, 0, 0}, {1, kSlope140, 0}};
  EXPECT_EQ(find_stretch_flaws(right, one, field, 0).n_obtuse, 0u);
  const StretchFlaws flaws = find_stretch_flaws(obtuse, one, field, 0);
  EXPECT_EQ(flaws.n_obtuse, 1u);
  ASSERT_EQ(flaws.stretched.size(), 1u);
  EXPECT_NEAR(flaws.stretched[0].length, 0.6 * 2, 1e-12) << "of the longest side, which is shorter than lengths along";
  EXPECT_GE(flaws.stretched[0].radius, 1) << "all of the triangle";
  EXPECT_TRUE(flaws.obtuse.empty());
}

TEST(StretchFlaws, are_obtuse_triangles_where_nothing_is_stretched_too) {
  const std::vector<Vec3> obtuse{{0, 0, 0}, {2, 0, 0}, {1, kSlope140, 0}};
  const StretchFlaws flaws = find_stretch_flaws(obtuse, std::vector<Triangle>{{{0, 1, 2}}}, UniformField(2), 0);
  EXPECT_TRUE(flaws.stretched.empty());
  ASSERT_EQ(flaws.obtuse.size(), 1u);
  EXPECT_NEAR(flaws.obtuse[0].length, 0.6 * 2, 1e-12);
}

/// Two triangles at the edge from the origin along y, the second one so many times as long as the first.
StretchFlaws flaws_of_step(double factor, const SizeField& field) {
  const std::vector<Vec3> points{{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {factor, 0, 0}};
  return find_stretch_flaws(points, std::vector<Triangle>{{{0, 1, 2}}, {{0, 3, 1}}}, field, 0);
}

TEST(StretchFlaws, are_large_triangles_beside_small_ones) {
  const test::StretchedField field({0.1, 40, {1, 0, 0}});
  EXPECT_EQ(flaws_of_step(4.5, field).n_large, 0u) << "2.12 squared";
  const StretchFlaws flaws = flaws_of_step(5, field);
  ASSERT_EQ(flaws.stretched.size(), 1u);
  EXPECT_GT(flaws.stretched[0].x.x, 1) << "the large one";
  EXPECT_NEAR(flaws.stretched[0].length, 1.6 * 1.6 / 5 * std::hypot(5, 1), 1e-12);
  EXPECT_NEAR(flaws_of_step(30, field).stretched[0].length, 0.35 * std::hypot(30, 1), 1e-12) << "at once";
  const StretchFlaws alike = flaws_of_step(5, UniformField(1));
  EXPECT_EQ(alike.n_large, 1u);
  EXPECT_TRUE(alike.stretched.empty() && alike.obtuse.empty()) << "no lengths along can be shorter";
}

TEST(StretchFlaws, shorten_lengths_along_to_those_across) {
  const test::StretchedField field({1.5, 2, {1, 0, 0}});
  const std::vector<Vec3> obtuse{{0, 0, 0}, {2, 0, 0}, {1, kSlope140, 0}};
  EXPECT_EQ(find_stretch_flaws(obtuse, std::vector<Triangle>{{{0, 1, 2}}}, field, 0).stretched.at(0).length, 1.5);
}

TEST(StretchFlaws, take_all_of_the_stretch_after_some_tries_no_further_around) {
  const test::StretchedField field({0.1, 4, {1, 0, 0}});
  const std::vector<Vec3> obtuse{{0, 0, 0}, {2, 0, 0}, {1, 0.2, 0}}, less{{0, 0, 0}, {2, 0, 0}, {1, kSlope140, 0}};
  const std::vector<Triangle> one{{{0, 1, 2}}};
  const RefinementPoint third = find_stretch_flaws(obtuse, one, field, 3).stretched.at(0);
  const RefinementPoint fourth = find_stretch_flaws(obtuse, one, field, 4).stretched.at(0);
  const RefinementPoint ninth = find_stretch_flaws(obtuse, one, field, 9).stretched.at(0);
  EXPECT_NEAR(third.length, 1.2, 1e-12);
  EXPECT_EQ(fourth.length, 0) << "that across, all over its radius";
  EXPECT_EQ(fourth.radius, third.radius);
  EXPECT_EQ(ninth.radius, third.radius) << "wider ones would leave lenses of equilateral triangles";
  EXPECT_NEAR(find_stretch_flaws(less, one, field, 5).stretched.at(0).length, 1.2, 1e-12) << "below 150 degrees";
}

TEST(StretchFlaws, take_stretch_from_unheld_places_bit_by_bit) {
  const RefinementPoint place{.x = {1, 2, 3}, .radius = 0.3};
  const LocalSize present{0.1, 4, {1, 0, 0}};
  const RefinementPoint first = eased_unheld(place, present, 0), last = eased_unheld(place, present, 4);
  EXPECT_EQ(first.x, place.x);
  EXPECT_NEAR(first.length, 0.6 * 4, 1e-12);
  EXPECT_NEAR(first.radius, 0.75 * 4, 1e-12);
  EXPECT_EQ(eased_unheld(place, {0.1, 0.12, {1, 0, 0}}, 0).length, 0.1) << "no shorter than across";
  EXPECT_EQ(last.length, 0) << "that across";
  EXPECT_EQ(last.radius, place.radius);
}

TEST(StretchFlaws, above_150_degrees_are_counted_among_the_obtuse) {
  const test::StretchedField field({0.1, 4, {1, 0, 0}});
  const std::vector<Vec3> points{{0, 0, 0}, {2, 0, 0}, {1, 0.2, 0}, {0, 9, 0}, {2, 9, 0}, {1, 9 + kSlope140, 0}};
  const StretchFlaws flaws = find_stretch_flaws(points, std::vector<Triangle>{{{0, 1, 2}}, {{3, 4, 5}}}, field, 0);
  EXPECT_EQ(flaws.n_obtuse, 2u);
  EXPECT_EQ(flaws.n_far, 1u);
}

}  // namespace
}  // namespace st
