// Which trailing edges belong together.
#include "features/trailing_chains.h"

#include <gtest/gtest.h>

#include "features/face_roles.h"
#include "features/strip.h"
#include "support/shapes.h"

namespace st {
namespace {

std::vector<WingEdge> all_edges_as_trailing(const Model& model, double angle) {
  const ModelTables& t = model.tables();
  std::vector<WingEdge> edges;
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    if (!t.edge_is_degenerate[e]) edges.push_back({.edge = e, .length = t.edge_length[e], .angle = angle});
  return edges;
}

TEST(TrailingChains, hang_together_at_vertices) {
  const Model model = test::make_model("box");
  std::vector<WingEdge> edges = all_edges_as_trailing(model, 1);
  EXPECT_EQ(trailing_chains(model, edges).size(), 1u);
  edges.front().kind = WingEdgeKind::kLeading;
  std::size_t n = 0;
  for (const auto& chain : trailing_chains(model, edges)) n += chain.size();
  EXPECT_EQ(n, 11u) << "leading edges are none";
}

TEST(TrailingChains, part_in_lines_at_corners) {
  const Model model = test::make_model("box");
  const std::vector<WingEdge> edges = all_edges_as_trailing(model, 1);
  EXPECT_EQ(lines_of(model, edges).size(), 12u);
  std::vector<WingEdge> of_base = edges;  // two of them along one face
  of_base[2].base = of_base[7].base = 0;
  EXPECT_EQ(lines_of(model, of_base).size(), 11u);
  const Model split = test::make_model("wing_with_cut_base");
  std::vector<WingEdge> upper;  // an edge cut into four
  for (const WingEdge& w : all_edges_as_trailing(split, 1)) {
    const Vec3 x = split.curve(w.edge)->point(split.curve(w.edge)->t_min());
    const Vec3 end = split.curve(w.edge)->point(split.curve(w.edge)->t_max());
    if (x.x > 9.9 && end.x > 9.9 && x.y > 0 && end.y > 0) upper.push_back(w);
  }
  ASSERT_EQ(upper.size(), 4u);
  EXPECT_EQ(lines_of(split, upper).size(), 1u);
}

TEST(TrailingChains, run_from_place_to_place_and_not_on_to_the_next_edge) {
  const std::vector<EdgePlace> places = {{.edge = 0, .x = {0, 0, 0}, .tangent = {1, 0, 0}},
                                         {.edge = 0, .x = {1, 0, 0}, .tangent = {1, 0, 0}},
                                         {.edge = 1, .x = {3, 0, 0}, .tangent = {1, 0, 0}}};
  const ChainLine line(places);
  EXPECT_TRUE(line.is_near({0.5, 0.1, 0}, 0.2));
  EXPECT_FALSE(line.is_near({0.5, 0.3, 0}, 0.2));
  EXPECT_FALSE(line.is_near({2, 0, 0}, 0.2));
  EXPECT_TRUE(line.is_near({3.1, 0, 0}, 0.2));
}

/// Two edges of a plate, in line on both sides of a notch in it.
TEST(TrailingChains, go_on_across_a_notch_unless_they_are_rims_of_a_plate) {
  const Model model = test::make_model("notched_plate");
  const ModelTables& t = model.tables();
  std::vector<WingEdge> edges;
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    const auto curve = model.curve(e);
    const Vec3 a = curve->point(curve->t_min()), b = curve->point(curve->t_max());
    if (a.x == 10 && b.x == 10 && a.z == 1 && b.z == 1) edges.push_back({.edge = e, .length = t.edge_length[e]});
  }
  ASSERT_EQ(edges.size(), 2u);
  EXPECT_EQ(trailing_chains(model, edges).size(), 1u);
  for (WingEdge& w : edges) w.base = static_cast<FaceId>(&w - edges.data()), w.angle = kPi / 2;
  EXPECT_EQ(trailing_chains(model, edges).size(), 2u);
}

}  // namespace
}  // namespace st
