// Faces that are given up.
#include "meshing/engine/hopeless_faces.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace st {
namespace {

/// The number of the meshing by which face 1 of two is given up; 0: it is not.
int given_up_by(std::int64_t n_triangles, const std::vector<std::int64_t>& folds) {
  HopelessFaces faces(2);
  for (std::size_t i = 0; i < folds.size(); ++i) {
    faces.add_meshed(1, n_triangles);
    if (!faces.gives_up_folded(1, folds[i])) continue;
    EXPECT_EQ(faces.all(), std::vector<FaceId>{1});
    EXPECT_FALSE(faces.contains(0));
    return static_cast<int>(i) + 1;
  }
  EXPECT_TRUE(faces.all().empty());
  return 0;
}

TEST(HopelessFaces, are_given_up_by_the_second_meshing_that_leaves_not_clearly_fewer) {
  EXPECT_EQ(given_up_by(1000, {100, 100, 100, 100}), 3);
  EXPECT_EQ(given_up_by(1000, {200, 181, 180}), 3) << "a tenth less is not yet fewer";
  EXPECT_EQ(given_up_by(1000, {200, 181, 179, 179, 179}), 5);
  EXPECT_EQ(given_up_by(1000, {1000, 890, 790, 700, 620, 550, 490}), 0);
}

TEST(HopelessFaces, are_kept_where_little_is_bad_and_little_was_meshed) {
  EXPECT_EQ(given_up_by(1000, {99, 99, 99, 99, 99, 99}), 0);
  EXPECT_EQ(given_up_by(200'000, {60, 60, 60, 60, 60}), 4) << "by 500,000 triangles since";
  EXPECT_EQ(given_up_by(333'000, {57, 61, 63, 64}), 3);
  EXPECT_EQ(given_up_by(333'000, {0, 0, 0, 0}), 0);
}

TEST(HopelessFaces, are_given_up_at_once_beyond_four_times_their_first_triangles) {
  const auto given_up_by_second = [](std::int64_t n_first, std::int64_t n_second, std::int64_t n_bad_then) {
    HopelessFaces faces(1);
    faces.add_meshed(0, n_first);
    EXPECT_FALSE(faces.gives_up_folded(0, 20));
    faces.add_meshed(0, n_second);
    return faces.gives_up_folded(0, n_bad_then);
  };
  EXPECT_TRUE(given_up_by_second(1000, 4001, 20));
  EXPECT_FALSE(given_up_by_second(1000, 4000, 20));
  EXPECT_FALSE(given_up_by_second(1000, 9000, 17)) << "it is getting better";
  EXPECT_FALSE(given_up_by_second(100, 900, 20)) << "few";
}

TEST(HopelessFaces, begin_anew_where_they_were_sound) {
  EXPECT_EQ(given_up_by(1000, {0, 0, 120, 60, 30}), 0);
  EXPECT_EQ(given_up_by(1000, {120, 0, 120, 120, 120}), 5);
}

TEST(HopelessFaces, give_all_folds_up_by_the_second_round_that_leaves_as_many) {
  const auto given_up_by = [](std::int64_t n_triangles, const std::vector<std::int64_t>& folds) {
    HopelessFaces faces(2);
    for (std::size_t i = 0; i < folds.size(); ++i) {
      for (FaceId f = 0; f < 2; ++f) faces.add_meshed(f, n_triangles / 2);
      if (faces.gives_up_folds(folds[i])) return static_cast<int>(i) + 1;
    }
    return 0;
  };
  EXPECT_EQ(given_up_by(100'000, {13, 17, 17, 26}), 3);
  EXPECT_EQ(given_up_by(99'000, {13, 17, 17, 26}), 4) << "by 200,000 triangles since";
  EXPECT_EQ(given_up_by(100'000, {13, 17, 11, 12, 11}), 5) << "fewer in the third";
  EXPECT_EQ(given_up_by(100'000, {0, 0, 0, 0}), 0);
}

TEST(HopelessFaces, count_once_for_each_meshing) {
  HopelessFaces faces(1);
  faces.add_meshed(0, 10);
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(faces.gives_up_crossing(0, 500));
}

TEST(HopelessFaces, compare_crossings_with_crossings) {
  HopelessFaces faces(1);
  const auto meshed_again = [&](std::int64_t n_folds, std::int64_t n_bad) {
    faces.add_meshed(0, 10);
    return std::pair(faces.gives_up_folded(0, n_folds), faces.gives_up_crossing(0, n_bad));
  };
  const std::pair neither(false, false);
  EXPECT_EQ(meshed_again(10, 900), neither);
  EXPECT_EQ(meshed_again(5, 900), neither);
  EXPECT_EQ(meshed_again(0, 700), neither);
  EXPECT_EQ(meshed_again(0, 700), neither);
  EXPECT_EQ(meshed_again(0, 700), std::pair(false, true));
  EXPECT_EQ(meshed_again(0, 700), neither) << "only once";
}

}  // namespace
}  // namespace st
