#include "meshing/engine/eased_places.h"

#include <gtest/gtest.h>

#include <vector>

namespace st {
namespace {

Refinement at(double x) {
  Refinement r;
  r.x = {x, 0, 0};
  r.length = 0.1;
  r.reach = 1;
  r.shortens = Shortens::kAlong;
  return r;
}

StretchFlaw flaw(double x, FlawKind kind) { return {{x, 0, 0}, kind}; }

std::vector<double> places_of(const std::vector<EasingRound>& rounds) {
  std::vector<double> x;
  for (const Refinement& r : best_of_places(rounds)) x.push_back(r.x.x);
  return x;
}

TEST(EasedPlaces, keep_what_helps_and_give_up_what_makes_things_worse) {
  EXPECT_EQ(places_of({{{}, {flaw(0, FlawKind::kObtuse), flaw(10, FlawKind::kObtuse)}},
                       {{at(0), at(10)}, {flaw(10.5, FlawKind::kFar)}}}),
            std::vector<double>{0});
}

TEST(EasedPlaces, have_the_refinements_of_their_own_best_round) {
  EXPECT_EQ(places_of({{{}, {flaw(0, FlawKind::kFar), flaw(10, FlawKind::kFar)}},
                       {{at(0), at(10)}, {flaw(0, FlawKind::kObtuse), flaw(10, FlawKind::kLarge)}},
                       {{at(0), at(10), at(0.2), at(10.2)}, {flaw(0, FlawKind::kLarge), flaw(10, FlawKind::kUnheld)}}}),
            (std::vector<double>{10, 0, 0.2}));
}

TEST(EasedPlaces, are_one_where_refinements_reach_each_other) {
  EXPECT_TRUE(
      places_of({{{}, {flaw(-0.5, FlawKind::kObtuse)}}, {{at(0), at(0.8)}, {flaw(1.6, FlawKind::kFar)}}}).empty())
      << "what helps one makes the other worse";
}

TEST(EasedPlaces, count_the_worst_kind_first_and_shorten_nothing_for_nothing) {
  EXPECT_EQ(places_of({{{}, {flaw(0, FlawKind::kUnheld), flaw(10, FlawKind::kLarge)}},
                       {{at(0), at(10)},
                        {flaw(0, FlawKind::kObtuse), flaw(0.1, FlawKind::kLarge), flaw(0.2, FlawKind::kLarge),
                         flaw(10, FlawKind::kLarge)}}}),
            std::vector<double>{0});
}

TEST(EasedPlaces, leave_what_was_refined_before) {
  EXPECT_EQ(places_of({{{at(3), at(20)}, {}}, {{at(3), at(20), at(0)}, {flaw(0, FlawKind::kLarge)}}}),
            (std::vector<double>{3, 20}));
}

}  // namespace
}  // namespace st
