#include "io/toml/size_rule_file.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "base/hash.h"
#include "base/nearest_name.h"
#include "io/file/text_file.h"
#include "io/toml/toml_entry.h"

namespace st {
namespace {

/// Those that take a size come after them.
const std::vector<std::string> kOtherKeys = {"groups",        "faces",        "edges", "between", "detected",
                                             "trailing_edge", "leading_edge", "for",   "sample"};

std::vector<std::string> names_of_sizes() {
  std::vector<std::string> names;
  for (const SizeKey& key : size_keys()) names.emplace_back(key.name);
  return names;
}

std::vector<std::string> all_keys() {
  std::vector<std::string> keys = kOtherKeys;
  std::ranges::copy(names_of_sizes(), std::back_inserter(keys));
  return keys;
}

/// One table [[size]].
class RuleReader : TomlEntry {
 public:
  RuleReader(const std::string& path, const toml::table& table) : TomlEntry(path, table) { rule_.where = where(); }

  SizeRule run() {
    for (const auto& [key, node] : table()) read(std::string(key.str()), node);
    if (!rule_.asks_sizes() && !rule_.meaning)
      fail(table(), fmt::format("the rule sets nothing; give {}, sample, trailing_edge or leading_edge",
                                fmt::join(names_of_sizes(), ", ")));
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
    else
      read_size(node, key);
  }

  void read_size(const toml::node& node, const std::string& key) {
    const auto known = std::ranges::find_if(size_keys(), [&](const SizeKey& k) { return k.name == key; });
    if (known == size_keys().end())
      fail(node, fmt::format("unknown key '{}' of a [[size]]{}; allowed are {}", key, did_you_mean(key, all_keys()),
                             fmt::join(all_keys(), ", ")));
    std::visit([&](const auto value) { set(rule_.*value, *known, node); }, known->value);
  }

  void set(std::optional<LengthSpec>& value, const SizeKey& key, const toml::node& node) {
    value = length(key.name, node);
  }

  void set(std::optional<double>& value, const SizeKey& key, const toml::node& node) {
    const auto given = node.is_number() ? node.value<double>() : std::nullopt;
    if (!given) fail(node, fmt::format("{}: takes a number in {}", key.name, key.option->interval));
    if (const std::string refusal = key.option->refusal(*given); !refusal.empty())
      fail(node, fmt::format("{}: {}", key.name, refusal));
    value = *given;
  }

  void set(std::optional<int>& value, const SizeKey& key, const toml::node& node) {
    const auto given = node.is_integer() ? node.value<std::int64_t>() : std::nullopt;
    if (!given || (*given != 0 && !key.option->refusal(static_cast<double>(*given)).empty()))
      fail(node, fmt::format("{}: takes a whole number in {}, or 0 for off", key.name, key.option->interval));
    value = static_cast<int>(*given);
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
