// When rounds of refinement stop, as a table.
#include "meshing/engine/refinement_policy.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace st {
namespace {

using Policy = RefinementPolicy;

struct Decision {
  std::string what;
  std::function<bool()> is_taken;
  bool expected;
};

void expect(const std::vector<Decision>& table) {
  for (const Decision& d : table) EXPECT_EQ(d.is_taken(), d.expected) << d.what;
}

TEST(RefinementPolicy, ends_the_rounds_of_faces_and_of_holes) {
  const auto &faces = kFacePolicy, &holes = kHolePolicy;
  expect({{"loops in round 6", [&] { return faces.refines_loops(6); }, true},
          {"loops in round 7", [&] { return faces.refines_loops(7); }, false},
          {"loops of holes: they grow", [&] { return holes.refines_loops(1); }, false},
          {"crossings after 7 rounds", [&] { return faces.refines_crossings(7, false); }, true},
          {"crossings after 8 rounds", [&] { return faces.refines_crossings(8, false); }, false},
          {"while it gets better, after 13", [&] { return faces.refines_crossings(13, true); }, true},
          {"while it gets better, after 14", [&] { return faces.refines_crossings(14, true); }, false},
          {"of holes after 3", [&] { return holes.refines_crossings(3, false); }, true},
          {"of holes after 4", [&] { return holes.refines_crossings(4, true); }, false}});
  EXPECT_EQ(faces.crossing_floor, 1.0 / 64);
  EXPECT_EQ(holes.crossing_floor, 1.0 / 8);
}

TEST(RefinementPolicy, goes_on_where_few_triangles_cross) {
  expect({{"200 places", [] { return Policy::is_promising(200, false); }, true},
          {"201 places", [] { return Policy::is_promising(201, false); }, false},
          {"measured", [] { return Policy::is_promising(9000, true); }, true}});
}

TEST(RefinementPolicy, ends_where_as_many_triangles_cross_after_some_rounds) {
  expect({{"three rounds, 100 pairs", [] { return Policy::is_stuck(3, 100); }, true},
          {"two rounds", [] { return Policy::is_stuck(2, 9000); }, false},
          {"99 pairs", [] { return Policy::is_stuck(9, 99); }, false}});
}

TEST(RefinementPolicy, shortens_lengths_along_for_longer_where_triangles_are_obtuse) {
  EXPECT_EQ(Policy::most_uneased(1), 5);
  EXPECT_EQ(Policy::most_uneased(0), 2);
}

TEST(RefinementPolicy, bounds_what_easing_may_cost) {
  expect({{"twice and 200,000", [] { return Policy::goes_on_easing(0, 0, 0, 100'000, 399'999); }, true},
          {"one more", [] { return Policy::goes_on_easing(0, 0, 0, 100'000, 400'000); }, false},
          {"twelve times for the worst", [] { return Policy::goes_on_easing(0, 0, 1, 100'000, 1'399'999); }, true},
          {"one more of them", [] { return Policy::goes_on_easing(0, 0, 1, 100'000, 1'400'000); }, false},
          {"ten rounds", [] { return Policy::goes_on_easing(10, 0, 0, 100'000, 0); }, false},
          {"less than twice as many", [] { return Policy::is_worth_easing(1000, 1999); }, true},
          {"twice as many", [] { return Policy::is_worth_easing(1000, 2000); }, false}});
}

TEST(RefinementPolicy, ends_what_costs_more_than_it_can_be_worth) {
  expect({{"30 times and 200,000", [] { return Policy::runs_away(500'000, 10'000, 0); }, false},
          {"one more", [] { return Policy::runs_away(500'001, 10'000, 0); }, true},
          {"twice what walls take is allowed", [] { return Policy::runs_away(700'000, 10'000, 100'000); }, false},
          {"one more than that", [] { return Policy::runs_away(700'001, 10'000, 100'000); }, true},
          {"walls", [] { return Policy::affords_walls(1'499'999); }, true},
          {"too many for walls", [] { return Policy::affords_walls(1'500'000); }, false}});
}

TEST(RefinementPolicy, tells_success_from_none) {
  expect({{"89 of 100", [] { return Policy::is_clearly_fewer(89, 100); }, true},
          {"90 of 100", [] { return Policy::is_clearly_fewer(90, 100); }, false},
          {"a refill that leaves 9 of 10", [] { return Policy::refill_stays(9, 10); }, true},
          {"10 of 11", [] { return Policy::refill_stays(10, 11); }, false},
          {"none of one", [] { return Policy::refill_stays(0, 1); }, true}});
  EXPECT_EQ(Policy::n_more_allowed(91), 10) << "a ninth";
  EXPECT_EQ(Policy::n_more_allowed(1'000'000), 999) << "no face may fail for it";
  EXPECT_EQ(Policy::n_bad_while_easing(0), 0);
  EXPECT_EQ(Policy::n_bad_while_easing(8), 24) << "tips of the propeller have 8 to 18 folds by chance";
  EXPECT_EQ(Policy::n_bad_while_easing(1'000), 1'999) << "no face may fail for it";
}

TEST(RefinementPolicy, gives_up_faces_that_smaller_triangles_do_not_help) {
  const auto gives_up = [](int n_without, std::int64_t n_bad, std::int64_t n_since, std::int64_t n_last,
                           std::int64_t n_first) {
    return [=] { return Policy::gives_up({n_without, n_bad, n_since, n_last, n_first}); };
  };
  expect({{"100 bad, twice", gives_up(2, 100, 0, 10, 10), true},
          {"100 bad, once", gives_up(1, 100, 0, 10, 10), false},
          {"99 bad", gives_up(2, 99, 499'999, 10, 10), false},
          {"much was meshed", gives_up(2, 1, 500'000, 10, 10), true},
          {"four times its first triangles", gives_up(1, 1, 0, 4000, 1000), false},
          {"more than that", gives_up(1, 1, 0, 4001, 1000), true},
          {"never by 1,000 triangles", gives_up(1, 1, 0, 1000, 1), false}});
}

TEST(RefinementPolicy, gives_up_folds_of_all_faces_after_two_rounds_that_meshed_much) {
  expect({{"two rounds, 200,000", [] { return Policy::gives_up_folds(2, 200'000); }, true},
          {"less", [] { return Policy::gives_up_folds(2, 199'999); }, false},
          {"one round", [] { return Policy::gives_up_folds(1, 900'000); }, false}});
}

TEST(RefinementPolicy, doubles_lengths_of_one_round_where_that_meshes_little) {
  expect({{"one round, 199,999", [] { return Policy::is_worth_loosening(2, 199'999); }, true},
          {"one more", [] { return Policy::is_worth_loosening(2, 200'000); }, false},
          {"two rounds", [] { return Policy::is_worth_loosening(3, 900'000); }, true}});
}

TEST(RefinementPolicy, mends_the_few_crossings_of_a_heavy_mesh_first) {
  expect({{"12 pairs of 60,000", [] { return Policy::mends_first(12, 12, 60'000); }, true},
          {"fewer triangles", [] { return Policy::mends_first(12, 12, 59'999); }, false},
          {"folds, too", [] { return Policy::mends_first(13, 12, 900'000); }, false},
          {"walls of a known distance", [] { return Policy::mends_first(12, 11, 900'000); }, false},
          {"50 pairs", [] { return Policy::mends_first(50, 50, 900'000); }, true},
          {"51 pairs", [] { return Policy::mends_first(51, 51, 900'000); }, false}});
}

}  // namespace
}  // namespace st
