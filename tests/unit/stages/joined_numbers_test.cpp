#include "stages/joined_numbers.h"

#include <gtest/gtest.h>

#include "geometry/model/joined_tables.h"
#include "stages/compose.h"
#include "support/shapes.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

/// A wing whose skins of 4 pieces are one face each.
GeometryArtifact joined_wing() {
  ImportResult cad = test::import_shape("wing_of_8");
  GeometryArtifact geometry;
  geometry.tables = std::move(cad.tables);
  geometry.brep = std::move(cad.brep);
  compose(geometry, false);
  return geometry;
}

SizeRule rule_for(const std::vector<std::string>& faces, const std::vector<std::string>& edges) {
  SizeRule rule;
  rule.where = "s.toml:3";
  rule.selection.faces = faces;
  rule.selection.edges = edges;
  return rule;
}

TEST(WholeFaces, are_those_of_all_composites_met) {
  const GeometryArtifact g = joined_wing();
  ASSERT_EQ(g.composites.size(), 2);
  const std::span<const FaceId> skin = g.composites.members(0);
  EXPECT_EQ(whole_faces({skin[1], skin[3]}, g.composites, "test"), std::vector<FaceId>{skin[0]});
  std::vector<FaceId> all;
  for (FaceId f = 0; f < g.cad.n_faces(); ++f) all.push_back(f);
  EXPECT_EQ(whole_faces(all, g.composites, "test").size(), 4u);  // with two tips
  EXPECT_TRUE(whole_faces({}, g.composites, "test").empty());
  EXPECT_EQ(whole_faces({4, 2}, {}, "test"), (std::vector<FaceId>{2, 4}));
}

TEST(RulesOnJoined, select_by_the_numbers_of_the_cad) {
  const GeometryArtifact g = joined_wing();
  const std::span<const FaceId> skin = g.composites.members(0);
  const auto rules = rules_on_joined({rule_for({std::to_string(skin[2] + 1)}, {})}, g);
  EXPECT_EQ(find_targets(rules[0], g.tables).faces, std::vector<FaceId>{skin[0]});
}

TEST(RulesOnJoined, name_the_edge_that_another_goes_on_into) {
  const GeometryArtifact g = joined_wing();
  const JoinedTables joined = join_tables(g.cad, g.composites);
  int n_tried = 0;
  for (EdgeId e = 0; e < g.cad.n_edges(); ++e) {
    const auto pieces = joined.pieces_of(e);
    if (pieces.size() < 2) continue;
    ++n_tried;
    for (const EdgePiece& p : pieces) {
      const auto rules = rules_on_joined({rule_for({}, {std::to_string(p.edge + 1)})}, g);
      EXPECT_EQ(find_targets(rules[0], g.tables).edges, std::vector<EdgeId>{e});
    }
  }
  EXPECT_GT(n_tried, 0);
}

TEST(RulesOnJoined, refuse_faces_that_do_not_exist) {
  const GeometryArtifact g = joined_wing();
  EXPECT_ERROR(rules_on_joined({rule_for({"99"}, {})}, g), kUsage, "s.toml:3");
  EXPECT_ERROR(select_parts({rule_for({}, {"99"})}, g), kUsage, "s.toml:3");
}

std::vector<std::string> numbers(std::span<const std::int32_t> ids) {
  std::vector<std::string> texts;
  for (const std::int32_t id : ids) texts.push_back(std::to_string(id + 1));
  return texts;
}

TEST(SelectParts, is_whether_rules_need_what_is_joined) {
  const GeometryArtifact g = joined_wing();
  const std::span<const FaceId> skin = g.composites.members(0);
  EXPECT_TRUE(select_parts({rule_for(numbers(skin.first(1)), {})}, g));
  EXPECT_FALSE(select_parts({rule_for(numbers(skin), {})}, g));
  EXPECT_TRUE(select_parts({rule_for({}, numbers(std::span(g.composites.joined_edges).first(1)))}, g));
  const JoinedTables joined = join_tables(g.cad, g.composites);
  for (EdgeId e = 0; e < g.cad.n_edges(); ++e) {
    std::vector<EdgeId> pieces;
    for (const EdgePiece& p : joined.pieces_of(e)) pieces.push_back(p.edge);
    if (pieces.empty()) continue;
    EXPECT_FALSE(select_parts({rule_for({}, numbers(pieces))}, g));
    EXPECT_EQ(select_parts({rule_for({}, numbers(std::span(pieces).first(1)))}, g), pieces.size() > 1);
  }
}

TEST(SizesOfCadFaces, have_weights_where_faces_are_joined) {
  const GeometryArtifact g = joined_wing();
  std::vector<double> weight(static_cast<std::size_t>(g.cad.n_faces()), 0);
  weight[static_cast<std::size_t>(g.composites.members(0)[0])] = 1;
  EXPECT_FALSE(are_of_cad_faces(weight, g.composites));
  EXPECT_FALSE(are_of_cad_faces({}, g.composites));
  weight[static_cast<std::size_t>(g.composites.members(0)[1])] = 1;
  EXPECT_TRUE(are_of_cad_faces(weight, g.composites));
}

TEST(RulesOnJoined, are_the_same_where_nothing_is_joined) {
  GeometryArtifact plain;
  plain.tables = test::import_shape("box").tables;
  const auto rules = rules_on_joined({rule_for({"99", "T*"}, {})}, plain);
  EXPECT_EQ(rules[0].selection.faces, (std::vector<std::string>{"99", "T*"}));
}

}  // namespace
}  // namespace st
