#include "io/toml/groups_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/hash.h"
#include "base/nearest_name.h"
#include "io/file/text_file.h"
#include "io/toml/toml_entry.h"

namespace st {
namespace {

using Words = std::vector<std::string>;

/// Values of `of`, in the order of EntityDim.
const Words kKinds = {"vertices", "edges", "faces"};

/// Keys of a group of each kind, in that order.
const Words kKeys[] = {
    {"name", "of", "table", "vertices", "on", "inside", "touching", "attributes", "optional"},
    {"name", "of", "table", "edges", "between", "rim", "on", "inside", "touching", "attributes", "optional"},
    {"name", "of", "table", "faces", "parts", "paths", "layers", "groups", "colors", "surfaces", "inside", "touching",
     "role", "tolerance", "attributes", "optional"}};

bool contains(const Words& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::string joined(const Words& words) {
  std::string text;
  for (const std::string& w : words) text += (text.empty() ? "" : ", ") + w;
  return text;
}

/// One table [[group]].
class EntryReader : TomlEntry {
 public:
  EntryReader(const std::string& path, const toml::table& table) : TomlEntry(path, table) { rule_.where = where(); }

  GroupRule run() {
    if (const toml::node* of = table().get("of")) read_kind(*of);
    for (const auto& [key, node] : table()) {
      require_key(std::string(key.str()), node);
      read(std::string(key.str()), node);
    }
    if (rule_.name.empty()) fail(table(), "name: is missing; every [[group]] has a name");
    return std::move(rule_);
  }

 private:
  void read_kind(const toml::node& node) {
    const std::string word = one_of("of", node, kKinds);
    rule_.of = static_cast<EntityDim>(std::find(kKinds.begin(), kKinds.end(), word) - kKinds.begin());
  }

  /// Each kind of group has keys of its own.
  void require_key(const std::string& key, const toml::node& node) const {
    const auto own = static_cast<std::size_t>(rule_.of);
    if (contains(kKeys[own], key)) return;
    for (std::size_t kind = 0; kind < kKinds.size(); ++kind)
      if (contains(kKeys[kind], key))
        fail(node, key + ": is not a key of a group of " + kKinds[own] + " but of " + kKinds[kind] + "; allowed are " +
                       joined(kKeys[own]) + "; of = \"edges\" or \"vertices\" makes a group of these");
    fail(node, "unknown key '" + key + "' of a [[group]]" + did_you_mean(key, kKeys[own]) + "; allowed are " +
                   joined(kKeys[own]));
  }

  void read(const std::string& key, const toml::node& node) {
    if (std::vector<std::string>* list = names_of(key)) {
      const bool has_numbers = contains(kKinds, key);
      *list = names(key, node, has_numbers ? "a number, a range \"3-7\"," : "");
      if (key == "between" && list->size() != 2)
        fail(node, "between: takes two names of groups, such as [\"WING*\", \"BODY\"]");
    } else if (key == "name") {
      read_name(node);
    } else if (key == "table") {
      read_table_name(node);
    } else if (key == "colors") {
      for_each(key, node, [&](const toml::node& n) { rule_.selection.colors.push_back(color(n)); });
    } else if (key == "surfaces") {
      for_each(key, node, [&](const toml::node& n) { rule_.selection.surfaces.push_back(surface(n)); });
    } else if (key == "inside" || key == "touching") {
      (key == "inside" ? rule_.selection.inside : rule_.selection.touching) = box(key, node);
    } else if (key == "role") {
      rule_.role = one_of(key, node, group_roles());
    } else if (key == "tolerance") {
      rule_.tolerance = length(key, node);
    } else if (key == "attributes") {
      read_attributes(node);
    } else if (key == "optional") {
      if (!node.is_boolean()) fail(node, "optional: takes true or false");
      rule_.is_optional = node.as_boolean()->get();
    }
  }

  std::vector<std::string>* names_of(const std::string& key) {
    const std::pair<const char*, std::vector<std::string>*> lists[] = {
        {"faces", &rule_.selection.faces},       {"parts", &rule_.selection.parts},
        {"paths", &rule_.selection.paths},       {"layers", &rule_.selection.layers},
        {"groups", &rule_.selection.groups},     {"edges", &rule_.selection.edges},
        {"vertices", &rule_.selection.vertices}, {"between", &rule_.selection.between},
        {"rim", &rule_.selection.rim},           {"on", &rule_.selection.on}};
    for (const auto& [name, list] : lists)
      if (key == name) return list;
    return nullptr;
  }

  std::string text(const std::string& key, const toml::node& node) const {
    const auto* s = node.as_string();
    if (!s || s->get().empty()) fail(node, key + ": takes a string that is not empty");
    return s->get();
  }

  std::string one_of(const std::string& key, const toml::node& node, const std::vector<std::string>& allowed) const {
    const std::string word = node.value_or(std::string());
    if (std::find(allowed.begin(), allowed.end(), word) == allowed.end())
      fail(node, key + ": '" + word + "' is unknown" + did_you_mean(word, allowed) + "; write " + joined(allowed));
    return word;
  }

  void read_name(const toml::node& node) {
    rule_.name = text("name", node);
    if (std::any_of(rule_.name.begin(), rule_.name.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }))
      fail(node, "name: contains a control character; use letters and blanks");
  }

  void read_table_name(const toml::node& node) {
    const std::string name = text("table", node);
    const bool is_word =
        std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
    if (!is_word || name.size() > 64)
      fail(node, "table: '" + name + "' is not a name of a table; use up to 64 letters, digits, '_' and '-'");
    rule_.table = name == "main" ? "" : name;
  }

  std::int32_t color(const toml::node& node) const {
    const std::string text = node.value_or(std::string());
    const std::string digits = text.starts_with('#') ? text.substr(1) : "";
    std::int32_t rgb = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), rgb, 16);
    if (digits.size() != 6 || digits[0] == '-' || error != std::errc() || end != digits.data() + 6)
      fail(node, "colors: takes \"#rrggbb\", such as \"#ff8000\", or a list of these");
    return rgb;
  }

  SurfaceType surface(const toml::node& node) const {
    const std::vector<std::string>& all = surface_type_names();
    const std::string word = one_of("surfaces", node, all);
    return static_cast<SurfaceType>(std::find(all.begin(), all.end(), word) - all.begin());
  }

  BoxSpec box(const std::string& key, const toml::node& node) const {
    const toml::array* list = node.as_array();
    if (!list || list->size() != 6) fail(node, key + ": takes six coordinates [x0, y0, z0, x1, y1, z1]");
    BoxSpec box;
    for (std::size_t i = 0; i < 6; ++i) box[i] = coordinate(key, *list->get(i));
    for (std::size_t i = 0; i < 3; ++i)
      if (box[i].is_in_metres == box[i + 3].is_in_metres && box[i].value > box[i + 3].value)
        fail(node, key + ": the lower corner comes first: [x0, y0, z0, x1, y1, z1]");
    return box;
  }

  CoordinateSpec coordinate(const std::string& key, const toml::node& node) const {
    const auto bad = [&] { fail(node, key + ": takes coordinates such as 2.5 or \"-30mm\""); };
    if (const auto value = node.is_number() ? node.value<double>() : std::nullopt) {
      if (std::isnan(*value)) bad();
      return {*value, false};
    }
    const std::string text = node.value_or(std::string());
    CoordinateSpec result;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result.value);
    if (error != std::errc() || !std::isfinite(result.value)) bad();
    std::string unit(end, text.data() + text.size());
    unit.erase(0, unit.find_first_not_of(' '));
    if (unit.empty()) return result;
    const std::optional<double> in_m = unit_in_metres(unit);
    if (!in_m) bad();
    return {result.value * *in_m, true};
  }

  nlohmann::json value_of(const std::string& key, const toml::node& node) const {
    if (const auto* s = node.as_string()) return s->get();
    if (const auto* b = node.as_boolean()) return b->get();
    if (const auto* i = node.as_integer()) return i->get();
    if (const auto* d = node.as_floating_point(); d && std::isfinite(d->get())) return d->get();
    if (const toml::array* list = node.as_array()) {
      nlohmann::json array = nlohmann::json::array();
      for (const toml::node& n : *list) array.push_back(value_of(key, n));
      return array;
    }
    fail(node, "attributes: " + key + ": takes a string, a number, true, false, or a list of these");
  }

  void read_attributes(const toml::node& node) {
    const toml::table* table = node.as_table();
    if (!table) fail(node, "attributes: takes a table such as {solver = \"viscous\", y_plus = 1}");
    nlohmann::json json = nlohmann::json::object();
    for (const auto& [key, value] : *table) {
      if (key.str() == "tolerance") fail(value, "attributes: tolerance is a key of [[group]] itself, a length");
      json[std::string(key.str())] = value_of(std::string(key.str()), value);
    }
    rule_.attributes = json.dump();
  }

  GroupRule rule_;
};

}  // namespace

GroupsFile read_groups(const std::string& path) {
  const std::string text = read_text_file(path);
  GroupsFile file;
  file.hash = hash_hex(text.data(), text.size());
  const toml::table table = parse_toml(path, text, ExitCode::kUsage);
  for (const toml::table* entry : toml_list(path, table, {"group", "st-import", ExitCode::kUsage}))
    file.rules.push_back(EntryReader(path, *entry).run());
  if (file.rules.empty()) throw Error(ExitCode::kUsage, path + ": has no table [[group]]; see docs/groups.md");
  return file;
}

}  // namespace st
