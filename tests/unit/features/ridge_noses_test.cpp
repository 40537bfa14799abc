// Noses on ridges, where rows of stretched triangles can begin.
#include "features/ridge_noses.h"

#include <gtest/gtest.h>

#include <vector>

#include "geometry/shape/projection.h"
#include "unit/features/sharp_wing.h"

namespace st {
namespace {

struct RidgeWing : test::SharpWing {
  /// In the middle of the span.
  ChordStation& station(std::size_t i) { return wing.trailing.at(0).stations.at(10 + i); }
  /// On the side of its face.
  void put_nose(std::size_t i, double x, double y) {
    ChordStation& s = station(i);
    const auto surface = model.surface(s.nose_face);
    const SurfaceFoot above = closest_point(*surface, {x, y, s.nose.z}),
                      below = closest_point(*surface, {x, -y, s.nose.z});
    s.nose = (above.distance < below.distance ? above : below).x;
  }
};

TEST(RidgeNoses, are_where_they_were_on_a_ridge) {
  RidgeWing w;
  const LiftingSurface before = w.wing;
  put_on_ridges(w.model, w.wing);
  for (std::size_t i = 0; i < before.trailing[0].stations.size(); ++i) {
    EXPECT_EQ(w.wing.trailing[0].stations[i].nose, before.trailing[0].stations[i].nose);
    EXPECT_EQ(w.wing.trailing[0].stations[i].is_measured, before.trailing[0].stations[i].is_measured);
  }
}

TEST(RidgeNoses, move_to_the_ridge_beside_them) {
  RidgeWing w;
  const Vec3 nose = w.station(0).nose;
  w.put_nose(0, 0.2, 0.25);
  ASSERT_GT(distance(w.station(0).nose, nose), 0.15);
  put_on_ridges(w.model, w.wing);
  EXPECT_TRUE(w.station(0).is_measured);
  EXPECT_LT(distance(w.station(0).nose, nose), 0.01) << "a thousandth of the chord";
}

TEST(RidgeNoses, are_put_onto_the_surface_where_facets_put_them_off_it) {
  RidgeWing w;
  const Vec3 nose = w.station(0).nose, before = w.station(1).nose;
  w.station(0).nose = nose - Vec3{0.03, 0, 0};     // 0.3 % of the chord
  w.station(1).nose = before - Vec3{0.001, 0, 0};  // 0.01 %
  const Vec3 beside = w.station(1).nose;
  put_on_ridges(w.model, w.wing);
  EXPECT_LT(distance(w.station(0).nose, nose), 0.001);
  EXPECT_EQ(w.station(1).nose, beside) << "hardly off it";
}

TEST(RidgeNoses, are_none_along_the_chord_where_the_surface_is_nearly_flat) {
  RidgeWing w;
  for (const std::size_t i : {0, 1, 2}) w.put_nose(i, 0.2 + 4.8 * static_cast<double>(i), 0.5);
  w.wing.front = {w.wing.trailing[0]};
  std::vector<ChordStation>& alone = w.wing.front[0].stations;
  for (ChordStation& s : alone) s.trailing = s.nose;
  put_on_ridges(w.model, w.wing);
  EXPECT_FALSE(alone[11].is_measured);
  EXPECT_TRUE(alone[16].is_measured);
  EXPECT_TRUE(w.station(1).is_measured) << "before a trailing edge";
}

TEST(RidgeNoses, are_left_out_beside_the_line_of_others_that_moved) {
  for (const bool is_beside : {false, true}) {
    RidgeWing w;
    const std::size_t n = w.wing.trailing[0].stations.size();
    for (const std::size_t i : {0, 2}) w.put_nose(i, 0.2, 0.25);
    if (is_beside) w.put_nose(1, 5, 0.5);
    put_on_ridges(w.model, w.wing);
    EXPECT_EQ(w.wing.trailing[0].stations.size(), is_beside ? n - 1 : n);
    EXPECT_LT(w.station(1).nose.x, 0.05) << "what follows it";
  }
}

TEST(RidgeNoses, stay_where_moving_them_makes_their_line_longer) {
  const auto is_put_back = [](std::size_t n_moved, double way) {
    std::vector<ChordStation> before;
    for (std::size_t i = 0; i < n_moved + 2; ++i)
      before.push_back({.is_measured = true, .nose = {0, 0, static_cast<double>(i)}});
    std::vector<ChordStation> after = before;
    for (std::size_t i = 1; i <= n_moved; ++i) after[i].nose.y = way;
    put_back_detours(before, after);
    return after[1].nose == before[1].nose;
  };
  EXPECT_TRUE(is_put_back(4, 0.3));
  EXPECT_FALSE(is_put_back(4, 0.1)) << "hardly longer";
  EXPECT_FALSE(is_put_back(4, 1.5)) << "further than they are apart";
  EXPECT_FALSE(is_put_back(1, 0.3)) << "one alone";
}

TEST(RidgeNoses, jump_where_they_are_far_apart_beside_their_trailing_edges) {
  ChordStation a{.trailing = {10, 0, 0}, .nose = {0, 0, 0}}, b{.trailing = {10, 1, 0}, .nose = {5, 1, 0}};
  EXPECT_FALSE(jumps(a, b)) << "swept by 79 degrees";
  b.nose.x = 7;
  EXPECT_TRUE(jumps(a, b));
}

}  // namespace
}  // namespace st
