#include "meshing/engine/stretch_flaws.h"

#include <gtest/gtest.h>

#include "unit/meshing/faces.h"

namespace st {
namespace {

constexpr double kSlope140 = 0.3;  // of the sides of a triangle of base 2, less high: its angle is above 140 degrees

constexpr double kSlope150 = 0.2;  // likewise above 150 degrees

TEST(StretchFlaws, are_obtuse_triangles) {
  const test::StretchedField field({0.1, 4, {1, 0, 0}});
  const std::vector<Triangle> one{{{0, 1, 2}}};
  const std::vector<Vec3> right{{0, 0, 0}, {2, 0, 0}, {0, 0.1, 0}}, obtuse{{0, 0, 0}, {2, 0, 0}, {1, kSlope140, 0}},
      far{{0, 0, 0}, {2, 0, 0}, {1, kSlope150, 0}};
  EXPECT_EQ(find_stretch_flaws(right, one, field, 0).n_obtuse, 0u);
  const StretchFlaws flaws = find_stretch_flaws(obtuse, one, field, 0);
  EXPECT_EQ(flaws.n_obtuse, 1u);
  EXPECT_TRUE(flaws.stretched.empty() && flaws.obtuse.empty()) << "not worth another mesh";
  const StretchFlaws worse = find_stretch_flaws(far, one, field, 0);
  ASSERT_EQ(worse.stretched.size(), 1u);
  EXPECT_NEAR(worse.stretched[0].length, 0.6 * 2, 1e-12) << "of the longest side, shorter than lengths along";
  EXPECT_NEAR(worse.stretched[0].radius, 0.25 * 2, 1e-12);
  EXPECT_FALSE(worse.is_wide());
  EXPECT_TRUE(worse.obtuse.empty());
}

TEST(StretchFlaws, are_obtuse_triangles_where_nothing_is_stretched_too) {
  const std::vector<Vec3> obtuse{{0, 0, 0}, {2, 0, 0}, {1, kSlope150, 0}};
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
  EXPECT_EQ(flaws_of_step(6, field).n_large, 1u);
  EXPECT_FALSE(flaws_of_step(6, field).has_eased()) << "2.45 squared: not worth another mesh";
  StretchFlaws flaws = flaws_of_step(6.4, field);
  ASSERT_EQ(flaws.steps.size(), 1u);
  EXPECT_TRUE(flaws.stretched.empty() && flaws.has_eased() && flaws.eases_steps());
  EXPECT_GT(flaws.steps[0].x.x, 1) << "the large one";
  EXPECT_NEAR(flaws.steps[0].length, 1.6 * 1.6 / 6.4 * std::hypot(6.4, 1), 1e-12);
  EXPECT_NEAR(flaws.steps[0].radius, 0.25 * std::hypot(6.4, 1), 1e-12);
  flaws.n_far = 1;
  EXPECT_TRUE(flaws.eases_steps()) << "no angle above 150 degrees is where lengths are stretched";
  flaws.stretched.push_back({.x = {7, 8, 9}, .length = 1, .radius = 1});
  EXPECT_FALSE(flaws.eases_steps()) << "angles above 150 degrees come first";
  EXPECT_NEAR(flaws_of_step(30, field).steps.at(0).length, 0.35 * std::hypot(30, 1), 1e-12) << "at once";
  const StretchFlaws alike = flaws_of_step(7, UniformField(1));
  EXPECT_EQ(alike.n_large, 1u);
  EXPECT_TRUE(!alike.has_eased() && alike.obtuse.empty()) << "no lengths along can be shorter";
}

TEST(StretchFlaws, shorten_lengths_along_to_those_across) {
  const test::StretchedField field({1.5, 2, {1, 0, 0}});
  const std::vector<Vec3> obtuse{{0, 0, 0}, {2, 0, 0}, {1, kSlope150, 0}};
  EXPECT_EQ(find_stretch_flaws(obtuse, std::vector<Triangle>{{{0, 1, 2}}}, field, 0).stretched.at(0).length, 1.5);
}

TEST(StretchFlaws, never_take_all_of_the_stretch_about_an_angle) {
  const test::StretchedField field({0.1, 4, {1, 0, 0}});
  const std::vector<Vec3> far{{0, 0, 0}, {2, 0, 0}, {1, kSlope150, 0}};
  const RefinementPoint place = find_stretch_flaws(far, std::vector<Triangle>{{{0, 1, 2}}}, field, 9).stretched.at(0);
  EXPECT_NEAR(place.radius, 0.25 * 2, 1e-12);
  EXPECT_NEAR(place.length, 0.6 * 2, 1e-12);
}

TEST(StretchFlaws, take_stretch_from_unheld_places_bit_by_bit) {
  const RefinementPoint place{.x = {1, 2, 3}, .radius = 0.3};
  const LocalSize present{0.1, 4, {1, 0, 0}};
  StretchFlaws flaws, beside_others;
  flaws.add_unheld(place, present);
  flaws.add_unheld(place, {0.1, 0.12, {1, 0, 0}});
  flaws.add_unheld(place, {0.1, 0.1, {}});
  EXPECT_EQ(flaws.n_unheld, 3u);
  EXPECT_EQ(flaws.all.size(), 3u);
  EXPECT_TRUE(flaws.is_wide() && flaws.eases_steps());
  ASSERT_EQ(flaws.stretched.size(), 2u) << "nothing is stretched at the last";
  EXPECT_EQ(flaws.stretched[0].x, place.x);
  EXPECT_NEAR(flaws.stretched[0].length, 0.6 * 4, 1e-12);
  EXPECT_NEAR(flaws.stretched[0].radius, 0.75 * 4, 1e-12);
  EXPECT_EQ(flaws.stretched[1].length, 0.1) << "no shorter than across";
  beside_others.n_far = 1;
  beside_others.add_unheld(place, present);
  EXPECT_NEAR(beside_others.stretched.at(0).radius, 0.25 * 4, 1e-12) << "while angles are above 150 degrees";
}

TEST(StretchFlaws, steps_beside_what_is_not_held_are_eased_further_around) {
  StretchFlaws flaws;
  const RefinementPoint beside{.x = {3.9, 0, 0}, .length = 1, .radius = 1}, apart{.x = {4.1, 0, 0}, .radius = 1};
  EXPECT_NEAR(further(beside).radius, 3, 1e-12);
  flaws.stretched.push_back({.x = {0, 0, 0}, .length = 1, .radius = 1});
  EXPECT_FALSE(flaws.is_beside_unheld(beside)) << "all is held";
  flaws.n_unheld = 1;
  EXPECT_TRUE(flaws.is_beside_unheld(beside));
  EXPECT_FALSE(flaws.is_beside_unheld(apart));
  flaws.n_far = 1;
  EXPECT_FALSE(flaws.is_beside_unheld(beside)) << "while angles are above 150 degrees";
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
