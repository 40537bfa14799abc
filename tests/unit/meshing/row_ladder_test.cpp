#include "meshing/face/row_ladder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "unit/meshing/row_case.h"

namespace st::test {
namespace {

/// Lengths across that grow along a band, so that it has fewer rows further on.
class FewerRowsField : public WallField {
 public:
  FewerRowsField() : WallField(0.1, 0, 1) {}
  LocalSize local(Vec3 x, int&) const override { return {0.1 + 0.02 * x.x, 1.2, {1, 0, 0}}; }
};

double largest_laid_angle(const Triangulation& m) {
  double largest = 0;
  for (const PlaneTriangle& t : m.triangles) {
    if (t.state != kLaid) continue;
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = m.nodes[t.v[k]].x;
      largest = std::max(largest, angle_between(m.nodes[t.v[(k + 1) % 3]].x - a, m.nodes[t.v[(k + 2) % 3]].x - a));
    }
  }
  return degrees(largest);
}

TEST(RowLadder, has_as_many_rows_as_each_place_asks_for) {
  const FewerRowsField field;
  RowCase face({band(10, 10, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}, {0.3, 0.6})}, field);
  const std::vector<RowChain> chains = find_row_chains(face.work);
  ASSERT_FALSE(chains.empty());
  ASSERT_TRUE(lay_ladder(face.work, chains[0]));
  EXPECT_NEAR(face.laid_area(), 10 * 0.6, 1e-9);
  EXPECT_LT(largest_laid_angle(face.work.mesh), 110);
  std::vector<int> rows(11, 1);
  for (const MeshNode& n : face.work.mesh.nodes)
    if (n.is_laid) ++rows[static_cast<std::size_t>(std::lround(n.x.x))];
  EXPECT_EQ(rows[1], 5);  // 0.6 / 0.12
  EXPECT_EQ(rows[9], 2);  // 0.6 / 0.28
  EXPECT_TRUE(std::is_sorted(rows.begin() + 1, rows.end() - 1, std::greater<>()));
}

TEST(RowLadder, is_laid_on_a_flat_face_some_segments_wide) {
  const FewerRowsField field;
  const std::vector<double> sides = growing(0.1, 0, 4);
  RowCase face({band(10, 10, sides, sides)}, field);
  ASSERT_TRUE(lay_ladder(face.work, find_row_chains(face.work).at(0)));
  EXPECT_NEAR(face.laid_area(), 10 * 4, 1e-9);
  const WallField square(0.9, 0, 1.2);
  RowCase other({band(10, 10, sides, sides)}, square);
  const std::vector<RowChain> chains = find_row_chains(other.work);
  EXPECT_TRUE(chains.empty() || !lay_ladder(other.work, chains[0])) << "rows as high as long";
}

/// Lengths across that let columns have 5.4, 5.6, 5.4 rows, and so on.
class UnevenField : public WallField {
 public:
  UnevenField() : WallField(0.1, 0, 1) {}
  LocalSize local(Vec3 x, int&) const override { return {1 / (5.5 + 0.1 * std::cos(3.14159 * x.x)), 1.2, {1, 0, 0}}; }
};

TEST(RowLadder, has_as_many_rows_as_the_column_before_where_sizes_hardly_differ) {
  const UnevenField field;
  RowCase face({band(10, 10, {0.2, 0.4, 0.6, 0.8, 1}, {0.2, 0.4, 0.6, 0.8, 1})}, field);
  ASSERT_TRUE(lay_ladder(face.work, find_row_chains(face.work).at(0)));
  EXPECT_NEAR(face.laid_area(), 10, 1e-9);
  EXPECT_EQ(face.n_laid(), 2 * 5 * 10) << "five rows all along";
}

/// A strip of rows that lean by 45 degrees, and have fewer rows further on.
TEST(RowLadder, has_no_fans_where_columns_lean_and_differ) {
  const FewerRowsField field;
  std::vector<Vec2> loop = band(10, 10, growing(0.1, 0, 1.2), growing(0.3, 0, 1.2));
  for (Vec2& p : loop) p.x += p.y;
  RowCase face({loop}, field);
  ASSERT_TRUE(lay_ladder(face.work, find_row_chains(face.work).at(0)));
  EXPECT_NEAR(face.laid_area(), 10 * 1.2, 1e-9);
  const Triangulation& m = face.work.mesh;
  std::vector<int> fan(m.nodes.size(), 0);
  for (const PlaneTriangle& t : m.triangles)
    if (t.state == kLaid)
      for (const std::int32_t n : t.v) ++fan[n];
  EXPECT_LE(*std::ranges::max_element(fan), 8);
}

TEST(RowLadder, is_part_of_a_sound_mesh) {
  const FewerRowsField field;
  FaceBoundary boundary = polygons({band(10, 10, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}, {0.6})}, 0.1);
  const FaceMesh mesh = mesh_face(kPlane, boundary, field, {});
  expect_valid(boundary, mesh);
  EXPECT_NEAR((MeshView{boundary, mesh}.area()), 6, 1e-9);
}

TEST(RowLadder, is_none_on_wide_faces_and_between_unlike_sides) {
  const FewerRowsField field;
  RowCase wide({band(10, 10, {7}, {7})}, field);
  EXPECT_FALSE(lay_ladder(wide.work, find_row_chains(wide.work).at(0)));
  std::vector<Vec2> loop = band(10, 10, {0.6}, {0.6});
  loop.erase(loop.begin() + 14);
  RowCase unlike({loop}, field);
  EXPECT_FALSE(lay_ladder(unlike.work, find_row_chains(unlike.work).at(0)));
  EXPECT_EQ(wide.n_laid() + unlike.n_laid(), 0);
}

/// Round about x with radius 1, v the angle.
class RolledSurface : public Surface {
 public:
  Vec3 point(Vec2 uv) const override { return {uv.x, std::sin(uv.y), 1 - std::cos(uv.y)}; }
  SurfacePoint evaluate(Vec2 uv) const override { return {point(uv), {1, 0, 0}, {0, std::cos(uv.y), std::sin(uv.y)}}; }
  SurfacePoint2 evaluate2(Vec2) const override { return {}; }
};

TEST(RowLadder, is_none_on_a_face_around_a_nose_whose_sides_are_near_each_other) {
  const FewerRowsField field;
  const RolledSurface surface;
  RowCase rolled({band(10, 10, {1, 2, 3, 4, 5, 6}, {1, 2, 3, 4, 5, 6})}, field, surface);
  EXPECT_FALSE(lay_ladder(rolled.work, find_row_chains(rolled.work).at(0)));
}

/// From its apex on, at either end of the chain.
TEST(RowLadder, fills_a_wedge) {
  const FewerRowsField field;
  std::vector<Vec2> loop;
  for (int i = 0; i <= 10; ++i) loop.push_back({static_cast<double>(i), 0});
  loop.push_back({10, 0.3});
  for (int i = 10; i > 0; --i) loop.push_back({static_cast<double>(i), 0.06 * i});
  for (const bool is_mirrored : {false, true}) {
    SCOPED_TRACE(is_mirrored);
    std::vector<Vec2> own = loop;
    if (is_mirrored) {
      for (Vec2& p : own) p.x = 10 - p.x;
      std::ranges::reverse(own);
    }
    RowCase face({own}, field);
    const std::vector<RowChain> chains = find_row_chains(face.work);
    ASSERT_FALSE(chains.empty());
    ASSERT_TRUE(lay_ladder(face.work, chains[0]));
    EXPECT_NEAR(face.laid_area(), 10 * 0.3, 1e-9);
    EXPECT_LT(largest_laid_angle(face.work.mesh), 110);
  }
}

TEST(RowLadder, leaves_out_columns_that_something_is_in) {
  const FewerRowsField field;
  RowCase face({band(10, 10, {0.3, 0.6}, {0.6}), {{4.9, 0.25}, {4.9, 0.35}, {5.1, 0.35}, {5.1, 0.25}}}, field);
  ASSERT_TRUE(lay_ladder(face.work, find_row_chains(face.work).at(0)));
  EXPECT_NEAR(face.laid_area(), 8 * 0.6, 1e-9);
}

}  // namespace
}  // namespace st::test
