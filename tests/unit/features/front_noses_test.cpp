// Noses before slots and flaps, where the trailing edge is another part's or none.
#include "features/front_noses.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/features/sharp_wing.h"

namespace st {
namespace {

struct WholeWing : test::SharpWing {
  std::vector<ChordStation>& stations() { return wing.trailing.at(0).stations; }
  void follow(std::vector<LiftingSurface> others = {}) {
    others.insert(others.begin(), wing);
    add_front_noses(model, others);
    wing = others[0];
  }
};

bool measured(const ChordStation& s) { return s.is_measured; }

/// Least and largest place along the span of what is on the nose.
void expect_front(const LiftingSurface& wing, double from, double to) {
  ASSERT_EQ(wing.front.size(), 1u);
  double least = 30, most = 0;
  for (const ChordStation& s : wing.front[0].stations) {
    EXPECT_TRUE(s.is_measured);
    EXPECT_EQ(distance(s.nose, s.trailing), 0) << "the nose alone";
    EXPECT_NEAR(s.nose.x, 0, 1e-5);
    EXPECT_NEAR(s.chord, 10, 0.1);
    EXPECT_EQ(std::ranges::count(wing.faces, s.nose_face), 1);
    least = std::min(least, s.nose.z);
    most = std::max(most, s.nose.z);
  }
  EXPECT_NEAR(least, from, 0.3) << "a twentieth of the chord halved: 0.03 of it";
  EXPECT_NEAR(most, to, 0.3);
}

TEST(FrontNoses, are_none_where_noses_run_from_end_to_end) {
  WholeWing w;
  w.follow();
  EXPECT_TRUE(w.wing.front.empty());
}

TEST(FrontNoses, run_before_a_slot_where_stations_have_another_nose) {
  WholeWing w;
  double from = 30, to = 0;
  for (ChordStation& s : w.stations()) {
    if (!s.is_measured || s.share < 0.3 || s.share > 0.7) continue;
    from = std::min(from, s.nose.z);
    to = std::max(to, s.nose.z);
    s.nose.x = 7;
    s.chord = 3;
  }
  w.follow();
  ASSERT_EQ(w.wing.front.size(), 1u) << "not from both sides";
  expect_front(w.wing, from - 30.0 / 24, to + 30.0 / 24);
}

TEST(FrontNoses, run_on_before_a_gap_in_the_trailing_edge) {
  WholeWing w;
  for (ChordStation& s : w.stations()) s.is_measured = s.is_measured && (s.share < 0.3 || s.share > 0.7);
  const auto is_before = [](const ChordStation& s) { return s.is_measured && s.share < 0.5; };
  const auto is_behind = [](const ChordStation& s) { return s.is_measured && s.share > 0.5; };
  const double from = std::find_if(w.stations().rbegin(), w.stations().rend(), is_before)->nose.z,
               to = std::ranges::find_if(w.stations(), is_behind)->nose.z;
  w.follow();
  expect_front(w.wing, std::min(from, to), std::max(from, to));
}

TEST(FrontNoses, run_to_the_tip_before_another_part_alone) {
  WholeWing w;
  LiftingSurface flap = w.wing;
  std::erase_if(w.stations(), [](const ChordStation& s) { return s.share > 0.55; });
  std::erase_if(flap.trailing[0].stations, [](const ChordStation& s) { return s.share < 0.45; });
  const LiftingSurface half = w.wing;
  w.follow();
  EXPECT_TRUE(w.wing.front.empty()) << "nothing is behind";
  w.wing = half;
  const double from = std::find_if(w.stations().rbegin(), w.stations().rend(), measured)->nose.z,
               tip = flap.trailing[0].stations.back().trailing.z;
  w.follow({flap});
  expect_front(w.wing, std::min(from, tip), std::max(from, tip));
}

}  // namespace
}  // namespace st
