// The parser is compiled here alone. It asserts, and without assertions lets clang assume, what damaged files break: a
// key that begins with '['.
#ifdef NDEBUG
#define ST_HAS_NDEBUG
#undef NDEBUG
#endif
#define TOML_ASSERT(expr) static_assert(true)
#define TOML_IMPLEMENTATION
#include "io/toml/toml_entry.h"
#ifdef ST_HAS_NDEBUG
#define NDEBUG
#endif

#include <cmath>
#include <optional>

#include "io/toml/option_file_lists.h"
#include "io/toml/toml_slips.h"

namespace st {

std::string toml_place(const std::string& path, const toml::source_region& region) {
  return path + ":" + std::to_string(region.begin.line);
}

toml::table parse_toml(const std::string& path, const std::string& text, ExitCode code) {
  try {
    return toml::parse(text, path);
  } catch (const toml::parse_error& e) {
    throw Error(code, toml_place(path, e.source()) + ": " + std::string(e.description()) +
                          say_toml_slip(text, e.source().begin.line));
  }
}

std::vector<const toml::table*> toml_list(const std::string& path, const toml::table& file, const TomlList& list) {
  const auto fail = [&](const toml::node& node, const std::string& what) {
    throw Error(list.code, toml_place(path, node.source()) + ": " + what + " tables [[" + list.key + "]]");
  };
  std::vector<const toml::table*> tables;
  const auto take = [&](const toml::table& parent) {
    const toml::node* node = parent.get(list.key);
    if (!node) return;
    if (!node->is_array_of_tables()) fail(*node, "'" + list.key + "' must be");
    for (const toml::node& item : *node->as_array()) tables.push_back(item.as_table());
  };
  take(file);
  for (const auto& [name, node] : file) {
    const std::string key(name.str());
    const bool is_tool = node.is_table() && key.starts_with("st-");
    const bool is_list = node.is_array_of_tables() && option_file_lists().contains(key);
    if ((node.is_table() && !is_tool) || (node.is_array_of_tables() && !is_list))
      fail(node, "unknown table '" + key + "'; expected are");
    if (is_tool && key == list.tool) take(*node.as_table());
  }
  return tables;
}

void TomlEntry::fail(const toml::node& node, const std::string& what) const {
  throw Error(ExitCode::kUsage, toml_place(path_, node.source()) + ": " + what);
}

std::vector<std::string> TomlEntry::names(const std::string& key, const toml::node& node,
                                          const std::string& number) const {
  std::vector<std::string> result;
  for_each(key, node, [&](const toml::node& n) {
    if (const auto* s = n.as_string(); s && !s->get().empty())
      result.push_back(s->get());
    else if (const auto* i = n.as_integer(); i && !number.empty())
      result.push_back(std::to_string(i->get()));
    else
      fail(n, key + ": takes a name with * and ?" + (number.empty() ? "" : ", " + number) + " or a list of these");
  });
  return result;
}

LengthSpec TomlEntry::length(const std::string& key, const toml::node& node) const {
  if (const auto value = node.is_number() ? node.value<double>() : std::nullopt) {
    if (!(std::isfinite(*value) && *value > 0)) fail(node, key + ": must be positive");
    return {LengthSpec::Kind::kModelUnit, *value, std::to_string(*value)};
  }
  if (!node.is_string()) fail(node, key + ": takes a length such as 0.2, \"5mm\" or \"0.1%\"");
  return parse_length(node.as_string()->get(), toml_place(path_, node.source()) + ": " + key);
}

}  // namespace st
