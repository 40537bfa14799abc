#include "meshing/face/ridge_lines.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "meshing/face/row_blocks.h"
#include "unit/meshing/row_case.h"

namespace st::test {
namespace {

/// Counter-clockwise about a ridge along the x axis: 30 wide, 2 x 5 high.
std::vector<Vec2> loop_about_ridge() {
  std::vector<double> up = growing(0.1, 0.2, 5);
  std::vector<Vec2> loop;
  for (int i = 0; i < 30; ++i) loop.push_back({static_cast<double>(i), -5});
  const auto add_side = [&](double x, double sign) {
    for (auto y = up.rbegin(); y != up.rend(); ++y) loop.push_back({x, -sign * *y});
    loop.push_back({x, 0});
    for (const double y : up) loop.push_back({x, sign * y});
  };
  add_side(30, 1);
  for (int i = 29; i > 0; --i) loop.push_back({static_cast<double>(i), 5});
  add_side(0, -1);
  loop.erase(loop.begin());
  return loop;
}

/// The ridge is a parabola.
class BentRidgeField : public WallField {
 public:
  BentRidgeField() : WallField(0.1, 0.2, 1) {}
  using WallField::size;
  double size(Vec3 x, int& hint) const override { return WallField::size({x.x, x.y - ridge_at(x.x), 0}, hint); }
  LocalSize local(Vec3 x, int& hint) const override {
    LocalSize own = WallField::local(x, hint);
    if (own.direction != Vec3{}) own.direction = normalized({1, (30 - 2 * x.x) * kBend, 0});
    return own;
  }
  static double ridge_at(double x) { return kBend * x * (30 - x); }

 private:
  static constexpr double kBend = 0.001;
};

TEST(RidgeLines, follow_the_least_length) {
  const WallField field(0.1, 0.2, 1);
  RowCase face({loop_about_ridge()}, field);
  const auto lines = lay_ridges(face.work);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_GE(lines[0].size(), 27u);
  for (std::size_t i = 0; i < lines[0].size(); ++i) {
    const MeshNode& n = face.work.mesh.nodes[lines[0][i]];
    EXPECT_NEAR(n.x.y, 0, 0.01);
    if (i == 0) continue;
    EXPECT_NEAR(std::abs(n.x.x - face.work.mesh.nodes[lines[0][i - 1]].x.x), 1, 0.05);
    EXPECT_TRUE(face.work.mesh.is_fixed(lines[0][i - 1], lines[0][i]));
  }
}

TEST(RidgeLines, follow_a_bent_one) {
  const BentRidgeField field;
  RowCase face({loop_about_ridge()}, field);
  const auto lines = lay_ridges(face.work);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_GE(lines[0].size(), 27u);
  for (const std::int32_t n : lines[0]) {
    const Vec3 x = face.work.mesh.nodes[n].x;
    EXPECT_NEAR(x.y, BentRidgeField::ridge_at(x.x), 0.02);
  }
}

/// As at a round tail: lengths are alike within `half` of the middle.
class FlatRidgeField : public WallField {
 public:
  explicit FlatRidgeField(double half = 1) : WallField(0.1, 0.2, 1), half_(half) {}
  using WallField::size;
  double size(Vec3 x, int& hint) const override {
    return WallField::size({x.x, std::max(0.0, std::abs(x.y) - half_), 0}, hint);
  }

 private:
  double half_;
};

TEST(RidgeLines, lie_in_the_middle_of_equal_lengths) {
  const FlatRidgeField field;
  RowCase face({loop_about_ridge()}, field);
  const auto lines = lay_ridges(face.work);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_GE(lines[0].size(), 27u);
  for (const std::int32_t n : lines[0]) EXPECT_NEAR(face.work.mesh.nodes[n].x.y, 0, 0.02);
}

TEST(RidgeLines, begin_in_the_middle_of_equal_lengths_wider_than_a_step) {
  const FlatRidgeField field(1.15);
  RowCase face({loop_about_ridge()}, field);
  const auto lines = lay_ridges(face.work);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_GE(lines[0].size(), 27u);
}

/// At two places of the ridge edges may not be longer along it.
class SpottedRidgeField : public WallField {
 public:
  SpottedRidgeField() : WallField(0.1, 0.2, 1) {}
  LocalSize local(Vec3 x, int& hint) const override {
    const LocalSize own = WallField::local(x, hint);
    const bool is_spot = std::min(std::abs(x.x - 10), std::abs(x.x - 20)) < 0.7;
    return is_spot ? LocalSize{own.length, own.length, {}} : own;
  }
};

TEST(RidgeLines, go_on_behind_places_without_stretch) {
  const SpottedRidgeField field;
  RowCase face({loop_about_ridge()}, field);
  const auto lines = lay_ridges(face.work);
  ASSERT_EQ(lines.size(), 3u);
  for (const auto& line : lines) EXPECT_GE(line.size(), 7u);
}

/// Of the least length over 20 of its 30 lengths alone.
class InnerRidgeField : public WallField {
 public:
  InnerRidgeField() : WallField(0.1, 0.2, 1) {}
  using WallField::size;
  double size(Vec3 x, int& hint) const override {
    return WallField::size({x.x, std::hypot(x.y, std::max(0.0, std::abs(x.x - 15) - 10)), 0}, hint);
  }
};

TEST(RidgeLines, are_found_inside_a_face) {
  const InnerRidgeField field;
  std::vector<Vec2> loop = band(30, 30, {10}, {10});
  for (Vec2& p : loop) p.y -= 5;
  RowCase face({loop}, field);
  const auto lines = lay_ridges(face.work);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_GE(lines[0].size(), 18u);
  for (const std::int32_t n : lines[0]) EXPECT_NEAR(face.work.mesh.nodes[n].x.y, 0, 0.02);
}

TEST(RidgeLines, are_none_where_lengths_are_alike_in_all_directions) {
  const WallField field(0.1, 0.2, 0.12);
  RowCase face({loop_about_ridge()}, field);
  EXPECT_TRUE(lay_ridges(face.work).empty());
}

TEST(RidgeLines, are_none_where_lengths_across_are_about_the_same) {
  const WallField field(0.1, 0.0001, 1);
  RowCase face({loop_about_ridge()}, field);
  EXPECT_TRUE(lay_ridges(face.work).empty());
}

TEST(RidgeLines, are_none_along_a_loop) {
  const WallField field(0.1, 0.2, 1);
  RowCase face({band(30, 30, growing(0.1, 0.2, 5), growing(0.1, 0.2, 5))}, field);
  EXPECT_TRUE(lay_ridges(face.work).empty());
}

/// As loop_about_ridge(), cut off below the ridge by an edge of `n` segments.
std::vector<Vec2> loop_cut_off(double y, int n) {
  std::vector<Vec2> loop;
  for (const Vec2 p : loop_about_ridge())
    if (p.y > y) loop.push_back(p);
  for (int i = 1; i < n; ++i) loop.push_back({30.0 * i / n, y});
  return loop;
}

TEST(RidgeLines, are_none_beside_a_loop_that_has_rows) {
  const WallField field(0.1, 0.2, 1);
  for (const double y : {-0.4, -1.2}) {  // a few rows, and twelve lengths
    RowCase face({loop_cut_off(y, 30)}, field);
    EXPECT_TRUE(lay_ridges(face.work).empty()) << y;
  }
}

TEST(RidgeLines, lie_beside_a_loop_without_long_segments) {
  const WallField field(0.1, 0.2, 1);
  RowCase face({loop_cut_off(-1.2, 300)}, field);
  EXPECT_FALSE(lay_ridges(face.work).empty());
}

TEST(RidgeLines, have_rows_on_both_sides) {
  const WallField field(0.1, 0.2, 1);
  RowCase face({loop_about_ridge()}, field);
  lay_row_blocks(face.work);
  double low = 0, high = 0;
  for (const PlaneTriangle& t : face.work.mesh.triangles) {
    if (t.state != kLaid) continue;
    for (const std::int32_t v : t.v) {
      low = std::min(low, face.work.mesh.nodes[v].x.y);
      high = std::max(high, face.work.mesh.nodes[v].x.y);
    }
  }
  EXPECT_LT(low, -1.5);
  EXPECT_GT(high, 1.5);
  EXPECT_NEAR(low, -high, 0.2);
}

}  // namespace
}  // namespace st::test
