#include "io/export/periodic_motion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace st {
namespace {

Similarity turned(Vec3 turns) {
  return rotation_about({1, 0, 0}, turns.x)
      .then(rotation_about({0, 1, 0}, turns.y))
      .then(rotation_about({0, 0, 1}, turns.z));
}

/// As CGNS and SU2 read it.
Similarity read_back(const PeriodicMotion& p) {
  Similarity motion = turned(p.turns).about(p.center);
  motion.translation = motion.translation + p.translation;
  return motion;
}

double difference(const Similarity& a, const Similarity& b) {
  double most = 0;
  for (const Vec3 x : {Vec3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) most = std::max(most, norm(a(x) - b(x)));
  return most;
}

TEST(PeriodicMotion, is_read_back_for_all_turns) {
  for (const double x : {-3.0, -0.4, 0.0, 0.7, kPi})
    for (const double y : {-2.0, -kPi / 2, 0.0, 0.3, kPi / 2, kPi})
      for (const double z : {-1.0, 0.0, 2.5, kPi}) {
        Similarity motion = turned({x, y, z}).about({3, -2, 5});
        motion.translation = motion.translation + Vec3{0.5, 0.25, -1};
        EXPECT_LT(difference(motion, read_back(periodic_motion(motion))), 1e-11) << x << " " << y << " " << z;
      }
}

TEST(PeriodicMotion, goes_back_by_opposite_signs_about_an_own_axis) {
  for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}})
    for (const double angle : {1e-3, 0.35, 2.0, kPi - 1e-7, kPi, 0.0}) {
      Similarity motion = rotation_about(axis, angle).about({3, -2, 5});
      motion.translation = motion.translation + 0.5 * axis;
      const PeriodicMotion p = periodic_motion(motion);
      EXPECT_TRUE(p.has_own_axis) << angle;
      EXPECT_LT(difference(motion, read_back(p)), 1e-11) << angle;
      const PeriodicMotion back{p.center, -1 * p.turns, -1 * p.translation};
      EXPECT_LT(difference(motion.inverse(), read_back(back)), 1e-11) << angle;
    }
}

TEST(PeriodicMotion, says_that_an_axis_is_askew) {
  EXPECT_FALSE(periodic_motion(rotation_about({0, 0.6, 0.8}, 0.35)).has_own_axis);
  EXPECT_TRUE(periodic_motion({.translation = {1, 2, 3}}).has_own_axis);
  EXPECT_TRUE(periodic_motion({.translation = {1, 2, 3}}).translation == (Vec3{1, 2, 3}));
}

}  // namespace
}  // namespace st
