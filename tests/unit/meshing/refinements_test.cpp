#include "meshing/face/refinements.h"

#include <gtest/gtest.h>

#include <random>
#include "unit/meshing/faces.h"

namespace st {
namespace {

Refinement at(Vec3 x, double length) { return {x, length, 0}; }

TEST(RefinedField, is_the_length_of_the_place_there_and_grows_with_the_distance) {
  const UniformField base(10);
  const RefinedField f(base, {at({0, 0, 0}, 1), at({100, 0, 0}, 2)});
  EXPECT_DOUBLE_EQ(f.size({0, 0, 0}), 1);
  EXPECT_DOUBLE_EQ(f.size({10, 0, 0}), 1 + 10 * kRefinementSlope);
  EXPECT_DOUBLE_EQ(f.size({100, 0, 0}), 2);
  EXPECT_DOUBLE_EQ(f.size({50, 0, 0}), 10);
  EXPECT_DOUBLE_EQ(f.min_size(), 1);
  EXPECT_DOUBLE_EQ(f.slope(), kRefinementSlope);
}

TEST(RefinedField, is_never_coarser_than_its_base) {
  const UniformField base(0.5);
  const RefinedField f(base, {at({0, 0, 0}, 1)});
  EXPECT_DOUBLE_EQ(f.size({0, 0, 0}), 0.5);
  EXPECT_DOUBLE_EQ(f.min_size(), 0.5);
  EXPECT_DOUBLE_EQ(RefinedField(base, {}).size({1, 2, 3}), 0.5);
}

TEST(RefinedField, finds_the_same_length_to_the_bit_as_a_visit_of_all_places) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(0, 10), length(0.01, 2);
  std::vector<Refinement> places;
  for (int i = 0; i < 1000; ++i)
    places.push_back(at({coordinate(random), coordinate(random), 0.1 * coordinate(random)}, length(random)));
  for (int i = 0; i < 50; ++i) places.push_back(places[0]);  // many at one place
  const UniformField base(3);
  const RefinedField f(base, places);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 x = i < 1000 ? places[i].x : Vec3{coordinate(random), coordinate(random), coordinate(random)};
    double expected = 3;
    for (const Refinement& r : places) expected = std::min(expected, r.length + kRefinementSlope * distance(x, r.x));
    EXPECT_EQ(f.size(x), expected);
  }
}

TEST(Refinements, take_a_place_no_finer_than_the_floor_of_the_request) {
  const UniformField base(8);
  Refinements r(base);
  EXPECT_TRUE(r.add({{0, 0, 0}, 0.001}, 0.25));
  ASSERT_EQ(r.all().size(), 1u);
  EXPECT_DOUBLE_EQ(r.all()[0].length, 2);
  EXPECT_DOUBLE_EQ(r.all()[0].reach, 6 / kRefinementSlope);
}

TEST(Refinements, refuse_a_place_that_is_about_as_fine_already) {
  const UniformField base(8);
  Refinements r(base);
  EXPECT_FALSE(r.add({{0, 0, 0}, 7.9}, 0.1));
  EXPECT_TRUE(r.add({{0, 0, 0}, 2}, 0.1));
  EXPECT_FALSE(r.add({{0.01, 0, 0}, 2}, 0.1));
  EXPECT_EQ(r.all().size(), 1u);
}

TEST(Refinements, are_near_a_box_when_they_reach_into_it) {
  const UniformField base(8);
  Refinements r(base);
  r.add({{0, 0, 0}, 2}, 0.1);  // reaches 20
  Box3 box;
  box.add(Vec3{19, 0, 0});
  box.add(Vec3{30, 1, 1});
  EXPECT_EQ(r.near(box).size(), 1u);
  box.lo.x = 21;
  EXPECT_TRUE(r.near(box).empty());
}

TEST(RefinedField, limits_both_lengths_of_a_stretched_base) {
  const test::StretchedField base({1, 10, {1, 0, 0}});
  const RefinedField f(base, {at({0, 0, 0}, 4), at({100, 0, 0}, 0.5)});
  int hint = 0;
  EXPECT_EQ(f.local({0, 0, 0}, hint).length, 1);
  EXPECT_DOUBLE_EQ(f.local({0, 0, 0}, hint).along, 4);
  EXPECT_DOUBLE_EQ(f.local({10, 0, 0}, hint).along, 4 + kRefinementSlope * 10);
  EXPECT_EQ(f.local({100, 0, 0}, hint).along, f.local({100, 0, 0}, hint).length);
  EXPECT_DOUBLE_EQ(f.local({100, 0, 0}, hint).length, 0.5);
  EXPECT_EQ(f.local({50, 0, 0}, hint).along, 10);
}

/// Lengths across grow with x, those along are ten times as long.
class GrowingField : public SizeField {
 public:
  using SizeField::size;
  double size(Vec3 x, int& hint) const override { return local(x, hint).length; }
  LocalSize local(Vec3 x, int&) const override { return {1 + 0.1 * x.x, 10 + x.x, {1, 0, 0}}; }
  bool is_stretched() const override { return true; }
  double min_size() const override { return 1; }
  double slope() const override { return 1; }
};

TEST(RefinedField, keeps_longer_lengths_across_beside_a_place) {
  const GrowingField base;
  Refinements refinements(base);
  ASSERT_TRUE(refinements.add({.x = {0, 0, 0}, .length = 1.2, .radius = 10}, 0.1, Shortens::kAlong));
  const RefinedField f(base, refinements.all());
  int hint = 0;
  EXPECT_DOUBLE_EQ(f.size({8, 0, 0}), 1.8);
  EXPECT_DOUBLE_EQ(f.local({8, 0, 0}, hint).along, 1.8) << "no shorter than across";
  EXPECT_DOUBLE_EQ(f.local({1, 0, 0}, hint).along, 1.2);
}

TEST(RefinedField, keeps_lengths_across_where_those_along_become_shorter) {
  const test::StretchedField base({1, 10, {1, 0, 0}});
  Refinements refinements(base);
  ASSERT_TRUE(refinements.add({{0, 0, 0}, 4}, 0.1, Shortens::kAlong));
  ASSERT_TRUE(refinements.add({.x = {100, 0, 0}, .length = 0.1, .radius = 2}, 0.1, Shortens::kAlong));
  EXPECT_FALSE(refinements.add({{101, 0, 0}, 0.1}, 0.1, Shortens::kAlong)) << "it is that of across already";
  EXPECT_TRUE(refinements.add({{200, 0, 0}, 0.5}, 0.1));
  ASSERT_TRUE(refinements.add({{300, 0, 0}, 4}, 0.1, Shortens::kAlongNearby));
  const RefinedField f(base, refinements.all());
  int hint = 0;
  EXPECT_DOUBLE_EQ(f.local({0, 0, 0}, hint).along, 4);
  EXPECT_DOUBLE_EQ(f.local({5, 0, 0}, hint).along, 4 + kAlongSlope * 5);
  EXPECT_EQ(f.local({101, 0, 0}, hint).along, 1);
  EXPECT_DOUBLE_EQ(f.local({302, 0, 0}, hint).along, 4 + kNearbySlope * 2) << "a short way";
  for (const double x : {0.0, 5.0, 101.0}) {
    EXPECT_EQ(f.local({x, 0, 0}, hint).length, 1) << x;
    EXPECT_EQ(f.size({x, 0, 0}), 1) << x;
  }
  EXPECT_EQ(f.size({200, 0, 0}), 0.5) << "others shorten all";
}

TEST(RefinedField, takes_all_stretch_within_the_radius_where_lengths_along_are_0) {
  const GrowingField base;
  Refinements refinements(base);
  ASSERT_TRUE(refinements.add({.x = {0, 0, 0}, .radius = 10}, 0.1, Shortens::kAlong));
  EXPECT_FALSE(refinements.add({.x = {0, 0, 0}, .radius = 10}, 0.1, Shortens::kAlong)) << "no stretch is left";
  const RefinedField f(base, refinements.all());
  int hint = 0;
  for (const double x : {-5.0, 0.0, 8.0}) {  // shorter across, as long, longer
    EXPECT_EQ(f.local({x, 0, 0}, hint).along, base.size({x, 0, 0})) << x;
    EXPECT_EQ(f.size({x, 0, 0}), base.size({x, 0, 0})) << x;
  }
  EXPECT_GT(f.local({30, 0, 0}, hint).along, f.size({30, 0, 0})) << "beyond it grows again";
}

TEST(Refinements, of_a_stretched_field_count_where_they_shorten_the_longer_length) {
  const test::StretchedField base({1, 10, {1, 0, 0}});
  Refinements refinements(base);
  EXPECT_TRUE(refinements.add({{0, 0, 0}, 5}, 0.1));
  EXPECT_FALSE(refinements.add({{0, 0, 0}, 4.9}, 0.1));
  EXPECT_FALSE(refinements.add({{500, 0, 0}, 9.9}, 0.1));
}

TEST(Refinements, ask_for_their_length_all_over_their_radius) {
  const UniformField base(1);
  Refinements all(base);
  ASSERT_TRUE(all.add({.x = {0, 0, 0}, .length = 0.1, .radius = 2}, 0.01));
  Box3 far;
  far.add(Vec3{4.9, 0, 0});
  ASSERT_EQ(all.near(far).size(), 1u) << "2 and (1 - 0.1) / 0.3";
  const RefinedField field(base, all.all());
  int hint = 0;
  EXPECT_EQ(field.size({0, 0, 0}, hint), 0.1);
  EXPECT_EQ(field.size({1.9, 0, 0}, hint), 0.1);
  EXPECT_NEAR(field.size({3, 0, 0}, hint), 0.1 + 0.3, 1e-12);
  EXPECT_EQ(field.size({5.1, 0, 0}, hint), 1);
  EXPECT_EQ(field.min_size(), 0.1);
}

}  // namespace
}  // namespace st
