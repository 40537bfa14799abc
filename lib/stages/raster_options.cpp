#include "stages/raster_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/required_unit.h"
#include "base/text.h"

namespace st {
namespace {

constexpr double kDefaultMinLength = 1.0 / 64;  // of the largest length

/// The rule of --trailing-edges or --leading-edges: "LMIN:LMAX" or "LMAX".
SizeRule detection_rule(const std::string& option, const std::string& word, const std::string& lengths) {
  SizeRule rule;
  rule.where = option;
  add_detected(word, rule.selection);
  const std::size_t colon = lengths.find(':');
  if (colon != std::string::npos) rule.lmin = parse_length(lengths.substr(0, colon), option);
  rule.lmax = parse_length(colon == std::string::npos ? lengths : lengths.substr(colon + 1), option);
  if (rule.lmin && rule.lmin->kind == rule.lmax->kind && rule.lmin->value > rule.lmax->value)
    throw Error(ExitCode::kUsage,
                fmt::format("{} {}: the smallest length is larger than the largest; write LMIN:LMAX", option, lengths));
  return rule;
}

/// What hangs on --edge-size has no effect without it.
void require_edge_size(const RasterStageOptions& o, const std::vector<SizeRule>& rules) {
  if (o.edge_size != "none") return;
  const auto says_edges = [](const SizeRule& rule) {
    return rule.meaning && rule.meaning != EdgeMeaning::kNoTrailing && !rule.asks_sizes();
  };
  const auto rule = std::ranges::find_if(rules, says_edges);
  if (rule == rules.end() && o.end_size.empty()) return;
  throw Error(ExitCode::kUsage,
              fmt::format("{} has no effect with --edge-size none; give --edge-size a length",
                          rule == rules.end() ? "--end-size" : rule->where + ": trailing_edge or leading_edge"));
}

}  // namespace

std::optional<LengthSpec> wing_length(const std::string& text, const std::string& option) {
  if (text.empty()) return std::nullopt;
  const LengthSpec spec = parse_length(text, option);
  return spec.is_of_wing() ? std::optional(spec) : std::nullopt;
}

std::vector<SizeRule> option_rules(const RasterStageOptions& o) {
  std::vector<SizeRule> rules;
  SizeRule walls;
  walls.lmin = wing_length(o.lmin, "--lmin");
  walls.lmax = wing_length(o.lmax, "--lmax");
  walls.chord = wing_length(o.chord, "--chord");
  if (walls.lmin) walls.where += "--lmin ";
  if (walls.lmax) walls.where += "--lmax ";
  if (walls.chord) walls.where += "--chord ";
  if (!walls.where.empty()) {
    walls.where.pop_back();
    rules.push_back(walls);
  }
  if (!o.trailing_edges.empty()) rules.push_back(detection_rule("--trailing-edges", "trailing", o.trailing_edges));
  if (!o.leading_edges.empty()) rules.push_back(detection_rule("--leading-edges", "leading", o.leading_edges));
  return rules;
}

std::vector<SizeRule> all_rules(const RasterStageOptions& o, const SizeRuleFile& sizes, const ModelTables& t) {
  std::vector<SizeRule> rules = option_rules(o);
  rules.insert(rules.end(), sizes.rules.begin(), sizes.rules.end());
  require_edge_size(o, rules);
  for (const SizeRule& rule : rules) {
    for (const auto& [length, key] : {std::pair(rule.lmin, "lmin"), {rule.lmax, "lmax"}, {rule.chord, "chord"}})
      if (length) require_unit(*length, t.unit_in_m, rule.where + ": " + key);
    if (rule.selection.detected.empty()) find_targets(rule, t);
  }
  return rules;
}

std::optional<LengthSpec> edge_size(const RasterStageOptions& o) {
  return o.edge_size == "none" ? std::nullopt : std::optional(parse_length(o.edge_size, "--edge-size"));
}

std::optional<LengthSpec> end_size(const RasterStageOptions& o) {
  return o.end_size.empty() ? std::nullopt : std::optional(parse_length(o.end_size, "--end-size"));
}

SamplingLimits resolve_limits(const RasterStageOptions& o, const ModelTables& t, double diagonal) {
  if (!(diagonal > 0))
    throw Error(ExitCode::kGeometry, fmt::format("{}: the model has no extent; check the CAD file", o.geometry));
  SamplingLimits limits;
  const auto resolved = [&](const std::string& text, const std::string& option, double otherwise) {
    if (text.empty() || wing_length(text, option)) return otherwise;
    return resolve_length(parse_length(text, option), {diagonal, t.unit_in_m}, option);
  };
  if (const std::optional<LengthSpec> size = edge_size(o)) require_unit(*size, t.unit_in_m, "--edge-size");
  if (const std::optional<LengthSpec> size = end_size(o)) require_unit(*size, t.unit_in_m, "--end-size");
  limits.max_length = resolved(o.lmax, "--lmax", kDefaultMaxLength * diagonal);
  limits.min_length = resolved(o.lmin, "--lmin", kDefaultMinLength * limits.max_length);
  limits.alpha = radians(o.alpha_deg);
  limits.chord = resolved(o.chord, "--chord", limits.chord);
  limits.chord_cells = o.chord_cells;
  limits.cell_per_length = o.cell_per_length;
  limits.gap_cells = o.gap_cells;
  limits.wall_cells = o.wall_cells;
  limits.edge_cells = o.edge_cells;
  limits.max_aspect = o.max_aspect;
  if (limits.min_length > limits.max_length)
    throw Error(ExitCode::kUsage, fmt::format("--lmin {} is larger than --lmax {}; give --lmin at most --lmax",
                                              limits.min_length, limits.max_length));
  return limits;
}

std::string wing_options(const RasterStageOptions& o) {
  const RasterStageOptions defaults;
  std::string set;
  const auto add = [&](bool is_set, const std::string& flag) {
    if (is_set) set += (set.empty() ? "" : ", ") + flag;
  };
  add(o.edge_size != defaults.edge_size && o.edge_size != "none", "--edge-size");
  add(o.base_cells != defaults.base_cells, "--base-cells");
  add(o.end_size != defaults.end_size, "--end-size");
  add(o.chord_cells != defaults.chord_cells, "--chord-cells");
  return set;
}

bool asks_for_wings(const RasterStageOptions& o) { return o.asks_for_wings || !wing_options(o).empty(); }

}  // namespace st
