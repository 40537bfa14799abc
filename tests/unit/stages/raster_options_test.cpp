#include "stages/raster_options.h"

#include <gtest/gtest.h>

#include "support/shapes.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

ModelTables box_in_mm() {
  ModelTables t = test::import_shape("box").tables;
  t.unit = "mm";
  t.unit_in_m = 0.001;
  return t;
}

TEST(RasterOptions, lengths_in_per_cent_are_of_the_diagonal_and_others_have_units) {
  RasterStageOptions o;
  o.lmax = "2%";
  o.lmin = "0.5mm";
  const SamplingLimits limits = resolve_limits(o, box_in_mm(), 100);
  EXPECT_DOUBLE_EQ(limits.max_length, 2);
  EXPECT_DOUBLE_EQ(limits.min_length, 0.5);
  EXPECT_DOUBLE_EQ(limits.alpha, radians(10));
}

TEST(RasterOptions, lengths_that_are_not_given_are_shares_of_others) {
  const SamplingLimits limits = resolve_limits({}, box_in_mm(), 100);
  EXPECT_DOUBLE_EQ(limits.max_length, 2.5);
  EXPECT_DOUBLE_EQ(limits.min_length, 2.5 / 64);
}

TEST(RasterOptions, refuse_a_least_length_above_the_largest_and_a_model_without_extent) {
  RasterStageOptions o;
  o.lmin = "3";
  o.lmax = "2";
  EXPECT_ERROR(resolve_limits(o, box_in_mm(), 100), kUsage, "--lmin");
  EXPECT_ERROR(resolve_limits({}, box_in_mm(), 0), kGeometry, "no extent");
}

TEST(RasterOptions, of_wings_are_rules_for_all_walls) {
  RasterStageOptions o;
  o.lmin = "0.1%chord";
  o.trailing_edges = "1:2";
  const std::vector<SizeRule> rules = option_rules(o);
  ASSERT_EQ(rules.size(), 2u);
  EXPECT_EQ(rules[0].where, "--lmin");
  EXPECT_TRUE(rules[0].lmin->is_of_wing());
  EXPECT_TRUE(rules[0].selection.empty());
  EXPECT_EQ(rules[1].lmax->value, 2);
  EXPECT_EQ(resolve_limits(o, box_in_mm(), 64).min_length, 0.025) << "the rule's length is no one for all";
  o.trailing_edges = "2:1";
  EXPECT_ERROR(option_rules(o), kUsage, "LMIN:LMAX");
}

TEST(RasterOptions, rules_of_the_file_come_last_and_are_refused_where_they_meet_nothing) {
  RasterStageOptions o;
  o.lmax = "3%chord";
  SizeRule rule;
  rule.where = "s.toml:3";
  rule.selection.faces = {"2"};
  const std::vector<SizeRule> rules = all_rules(o, {{rule}, ""}, box_in_mm());
  ASSERT_EQ(rules.size(), 2u);
  EXPECT_EQ(rules[1].where, "s.toml:3");
  rule.selection.faces = {"99"};
  EXPECT_ERROR(all_rules(o, {{rule}, ""}, box_in_mm()), kUsage, "s.toml:3");
}

TEST(RasterOptions, of_lifting_surfaces_are_those_that_were_set) {
  RasterStageOptions o;
  EXPECT_EQ(wing_options(o), "");
  EXPECT_FALSE(asks_for_wings(o));
  o.edge_size = "0.1%chord";
  o.base_cells = 4;
  EXPECT_EQ(wing_options(o), "--edge-size, --base-cells");
  EXPECT_TRUE(asks_for_wings(o));
  o.edge_size = "none";
  o.end_size = "1";
  EXPECT_FALSE(edge_size(o));
  EXPECT_ERROR(all_rules(o, {}, box_in_mm()), kUsage, "--end-size");
}

}  // namespace
}  // namespace st
