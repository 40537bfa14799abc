// Lifting surfaces whose trailing edge runs inside a face.
#include "features/round_tails.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/shapes.h"

namespace st {
namespace {

std::vector<LiftingSurface> found_on(const Model& model, EdgeId excluded = kNone) {
  std::vector<std::uint8_t> is_excluded(static_cast<std::size_t>(model.tables().n_edges()), 0);
  if (excluded != kNone) is_excluded[excluded] = 1;
  std::vector<LiftingSurface> wings;
  add_round_tails(model, face_roles(model.tables()), {}, is_excluded, wings);
  return wings;
}

TEST(RoundTails, run_along_the_thinner_end_of_a_closed_wing) {
  const Model model = test::make_model("closed_wing");
  const std::vector<LiftingSurface> wings = found_on(model);
  ASSERT_EQ(wings.size(), 1u);
  EXPECT_TRUE(wings[0].is_round);
  EXPECT_NEAR(wings[0].span, 30, 0.3);
  EXPECT_NEAR(wings[0].median_chord, 10, 0.01);
  EXPECT_GT(wings[0].covered(), 0.99);
  ASSERT_EQ(wings[0].trailing.size(), 1u);
  const ChordEdge& edge = wings[0].trailing[0];
  EXPECT_TRUE(edge.is_inside);
  EXPECT_EQ(edge.stations.front().share, 0);
  EXPECT_EQ(edge.stations.back().share, 1);
  for (const ChordStation& s : edge.stations) {
    if (!s.is_measured) continue;
    EXPECT_NEAR(s.trailing.x, 5, 0.01);
    EXPECT_NEAR(s.nose.x, -5, 0.01);
    EXPECT_EQ(s.tail_face, s.nose_face);
  }
}

TEST(RoundTails, are_none_where_a_rule_says_so) {
  const Model model = test::make_model("closed_wing");
  EXPECT_TRUE(found_on(model, found_on(model).at(0).trailing[0].edge).empty());
}

TEST(RoundTails, are_none_of_bars_tubes_and_vessels) {
  for (const char* shape : {"oval_bar", "closed_tube", "periodic_tube", "torus", "thin_tube", "helical_ribbon"})
    EXPECT_TRUE(found_on(test::make_model(shape)).empty()) << shape;
}

}  // namespace
}  // namespace st
