#include "stages/wing_report.h"

#include <gtest/gtest.h>

namespace st {
namespace {

const std::vector<UnusedTrailing> kUnusedEdges = {
    {{6}, 0.4, "it is short"}, {{1, 3}, 9, "no plane cuts it"}, {{4}, 5, "no plane cuts it"}};
const UnusedTrailing kRim{{7}, 20, "its base is wide", false};

TEST(WingReport, names_the_longest_edges_first_and_says_why) {
  const std::vector<std::string> lines = unused_lines(kUnusedEdges, 2);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0], "  no lifting surface at trailing edges 2, 4, length 9: no plane cuts it");
  EXPECT_EQ(lines[1], "  no lifting surface at trailing edge 5, length 5: no plane cuts it");
  EXPECT_EQ(lines[2], "  and 1 more trailing edges without a lifting surface");
  EXPECT_EQ(unused_lines(kUnusedEdges, 3).size(), 3U);
}

TEST(WingReport, warns_of_long_edges_alone_and_names_the_rule) {
  const std::string text = unused_warning(kUnusedEdges, 100);
  EXPECT_NE(text.find("3 trailing edges, 14 long"), std::string::npos) << text;
  EXPECT_NE(text.find("size = [{ edges = [2, 4, 5], trailing_edge = true }]"), std::string::npos) << text;
  EXPECT_EQ(unused_warning(kUnusedEdges, 1000), "");
  EXPECT_EQ(unused_warning({}, 1), "");
  UnusedTrailing said = kUnusedEdges[1];
  said.is_declared = true;
  EXPECT_EQ(unused_warning({&said, 1}, 1), "") << "the rule is there already";
  EXPECT_NE(declared_warning(said).find("a rule names edges 2, 4"), std::string::npos);
  EXPECT_EQ(unused_warning({&kRim, 1}, 1), "") << "rims are no wings";
}

LiftingSurface noseless() {
  LiftingSurface wing;
  wing.has_noses = false;
  wing.span = 3;
  wing.least_chord = wing.median_chord = wing.largest_chord = 1;
  wing.trailing.resize(1);
  wing.trailing[0].edge = 4;
  return wing;
}

TEST(WingReport, says_where_no_nose_is_seen) {
  LiftingSurface wing = noseless();
  EXPECT_EQ(wing_line(wing, "0.1%chord"),
            "  lifting surface: trailing edge 5, sharp, span 3, chord 1 to 1; 0.1%chord along the edge, "
            "no nose is seen");
  const std::string text = noseless_warning({&wing, 1});
  EXPECT_NE(text.find("before the trailing edge 5:"), std::string::npos) << text;
  EXPECT_NE(text.find("size = [{ edges = [5], trailing_edge = false }]"), std::string::npos) << text;
  EXPECT_EQ(wings_json({&wing, 1})[0]["has_noses"], false);
  wing.is_declared = true;
  EXPECT_EQ(noseless_warning({&wing, 1}), "") << "the user knows";
  std::swap(wing.trailing, wing.declared_leading);
  EXPECT_NE(wing_line(wing, "1", "m").find(" m, chord "), std::string::npos);
  EXPECT_NE(wing_line(wing, "1").find("lifting surface by a rule: leading edge 5,"), std::string::npos);
}

TEST(WingReport, says_where_a_trailing_edge_runs_inside_faces) {
  LiftingSurface wing = noseless();
  wing.trailing[0].is_inside = true;
  EXPECT_NE(wing_line(wing, "1").find("trailing edge inside faces, beside edge 5,"), std::string::npos);
  const nlohmann::json json = wings_json({&wing, 1})[0];
  EXPECT_TRUE(json["trailing_edges"].empty());
  EXPECT_EQ(json["inside_along"], nlohmann::json({5}));
}

TEST(WingReport, says_how_much_of_a_nose_is_seen) {
  LiftingSurface wing = noseless();
  wing.has_noses = true;
  for (const double y : {0, 1, 2, 3, 4})
    wing.trailing[0].stations.push_back({.share = y / 4, .trailing = {0, y, 0}, .chord = 1, .is_measured = y < 2.5});
  EXPECT_DOUBLE_EQ(wing.covered(), 0.625);
  EXPECT_NE(wing_line(wing, "1").find("edge and nose, which is seen on 62 %"), std::string::npos);
  const std::string text = noseless_warning({&wing, 1});
  EXPECT_NE(text.find("before 50 % of the span at edge 5:"), std::string::npos) << text;
  EXPECT_EQ(text.find("trailing_edge = false"), std::string::npos) << "it is one";
  wing.trailing[0].stations[4].is_hidden = true;
  EXPECT_NE(noseless_warning({&wing, 1}).find("before 33 % of the span at edge 5:"), std::string::npos)
      << "its own nose";
  for (ChordStation& s : wing.trailing[0].stations) s.is_measured = true;
  EXPECT_EQ(noseless_warning({&wing, 1}), "");
}

TEST(WingReport, says_how_much_of_a_nose_is_not_seen_in_short_stretches) {
  LiftingSurface wing = noseless();
  wing.has_noses = true;
  wing.span = 100;
  for (int i = 0; i <= 100; ++i)
    wing.trailing[0].stations.push_back(
        {.share = 0.01 * i, .trailing = {0, 1.0 * i, 0}, .chord = 1, .is_measured = i != 20});
  EXPECT_EQ(noseless_warning({&wing, 1}), "") << "a single one";
  for (const std::size_t i : {50, 51, 80}) wing.trailing[0].stations[i].is_measured = false;
  wing.span = 101;
  const std::string text = noseless_warning({&wing, 1});
  EXPECT_NE(text.find("before 4 % of the span in 3 short stretches, the longest at edge 5:"), std::string::npos)
      << text;
}

TEST(WingReport, says_how_many_sets_are_used_and_why_others_are_not) {
  const std::string line = used_line(2, kUnusedEdges);
  EXPECT_NE(line.find("of 5 sets found, 2 used as lifting surfaces; left out are"), std::string::npos) << line;
  EXPECT_NE(line.find("1 because it is short"), std::string::npos) << line;
  EXPECT_EQ(used_line(2, {}), "");
}

TEST(WingReport, lengths_have_their_unit) {
  EXPECT_NE(unused_lines(kUnusedEdges, 1, "mm")[0].find(" mm: "), std::string::npos);
}

TEST(WingReport, lists_all_in_json) {
  const nlohmann::json list = unused_json(kUnusedEdges);
  ASSERT_EQ(list.size(), 3U);
  EXPECT_EQ(list[1]["edges"], (std::vector<int>{2, 4}));
  EXPECT_EQ(list[1]["length"], 9);
  EXPECT_EQ(list[0]["reason"], "it is short");
}

}  // namespace
}  // namespace st
