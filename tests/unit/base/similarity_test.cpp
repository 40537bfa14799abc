#include "base/similarity.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace st {
namespace {

void expect_at(const std::string& steps, Vec3 x, Vec3 where) {
  EXPECT_NEAR(distance(parse_similarity(steps, "--transform")(x), where), 0, 1e-12) << steps;
}

TEST(Similarity, is_read_in_steps) {
  expect_at("rotate 0 0 1 90; scale 2; translate 1 2 3", {1, 0, 0}, {1, 4, 3});
  expect_at(" translate 1 0 0 ;; rotate 0 0 2 90;", {1, 0, 0}, {0, 2, 0});
  EXPECT_EQ(parse_similarity("", "--transform"), Similarity());
  EXPECT_EQ(parse_similarity("rotate 1 2 3 0", "--transform")({1, 2, 3}), (Vec3{1, 2, 3}));
}

TEST(Similarity, of_a_step_with_a_point_leaves_that_point) {
  expect_at("rotate 0 0 1 90 at 1 0 0", {2, 0, 7}, {1, 1, 7});
  expect_at("hinge 1 0 0  1 0 5  90", {2, 0, 7}, {1, 1, 7});
  expect_at("hinge 1 0 5  1 0 0  90", {2, 0, 7}, {1, -1, 7});
  expect_at("scale 3 at 1 1 1", {2, 1, 0}, {4, 1, -2});
  expect_at("mirror 0 2 0", {1, 2, 3}, {1, -2, 3});
  expect_at("mirror 0 1 0 at 9 5 9", {1, 2, 3}, {1, 8, 3});
}

TEST(Similarity, comes_back_by_its_inverse) {
  const Similarity motion =
      parse_similarity("hinge 1 2 3 4 5 7 31; scale 2.5; mirror 1 1 0 at 3 0 0; translate 4 5 6", "--transform");
  EXPECT_TRUE(motion.is_mirrored());
  EXPECT_FALSE(motion.then(motion).is_mirrored());
  const Vec3 x{0.3, -7, 11};
  EXPECT_NEAR(distance(motion.inverse()(motion(x)), x), 0, 1e-12);
  EXPECT_NEAR(distance(motion.then(motion.inverse())(x), x), 0, 1e-12);
}

TEST(Similarity, refuses_what_is_no_step) {
  for (const char* bad :
       {"rotate 1 2 3", "scale -1", "scale 0", "shear 1", "translate 1 2 3 4", "rotate 0 0 0 3", "scale 1x",
        "rotate 0 0 1 5 at 1 2", "rotate 0 0 1 5 at 1 2 3 4", "rotate 0 0 1 5 by 1 2 3", "translate 1 2 3 at 0 0 0",
        "hinge 0 0 0 0 0 0 5", "hinge 0 0 0 1 0 0", "mirror 0 0 0", "mirror x"})
    try {
      parse_similarity(bad, "--transform");
      ADD_FAILURE() << bad;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::kUsage);
      EXPECT_NE(std::string(e.what()).find(std::string("--transform: '") + bad + "'"), std::string::npos) << e.what();
    }
}

}  // namespace
}  // namespace st
