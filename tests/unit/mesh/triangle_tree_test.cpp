// Pairs of triangles that trees of boxes find, by group.
#include "mesh/triangle_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace st {
namespace {

/// Small triangles at random places of a cube; many cross.
struct Soup {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> begin;

  Soup(std::int32_t n, std::vector<std::int32_t> first) : begin(std::move(first)) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(0, 1), step(-0.2, 0.2);
    for (std::int32_t t = 0; t < n; ++t) {
      const Vec3 x{place(random), place(random), place(random)};
      for (int k = 0; k < 3; ++k) points.push_back(x + Vec3{step(random), step(random), step(random)});
      triangles.push_back({{3 * t, 3 * t + 1, 3 * t + 2}});
    }
    begin.push_back(n);
  }

  template <class Wanted>
  void expect_those(const std::vector<TrianglePair>& found, const Wanted& is_wanted) const {
    std::vector<std::pair<TriangleId, TriangleId>> expected, pairs;
    int n_shared = 0;
    for (TriangleId b = 0; b < begin.back(); ++b)
      for (TriangleId a = 0; a < b; ++a)
        if (is_wanted(a, b) && triangles_cross(points, triangles[a], triangles[b], n_shared))
          expected.push_back({a, b});
    std::sort(expected.begin(), expected.end());
    for (const TrianglePair& p : found) pairs.push_back({p.a, p.b});
    EXPECT_GT(expected.size(), 10u);
    EXPECT_EQ(pairs, expected);
  }
};

TEST(TriangleTree, finds_the_pairs_within_and_between_the_groups_that_are_asked_for) {
  const Soup s(400, {0, 150, 290});
  const auto group = [&](TriangleId t) { return (t >= 150) + (t >= 290); };
  bool was_ended = true;
  s.expect_those(
      find_pairs({s.points, s.triangles, s.begin}, WithinGroup::kAll, {{0, 0}, {1, 2}}, was_ended),
      [&](TriangleId a, TriangleId b) { return (group(a) == 0 && group(b) == 0) || (group(a) == 1 && group(b) == 2); });
  EXPECT_FALSE(was_ended);
}

TEST(TriangleTree, leaves_out_pairs_of_triangles_that_were_there_before) {
  const Soup s(400, {0, 200});
  std::vector<TriangleId> previous(400, 0);
  for (TriangleId t = 0; t < 400; t += 9) previous[t] = kNone;
  bool was_ended = false;
  for (const auto& search : {std::pair(0, 0), std::pair(0, 1)})
    s.expect_those(find_pairs({s.points, s.triangles, s.begin, previous}, WithinGroup::kAll, {search}, was_ended),
                   [&](TriangleId a, TriangleId b) {
                     return (a % 9 == 0 || b % 9 == 0) && a < 200 && (b < 200) == (search.second == 0);
                   });
}

TEST(TriangleTree, compares_nothing_inside_a_part_of_like_normals_where_told_so) {
  const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -0.5}, {5, 1, 0.5}, {1, 5, 0.5}};
  const std::vector<Triangle> triangles{{{0, 1, 2}}, {{3, 4, 5}}};
  const std::int32_t begin[] = {0, 2};
  bool was_ended = false;
  EXPECT_EQ(find_pairs({points, triangles, begin}, WithinGroup::kAll, {{0, 0}}, was_ended).size(), 1u);
  EXPECT_TRUE(find_pairs({points, triangles, begin}, WithinGroup::kUnlessAlike, {{0, 0}}, was_ended).empty());
}

/// Three triangles about the origin, their normals so far from a direction.
std::vector<Vec3> tilted_about(Vec3 direction, double angle) {
  const Vec3 u = normalized(cross(direction, std::abs(direction.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
  const Vec3 v = cross(direction, u);
  std::vector<Vec3> points;
  for (const double turn : {radians(0), radians(120), radians(240)}) {
    const Vec3 aside = std::cos(turn) * u + std::sin(turn) * v, a = cross(direction, aside);
    const Vec3 b = std::cos(angle) * aside - std::sin(angle) * direction;
    points.insert(points.end(), {-1.0 * b - a, a - b, b});
  }
  return points;
}

TEST(TriangleTree, sees_like_normals_about_every_direction) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const std::vector<Triangle> triangles{{{0, 1, 2}}, {{3, 4, 5}}, {{6, 7, 8}}};
  const std::int32_t begin[] = {0, 3};
  for (int i = 0; i < 500; ++i) {
    const Vec3 direction = normalized({coordinate(random), coordinate(random), coordinate(random)});
    for (const double angle : {radians(32), radians(75)}) {
      const std::vector<Vec3> points = tilted_about(direction, angle);
      bool was_ended = false;
      const auto n_found = [&](WithinGroup rule) {
        return find_pairs({points, triangles, begin}, rule, {{0, 0}}, was_ended).size();
      };
      ASSERT_EQ(n_found(WithinGroup::kAll), 3u);
      ASSERT_EQ(n_found(WithinGroup::kUnlessAlike), angle < radians(60) ? 0u : 3u)
          << direction.x << " " << direction.y << " " << direction.z;
    }
  }
}

TEST(TriangleTree, compares_all_of_a_group_of_which_one_triangle_turns_away) {
  // two sheets through each other, alike, and one beside them that looks the other way
  std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -0.5}, {5, 1, 0.5}, {1, 5, 0.5}};
  for (const Vec3 x : {Vec3{9, 0, 0}, Vec3{9, 4, 0}, Vec3{13, 0, 0}}) points.push_back(x);
  const std::vector<Triangle> triangles{{{0, 1, 2}}, {{3, 4, 5}}, {{6, 7, 8}}};
  const std::int32_t begin[] = {0, 3};
  std::vector<TriangleId> previous{kNone, kNone, kNone};
  bool was_ended = true;
  const auto n_found = [&] {
    return find_pairs({points, triangles, begin, previous}, WithinGroup::kUnlessAlike, {{0, 0}}, was_ended).size();
  };
  EXPECT_EQ(n_found(), 1u);
  previous = {0, 1, kNone};
  EXPECT_EQ(n_found(), 0u);
  EXPECT_FALSE(was_ended);
}

}  // namespace
}  // namespace st
