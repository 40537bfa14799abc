#include "io/toml/size_rule_file.h"

#include "base/hash.h"
#include "base/nearest_name.h"
#include "io/file/text_file.h"
#include "io/toml/toml_entry.h"
#include "sizing/size_options.h"

namespace st {
namespace {

const std::vector<std::string> kKeys = {
    "groups", "faces", "edges", "between", "detected",  "trailing_edge", "leading_edge", "for",       "sample",
    "lmin",   "lmax",  "alpha", "chord",   "gap_cells", "wall_cells",    "edge_cells",   "max_aspect"};

std::string all_keys() {
  std::string text;
  for (const std::string& key : kKeys) text += (text.empty() ? "" : ", ") + key;
  return text;
}

/// One table [[size]].
class RuleReader : TomlEntry {
 public:
  RuleReader(const std::string& path, const toml::table& table) : TomlEntry(path, table) { rule_.where = where(); }

  SizeRule run() {
    for (const auto& [key, node] : table()) read(std::string(key.str()), node);
    if (!rule_.asks_sizes() && !rule_.meaning)
      fail(table(),
           "the rule sets nothing; give lmin, lmax, alpha, chord, gap_cells, wall_cells, edge_cells, max_aspect, "
           "sample, trailing_edge or leading_edge");
    if (rule_.meaning && rule_.selection.empty())
      fail(table(), "trailing_edge and leading_edge need a selection: give edges, between, detected or groups");
    return std::move(rule_);
  }

 private:
  void read(const std::string& key, const toml::node& node) {
    if (key == "groups")
      rule_.selection.groups = names(key, node);
    else if (key == "faces")
      rule_.selection.faces = names(key, node, "a number, a range \"3-7\",");
    else if (key == "edges")
      rule_.selection.edges = names(key, node, "a number, a range \"3-7\",");
    else if (key == "between")
      read_between(node);
    else if (key == "detected")
      read_detected(node);
    else if (key == "trailing_edge")
      read_meaning(node, key, EdgeMeaning::kTrailing, EdgeMeaning::kNoTrailing);
    else if (key == "leading_edge")
      read_meaning(node, key, EdgeMeaning::kLeading, std::nullopt);
    else if (key == "for")
      read_for(node);
    else if (key == "sample")
      read_sample(node);
    else if (key == "lmin")
      rule_.lmin = length(key, node);
    else if (key == "lmax")
      rule_.lmax = length(key, node);
    else if (key == "chord")
      rule_.chord = length(key, node);
    else if (key == "alpha")
      rule_.alpha_deg = number(key, node, SizeOptions::kAlpha);
    else if (key == "gap_cells")
      rule_.gap_cells = count(key, node, SizeOptions::kGapCells);
    else if (key == "wall_cells")
      rule_.wall_cells = count(key, node, SizeOptions::kWallCells);
    else if (key == "edge_cells")
      rule_.edge_cells = count(key, node, SizeOptions::kEdgeCells);
    else if (key == "max_aspect")
      rule_.max_aspect = number(key, node, SizeOptions::kMaxAspect);
    else
      fail(node, "unknown key '" + key + "' of a [[size]]" + did_you_mean(key, kKeys) + "; allowed are " + all_keys());
  }

  void read_between(const toml::node& node) {
    rule_.selection.between = names("between", node);
    if (rule_.selection.between.size() != 2)
      fail(node, "between: takes two names of groups, such as [\"WING*\", \"BODY\"]");
  }

  void read_detected(const toml::node& node) {
    for (const std::string& name : names("detected", node))
      if (!add_detected(name, rule_.selection))
        fail(node, "detected: takes \"trailing\", \"leading\" or a list of these");
  }

  /// `if_not`: nullopt: false is refused.
  void read_meaning(const toml::node& node, const std::string& key, EdgeMeaning if_so,
                    std::optional<EdgeMeaning> if_not) {
    if (!node.is_boolean() || (!if_not && !node.as_boolean()->get()))
      fail(node, key + (if_not ? ": takes true or false" : ": takes true; leave the key out otherwise"));
    if (rule_.meaning) fail(node, "a rule has either trailing_edge or leading_edge");
    rule_.meaning = node.as_boolean()->get() ? if_so : if_not;
  }

  void read_for(const toml::node& node) {
    const std::string what = node.value_or(std::string());
    if (what != "curves" && what != "surfaces" && what != "both")
      fail(node, "for: takes \"curves\", \"surfaces\" or \"both\"");
    rule_.for_curves = what != "surfaces";
    rule_.for_surfaces = what != "curves";
  }

  void read_sample(const toml::node& node) {
    if (!node.is_boolean()) fail(node, "sample: takes true or false");
    rule_.is_sampled = node.as_boolean()->get();
  }

  double number(const std::string& key, const toml::node& node, const NumberOption& option) const {
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value) fail(node, key + ": takes a number in " + option.interval);
    if (const std::string refusal = option.refusal(*value); !refusal.empty()) fail(node, key + ": " + refusal);
    return *value;
  }

  /// 0 is accepted, too.
  int count(const std::string& key, const toml::node& node, const NumberOption& option) const {
    const auto value = node.is_integer() ? node.value<std::int64_t>() : std::nullopt;
    if (!value || (*value != 0 && !option.refusal(static_cast<double>(*value)).empty()))
      fail(node, key + ": takes a whole number in " + option.interval + ", or 0 for off");
    return static_cast<int>(*value);
  }

  SizeRule rule_;
};

}  // namespace

SizeRuleFile read_size_rules(const std::string& path) {
  const std::string text = read_text_file(path);
  SizeRuleFile file;
  file.hash = hash_hex(text.data(), text.size());
  const toml::table table = parse_toml(path, text, ExitCode::kUsage);
  for (const toml::table* rule : toml_list(path, table, {"size", "st-raster", ExitCode::kUsage}))
    file.rules.push_back(RuleReader(path, *rule).run());
  if (file.rules.empty()) throw Error(ExitCode::kUsage, path + ": no table [[size]] in it; see docs/st-raster.md");
  return file;
}

}  // namespace st
