#include "io/toml/pair_file.h"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "base/nearest_name.h"
#include "io/file/text_file.h"
#include "io/toml/toml_entry.h"

namespace st {
namespace {

const std::vector<std::string> kKeys = {"a", "b", "rotate", "at", "translate"};

class PairReader : TomlEntry {
 public:
  PairReader(const std::string& path, const toml::table& table) : TomlEntry(path, table) { pair_.where = where(); }

  PairSpec run() {
    for (const auto& [key, node] : table()) read(std::string(key.str()), node);
    if (pair_.a.empty() || pair_.b.empty()) fail(table(), "a pair needs a and b, two groups of faces");
    if (!rotation_ && !translation_) fail(table(), "a pair needs rotate = \"x 20deg\" or translate = [x, y, z]");
    if (at_ && !rotation_) fail(table(), "at: is a point on the axis of rotate, which is not given");
    if (rotation_) pair_.motion = at_ ? rotation_->about(*at_) : *rotation_;
    if (translation_) pair_.motion = pair_.motion.then({.translation = *translation_});
    return std::move(pair_);
  }

 private:
  void read(const std::string& key, const toml::node& node) {
    if (key == "a")
      pair_.a = name(key, node);
    else if (key == "b")
      pair_.b = name(key, node);
    else if (key == "rotate")
      rotation_ = rotation(node);
    else if (key == "at")
      at_ = vector(key, node);
    else if (key == "translate")
      translation_ = vector(key, node);
    else
      fail(node,
           "unknown key '" + key + "' of a pair" + did_you_mean(key, kKeys) + "; write a, b, rotate, at, translate");
  }

  std::string name(const std::string& key, const toml::node& node) const {
    const std::vector<std::string> all = names(key, node);
    if (all.size() != 1) fail(node, key + ": one name");
    return all.front();
  }

  Vec3 vector(const std::string& key, const toml::node& node) const {
    const toml::array* list = node.as_array();
    double v[3] = {};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto value = list && list->size() == 3 ? (*list)[k].value<double>() : std::nullopt;
      if (!value || !(std::abs(*value) <= kLargestCoordinate)) fail(node, key + ": [x, y, z] expected, model unit");
      v[k] = *value;
    }
    return {v[0], v[1], v[2]};
  }

  /// "x 20deg" as a step of parse_similarity().
  Similarity rotation(const toml::node& node) const {
    std::string text = node.value<std::string>().value_or("");
    if (!text.ends_with("deg")) fail(node, "rotate: an axis and an angle expected, such as \"x 20deg\"");
    text.resize(text.size() - 3);
    const std::string axes[] = {"x", "y", "z"}, units[] = {"1 0 0", "0 1 0", "0 0 1"};
    for (std::size_t k = 0; k < 3; ++k)
      if (text.starts_with(axes[k] + " ")) text = units[k] + text.substr(1);
    try {
      return parse_similarity("rotate " + text, "rotate");
    } catch (const Error&) {
      fail(node, "rotate: an axis and an angle expected, such as \"x 20deg\" or \"0 0.6 0.8 20deg\"");
    }
  }

  PairSpec pair_;
  std::optional<Similarity> rotation_;
  std::optional<Vec3> at_, translation_;
};

}  // namespace

std::vector<PairSpec> read_pair_file(const std::string& path) {
  const toml::table file = parse_toml(path, read_text_file(path), ExitCode::kUsage);
  std::vector<PairSpec> pairs;
  for (const toml::table* entry : toml_list(path, file, {"pair", "st-mesh", ExitCode::kUsage}))
    pairs.push_back(PairReader(path, *entry).run());
  if (pairs.empty()) throw Error(ExitCode::kUsage, path + ": no table [[pair]] in it; see docs/st-mesh.md");
  return pairs;
}

}  // namespace st
