#include "meshing/face/row_line.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/shape/analytic.h"
#include "unit/meshing/row_case.h"

namespace st::test {
namespace {

TEST(NextLine, is_as_high_as_the_sizes_say_and_square_to_the_line) {
  const WallField field(0.1, 0.2, 1);
  RowCase face({band(10, 10, {5}, {5})}, field);
  const NextLine next = next_line(face.work, line_of(11), {});
  for (std::size_t i = 1; i < 10; ++i) {  // the others would run along the sides
    ASSERT_TRUE(next.columns[i].is_placed);
    EXPECT_NEAR(next.columns[i].node.x.y, 0.1 * (1 + 0.2 / 2), 2e-3);
    EXPECT_NEAR(next.columns[i].node.x.x, static_cast<double>(i), 2e-3);
  }
  EXPECT_GE(std::count(next.joined.begin(), next.joined.end(), 1), 8);
}

TEST(NextLine, does_not_ask_again_for_what_is_known_of_its_nodes) {
  const WallField field(0.1, 0, 1);
  RowCase face({band(10, 10, {5}, {5})}, field);
  RowLine line = line_of(11);
  line.asked.assign(11, {0.06, 1, {1, 0, 0}});
  const NextLine next = next_line(face.work, line, {});
  EXPECT_NEAR(next.columns[5].node.x.y, 0.5 * (0.06 + 1.4 * 0.06), 2e-3);
  EXPECT_EQ(next.columns[5].asked.length, 0.1) << "what the field tells there";
}

/// As beyond the end of a nose, within one segment.
TEST(NextLine, is_hardly_higher_than_asked_for_where_it_is_much_higher_beside) {
  const WallField field(0.1, 0, 1);
  RowCase face({band(10, 10, {5}, {5})}, field);
  RowLine line = line_of(11);
  line.asked.assign(11, {0.05, 1, {1, 0, 0}});
  std::fill_n(line.asked.begin() + 5, 6, LocalSize{0.3, 1, {1, 0, 0}});
  const NextLine next = next_line(face.work, line, {});
  const double asked = 0.5 * (0.05 + 1.4 * 0.05);
  EXPECT_NEAR(next.columns[1].node.x.y, asked, 2e-3);
  EXPECT_GT(next.columns[4].node.x.y, 1.05 * asked);
  EXPECT_LT(next.columns[4].node.x.y, 1.15 * asked);
}

TEST(NextLine, takes_the_nodes_of_its_sides_and_turns_towards_them) {
  const WallField field(0.1, 0, 1);
  std::vector<Vec2> loop = band(10, 8, {0.1, 3}, {0.1, 3});
  for (Vec2& p : loop) p.x += 1 + 0.4 * p.y;  // both sides lean to the right
  RowCase face({loop}, field);
  const NextLine next = next_line(face.work, line_of(11), {static_cast<std::int32_t>(loop.size()) - 1, 11});
  EXPECT_EQ(next.columns[0].existing, static_cast<std::int32_t>(loop.size()) - 1);
  EXPECT_EQ(next.columns[10].existing, 11);
  EXPECT_NEAR(next.columns[5].node.x.x, 5.04, 2e-3);
  EXPECT_NEAR(next.columns[5].node.x.y, 0.1, 2e-3);
}

TEST(NextLine, comes_off_a_side_whose_segment_is_much_longer) {
  const WallField field(0.1, 0, 1);
  RowCase face({band(10, 10, {0.3, 3}, {0.1, 3})}, field);
  const auto last = static_cast<std::int32_t>(face.boundary.nodes.size()) - 1;
  const NextLine next = next_line(face.work, line_of(11), {last, 11});
  EXPECT_EQ(next.columns[0].existing, kNone);
  EXPECT_FALSE(next.joined[0]);
  EXPECT_TRUE(next.joined[1]);
}

TEST(NextLine, ends_before_what_is_beside_it_nearer_than_most_of_a_length) {
  const WallField field(0.1, 0, 1);
  for (const auto& [left, is_room] : {std::pair{8.6, false}, {8.8, true}}) {  // of the hole; the row ends at x = 8
    RowCase face({band(10, 10, {5}, {5}), {{left, 0.05}, {left, 0.5}, {9.6, 0.5}, {9.6, 0.05}}}, field);
    RowLine line = line_of(11);
    std::fill_n(line.joined.begin() + 8, 2, 0);
    const NextLine next = next_line(face.work, line, {});
    EXPECT_EQ(next.joined[7] != 0, is_room) << left;
    EXPECT_TRUE(next.joined[6]);
    EXPECT_FALSE(next.joined[0]) << "beside the side";
  }
}

TEST(NextLine, leaves_out_columns_in_front_of_something) {
  const WallField field(0.1, 0, 1);
  RowCase face({band(20, 10, {5}, {5}), {{2.4, 0.12}, {2.4, 0.5}, {2.6, 0.5}, {2.6, 0.12}}}, field);
  const NextLine next = next_line(face.work, line_of(21), {});
  EXPECT_FALSE(next.joined[4]);
  EXPECT_FALSE(next.joined[5]);
  EXPECT_TRUE(next.joined[8]);
  EXPECT_TRUE(next.joined[18]);
}

TEST(NextLine, ends_where_quadrilaterals_are_nearly_square) {
  const WallField coarse(0.5, 0, 1), fine(0.4, 0, 1);
  RowCase square({band(10, 10, {5}, {5})}, coarse), flat({band(10, 10, {5}, {5})}, fine);
  const auto n = [](const NextLine& l) { return std::count(l.joined.begin(), l.joined.end(), 1); };
  EXPECT_EQ(n(next_line(square.work, line_of(11), {})), 0);
  EXPECT_GE(n(next_line(flat.work, line_of(11), {})), 8);
}

TEST(NextLine, ends_where_a_shorter_length_is_asked_for_along_it) {
  const WallField field(0.1, 0, 0.6);
  RowCase face({band(10, 10, {5}, {5})}, field);
  const NextLine next = next_line(face.work, line_of(11), {});
  EXPECT_EQ(std::count(next.joined.begin(), next.joined.end(), 1), 0);
}

/// Shorter along about one place.
class ShortSpotField : public WallField {
 public:
  explicit ShortSpotField(double along) : WallField(0.1, 0, 1), along_(along) {}
  LocalSize local(Vec3 x, int& hint) const override {
    LocalSize local = WallField::local(x, hint);
    if (std::abs(x.x - 5.5) < 0.3) local.along = along_;
    return local;
  }

 private:
  double along_;
};

TEST(NextLine, goes_on_where_one_place_alone_asks_for_a_shorter_length_along_it) {
  for (const auto& [along, goes_on] : {std::pair{0.6, true}, {0.4, false}}) {
    const ShortSpotField field(along);
    RowCase face({band(10, 10, {5}, {5})}, field);
    const NextLine next = next_line(face.work, line_of(11), {});
    EXPECT_EQ(next.joined[5] != 0, goes_on) << along;
    EXPECT_TRUE(next.joined[3]);
  }
}

TEST(NextLine, ends_behind_the_crest_of_its_heights) {
  const WallField field(0.1, 0, 1);
  RowCase face({band(10, 10, {0.8}, {0.8})}, field);
  RowLine line = line_of(11);
  line.lowest.assign(11, 0.1);
  line.highest.assign(11, 0.16);
  const NextLine next = next_line(face.work, line, {});
  EXPECT_EQ(std::count(next.joined.begin(), next.joined.end(), 1), 0);
}

/// Long along z.
class AxisField : public WallField {
 public:
  explicit AxisField(double across) : WallField(across, 0, 0), across_(across) {}
  LocalSize local(Vec3, int&) const override { return {across_, 4, {0, 0, 1}}; }

 private:
  double across_;
};

TEST(NextLine, is_lower_where_the_surface_would_turn_too_far) {
  const AxialSurface tube(SurfaceType::kCylinder, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 1, 0, 0, 2 * kPi, 0,
                          40);
  std::vector<Vec2> loop;
  for (int i = 10; i >= 0; --i) loop.push_back({0.1, 4.0 * i});
  loop.push_back({3.1, 0.1});
  loop.push_back({3.2, 40.1});
  for (const auto& [across, turned] : {std::pair{0.5, 0.5}, {1.3, 0.9}}) {  // chords for a radius of 1; radians
    const AxisField field(across);
    RowCase face({loop}, field, tube);
    const NextLine next = next_line(face.work, line_of(11), {});
    ASSERT_TRUE(next.columns[5].is_placed);
    EXPECT_NEAR(angle_between(next.columns[5].node.normal, face.work.mesh.nodes[5].normal), turned, 0.08);
    EXPECT_TRUE(next.joined[5]);
  }
}

TEST(StepOnSurface, has_its_length_and_direction_on_a_curved_surface) {
  const FaceCase cylinder("cylinder", UniformField(1));
  FaceWork work;
  work.set_surface(*cylinder.surface);
  MeshNode a, p;
  a.p = work.plane.to_plane({0.5 * (cylinder.surface->u_min() + cylinder.surface->u_max()),
                             0.5 * (cylinder.surface->v_min() + cylinder.surface->v_max())});
  work.evaluate(a);
  const Vec3 d = normalized(normalized(a.du) + normalized(a.dv));
  ASSERT_TRUE(step_on_surface(work, a, d, 0.5, p));
  EXPECT_NEAR(distance(a.x, p.x), 0.5, 0.006);
  EXPECT_NEAR(dot(p.x - a.x, cross(a.normal, d)), 0, 0.006);
}

}  // namespace
}  // namespace st::test
