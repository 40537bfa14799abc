#include "io/toml/size_rule_file.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "base/error.h"
#include "io/file/text_file.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

class SizeRuleFiles : public testing::Test {
 protected:
  /// The rules of a file with one table [[size]] of these lines.
  SizeRuleFile read(const std::string& keys) const {
    write_text_file(dir_ / "sizes.toml", "[[size]]\n" + keys + "\n");
    return read_size_rules(dir_ / "sizes.toml");
  }
  /// What a reader is told; "": the rule was taken.
  std::string refusal(const std::string& keys) const {
    try {
      read(keys);
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::kUsage);
      return e.what();
    }
    return "";
  }
  TemporaryDirectory dir_;
};

TEST_F(SizeRuleFiles, keep_what_each_key_sets) {
  const SizeRule rule = read(
                            "groups = [\"WING*\", \"TAIL\"]\nfaces = 3\nlmin = 0.5\nlmax = \"2%\"\nalpha = 7.5\n"
                            "gap_cells = 3\nwall_cells = 4\nedge_cells = 0\nmax_aspect = 8\nfor = \"curves\"")
                            .rules.at(0);
  EXPECT_EQ(rule.selection.groups, (std::vector<std::string>{"WING*", "TAIL"}));
  EXPECT_EQ(rule.selection.faces, std::vector<std::string>{"3"});
  EXPECT_TRUE(rule.lmin && rule.lmax && !rule.chord);
  EXPECT_EQ(rule.alpha_deg, 7.5);
  EXPECT_EQ(rule.gap_cells, 3);
  EXPECT_EQ(rule.wall_cells, 4);
  EXPECT_EQ(rule.edge_cells, 0) << "off";
  EXPECT_EQ(rule.max_aspect, 8);
  EXPECT_TRUE(rule.for_curves && !rule.for_surfaces);
  EXPECT_NE(rule.where.find("sizes.toml:1"), std::string::npos);
}

TEST_F(SizeRuleFiles, take_numbers_within_the_ranges_of_the_options_alone) {
  for (const char* good : {"alpha = 0.001", "alpha = 90", "gap_cells = 100", "wall_cells = 0", "max_aspect = 1"})
    EXPECT_EQ(refusal(good), "") << good;
  for (const char* bad : {"alpha = 0", "alpha = 90.1", "alpha = \"7\"", "gap_cells = 101", "wall_cells = -1",
                          "edge_cells = 1.5", "max_aspect = 0.9", "max_aspect = 101"}) {
    const std::string text = refusal(bad), key = std::string(bad).substr(0, std::string(bad).find(' '));
    EXPECT_NE(text.find("sizes.toml:2: " + key), std::string::npos) << bad << " -> " << text;
    EXPECT_NE(text.find('['), std::string::npos) << "has the range: " << text;
  }
}

TEST_F(SizeRuleFiles, refuse_rules_that_set_nothing_and_keys_that_they_do_not_know) {
  EXPECT_NE(refusal("groups = \"WING\"").find("sets nothing"), std::string::npos);
  EXPECT_NE(refusal("lmim = 2").find("unknown key 'lmim' of a [[size]], did you mean 'lmin'"), std::string::npos);
  EXPECT_NE(refusal("between = [\"A\"]\nlmax = 1").find("two names"), std::string::npos);
}

TEST_F(SizeRuleFiles, refuse_values_that_a_key_does_not_take) {
  const std::pair<const char*, const char*> cases[] = {
      {"detected = \"wing\"", "sizes.toml:3: detected: takes \"trailing\", \"leading\" or a list of these"},
      {"for = \"edges\"", "sizes.toml:3: for: takes \"curves\", \"surfaces\" or \"both\""},
      {"sample = 1", "sizes.toml:3: sample: takes true or false"},
      {"alpha = \"7\"", "sizes.toml:3: alpha: takes a number in [0.001, 90]"},
      {"chord = true", "sizes.toml:3: chord: takes a length such as 0.2"},
  };
  for (const auto& [key, message] : cases) EXPECT_ERROR(read(std::string("lmax = 1\n") + key), kUsage, message);
}

TEST_F(SizeRuleFiles, say_what_edges_are_in_one_line) {
  write_text_file(dir_ / "one.toml", "size = [{ edges = [3, 8], trailing_edge = true }]\n");
  EXPECT_EQ(read_size_rules(dir_ / "one.toml").rules.at(0).meaning, EdgeMeaning::kTrailing);
  EXPECT_EQ(read("edges = 3\ntrailing_edge = false").rules.at(0).meaning, EdgeMeaning::kNoTrailing);
  const SizeRule nose = read("edges = \"LE\"\nleading_edge = true\nlmax = 1").rules.at(0);
  EXPECT_EQ(nose.meaning, EdgeMeaning::kLeading);
  EXPECT_TRUE(nose.asks_sizes());
  EXPECT_NE(refusal("trailing_edge = true").find("need a selection"), std::string::npos);
  EXPECT_NE(refusal("edges = 1\nleading_edge = false").find("takes true"), std::string::npos);
  EXPECT_NE(refusal("edges = 1\ntrailing_edge = 1").find("takes true or false"), std::string::npos);
  EXPECT_NE(refusal("edges = 1\ntrailing_edge = true\nleading_edge = true").find("either"), std::string::npos);
}

TEST_F(SizeRuleFiles, without_a_rule_are_refused) {
  write_text_file(dir_ / "none.toml", "alpha = 7\n");
  EXPECT_ERROR(read_size_rules(dir_ / "none.toml"), kUsage, "none.toml: no table [[size]] in it");
}

}  // namespace
}  // namespace st
