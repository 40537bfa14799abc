#include "io/size_rule_file.h"

#define TOML_HEADER_ONLY 1
#include <toml++/toml.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "base/hash.h"

namespace st {
namespace {

constexpr const char* kKeys = "groups, faces, edges, between, detected, for, sample, lmin, lmax, alpha, chord, gap_cells, edge_cells";

std::string read_text(const std::string& path) {
  std::error_code none;
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  if (std::filesystem::is_directory(path, none) || !file.is_open() || file.bad())
    throw Error(ExitCode::kInput, path + ": cannot be read; name a file of sizes");
  return text.str();
}

/// One table [[size]].
class RuleReader {
 public:
  RuleReader(const std::string& path, const toml::table& table) : path_(path), table_(table) { rule_.where = where(table); }

  SizeRule run() {
    for (const auto& [key, node] : table_) read(std::string(key.str()), node);
    const bool asks = rule_.is_sampled || rule_.lmin || rule_.lmax || rule_.chord || rule_.alpha_deg || rule_.gap_cells || rule_.edge_cells;
    if (!asks) fail(table_, "the rule asks for nothing; give lmin, lmax, alpha, chord, gap_cells, edge_cells or sample");
    return std::move(rule_);
  }

 private:
  std::string where(const toml::node& node) const { return path_ + ":" + std::to_string(node.source().begin.line); }
  [[noreturn]] void fail(const toml::node& node, const std::string& what) const {
    throw Error(ExitCode::kUsage, where(node) + ": " + what);
  }

  void read(const std::string& key, const toml::node& node) {
    if (key == "groups")
      rule_.groups = names(key, node, false);
    else if (key == "faces")
      rule_.faces = names(key, node, true);
    else if (key == "edges")
      rule_.edges = names(key, node, true);
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
    else if (key == "edge_cells")
      rule_.edge_cells = count(key, node);
    else
      fail(node, "unknown key '" + key + "' of a [[size]]; allowed are " + kKeys);
  }

  std::vector<std::string> names(const std::string& key, const toml::node& node, bool may_be_id) const {
    std::vector<std::string> result;
    const auto add = [&](const toml::node& n) {
      if (const auto* s = n.as_string(); s && !s->get().empty())
        result.push_back(s->get());
      else if (const auto* i = n.as_integer(); i && may_be_id)
        result.push_back(std::to_string(i->get()));
      else
        fail(n, key + ": takes a name with * and ?" + (may_be_id ? " or a number," : "") + " or a list of these");
    };
    if (const toml::array* list = node.as_array())
      for (const toml::node& n : *list) add(n);
    else
      add(node);
    if (result.empty()) fail(node, key + ": an empty list; leave it out to speak of the whole model");
    return result;
  }

  void read_between(const toml::node& node) {
    rule_.between = names("between", node, false);
    if (rule_.between.size() != 2) fail(node, "between: takes two names of groups, such as [\"WING*\", \"BODY\"]");
  }

  void read_detected(const toml::node& node) {
    for (const std::string& name : names("detected", node, false))
      if (!add_detected(name, rule_)) fail(node, "detected: takes \"trailing\", \"leading\" or a list of these");
  }

  void read_for(const toml::node& node) {
    const std::string what = node.value_or(std::string());
    if (what != "curves" && what != "surfaces" && what != "both") fail(node, "for: takes \"curves\", \"surfaces\" or \"both\"");
    rule_.for_curves = what != "surfaces";
    rule_.for_surfaces = what != "curves";
  }

  void read_sample(const toml::node& node) {
    if (!node.is_boolean()) fail(node, "sample: takes true or false");
    rule_.is_sampled = node.as_boolean()->get();
  }

  void read_alpha(const toml::node& node) {
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !(*value > 0 && *value <= 90)) fail(node, "alpha: takes degrees in (0, 90]");
    rule_.alpha_deg = *value;
  }

  int count(const std::string& key, const toml::node& node) const {
    const auto value = node.is_integer() ? node.value<std::int64_t>() : std::nullopt;
    if (!value || *value < 0 || *value > 100) fail(node, key + ": takes a whole number in [1, 100], or 0 for off");
    return static_cast<int>(*value);
  }

  LengthSpec length(const std::string& key, const toml::node& node) const {
    std::string text;
    if (node.is_string())
      text = node.as_string()->get();
    else if (const auto value = node.value<double>(); value && node.is_number()) {
      if (!(std::isfinite(*value) && *value > 0)) fail(node, key + ": must be positive");
      return {LengthSpec::Kind::kModelUnit, *value, std::to_string(*value)};
    } else
      fail(node, key + ": takes a length such as 0.2, \"5mm\" or \"0.1%\"");
    return parse_length(text, where(node) + ": " + key);
  }

  const std::string& path_;
  const toml::table& table_;
  SizeRule rule_;
};

void read_list(const std::string& path, const toml::node* node, std::vector<SizeRule>& rules) {
  if (!node) return;
  const toml::array* list = node->as_array();
  if (!list || !list->is_array_of_tables())
    throw Error(ExitCode::kUsage, path + ":" + std::to_string(node->source().begin.line) + ": rules of sizes are tables [[size]]");
  for (const toml::node& item : *list) rules.push_back(RuleReader(path, *item.as_table()).run());
}

}  // namespace

SizeRuleFile read_size_rules(const std::string& path) {
  const std::string text = read_text(path);
  SizeRuleFile file;
  file.hash = hash_hex(text.data(), text.size());
  try {
    const toml::table table = toml::parse(text, path);
    read_list(path, table.get("size"), file.rules);
    if (const toml::table* own = table["st-raster"].as_table()) read_list(path, own->get("size"), file.rules);
  } catch (const toml::parse_error& e) {
    throw Error(ExitCode::kUsage, path + ":" + std::to_string(e.source().begin.line) + ": " + std::string(e.description()));
  }
  if (file.rules.empty()) throw Error(ExitCode::kUsage, path + ": no table [[size]] in it; see docs/st-raster.md");
  return file;
}

}  // namespace st
