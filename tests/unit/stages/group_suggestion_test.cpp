#include "stages/group_suggestion.h"

#include <gtest/gtest.h>

#include "io/file/text_file.h"
#include "io/toml/groups_file.h"
#include "support/shapes.h"

namespace st {
namespace {

TEST(GroupSuggestion, is_a_groups_file_that_can_be_read) {
  const Model box = test::make_model("box");
  const std::vector<SuggestedGroup> groups = {{"wing", "wall", "the largest", {0, 1, 2}},
                                              {"farfield", "farfield", "by its role", {4}}};
  const std::string path = testing::TempDir() + "suggested.toml";
  write_text_file(path, groups_file_text(groups, box.tables(), "a.step"));
  const std::vector<GroupRule> rules = read_groups(path).rules;
  ASSERT_EQ(rules.size(), 2U);
  EXPECT_EQ(rules[0].name, "wing");
  EXPECT_EQ(rules[0].selection.faces, std::vector<std::string>{"1-3"});
  EXPECT_EQ(rules[1].selection.faces, std::vector<std::string>{"5"});
  EXPECT_EQ(rules[1].role, "farfield");
  EXPECT_NE(read_text_file(path).find("# in none of them: faces 4, 6"), std::string::npos);
}

TEST(GroupSuggestion, says_how_many_faces_are_in_which) {
  const Model box = test::make_model("box");
  EXPECT_EQ(groups_in_words({{"wing", "wall", "", {0, 1}}, {"fin", "wall", "", {3}}}, box.tables()),
            "wing 2, fin 1 faces; 3 of 6 faces are in none");
  EXPECT_EQ(groups_in_words({}, box.tables()), "none; 6 of 6 faces are in none");
}

TEST(GroupsInWords, have_faces_and_roles_of_every_kind_of_group) {
  FaceLabels labels;
  labels.group_name = {"hub", "inlet"};
  labels.group_role = {"wall", "inlet"};
  labels.face_group = {0, 1, 0};
  labels.tables = {{"paint", {"red", "blue"}, {}, {}, {}}};
  labels.edge_groups = {{"rim", "", "{}", {4}}};
  labels.vertex_groups = {{"pins", "", "{}", {1, 2}}};
  EXPECT_EQ(groups_in_words(labels),
            "hub 2 faces, inlet 1 face (inlet), table paint of 2 groups, rim 1 edge, pins 2 vertices");
  labels.edge_groups.resize(20, labels.edge_groups[0]);
  EXPECT_TRUE(groups_in_words(labels).ends_with(", rim 1 edge and 8 more"));
}

TEST(GroupSuggestion, finds_a_wing) {
  const std::vector<SuggestedGroup> groups = suggest_groups_of(test::make_model("blunt_wing"));
  ASSERT_EQ(groups.size(), 1U);
  EXPECT_EQ(groups[0].name, "wing");
}

}  // namespace
}  // namespace st
