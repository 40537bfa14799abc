#include "sizing/size_rules.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "sizing/model_limits.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

const SamplingLimits kWall{0.01, 0.5, radians(10), 2};

/// Faces 0 WING (wall), 1 BODY (wall), 2 SYM (symmetry), 3 FAR (far field). Edges: 0 wing only, 1 wing-body, 2
/// body-symmetry, 3 degenerate.
ModelTables wing_body() {
  ModelTables t;
  t.labels.group_name = {"WING", "BODY", "SYM", "FAR"};
  t.labels.group_role = {"wall", "wall", "symmetry", "farfield"};
  t.labels.face_group = {0, 1, 2, 3};
  t.labels.face_name = {"wing_upper", "", "", ""};
  t.face_is_reversed = {0, 0, 0, 0};
  t.face_box = {{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {0, 2, 0}}, {{0, 0, 0}, {100, 0, 0}}, {{0, 0, 0}, {0, 0, 300}}};
  t.edge_length = {1, 1, 1, 0};
  t.edge_name = {"TE_1", "", "", ""};
  t.edge_is_degenerate = {0, 0, 0, 1};
  t.face_loop_offsets = {0, 1, 2, 3, 4};
  t.loop_coedge_offsets = {0, 3, 5, 6, 6};
  t.coedge_edge = {0, 1, 3, 1, 2, 2};
  return t;
}

LengthSpec length(double value) { return {LengthSpec::Kind::kModelUnit, value, ""}; }

SizeRule rule_of(std::optional<double> lmin, std::optional<double> lmax) {
  SizeRule rule;
  rule.where = "sizes.toml:3";
  if (lmin) rule.lmin = length(*lmin);
  if (lmax) rule.lmax = length(*lmax);
  return rule;
}

ModelLimits limits_of(const std::vector<SizeRule>& rules) {
  const ModelTables t = wing_body();
  return model_limits(t, face_roles(t), kWall, rules);
}

std::string message_of(const SizeRule& rule) {
  try {
    limits_of({rule});
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kUsage);
    return e.what();
  }
  return "";
}

TEST(SizeRules, of_a_group_change_its_faces_and_edges_and_the_finest_wins_between_two) {
  SizeRule rule = rule_of({}, 0.2);
  rule.selection.groups = {"W*G"};
  const ModelLimits limits = limits_of({rule});
  EXPECT_EQ(limits.face[0]->max_length, 0.2);
  EXPECT_EQ(limits.face[1]->max_length, 0.5);
  EXPECT_EQ(limits.edge[0]->max_length, 0.2);
  EXPECT_EQ(limits.edge[1]->max_length, 0.2);
  EXPECT_EQ(limits.edge[2]->max_length, 0.5);
  rule.lmax = length(0.8);
  EXPECT_EQ(limits_of({rule}).edge[1]->max_length, 0.5) << "a coarse group does not coarsen the edges of its neighbour";
}

TEST(SizeRules, tell_curves_from_surfaces) {
  SizeRule rule = rule_of({}, 0.2);
  rule.selection.groups = {"WING"};
  rule.for_surfaces = false;
  EXPECT_EQ(limits_of({rule}).face[0]->max_length, 0.5);
  EXPECT_EQ(limits_of({rule}).edge[0]->max_length, 0.2);
  rule.for_surfaces = true;
  rule.for_curves = false;
  EXPECT_EQ(limits_of({rule}).face[0]->max_length, 0.2);
  EXPECT_EQ(limits_of({rule}).edge[0]->max_length, 0.5);
}

TEST(SizeRules, select_faces_and_edges_by_number_range_and_name) {
  SizeRule rule = rule_of({}, 0.2), of_edges = rule_of({}, 0.2);
  rule.selection.faces = {"wing_*"};
  of_edges.selection.edges = {"3-4"};
  const ModelLimits limits = limits_of({rule, of_edges});
  EXPECT_EQ(limits.face[0]->max_length, 0.2);
  EXPECT_EQ(limits.edge[2]->max_length, 0.2);
  EXPECT_FALSE(limits.edge[3]) << "degenerate, whatever is said of it";
  EXPECT_EQ(limits.face[1]->max_length, 0.5);
}

TEST(SizeRules, sample_the_curves_between_two_groups_only) {
  SizeRule none = rule_of({}, {}), root = rule_of(0.002, 0.02);
  none.is_sampled = false;
  none.for_surfaces = false;
  root.selection.between = {"BODY", "WING"};
  const ModelLimits limits = limits_of({none, root});
  EXPECT_FALSE(limits.edge[0]);
  ASSERT_TRUE(limits.edge[1]);
  EXPECT_EQ(limits.edge[1]->max_length, 0.02);
  EXPECT_EQ(limits.min_length, 0.002);
  EXPECT_FALSE(limits.edge[2]);
  EXPECT_TRUE(limits.face[0]);
}

TEST(SizeRules, of_the_whole_model_leave_symmetry_and_far_field_alone_but_named_ones_do_not) {
  SizeRule rule = rule_of({}, 0.2);
  EXPECT_EQ(limits_of({rule}).face[1]->max_length, 0.2);
  EXPECT_FALSE(limits_of({rule}).face[2]);
  EXPECT_DOUBLE_EQ(limits_of({rule}).face[3]->max_length, 10);
  rule.selection.groups = {"SYM", "FAR"};
  EXPECT_EQ(limits_of({rule}).face[2]->max_length, 0.2);
  EXPECT_EQ(limits_of({rule}).face[3]->max_length, 0.2);
}

TEST(SizeRules, apply_in_order_and_keep_what_they_do_not_name) {
  SizeRule first = rule_of({}, 0.2), second = rule_of({}, {});
  second.alpha_deg = 5;
  const SamplingLimits both = *limits_of({first, second}).face[0];
  EXPECT_EQ(both.max_length, 0.2);
  EXPECT_DOUBLE_EQ(both.alpha, radians(5));
  EXPECT_EQ(limits_of({first, rule_of({}, 0.3)}).face[0]->max_length, 0.3);
  EXPECT_EQ(limits_of({rule_of({}, 0.001)}).face[0]->min_length, 0.001) << "lmin gives way to a smaller lmax";
}

TEST(SizeRules, that_select_nothing_or_contradict_themselves_are_refused) {
  SizeRule rule = rule_of({}, 0.2);
  rule.selection.groups = {"FLAP"};
  EXPECT_NE(message_of(rule).find("sizes.toml:3: groups: no group or part matches 'FLAP'"), std::string::npos)
      << message_of(rule);
  rule.selection.groups.clear();
  rule.selection.edges = {"5"};
  EXPECT_NE(message_of(rule).find("edges: 5 does not exist, there are 4"), std::string::npos) << message_of(rule);
  rule.selection.edges.clear();
  rule.selection.between = {"WING", "SYM"};
  EXPECT_NE(message_of(rule).find("no edge separates"), std::string::npos) << message_of(rule);
  EXPECT_NE(message_of(rule_of(0.4, 0.3)).find("lmin 0.4 is larger than lmax 0.3"), std::string::npos);
}

ModelTables with_groups() {
  ModelTables t = wing_body();
  t.labels.edge_groups = {{"te", "", "{}", {0}}, {"root", "bc", "{}", {1}}};
  t.labels.vertex_groups = {{"tip", "", "{}", {1}}};
  t.vertex_xyz = {{0, 0, 0}, {1, 0, 0}};
  return t;
}

TEST(SizeRules, take_groups_of_edges_by_edges_and_by_groups) {
  const ModelTables t = with_groups();
  SizeRule rule = rule_of({}, 0.1);
  rule.selection.edges = {"te"};
  EXPECT_EQ(find_targets(rule, t).edges, std::vector<EdgeId>{0});
  rule.selection.edges = {"TE_*", "bc:root", "3"};
  EXPECT_EQ(find_targets(rule, t).edges, (std::vector<EdgeId>{0, 1, 2}));
  rule.selection.edges.clear();
  rule.selection.groups = {"te", "BODY"};
  const RuleTargets both = find_targets(rule, t);
  EXPECT_EQ(both.edges, std::vector<EdgeId>{0});
  EXPECT_EQ(both.faces, std::vector<FaceId>{1});
  const ModelLimits limits = model_limits(t, face_roles(t), kWall, {rule});
  EXPECT_EQ(limits.edge[0]->max_length, 0.1);
  EXPECT_EQ(limits.face[0]->max_length, 0.5) << "its face keeps its own";
}

TEST(SizeRules, of_a_group_of_vertices_ask_for_lmax_there) {
  const ModelTables t = with_groups();
  SizeRule rule = rule_of({}, 0.1);
  rule.selection.groups = {"tip"};
  const ModelLimits limits = model_limits(t, face_roles(t), kWall, {rule});
  EXPECT_FALSE(limits.vertex[0]);
  EXPECT_EQ(limits.vertex[1]->max_length, 0.1);
}

TEST(SizeRules, say_of_between_that_it_takes_groups_of_faces) {
  const ModelTables t = with_groups();
  SizeRule rule = rule_of({}, 0.1);
  rule.selection.between = {"te", "BODY"};
  try {
    find_targets(rule, t);
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("it names a group of edges"), std::string::npos) << e.what();
  }
}

TEST(SizeRules, of_several_keys_take_what_meets_all_of_them_and_of_a_list_what_meets_any) {
  const ModelTables t = with_groups();
  SizeRule rule = rule_of({}, 0.1);
  rule.selection.groups = {"WING", "BODY"};
  EXPECT_EQ(find_targets(rule, t).faces, (std::vector<FaceId>{0, 1}));
  rule.selection.faces = {"2-4"};
  EXPECT_EQ(find_targets(rule, t).faces, std::vector<FaceId>{1});
  rule.selection.edges = {"1", "2"};
  const RuleTargets of_body = find_targets(rule, t);
  EXPECT_EQ(of_body.edges, std::vector<EdgeId>{1}) << "faces stand for their edges";
  EXPECT_TRUE(of_body.faces.empty());
  rule.selection.faces.clear();
  rule.selection.groups = {"te"};
  EXPECT_EQ(find_targets(rule, t).edges, std::vector<EdgeId>{0}) << "a group of edges";
  rule.selection.between = {"WING", "BODY"};
  EXPECT_NE(message_of(rule).find("no group or part matches 'te'"), std::string::npos) << message_of(rule);
  EXPECT_ERROR(find_targets(rule, t), kUsage, "sizes.toml:3: no edge meets all keys of its selection");
}

TEST(SizeRules, say_what_edges_are_in_their_order) {
  const ModelTables t = with_groups();
  SizeRule rule = rule_of({}, {});
  rule.meaning = EdgeMeaning::kTrailing;
  rule.selection.edges = {"TE_1"};
  SizeRule none = rule_of({}, {});
  none.meaning = EdgeMeaning::kNoTrailing;
  none.selection.groups = {"WING"};
  const std::vector<SizeRule> rules = {rule, none};
  const std::vector<DeclaredEdge> declared = declared_edges(rules, t, {}, {});
  ASSERT_EQ(declared.size(), 3u) << "TE_1, and both edges of the wing that are no pole";
  EXPECT_EQ(declared[0].edge, 0);
  EXPECT_EQ(declared[0].meaning, EdgeMeaning::kTrailing);
  EXPECT_EQ(declared[1].meaning, EdgeMeaning::kNoTrailing);
  rule.selection.edges.clear();
  rule.selection.groups = {"WING"};
  EXPECT_ERROR(declared_edges(std::vector<SizeRule>{rule}, t, {}, {}), kUsage, "is not the base of a blunt");
  const std::vector<Strip> bases = {{.face = 0, .edges = {0, 1}, .stations = {}}};
  ASSERT_EQ(declared_edges(std::vector<SizeRule>{rule}, t, bases, {}).size(), 1u);
}

TEST(SizeRules, without_sizes_leave_limits_alone) {
  SizeRule rule = rule_of({}, {});
  rule.meaning = EdgeMeaning::kTrailing;
  rule.selection.groups = {"SYM"};
  const ModelLimits limits = limits_of({rule});
  EXPECT_FALSE(limits.face[2]) << "a symmetry plane asks for nothing";
  rule.selection.groups.clear();
  rule.selection.edges = {"TE_1"};
  EXPECT_FALSE(limits_of({rule}).edge_is_ruled[0]);
  rule.selection.edges.clear();
  add_detected("trailing", rule.selection);
  rule.meaning = EdgeMeaning::kNoTrailing;
  EXPECT_NO_THROW(limits_of({rule})) << "of what is found there is nothing left by now";
}

TEST(SizeRules, take_the_detected_edges_of_a_group_alone) {
  const ModelTables t = with_groups();
  std::vector<WingEdge> found(2);
  found[0].edge = 0, found[1].edge = 2;
  for (WingEdge& w : found) w.kind = WingEdgeKind::kSharpTrailing;
  SizeRule rule = rule_of({}, 0.1);
  add_detected("trailing", rule.selection);
  EXPECT_EQ(find_targets(rule, t, found).edges, (std::vector<EdgeId>{0, 2}));
  rule.selection.groups = {"WING"};
  EXPECT_EQ(find_targets(rule, t, found).edges, std::vector<EdgeId>{0});
}

}  // namespace
}  // namespace st
