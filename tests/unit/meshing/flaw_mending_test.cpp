// Single flaws of stretched meshes, made by hand.
#include "meshing/face/flaw_mending.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "meshing/face/triangle_shape.h"
#include "unit/meshing/face_work.h"

namespace st::test {
namespace {

constexpr int kColumns = 6, kRows = 4;
constexpr double kAlong = 1, kAcross = 0.2;

/// A plate of long rectangles, cut in two, and nodes that do not belong there.
struct Plate {
  StretchedField field{LocalSize{kAcross, kAlong, {1, 0, 0}}};
  FaceBoundary boundary;
  std::optional<Prepared> made;

  static Vec2 at(double i, double j) { return {1 + kAlong * i, 1 + kAcross * j}; }

  /// `odd`: node (3,2) lies there, in columns and rows.
  explicit Plate(Vec2 odd = {3, 2}) {
    std::vector<Vec2> loop;
    for (int i = 0; i < kColumns; ++i) loop.push_back(at(i, 0));
    for (int j = 0; j < kRows; ++j) loop.push_back(at(kColumns, j));
    for (int i = kColumns; i > 0; --i) loop.push_back(at(i, kRows));
    for (int j = kRows; j > 0; --j) loop.push_back(at(0, j));
    boundary = polygons({loop}, kAcross);
    made.emplace(kPlane, boundary, field);
    for (int i = 1; i < kColumns; ++i)
      for (int j = 1; j < kRows; ++j) EXPECT_NE(made->insert(at(i, j)), kNone);
    for (MeshNode& n : mesh().nodes) made->work.ask_sizes(n);
    for (MeshNode& n : mesh().nodes)
      if (norm(n.uv - at(3, 2)) < 1e-9) {
        n.p = made->work.plane.to_plane(at(odd.x, odd.y));
        made->work.evaluate(n);
      }
    EXPECT_GT(made->worst_cosine(), 0);
  }
  Triangulation& mesh() { return made->work.mesh; }
  std::int32_t node_at(Vec2 p) {
    const auto is_there = [&](const MeshNode& n) { return norm(n.uv - at(p.x, p.y)) < 1e-9; };
    return static_cast<std::int32_t>(std::ranges::find_if(mesh().nodes, is_there) - mesh().nodes.begin());
  }
  double largest_angle() { return degrees(std::acos(least_cosine())); }
  double least_quality() {
    double least = 1;
    for (const PlaneTriangle& t : mesh().triangles)
      if (Prepared::is_inside(t))
        least = std::min(least, metric_quality(mesh().nodes[t.v[0]], mesh().nodes[t.v[1]], mesh().nodes[t.v[2]]));
    return least;
  }
  double largest_growth() {
    double most = 1;
    for (const PlaneTriangle& t : mesh().triangles)
      for (const std::int32_t other : t.n)
        if (Prepared::is_inside(t) && other != kNone && Prepared::is_inside(mesh().triangles[other]))
          most = std::max(most, std::sqrt(area(t) / area(mesh().triangles[other])));
    return most;
  }

 private:
  Vec3 x(const PlaneTriangle& t, int k) { return mesh().nodes[t.v[k % 3]].x; }
  double area(const PlaneTriangle& t) { return 0.5 * norm(cross(x(t, 1) - x(t, 0), x(t, 2) - x(t, 0))); }
  double least_cosine() {
    double least = 1;
    for (const PlaneTriangle& t : mesh().triangles)
      for (int k = 0; k < 3 && Prepared::is_inside(t); ++k)
        least = std::min(least, dot(normalized(x(t, k + 1) - x(t, k)), normalized(x(t, k + 2) - x(t, k))));
    return least;
  }
};

std::vector<std::array<std::int32_t, 3>> corners_of(const Triangulation& m) {
  std::vector<std::array<std::int32_t, 3>> all;
  for (const PlaneTriangle& t : m.triangles) all.push_back({t.v[0], t.v[1], t.v[2]});
  return all;
}

TEST(FlawMending, leaves_sound_rows_as_they_are) {
  Plate plate;
  const auto corners = corners_of(plate.mesh());
  const auto nodes = plate.mesh().nodes;
  mend_flaws(plate.made->work);
  EXPECT_EQ(corners_of(plate.mesh()), corners);
  for (std::size_t i = 0; i < nodes.size(); ++i) EXPECT_TRUE(plate.mesh().nodes[i].x == nodes[i].x);
}

TEST(FlawMending, leaves_no_obtuse_triangle_about_an_odd_node) {
  for (const Vec2 odd : {Vec2{3.45, 2.4}, Vec2{2.6, 1.6}}) {
    SCOPED_TRACE(odd.x);
    Plate plate(odd);
    ASSERT_GT(plate.largest_angle(), 140);
    const BoundaryWatch watch(*plate.made);
    mend_flaws(plate.made->work);
    EXPECT_LE(plate.largest_angle(), 140);
    EXPECT_LE(plate.largest_growth(), kMostGrowth);
    watch.expect_unchanged();
    expect_valid(plate.boundary, plate.made->mesh());
  }
}

/// Between two rows that must stay, half a column beside all others.
struct PlateWithNodeBetween : Plate {
  std::int32_t between = kNone;
  PlateWithNodeBetween() {
    for (const double row : {2, 3}) EXPECT_TRUE(mesh().force_side(node_at({3, row}), node_at({4, row})));
    for (MeshNode& n : mesh().nodes) n.is_laid = true;
    between = made->insert(at(3.5, 2.5));
    EXPECT_NE(between, kNone);
    EXPECT_GT(largest_angle(), 150);
  }
};

TEST(FlawMending, takes_out_a_node_between_two_columns) {
  PlateWithNodeBetween plate;
  const BoundaryWatch watch(*plate.made);
  mend_flaws(plate.made->work);
  EXPECT_EQ(plate.mesh().triangle_at(plate.between), kNone);
  EXPECT_LE(plate.largest_angle(), 140);
  watch.expect_unchanged();
  expect_valid(plate.boundary, plate.made->mesh());
}

TEST(FlawMending, takes_out_no_node_that_is_kept) {
  PlateWithNodeBetween plate;
  plate.mesh().nodes[plate.between].is_kept = true;
  mend_flaws(plate.made->work);
  EXPECT_NE(plate.mesh().triangle_at(plate.between), kNone);
}

/// As a nose inside a face: rows begin there.
TEST(FlawMending, moves_no_node_of_a_line_of_rows) {
  Plate plate({3.45, 2.4});
  for (MeshNode& n : plate.mesh().nodes) n.is_laid = n.is_kept = true;
  const auto nodes = plate.mesh().nodes;
  mend_flaws(plate.made->work);
  for (std::size_t i = 0; i < nodes.size(); ++i) EXPECT_TRUE(plate.mesh().nodes[i].x == nodes[i].x) << i;
}

TEST(FlawMending, moves_nodes_at_ends_of_rows) {
  Plate plate({3.2, 2});
  for (MeshNode& n : plate.mesh().nodes) n.is_laid = true;
  mend_flaws(plate.made->work);
  EXPECT_GT(plate.least_quality(), 0.85);
  expect_valid(plate.boundary, plate.made->mesh());
}

/// Whole quadrilaterals, though some are high.
TEST(FlawMending, leaves_quadrilaterals_of_rows_as_they_are) {
  Plate plate({3, 2.35});
  ASSERT_LT(plate.least_quality(), 0.84);
  for (PlaneTriangle& t : plate.mesh().triangles)
    if (Prepared::is_inside(t)) t.state = kLaid;
  for (MeshNode& n : plate.mesh().nodes) n.is_laid = true;
  const auto nodes = plate.mesh().nodes;
  mend_flaws(plate.made->work);
  for (std::size_t i = 0; i < nodes.size(); ++i) EXPECT_TRUE(plate.mesh().nodes[i].x == nodes[i].x) << i;
}

/// Rows that are narrow there have given them less stretch.
TEST(FlawMending, judges_nodes_of_rows_by_what_is_asked_for) {
  Plate plate({3.2, 2});
  for (std::size_t i = 0; i < plate.mesh().nodes.size(); ++i) {
    MeshNode& n = plate.mesh().nodes[i];
    n.is_laid = true;
    plate.made->work.shortened.push_back({static_cast<std::int32_t>(i), n.squeeze});
    n.squeeze = LocalSize{kAcross, 1.5 * kAcross, {0, 1, 0}}.squeeze();
  }
  mend_flaws(plate.made->work);
  EXPECT_GT(plate.least_quality(), 0.85);
}

TEST(FlawMending, opens_a_side_of_a_row_for_what_is_beside_it) {
  Plate plate;
  const std::int32_t t = plate.mesh().left_of(plate.node_at({3, 1}), plate.node_at({3, 2})).first;
  ASSERT_NE(t, kNone);
  int k = 0;
  while (plate.mesh().triangles[t].v[k] != plate.node_at({3, 1})) ++k;
  const std::int32_t other = plate.mesh().triangles[t].n[k];
  ASSERT_TRUE(plate.mesh().can_swap(t, k));
  plate.mesh().swap(t, k);
  for (const std::int32_t i : {t, other}) {
    PlaneTriangle& r = plate.mesh().triangles[i];
    for (int side = 0; side < 3; ++side)
      if (r.n[side] == (i == t ? other : t)) r.constrained |= static_cast<std::uint8_t>(1 << side);
  }
  for (MeshNode& n : plate.mesh().nodes) n.is_laid = n.is_kept = true;
  ASSERT_LT(plate.least_quality(), 0.7);
  mend_flaws(plate.made->work);
  EXPECT_GT(plate.least_quality(), 0.85);
  expect_valid(plate.boundary, plate.made->mesh());
}

TEST(FlawMending, makes_large_steps_of_size_smaller) {
  Plate plate({3, 2.85});
  ASSERT_GT(plate.largest_growth(), 2.5);
  mend_flaws(plate.made->work);
  EXPECT_LE(plate.largest_growth(), kMostGrowth);
  expect_valid(plate.boundary, plate.made->mesh());
}

/// Half squares have 0.866.
TEST(FlawMending, makes_triangles_as_good_as_half_squares) {
  Plate plate({3.2, 2});
  ASSERT_GT(plate.least_quality(), 0.75);
  ASSERT_LT(plate.least_quality(), 0.76);
  ASSERT_LT(plate.largest_angle(), 138);
  mend_flaws(plate.made->work);
  EXPECT_GT(plate.least_quality(), 0.85);
  expect_valid(plate.boundary, plate.made->mesh());
}

/// In space its largest angle is 133 degrees, which is allowed.
TEST(FlawMending, sees_no_lack_in_what_the_metric_makes_equilateral) {
  const LocalSize size{1, 4, {1, 0, 0}};
  std::array<MeshNode, 3> corner;
  for (MeshNode& n : corner) n.squeeze = size.squeeze();
  corner[1].x = {4, 0, 0};
  corner[2].x = {2, std::sqrt(0.75), 0};
  EXPECT_NEAR(metric_quality(corner[0], corner[1], corner[2]), 1, 1e-12);
}

/// Takes one out.
struct PlateWithHole : Plate {
  PlateWithHole() {
    std::vector<std::int32_t> around, tris;
    const auto is_there = [](const MeshNode& n) { return norm(n.uv - at(3, 2)) < 1e-9; };
    const auto node = static_cast<std::int32_t>(std::ranges::find_if(mesh().nodes, is_there) - mesh().nodes.begin());
    EXPECT_TRUE(mesh().ring_of(node, around, tris));
    for (int k = 0; k < std::ssize(around) && mesh().triangle_at(node) != kNone; ++k)
      if (stays_valid(around, k)) mesh().collapse(node, k, around, tris);
    EXPECT_EQ(mesh().triangle_at(node), kNone);
  }

 private:
  bool stays_valid(const std::vector<std::int32_t>& around, int onto) {
    const auto n = std::ssize(around);
    const auto p = [&](std::ptrdiff_t i) { return mesh().nodes[around[i % n]].p; };
    for (std::ptrdiff_t i = 1; i + 1 < n; ++i)
      if (cross(p(onto + i) - p(onto), p(onto + i + 1) - p(onto)) <= 1e-9) return false;
    return true;
  }
};

TEST(FlawMending, puts_a_node_where_one_is_missing) {
  PlateWithHole plate;
  const int n_before = plate.made->n_inner();
  ASSERT_LT(plate.least_quality(), 0.7);
  const BoundaryWatch watch(*plate.made);
  mend_flaws(plate.made->work);
  EXPECT_EQ(plate.made->n_inner(), n_before + 1);
  EXPECT_GT(plate.least_quality(), 0.85);
  watch.expect_unchanged();
  expect_valid(plate.boundary, plate.made->mesh());
}

/// Seen from the side nothing is better than what is there.
TEST(FlawMending, turns_no_triangle_away_from_the_surface) {
  Plate plate({3.45, 2.4});
  ASSERT_GT(plate.largest_angle(), 140);
  const auto corners = corners_of(plate.mesh());
  for (MeshNode& n : plate.mesh().nodes) {
    n.normal = {0, 0.995, 0.1};
    n.is_laid = true;
  }
  mend_flaws(plate.made->work);
  EXPECT_EQ(corners_of(plate.mesh()), corners);
}

}  // namespace
}  // namespace st::test
