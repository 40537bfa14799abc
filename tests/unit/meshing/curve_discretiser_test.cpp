#include "meshing/topology/curve_discretiser.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/shape/analytic.h"
#include "geometry/shape/bspline.h"
#include "unit/meshing/faces.h"

namespace st {
namespace {

const Frame kFrame{{1, 2, 3}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

std::vector<double> segment_lengths(const EdgeMesh& n) {
  std::vector<double> lengths;
  for (std::size_t i = 1; i < n.node_xyz.size(); ++i) lengths.push_back(distance(n.node_xyz[i - 1], n.node_xyz[i]));
  return lengths;
}

void expect_ends_and_order(const Curve& c, const EdgeMesh& n, const SizeField& field) {
  ASSERT_GE(n.node_t.size(), 2u);
  EXPECT_EQ(n.node_t.front(), c.t_min());
  EXPECT_EQ(n.node_t.back(), c.t_max());
  ASSERT_EQ(n.node_xyz.size(), n.node_t.size());
  ASSERT_EQ(n.node_size.size(), n.node_t.size());
  for (std::size_t i = 0; i < n.node_t.size(); ++i) {
    if (i > 0) {
      EXPECT_GT(n.node_t[i], n.node_t[i - 1]);
    }
    EXPECT_TRUE(n.node_xyz[i] == c.point(n.node_t[i]));
    EXPECT_EQ(n.node_size[i], field.size(n.node_xyz[i]));
  }
}

TEST(DiscretiseCurve, cuts_a_line_into_as_many_equal_segments_as_its_length_asks_for) {
  const LineCurve line({1, 1, 1}, {0, 3, 4}, 1, 3);  // length 10
  for (const auto& [h, n] : std::vector<std::pair<double, std::size_t>>{
           {1, 10}, {0.7, 14}, {0.6, 17}, {6.5, 2}, {7, 1}, {100, 1}, {0.01, 1000}}) {
    const UniformField field(h);
    const EdgeMesh nodes = discretise_curve(line, field, {});
    expect_ends_and_order(line, nodes, field);
    ASSERT_EQ(nodes.node_t.size(), n + 1) << h;
    for (double l : segment_lengths(nodes)) EXPECT_NEAR(l, 10.0 / static_cast<double>(n), 1e-9);
  }
}

TEST(DiscretiseCurve, makes_at_least_the_segments_asked_for) {
  const EllipseCurve circle(kFrame, 0.01, 0.01, 0, 2 * kPi);
  const LineCurve line({}, {1, 0, 0}, 0, 1);
  for (int least : {1, 2, 3, 7}) {
    EXPECT_GE(discretise_curve(circle, UniformField(100), {30, std::max(3, least)}).node_t.size(),
              static_cast<std::size_t>(std::max(3, least)) + 1);
    EXPECT_EQ(discretise_curve(line, UniformField(100), {30, least}).node_t.size(),
              static_cast<std::size_t>(least) + 1);
  }
}

TEST(DiscretiseCurve, spaces_a_fine_circle_evenly) {
  const EllipseCurve circle(kFrame, 5, 5, 0, 2 * kPi);
  const UniformField field(0.5);
  const EdgeMesh n = discretise_curve(circle, field, {});
  expect_ends_and_order(circle, n, field);
  EXPECT_EQ(n.node_t.size(), 63u + 1);  // 10 pi / 0.5 = 62.8
  for (double l : segment_lengths(n)) EXPECT_NEAR(l, 10 * kPi / 63, 0.01 * l);
}

TEST(DiscretiseCurve, limits_the_turning_of_a_segment) {
  const EllipseCurve circle(kFrame, 5, 5, 0, 2 * kPi);
  for (double turning : {10.0, 30.0, 45.0})
    EXPECT_EQ(discretise_curve(circle, UniformField(10), {turning, 3}).node_t.size(), std::round(360 / turning) + 1);
  const EllipseCurve flat(kFrame, 10, 1, 0, 2 * kPi);
  const EdgeMesh n = discretise_curve(flat, UniformField(0.2), {30, 3});
  for (std::size_t i = 1; i < n.node_t.size(); ++i)
    EXPECT_LE(degrees(angle_between(flat.evaluate(n.node_t[i - 1]).d1, flat.evaluate(n.node_t[i]).d1)), 1.25 * 30);
}

/// Largest distance of the curve from the chords.
double largest_sagitta(const Curve& c, const EdgeMesh& n) {
  double largest = 0;
  for (std::size_t i = 1; i < n.node_t.size(); ++i)
    for (int k = 1; k < 100; ++k) {
      const Vec3 a = n.node_xyz[i - 1], ab = n.node_xyz[i] - a,
                 x = c.point(n.node_t[i - 1] + (n.node_t[i] - n.node_t[i - 1]) * 0.01 * k) - a;
      const double along = std::clamp(dot(x, ab) / norm2(ab), 0.0, 1.0);
      largest = std::max(largest, norm(x - along * ab));
    }
  return largest;
}

TEST(DiscretiseCurve, stays_near_arcs_far_smaller_than_the_length) {
  for (double radius : {0.02, 0.05, 0.1, 0.3, 0.5, 1.0}) {
    const EllipseCurve arc(kFrame, radius, radius, 0.5, 0.5 + kPi);
    EXPECT_LE(largest_sagitta(arc, discretise_curve(arc, UniformField(1), {})), 0.05) << radius;
  }
  const EllipseCurve flat(kFrame, 10, 1, 0, 2 * kPi);
  EXPECT_LE(largest_sagitta(flat, discretise_curve(flat, UniformField(3), {30, 3})), 0.05 * 3);
}

/// Straight from (0, 0) to (length, 0), then an arc that turns by `angle_deg`, then straight on for `rest`.
BsplineCurve hook(double length, double radius, double angle_deg, double rest) {
  const double a = radians(angle_deg), w = std::cos(0.5 * a);
  const Vec3 corner{length + radius * std::tan(0.5 * a), 0, 0}, on{std::cos(a), std::sin(a), 0};
  const Vec3 end = corner + radius * std::tan(0.5 * a) * on, last = end + rest * on, first{0, 0, 0},
             start{length, 0, 0};
  const auto pole = [](Vec3 x, double weight) { return Pole{{weight * x.x, weight * x.y, weight * x.z, weight}}; };
  const double s = length / (length + rest);
  return BsplineCurve(KnotSpans(2, {0, 0, 0, 0.9 * s, 0.9 * s, 0.9 * s + 0.1, 0.9 * s + 0.1, 1, 1, 1}, 0),
                      {pole(first, 1), pole(0.5 * (first + start), 1), pole(start, 1), pole(corner, w), pole(end, 1),
                       pole(0.5 * (end + last), 1), pole(last, 1)},
                      true, 0, 1);
}

TEST(DiscretiseCurve, keeps_arcs_round_that_are_far_smaller_than_the_length) {
  for (double radius : {1e-4, 0.01, 0.1})
    for (double angle : {90.0, 180.0, 270.0, 360.0}) {
      const EllipseCurve arc(kFrame, radius, radius, 0, radians(angle));
      EXPECT_GE(static_cast<double>(discretise_curve(arc, UniformField(1), {}).node_t.size()) - 1, angle / 52)
          << radius << " " << angle;
    }
}

TEST(DiscretiseCurve, makes_no_tiny_segments_at_a_hook_far_smaller_than_the_length) {
  for (double radius : {1e-6, 1e-4, 1e-3, 5e-3})
    for (double rest : {0.01, 0.1, 0.3, 1.2, 3.0}) {
      const BsplineCurve c = hook(5, radius, 80, rest);
      const EdgeMesh n = discretise_curve(c, UniformField(1), {});
      for (double l : segment_lengths(n)) EXPECT_GE(l, 0.2) << radius << " " << rest;
      EXPECT_LE(largest_sagitta(c, n), 0.25) << radius << " " << rest;
    }
}

TEST(DiscretiseCurve, puts_one_node_at_a_sharp_kink) {
  const BsplineCurve c = hook(5.3, 1e-5, 90, 3.2);
  const EdgeMesh n = discretise_curve(c, UniformField(1), {});
  EXPECT_EQ(std::count_if(n.node_xyz.begin(), n.node_xyz.end(),
                          [](Vec3 x) {
                            return distance(x, {5.3, 0, 0}) < 0.01;
                          }),
            1);
  EXPECT_LE(largest_sagitta(c, n), 0.01);
}

TEST(DiscretiseCurve, follows_a_graded_field) {
  const LineCurve line({0, 0, 0}, {1, 0, 0}, 0, 20);
  const test::LinearField field({0, 0, 0}, 1, 0.2);
  const EdgeMesh n = discretise_curve(line, field, {});
  expect_ends_and_order(line, n, field);
  ASSERT_EQ(n.node_t.size(), 8u + 1);  // integral of dx / (1 + x/5) = 5 ln 5 = 8.05
  const std::vector<double> lengths = segment_lengths(n);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    EXPECT_NEAR(lengths[i], field.size(0.5 * (n.node_xyz[i] + n.node_xyz[i + 1])), 0.05 * lengths[i]);
    if (i > 0) {
      EXPECT_NEAR(lengths[i] / lengths[i - 1], std::exp(0.2 * 8.047 / 8), 0.02);
    }
  }
}

TEST(DiscretiseCurve, is_the_same_from_either_end) {
  const EllipseCurve there(kFrame, 10, 2, 0.3, 2.9);
  const EllipseCurve back({kFrame.origin, -kFrame.x, kFrame.y, kFrame.z}, 10, 2, kPi - 2.9, kPi - 0.3);
  const test::LinearField field({8, 0, 3}, 0.2, 0.3);
  const EdgeMesh a = discretise_curve(there, field, {}), b = discretise_curve(back, field, {});
  ASSERT_EQ(a.node_t.size(), b.node_t.size());
  for (std::size_t i = 0; i < a.node_t.size(); ++i)
    EXPECT_LE(distance(a.node_xyz[i], b.node_xyz[b.node_xyz.size() - 1 - i]), 1e-6);
}

TEST(DiscretiseCurve, does_not_multiply_segments_at_a_corner) {
  const auto pole = [](double x, double y) { return Pole{{x, y, 0, 1}}; };
  const BsplineCurve corner(KnotSpans(1, {0, 0, 0.37, 1, 1}, 0), {pole(0, 0), pole(5, 0), pole(5, 5)}, false, 0, 1);
  const UniformField field(0.5);
  const EdgeMesh n = discretise_curve(corner, field, {});
  expect_ends_and_order(corner, n, field);
  EXPECT_EQ(n.node_t.size(), 21u);
  EXPECT_LE(distance(n.node_xyz[10], {5, 0, 0}), 0.01 * 0.5);
}

TEST(DiscretiseCurve, does_not_depend_on_the_fields_hint) {
  const EllipseCurve c(kFrame, 5, 3, 0, 4);
  EXPECT_EQ(discretise_curve(c, UniformField(0.3), {}).node_t,
            discretise_curve(c, test::RestlessField(0.3), {}).node_t);
}

TEST(DiscretiseCurve, sees_a_small_place_of_small_sizes) {
  // 1 everywhere but for a spot of a hundredth of the line
  class Spot : public UniformField {
   public:
    using UniformField::UniformField;
    double size(Vec3 x, int&) const override { return std::min(1.0, 0.02 + 0.2 * std::abs(x.x - 7.3)); }
    double slope() const override { return 0.2; }
  };
  const LineCurve line({}, {1, 0, 0}, 0, 20);
  const EdgeMesh n = discretise_curve(line, Spot(1), {});
  double shortest = 1;
  for (double l : segment_lengths(n)) shortest = std::min(shortest, l);
  EXPECT_LE(shortest, 0.03);
}

TEST(DiscretiseCurve, spaces_nodes_by_the_length_along_the_curve) {
  const LineCurve line({0, 0, 0}, {1, 0, 0}, 0, 20);
  EXPECT_EQ(discretise_curve(line, test::StretchedField({0.1, 2, {1, 0, 0}}), {}).node_t.size(), 11u);
  EXPECT_EQ(discretise_curve(line, test::StretchedField({0.1, 2, {0, 0, 1}}), {}).node_t.size(), 201u);
  for (const double h : discretise_curve(line, test::StretchedField({0.1, 2, {1, 0, 0}}), {}).node_size)
    EXPECT_EQ(h, 0.1);
}

TEST(EndAtVertices, leaves_out_nodes_that_a_vertex_off_the_end_passed) {
  const LineCurve line({}, {1, 0, 0}, 0, 10);
  const EdgeMesh whole = discretise_curve(line, UniformField(1), {});
  const auto inner = [&](const Vec3& first, const Vec3& last, int min_segments) {
    EdgeMesh nodes = whole;
    end_at_vertices(nodes, first, last, min_segments);
    EXPECT_TRUE(nodes.node_xyz.front() == first && nodes.node_xyz.back() == last);
    EXPECT_EQ(nodes.n_nodes(0), static_cast<int>(nodes.node_t.size()));
    EXPECT_EQ(nodes.node_size.size(), nodes.node_t.size());
    return std::vector<double>(nodes.node_t.begin() + 1, nodes.node_t.end() - 1);
  };
  const std::vector<double> all(whole.node_t.begin() + 1, whole.node_t.end() - 1);
  EXPECT_EQ(inner({0.2, 0, 0}, {10, 0.2, 0}, 1), all) << "little against the segments";
  EXPECT_EQ(inner({-3, 0, 0}, {10, 2, 0}, 1), all) << "ahead of the end or beside it";
  EXPECT_EQ(inner({2.4, 0, 0}, {10, 0, 0}, 1).front(), 3);
  EXPECT_EQ(inner({2.6, 0, 0}, {10, 0, 0}, 1).front(), 4) << "3 is too near";
  EXPECT_EQ(inner({0, 0, 0}, {7.6, 0, 0}, 1).back(), 7);
  EXPECT_EQ(inner({2.4, 0, 0}, {7.6, 0, 0}, 1).size(), 5u);
  EXPECT_EQ(inner({2.4, 0, 0}, {7.6, 0, 0}, 9).size(), 8u) << "nine segments are asked for";
  EXPECT_TRUE(inner({20, 0, 0}, {-20, 0, 0}, 1).empty());
}

TEST(EndAtVertices, lets_no_edge_run_back_at_a_vertex_off_its_edges) {
  for (const char* shape : {"vertex_back", "vertex_ahead", "vertex_aside", "vertex_inside", "vertex_outside"}) {
    const Model model = test::make_model(shape);
    const EdgeMesh edges = test::discretise_edges(model, UniformField(0.1));
    for (EdgeId e = 0; e < edges.n_edges(); ++e)
      for (std::int32_t i = edges.first_node(e); i + 2 < edges.first_node(e) + edges.n_nodes(e); ++i) {
        const Vec3* x = &edges.node_xyz[i];
        EXPECT_GT(dot(x[1] - x[0], x[2] - x[1]), 0) << shape << ", edge " << e;
      }
  }
}

}  // namespace
}  // namespace st
