// Patches hold numbers only.
#include "meshing/face/face_patch.h"

#include <gtest/gtest.h>

#include <limits>

namespace st {
namespace {

FacePatch sound_patch() {
  FacePatch patch;
  patch.inner_xyz = {{1, 2, 3}};
  patch.inner_uv = {{0.5, -1}};
  patch.own_uv = {{1e300, 0}};
  patch.inner_size = {0.1};
  return patch;
}

TEST(FacePatch, without_numbers_is_told_from_a_sound_one) {
  EXPECT_TRUE(has_numbers_only(FacePatch()));
  EXPECT_TRUE(has_numbers_only(sound_patch()));
  for (const double none : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                            -std::numeric_limits<double>::infinity()}) {
    FacePatch patch = sound_patch();
    patch.inner_xyz[0].z = none;
    EXPECT_FALSE(has_numbers_only(patch));
    patch = sound_patch();
    patch.inner_uv[0].x = none;
    EXPECT_FALSE(has_numbers_only(patch));
    patch = sound_patch();
    patch.own_uv[0].y = none;
    EXPECT_FALSE(has_numbers_only(patch));
    patch = sound_patch();
    patch.inner_size[0] = none;
    EXPECT_FALSE(has_numbers_only(patch));
  }
}

}  // namespace
}  // namespace st
