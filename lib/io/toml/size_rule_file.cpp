#include "io/toml/size_rule_file.h"

#include <fmt/format.h>

#include "base/hash.h"
#include "io/file/text_file.h"
#include "io/toml/toml_entry.h"

namespace st {
namespace {

constexpr const char* kKeys =
    "groups, faces, edges, between, detected, for, sample, lmin, lmax, alpha, chord, gap_cells, wall_cells, "
    "edge_cells, max_aspect";

/// One table [[size]].
class RuleReader : TomlEntry {
 public:
  RuleReader(const std::string& path, const toml::table& table) : TomlEntry(path, table) { rule_.where = where(); }

  SizeRule run() {
    for (const auto& [key, node] : table()) read(std::string(key.str()), node);
    const bool asks = rule_.is_sampled || rule_.lmin || rule_.lmax || rule_.chord || rule_.alpha_deg ||
                      rule_.gap_cells || rule_.wall_cells || rule_.edge_cells || rule_.max_aspect;
    if (!asks)
      fail(table(),
           "the rule sets nothing; give lmin, lmax, alpha, chord, gap_cells, wall_cells, edge_cells, max_aspect or "
           "sample");
    return std::move(rule_);
  }

 private:
  void read(const std::string& key, const toml::node& node) {
    if (key == "groups")
      rule_.groups = names(key, node);
    else if (key == "faces")
      rule_.faces = names(key, node, "a number,");
    else if (key == "edges")
      rule_.edges = names(key, node, "a number,");
    else if (key == "between")
      read_between(node);
    else if (key == "detected")
      read_detected(node);
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
      read_alpha(node);
    else if (key == "gap_cells")
      rule_.gap_cells = count(key, node);
    else if (key == "wall_cells")
      rule_.wall_cells = count(key, node);
    else if (key == "edge_cells")
      rule_.edge_cells = count(key, node);
    else if (key == "max_aspect")
      rule_.max_aspect = number(key, node, 1, 100);
    else
      fail(node, "unknown key '" + key + "' of a [[size]]; allowed are " + kKeys);
  }

  void read_between(const toml::node& node) {
    rule_.between = names("between", node);
    if (rule_.between.size() != 2) fail(node, "between: takes two names of groups, such as [\"WING*\", \"BODY\"]");
  }

  void read_detected(const toml::node& node) {
    for (const std::string& name : names("detected", node))
      if (!add_detected(name, rule_)) fail(node, "detected: takes \"trailing\", \"leading\" or a list of these");
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

  void read_alpha(const toml::node& node) {
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !(*value >= 0.001 && *value <= 90)) fail(node, "alpha: takes degrees in [0.001, 90]");
    rule_.alpha_deg = *value;
  }

  double number(const std::string& key, const toml::node& node, double least, double most) const {
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !(*value >= least && *value <= most))
      fail(node, fmt::format("{}: takes a number in [{:g}, {:g}]", key, least, most));
    return *value;
  }

  int count(const std::string& key, const toml::node& node) const {
    const auto value = node.is_integer() ? node.value<std::int64_t>() : std::nullopt;
    if (!value || *value < 0 || *value > 100) fail(node, key + ": takes a whole number in [1, 100], or 0 for off");
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
