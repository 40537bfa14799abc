#include "geometry/shape/rim_pinches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "geometry/shape/flatten.h"

namespace st {
namespace {

/// One loop through all places.
struct Rim {
  std::vector<Vec3> x;
  std::vector<Vec2> p;

  void add(Vec2 flat, Vec3 in_space) {
    p.push_back(flat);
    x.push_back(in_space);
  }
  bool pinches() const {
    PatchTopology topology;
    topology.loops.emplace_back(x.size());
    std::iota(topology.loops[0].begin(), topology.loops[0].end(), 0);
    topology.loop_length.push_back(0);
    for (std::size_t i = 0; i < x.size(); ++i) topology.loop_length[0] += distance(x[i], x[(i + 1) % x.size()]);
    return rim_pinches(x, topology, p);
  }
};

/// A flat ring with a slot, one end of which is `lifted` in space.
Rim slotted_ring(double slot, double lifted, int n) {
  Rim rim;
  const auto add = [&](double radius, double share) {
    const double a = slot + (2 * kPi - 2 * slot) * share;
    const Vec2 flat{radius * std::cos(a), radius * std::sin(a)};
    rim.add(flat, {flat.x, flat.y, lifted * share});
  };
  for (int i = 0; i <= n; ++i) add(2, static_cast<double>(i) / n);
  for (int i = n; i >= 0; --i) add(1, static_cast<double>(i) / n);
  return rim;
}

TEST(RimPinches, finds_the_ends_of_a_slot_that_are_apart_in_space) {
  constexpr double kSlot = 0.05;  // across it the inner ends are a tenth apart
  for (const int n : {5, 40, 3000}) {
    EXPECT_TRUE(slotted_ring(kSlot, 0.11 * kMostStretch, n).pinches()) << n;
    EXPECT_FALSE(slotted_ring(kSlot, 0.08 * kMostStretch, n).pinches()) << n;
  }
}

/// Two straight arms beside each other, which are `apart` in space.
Rim hairpin(double slot, double apart) {
  Rim rim;
  const double away = 0.5 * (apart - slot);  // of each arm
  for (const auto& [x, y] : {std::pair(0.0, 1.0),
                             {0.0, -1.0},
                             {9.0, -1.0},
                             {9.0, -0.5 * slot},
                             {1.0, -0.5 * slot},
                             {1.0, 0.5 * slot},
                             {9.0, 0.5 * slot},
                             {9.0, 1.0}})
    rim.add({x, y}, {x, y + (x > 5 ? std::copysign(away, y) : 0.0), 0});
  return rim;
}

TEST(RimPinches, compares_straight_sides_with_each_other) {
  EXPECT_TRUE(hairpin(0.1, 0.11 * kMostStretch).pinches());
  EXPECT_FALSE(hairpin(0.1, 0.09 * kMostStretch).pinches());
}

TEST(RimPinches, finds_a_side_that_is_too_short_in_the_plane) {
  const auto square = [](double width) {
    Rim rim;
    for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
      rim.add({width * x, 1.0 * y}, {1.0 * x, 1.0 * y, 0});
    return rim;
  };
  EXPECT_TRUE(square(0.99 / kMostStretch).pinches());
  EXPECT_FALSE(square(1.01 / kMostStretch).pinches());
}

TEST(RimPinches, takes_a_rim_without_length_for_sound) { EXPECT_FALSE(Rim().pinches()); }

}  // namespace
}  // namespace st
