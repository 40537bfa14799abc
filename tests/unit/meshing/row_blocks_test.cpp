#include "meshing/face/row_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "unit/meshing/row_case.h"

namespace st::test {
namespace {

double largest_angle(const MeshView& view) {
  double largest = 0;
  for (std::size_t i = 0; i < view.mesh.corners.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = view.x(view.mesh.corners[i + k]), b = view.x(view.mesh.corners[i + (k + 1) % 3]);
      largest = std::max(largest, angle_between(b - a, view.x(view.mesh.corners[i + (k + 2) % 3]) - a));
    }
  return degrees(largest);
}

TEST(RowBlocks, fill_a_band_with_rows_of_right_angled_triangles) {
  const WallField field(0.1, 0, 1);
  RowCase face({band(10, 10, {0.1, 0.2, 0.3, 0.4}, {0.1, 0.2, 0.3, 0.4})}, field);
  EXPECT_TRUE(lay_row_blocks(face.work).empty());
  EXPECT_EQ(face.n_laid(), 2 * 10 * 4);
  EXPECT_NEAR(face.laid_area(), 10 * 0.4, 1e-9);
}

TEST(RowBlocks, grow_by_the_slope_until_they_are_nearly_square) {
  const WallField field(0.1, 0.2, 1);
  const std::vector<double> side = growing(0.1, 0.2, 9);
  RowCase face({band(10, 10, side, side)}, field);
  const auto ends = lay_row_blocks(face.work);
  EXPECT_EQ(ends.size(), 10u);
  double height = 0;
  for (const auto& [a, b] : ends) {
    EXPECT_TRUE(face.work.mesh.nodes[a].is_laid || a < face.work.mesh.n_boundary);
    height = std::max(height, face.work.mesh.nodes[a].x.y);
  }
  EXPECT_GT(height, 1.5);
  EXPECT_LT(height, 2.5);
  EXPECT_NEAR(face.laid_area(), 10 * height, 0.05 * 10 * height);
}

TEST(RowBlocks, stay_as_they_were_laid) {
  const WallField field(0.1, 0.2, 1);
  const std::vector<double> side = growing(0.1, 0.2, 9);
  RowCase face({band(10, 10, side, side)}, field);
  lay_row_blocks(face.work);
  const std::vector<MeshNode> before = face.work.mesh.nodes;
  const int n_laid = face.n_laid();
  RowCase again({band(10, 10, side, side)}, field);
  advance_front(again.work);
  enhance(again.work, 5);
  EXPECT_EQ(again.n_laid(), n_laid);
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_TRUE(!before[i].is_laid || again.work.mesh.nodes[i].x == before[i].x) << i;
}

TEST(RowBlocks, leave_a_hole_free_and_the_mesh_valid) {
  const WallField field(0.1, 0.2, 1);
  const std::vector<double> side = growing(0.1, 0.2, 9);
  const FaceBoundary boundary =
      polygons({band(20, 10, side, side), {{4.5, 0.5}, {4.5, 0.8}, {4.8, 0.8}, {4.8, 0.5}}}, 0.1);
  FaceBoundary sized = boundary;
  for (FaceNode& n : sized.nodes) n.h = field.size(n.x);
  const FaceMesh mesh = mesh_face(kPlane, sized, field, {});
  expect_valid(sized, mesh);
  const MeshView view{sized, mesh};
  EXPECT_NEAR(view.area(), 10 * 9 - 0.3 * 0.3, 1e-6);
  EXPECT_LT(largest_angle(view), 150);
}

TEST(RowBlocks, keep_their_distance_from_rows_across) {
  const WallField field(0.1, 0, 0.4);
  std::vector<Vec2> loop;
  for (int i = 0; i <= 25; ++i) loop.push_back({0.4 * i, 0});
  for (int k = 1; k < 10; ++k) loop.push_back({10, 0.1 * k});
  for (int i = 30; i >= 0; --i) loop.push_back({i / 3.0, 1});  // stations that do not match
  for (int k = 9; k > 0; --k) loop.push_back({0, 0.1 * k});
  const FaceBoundary boundary = polygons({loop}, 0.1);
  const FaceMesh mesh = mesh_face(kPlane, boundary, field, {});
  expect_valid(boundary, mesh);
  EXPECT_LT(largest_angle({boundary, mesh}), 140);
}

/// Largest angle under which the nodes beside laid rows see their edges, degrees.
double largest_view_of_rows(const Triangulation& m) {
  double largest = 0;
  for (const PlaneTriangle& t : m.triangles)
    for (int k = 0; k < 3; ++k) {
      if (t.state == kLaid || t.state == kOutside || t.state == kDead || t.n[k] == kNone) continue;
      if (m.triangles[t.n[k]].state != kLaid || t.v[(k + 2) % 3] < m.n_boundary) continue;
      if (m.nodes[t.v[(k + 2) % 3]].is_laid) continue;
      const Vec3 p = m.nodes[t.v[(k + 2) % 3]].x;
      largest = std::max(largest, angle_between(m.nodes[t.v[k]].x - p, m.nodes[t.v[(k + 1) % 3]].x - p));
    }
  return degrees(largest);
}

/// With pointed ends, and nodes in step on both sides: two rows at the left, six at the right.
TEST(RowBlocks, end_one_by_one_at_nodes_across_in_a_wedge) {
  const WallField field(0.1, 0, 1);
  std::vector<Vec2> loop{{-1, 0.1}};
  for (int i = 0; i <= 20; ++i) loop.push_back({static_cast<double>(i), 0});
  loop.push_back({23, 0.3});
  for (int i = 20; i >= 0; --i) loop.push_back({static_cast<double>(i), 0.2 + 0.02 * i});
  RowCase face({loop}, field);
  lay_row_blocks(face.work);
  EXPECT_GT(face.laid_area(), 20 * 0.4 - 0.4) << "no gap where they meet, but for the last column";
}

TEST(RowBlocks, are_seen_by_new_nodes_under_no_obtuse_angle) {
  for (const int n : {7, 8, 10, 13, 16, 20}) {
    const WallField field(0.1, 0, 10.0 / n);
    std::vector<Vec2> loop;
    for (int i = 0; i <= n; ++i) loop.push_back({10.0 * i / n, 0});
    for (int k = 1; k < 10; ++k) loop.push_back({10, 0.1 * k});
    for (int i = n + 3; i >= 0; --i) loop.push_back({10.0 * i / (n + 3), 1});
    for (int k = 9; k > 0; --k) loop.push_back({0, 0.1 * k});
    RowCase face({loop}, field);
    advance_front(face.work);
    EXPECT_LT(largest_view_of_rows(face.work.mesh), 131) << n;
  }
}

TEST(RowBlocks, leave_no_edge_that_must_stay_without_a_row_beside_it) {
  const WallField field(0.1, 0, 1);
  std::vector<Vec2> comb{{4.4, 0.5}};  // two needles come down into quadrilaterals beside each other
  for (const double x : {4.62, 5.62}) comb.insert(comb.end(), {{x - 0.02, 0.5}, {x, 0.05}, {x + 0.02, 0.5}});
  comb.insert(comb.end(), {{6, 0.5}, {6, 0.6}, {4.4, 0.6}});
  std::reverse(comb.begin(), comb.end());
  RowCase face({band(10, 10, {3}, {3}), comb}, field);
  lay_row_blocks(face.work);
  EXPECT_GT(face.n_laid(), 0);
  const Triangulation& m = face.work.mesh;
  for (const PlaneTriangle& t : m.triangles)
    for (int k = 0; k < 3; ++k) {
      const bool is_own = t.state == kUnfinished && t.n[k] != kNone && m.triangles[t.n[k]].state == kUnfinished;
      EXPECT_FALSE(is_own && (t.constrained >> k & 1)) << t.v[k] << " " << t.v[(k + 1) % 3];
    }
}

/// Long along circles about the origin.
class RingField : public WallField {
 public:
  RingField() : WallField(0.1, 0, 1) {}
  LocalSize local(Vec3 x, int&) const override { return {0.1, 1, normalized(Vec3{-x.y, x.x, 0})}; }
};

/// Triangles laid inside a circle of 60 nodes, the first at `first`, a hole before the 30th.
int laid_in_circle(int first) {
  const auto at = [](double node, double radius) {
    return radius * Vec2{std::cos(2 * M_PI * node / 60), std::sin(2 * M_PI * node / 60)};
  };
  std::vector<Vec2> loop;
  for (int i = 0; i < 60; ++i) loop.push_back(at(first + i, 10));
  const RingField field;
  RowCase face({loop, {at(30.3, 9.42), at(30.3, 9), at(30.7, 9), at(30.7, 9.42)}}, field);
  lay_row_blocks(face.work);
  return face.n_laid();
}

TEST(RowBlocks, are_the_same_wherever_a_closed_loop_begins) {
  const int n = laid_in_circle(0);
  EXPECT_GT(n, 700);
  for (int first = 26; first < 36; ++first) EXPECT_EQ(laid_in_circle(first), n) << first;
}

TEST(RowBlocks, are_not_laid_obliquely_to_metrics) {
  for (const int n_rows : {4, 40}) {
    for (const double angle : {-20, 20}) {
      const SlantedField metric(angle, true), lengths(angle, false);
      RowCase oblique({metric.band_of(n_rows)}, metric), laid({metric.band_of(n_rows)}, lengths);
      lay_row_blocks(oblique.work);
      lay_row_blocks(laid.work);
      EXPECT_EQ(oblique.n_laid(), 0) << n_rows << " rows, " << angle;
      EXPECT_GT(laid.n_laid(), 0) << n_rows << " rows, " << angle;
    }
  }
}

TEST(RowBlocks, are_cut_by_the_diagonal_that_is_shorter_in_metrics) {
  for (const double angle : {-4, 4}) {
    const SlantedField metric(angle, true);
    RowCase face({metric.band_of(4)}, metric);
    lay_row_blocks(face.work);
    EXPECT_EQ(face.n_laid(), 2 * 10 * 4) << angle;
    for (const PlaneTriangle& t : face.work.mesh.triangles) {
      if (t.state != kLaid) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 d = face.work.mesh.nodes[t.v[k]].x - face.work.mesh.nodes[t.v[(k + 1) % 3]].x;
        EXPECT_LE(std::sqrt(length2(d, face.work.mesh.nodes[t.v[k]])), 1.35 * 0.1) << angle;
      }
    }
  }
}

TEST(RowBlocks, are_none_where_lengths_are_equal) {
  const WallField field(0.5, 0, 0.5);
  RowCase face({band(20, 10, {5}, {5})}, field);
  EXPECT_TRUE(lay_row_blocks(face.work).empty());
  EXPECT_EQ(face.n_laid(), 0);
}

TEST(OpenAtGap, keeps_all_quadrilaterals_in_order) {
  RowLine line{{kNone, 11, 12, 13, 10}, {0, 1, 2, 3, 4}, {0, 5, 6, 7, 8}, {0, 1, 1, 1}, true};
  open_at_gap(line);
  EXPECT_FALSE(line.is_closed);
  EXPECT_EQ(line.nodes, (std::vector<std::int32_t>{11, 12, 13, 10}));
  EXPECT_EQ(line.lowest, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(line.highest, (std::vector<double>{5, 6, 7, 8}));
  EXPECT_EQ(line.joined, (std::vector<char>{1, 1, 1}));
  RowLine inside{{10, 11, 12, 13, 10}, {4, 1, 2, 3, 4}, {8, 5, 6, 7, 8}, {1, 1, 0, 1}, true};
  for (const double length : {4, 1, 2, 3, 4}) inside.asked.push_back({length, length, {}});
  open_at_gap(inside);
  EXPECT_EQ(inside.asked.front().length, 3) << "as the nodes";
  EXPECT_EQ(inside.asked.size(), 4u);
  EXPECT_EQ(inside.nodes, (std::vector<std::int32_t>{13, 10, 11, 12}));
  EXPECT_EQ(inside.joined, (std::vector<char>{1, 1, 1}));
}

TEST(OpenAtGap, leaves_whole_rings_closed) {
  RowLine line{{10, 11, 12, 10}, {1, 2, 3, 1}, {1, 2, 3, 1}, {1, 1, 1}, true};
  open_at_gap(line);
  EXPECT_TRUE(line.is_closed);
  EXPECT_EQ(line.nodes.size(), 4u);
}

}  // namespace
}  // namespace st::test
