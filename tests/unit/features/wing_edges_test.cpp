#include "features/wing_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "features/certain_wing_edges.h"
#include "sizing/size_rules.h"
#include "support/shapes.h"

namespace st {
namespace {

std::vector<WingEdge> found(const std::string& shape) {
  const Model model = test::make_model(shape);
  return find_wing_edges(model, face_roles(model.tables()), find_strips(model));
}

std::ptrdiff_t count(const std::vector<WingEdge>& edges, WingEdgeKind kind) {
  return std::count_if(edges.begin(), edges.end(), [&](const WingEdge& w) { return w.kind == kind; });
}

void expect_nose(const std::vector<WingEdge>& edges) {
  ASSERT_EQ(count(edges, WingEdgeKind::kLeading), 1);
  const WingEdge& nose =
      *std::find_if(edges.begin(), edges.end(), [](const WingEdge& w) { return w.kind == WingEdgeKind::kLeading; });
  EXPECT_NEAR(nose.middle.x, 0, 1e-6);
  EXPECT_NEAR(nose.length, 30, 1e-6);
  EXPECT_NEAR(nose.size, 1.1019 * 0.12 * 0.12 * 10, 0.04) << "radius of the aerofoil's nose";
}

TEST(WingEdges, are_nose_and_point_of_a_sharp_wing) {
  const std::vector<WingEdge> edges = found("sharp_wing");
  EXPECT_EQ(edges.size(), 2u);
  expect_nose(edges);
  ASSERT_EQ(count(edges, WingEdgeKind::kSharpTrailing), 1);
  for (const WingEdge& w : edges)
    if (w.kind == WingEdgeKind::kSharpTrailing) {
      EXPECT_NEAR(w.middle.x, 10, 1e-6);
      EXPECT_NEAR(degrees(w.angle), 16, 2);
    }
}

TEST(WingEdges, are_nose_and_both_corners_of_a_blunt_wing) {
  const std::vector<WingEdge> edges = found("blunt_wing");
  EXPECT_EQ(edges.size(), 3u);
  expect_nose(edges);
  ASSERT_EQ(count(edges, WingEdgeKind::kBluntTrailing), 2);
  for (const WingEdge& w : edges)
    if (w.kind == WingEdgeKind::kBluntTrailing) {
      EXPECT_NEAR(w.middle.x, 10, 1e-6);
      EXPECT_NEAR(w.size, 0.0252, 1e-4);
    }
}

TEST(WingEdges, are_not_the_ends_of_the_base_of_a_swept_wing) {
  const std::vector<WingEdge> edges = found("swept_wing");
  EXPECT_EQ(count(edges, WingEdgeKind::kBluntTrailing), 2);
  EXPECT_EQ(count(edges, WingEdgeKind::kSharpTrailing), 0) << "of 40 degrees, at tip or root";
}

TEST(WingEdges, of_a_domain_lie_on_the_other_side_of_its_normals) {
  const Model model = test::make_model("wing_in_box");
  FaceRoles roles = face_roles(model.tables());
  EXPECT_EQ(count(find_wing_edges(model, roles, find_strips(model)), WingEdgeKind::kSharpTrailing), 0)
      << "a notch in a solid";
  for (FaceId f = 0; f < model.tables().n_faces(); ++f)
    if (model.tables().face_box[f].diagonal() > 50) roles.role[f] = FaceRole::kFarfield;
  const std::vector<WingEdge> edges = find_wing_edges(model, roles, find_strips(model));
  EXPECT_EQ(count(edges, WingEdgeKind::kSharpTrailing), 1);
  EXPECT_EQ(count(edges, WingEdgeKind::kLeading), 1);
}

TEST(WingEdges, are_not_found_on_plain_bodies) {
  for (const char* shape : {"box", "cylinder", "sphere", "cone", "torus", "drilled_block", "stepped_box"})
    EXPECT_TRUE(found(shape).empty()) << shape;
}

TEST(WingEdges, are_certain_where_all_diagonals_within_bounds_tell_the_same) {
  const Model model = test::make_model("sharp_wing");
  const FaceRoles roles = face_roles(model.tables());
  const std::vector<Strip> strips = find_strips(model);
  const double diagonal = roles.reference_diagonal, nose_radius = 1.1019 * 0.12 * 0.12 * 10, span = 30;
  const auto certain = [&](double least, double most) {
    return find_certain_wing_edges(model, roles, strips, {least, most});
  };
  const auto known = certain(0.7 * diagonal, 1.5 * diagonal);
  ASSERT_TRUE(known);
  EXPECT_EQ(known->size(), find_wing_edges(model, roles, strips).size());
  EXPECT_FALSE(certain(0.5 * nose_radius / 0.02, diagonal)) << "the nose is too blunt for the smaller one";
  EXPECT_FALSE(certain(diagonal, 2 * span / 0.005)) << "its edges are too short for the larger one";
  EXPECT_TRUE(certain(2 * span / 0.005, 3 * span / 0.005)->empty());
}

TEST(WingEdges, select_edges_in_rules) {
  const Model model = test::make_model("sharp_wing");
  const std::vector<WingEdge> edges = find_wing_edges(model, face_roles(model.tables()), find_strips(model));
  SizeRule rule;
  rule.where = "rule";
  ASSERT_TRUE(add_detected("trailing", rule.selection));
  const RuleTargets targets = find_targets(rule, model.tables(), edges);
  ASSERT_EQ(targets.edges.size(), 1u);
  EXPECT_EQ(targets.faces.size(), 0u);
  for (const WingEdge& w : edges) EXPECT_EQ(w.kind == WingEdgeKind::kSharpTrailing, w.edge == targets.edges[0]);
  EXPECT_FALSE(add_detected("upper", rule.selection));
  EXPECT_ANY_THROW(find_targets(rule, model.tables(), {})) << "nothing found";
}

}  // namespace
}  // namespace st
