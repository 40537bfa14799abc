// Lifting surfaces without noses, and those that the user declares.
#include "features/thin_surface.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/shapes.h"

namespace st {
namespace {

/// What is found in a shape after the user has said something of its edges.
struct Found {
  std::vector<LiftingSurface> wings;
  std::vector<UnusedTrailing> unused;
};

Found find_in(const Model& model, Noseless noseless, const std::vector<DeclaredEdge>& declared = {}) {
  const FaceRoles roles = face_roles(model.tables());
  const std::vector<Strip> strips = find_strips(model);
  std::vector<WingEdge> edges = find_wing_edges(model, roles, strips);
  declare_edges(model, roles, strips, declared, edges);
  Found found;
  found.wings = find_lifting_surfaces(model, roles, edges, SerialExecutor(), &found.unused, noseless);
  return found;
}

/// The edge of the wedge's tail.
EdgeId tail_of(const Model& model) {
  for (EdgeId e = 0; e < model.tables().n_edges(); ++e) {
    const auto curve = model.curve(e);
    if (std::abs(curve->point(curve->t_min()).x - 10) + std::abs(curve->point(curve->t_max()).x - 10) < 1e-9) return e;
  }
  return kNone;
}

TEST(ThinSurface, behind_the_edge_of_a_wedge_is_as_long_as_the_wedge) {
  const Model model = test::make_model("wedge_fin");
  EXPECT_TRUE(find_in(model, Noseless::kOfAircraft).wings.empty()) << "it may be a part of a machine";
  const Found found = find_in(model, Noseless::kAll);
  ASSERT_EQ(found.wings.size(), 1u);
  const LiftingSurface& wing = found.wings[0];
  EXPECT_FALSE(wing.has_noses || wing.is_declared);
  ASSERT_EQ(wing.trailing.size(), 1u);
  EXPECT_EQ(wing.trailing[0].edge, tail_of(model));
  EXPECT_NEAR(wing.span, 30, 1e-9);
  EXPECT_NEAR(wing.median_chord, 10, 0.6);
  EXPECT_NEAR(wing.nearest_chord({10, 0, 15}).chord, 10, 0.6);
  EXPECT_NEAR(wing.nearest_chord({13, 0, 15}).distance, 3, 0.1);
  EXPECT_EQ(wing.trailing[0].stations.front().share, 0);
  EXPECT_EQ(wing.trailing[0].stations.back().share, 1);
}

TEST(ThinSurface, is_no_plate_box_or_body_of_revolution) {
  for (const char* shape : {"thin_plate", "box", "cone", "lens", "fan", "stepped_box"})
    EXPECT_TRUE(find_in(test::make_model(shape), Noseless::kAll).wings.empty()) << shape;
}

TEST(ThinSurface, is_what_the_user_says) {
  const Model model = test::make_model("wedge_fin");
  const EdgeId tail = tail_of(model);
  const Found found = find_in(model, Noseless::kOfAircraft, {{tail, EdgeMeaning::kTrailing}});
  ASSERT_EQ(found.wings.size(), 1u);
  EXPECT_TRUE(found.wings[0].is_declared);
  EXPECT_EQ(found.wings[0].trailing[0].edge, tail);
  const Found none = find_in(model, Noseless::kAll, {{tail, EdgeMeaning::kNoTrailing}});
  EXPECT_TRUE(none.wings.empty());
  EXPECT_TRUE(std::ranges::none_of(none.unused, [&](const UnusedTrailing& u) {
    return std::ranges::count(u.edges, tail) > 0;
  })) << "it is no trailing edge at all";
}

TEST(ThinSurface, is_not_made_where_nothing_is_thin) {
  const Model model = test::make_model("box");
  const Found found = find_in(model, Noseless::kAll, {{0, EdgeMeaning::kTrailing}});
  EXPECT_TRUE(found.wings.empty());
  ASSERT_EQ(found.unused.size(), 1u);
  EXPECT_FALSE(found.unused[0].why.empty());
  EXPECT_TRUE(found.unused[0].is_declared);
}

TEST(ThinSurface, of_a_declared_nose_belongs_to_its_wing) {
  const Model model = test::make_model("sharp_wing");
  const std::vector<LiftingSurface> before = find_in(model, Noseless::kOfAircraft).wings;
  ASSERT_EQ(before.size(), 1u);
  ASSERT_EQ(before[0].leading.size(), 1u);
  const EdgeId nose = before[0].leading[0];
  const Found found = find_in(model, Noseless::kOfAircraft, {{nose, EdgeMeaning::kLeading}});
  ASSERT_EQ(found.wings.size(), 1u);
  ASSERT_EQ(found.wings[0].declared_leading.size(), 1u);
  for (const ChordStation& s : found.wings[0].declared_leading[0].stations) EXPECT_NEAR(s.chord, 10, 0.05);
  const EdgeId tail = before[0].trailing[0].edge;
  const Found alone =
      find_in(model, Noseless::kOfAircraft, {{nose, EdgeMeaning::kLeading}, {tail, EdgeMeaning::kNoTrailing}});
  ASSERT_EQ(alone.wings.size(), 1u) << "a nose whose trailing edge is none";
  EXPECT_TRUE(alone.wings[0].trailing.empty());
  EXPECT_NEAR(alone.wings[0].median_chord, 10, 0.6);
}

TEST(ThinSurface, takes_out_both_edges_of_a_base) {
  const Model model = test::make_model("blunt_wing");
  const EdgeId edge = find_in(model, Noseless::kAll).wings.at(0).trailing[0].edge;
  EXPECT_TRUE(find_in(model, Noseless::kAll, {{edge, EdgeMeaning::kNoTrailing}}).wings.empty());
}

TEST(ThinSurface, of_a_sharp_edge_takes_no_strip_of_the_skin_for_its_base) {
  const Model model = test::make_model("sharp_wing");
  const FaceRoles roles = face_roles(model.tables());
  const EdgeId tail = find_in(model, Noseless::kAll).wings.at(0).trailing[0].edge;
  // a strip of the skin that ends at the tail, as a narrow face of the CAD would be
  std::vector<Strip> strips(1);
  strips[0].face = 0;
  strips[0].edges[0] = tail;
  strips[0].edges[1] = find_in(model, Noseless::kAll).wings.at(0).leading.at(0);
  strips[0].length = 30;
  strips[0].stations.resize(1);
  for (const bool is_known : {true, false}) {
    std::vector<WingEdge> edges;
    if (is_known) edges = find_wing_edges(model, roles, find_strips(model));
    declare_edges(model, roles, strips, std::vector<DeclaredEdge>{{tail, EdgeMeaning::kTrailing}}, edges);
    const auto own = std::ranges::find(edges, tail, &WingEdge::edge);
    ASSERT_NE(own, edges.end());
    EXPECT_EQ(own->kind, WingEdgeKind::kSharpTrailing) << is_known;
    EXPECT_EQ(own->base, kNone);
  }
}

TEST(ThinSurface, has_both_edges_of_a_base_when_one_is_declared) {
  const Model model = test::make_model("blunt_wing");
  const EdgeId base = find_in(model, Noseless::kAll).wings.at(0).trailing[0].edge;
  const FaceRoles roles = face_roles(model.tables());
  std::vector<WingEdge> edges;
  declare_edges(model, roles, find_strips(model), std::vector<DeclaredEdge>{{base, EdgeMeaning::kTrailing}}, edges);
  ASSERT_EQ(edges.size(), 2u);
  for (const WingEdge& w : edges) {
    EXPECT_TRUE(w.is_declared);
    EXPECT_EQ(w.kind, WingEdgeKind::kBluntTrailing);
    EXPECT_GT(w.size, 0);
    EXPECT_NEAR(w.length, 30, 1e-6);
  }
}

}  // namespace
}  // namespace st
