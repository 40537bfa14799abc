#include "common/option_file.h"

#define TOML_HEADER_ONLY 0
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "base/error.h"
#include "base/nearest_name.h"
#include "common/option_set.h"
#include "io/toml/option_file_lists.h"
#include "io/toml/toml_slips.h"

namespace st {
namespace {

const std::set<std::string> kTools = {"st-import", "st-edit",   "st-raster", "st-prolong", "st-mesh",
                                      "st-metric", "st-remesh", "st-merge",  "st-check",   "st-info",
                                      "st-diff",   "st-export", "st-report", "st-run"};
/// Options that a file cannot set: they say where the options come from, or what to do instead of running.
const std::set<std::string> kCommandLineOnly = {"help",          "version",      "options",
                                                "print-options", "print-inputs", "help-all"};

[[noreturn]] void fail(const std::string& where, const std::string& what) {
  throw Error(ExitCode::kUsage, where + ": " + what);
}

std::string position(const std::string& path, const toml::source_region& source) {
  return path + ":" + std::to_string(source.begin.line);
}

toml::table parse_text(const std::string& text, const std::string& path) {
  try {
    return toml::parse(text, path);
  } catch (const toml::parse_error& e) {
    fail(position(path, e.source()), std::string(e.description()) + say_toml_slip(text, e.source().begin.line));
  }
}

std::string read_text(const std::string& path) {
  std::error_code none;
  if (std::filesystem::is_other(std::filesystem::status(path, none)))
    fail(path, "is a pipe or a device, which might never end; name a file");
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  if (!file || !(text << file.rdbuf() || file.peek() == std::ifstream::traits_type::eof()) || file.bad())
    fail(path, "cannot read the option file");
  return text.str();
}

/// The shortest decimal that reads back as the same number.
template <class T>
std::string shortest(T value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

/// The value as the command line would have it; empty optional for what no option takes (dates, tables).
std::optional<std::string> scalar_text(const toml::node& node) {
  if (const auto* s = node.as_string()) return s->get();
  if (const auto* i = node.as_integer()) return shortest(i->get());
  if (const auto* f = node.as_floating_point()) return shortest(f->get());
  if (const auto* b = node.as_boolean()) return b->get() ? "true" : "false";
  return std::nullopt;
}

std::vector<std::string> values_of(const toml::node& node, const std::string& where, const std::string& key) {
  std::vector<std::string> values;
  const auto add = [&](const toml::node& n) {
    const auto text = scalar_text(n);
    if (!text) fail(where, key + ": takes a string, a number, true or false, or a list of these");
    values.push_back(*text);
  };
  if (const auto* list = node.as_array())
    for (const auto& item : *list) add(item);
  else
    add(node);
  return values;
}

std::vector<std::string> known_keys(const CLI::App& app) {
  std::vector<std::string> keys;
  for (const CLI::Option* o : app.get_options())
    for (const std::string& name : o->get_lnames())
      if (!kCommandLineOnly.contains(name)) keys.push_back(name);
  return keys;
}

[[noreturn]] void refuse_key(const std::string& where, const std::string& key, const std::string& tool,
                             const CLI::App& app, const TablesOf& tables_of) {
  std::string tables;
  for (const std::string& table : tables_of("--" + key)) tables += (tables.empty() ? "[" : ", [") + table + "]";
  if (!tables.empty()) fail(where, "'" + key + "' is an option of a stage; write it below " + tables);
  const std::vector<std::string> known = known_keys(app);
  std::string list;
  for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
  const char* of_stages = tool == "st-run" ? "; options of a stage stand below its table, such as [st-raster]" : "";
  fail(where, "unknown option '" + key + "'" + did_you_mean(key, known) + "; " + tool + " knows " + list + of_stages);
}

void apply(const std::string& key, const toml::node& node, const std::string& path, const std::string& tool,
           CLI::App& app, const TablesOf& tables_of) {
  const std::string where = position(path, node.source());
  CLI::Option* option = kCommandLineOnly.contains(key) ? nullptr : app.get_option_no_throw("--" + key);
  if (!option) refuse_key(where, key, tool, app, tables_of);
  if (option->count() > 0) return;
  for (const std::string& value : values_of(node, where, key)) option->add_result(value);
  if (option->count() == 0) return;
  try {
    option->run_callback();
  } catch (const CLI::Error& e) {
    fail(where, said_by(e));
  }
}

bool is_flag(const CLI::Option& option) { return option.get_expected_max() == 0; }

/// A value as TOML: numbers bare where they read back as the same text, all else quoted.
std::string toml_value(const std::string& text) {
  double number = 0;
  if (CLI::detail::lexical_cast(text, number)) {
    try {
      const toml::table read = toml::parse("x = " + text);
      if (scalar_text(*read.get("x")) == text) return text;
    } catch (const toml::parse_error&) {
    }
  }
  const auto is_plain = [](unsigned char c) { return c >= ' ' && c != '"' && c != '\\' && c < 0x7f; };
  if (std::all_of(text.begin(), text.end(), is_plain)) return '"' + text + '"';
  std::ostringstream quoted;
  quoted << toml::value<std::string>(text);
  return quoted.str();
}

/// A value or a list of values.
std::string toml_values(const std::vector<std::string>& values) {
  if (values.size() == 1) return toml_value(values[0]);
  std::string list;
  for (const std::string& value : values) list += (list.empty() ? "" : ", ") + toml_value(value);
  return "[" + list + "]";
}

/// What a file says to one tool, by key.
struct Settings {
  std::map<std::string, const toml::node*> values;
  std::map<std::string, const toml::node*> lists;  ///< tables such as [[size]]
};

void collect(const toml::table& table, OptionFileTop values, Settings& settings) {
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (option_file_lists().contains(name) && node.is_array_of_tables())
      settings.lists[name] = &node;
    else if (!node.is_table() && values == OptionFileTop::kHolds)
      settings.values[name] = &node;
  }
}

/// The keys at the top, then those in the tool's own table, which win.
Settings settings_for(const std::string& tool, const toml::table& file, const std::string& path, OptionFileTop top) {
  Settings settings;
  collect(file, top, settings);
  const std::vector<std::string> tools(kTools.begin(), kTools.end());
  for (const auto& [key, node] : file)
    if (const std::string name(key.str()); node.is_table() && !kTools.contains(name))
      fail(position(path, node.source()), "unknown table [" + name + "]" + did_you_mean(name, tools) +
                                              "; a table is named after a tool, such as [" + tool + "]");
  if (const toml::table* own = file[tool].as_table()) {
    collect(*own, OptionFileTop::kHolds, settings);
    for (const auto& [key, node] : *own)
      if (node.is_table()) settings.values[std::string(key.str())] = &node;
  }
  return settings;
}

/// The option that reads a list from a file; null for tools that have none, and where the command line has set it.
CLI::Option* open_list_option(const std::string& key, CLI::App& app) {
  CLI::Option* option = app.get_option_no_throw(option_file_lists().at(key));
  return option && option->get_type_name() == "FILE" && option->count() == 0 ? option : nullptr;
}

/// Tables such as [[size]] stand in the option file itself: it is then one more file that the option names.
void apply_list(const toml::node& node, const std::string& path, CLI::Option& option) {
  if (option.count() > 0 && option.get_expected_max() == 1)
    fail(position(path, node.source()), "tables are written here and '" + option.get_lnames().front() +
                                            "' names a file with tables, too; keep one of them");
  option.add_result(path);
  option.run_callback();
}

}  // namespace

std::string option_file_template(const std::string& tool, const std::vector<const CLI::Option*>& options) {
  std::string text = "# Options of " + tool + ": remove the # before a line to change it.\n";
  for (const CLI::Option* option : options) {
    text += "\n# " + option->get_description() + "\n";
    text += "# " + option->get_lnames().front() + " = " +
            (is_flag(*option) ? "false" : toml_value(option->get_default_str())) + "\n";
  }
  return text;
}

std::string option_file_settings(const std::vector<const CLI::Option*>& options) {
  std::string text;
  for (const CLI::Option* option : options)
    if (option->count() > 0)
      text +=
          option->get_lnames().front() + " = " + (is_flag(*option) ? "true" : toml_values(option->results())) + "\n";
  return text;
}

void apply_option_file(const std::string& path, const std::string& tool, CLI::App& app, OptionFileTop top,
                       const TablesOf& tables_of) {
  apply_option_text(read_text(path), path, tool, app, top, tables_of);
}

void apply_option_text(const std::string& text, const std::string& path, const std::string& tool, CLI::App& app,
                       OptionFileTop top, const TablesOf& tables_of) {
  const toml::table file = parse_text(text, path);
  const Settings settings = settings_for(tool, file, path, top);
  std::vector<std::pair<const toml::node*, CLI::Option*>> lists;
  for (const auto& [key, node] : settings.lists)
    if (CLI::Option* option = open_list_option(key, app)) lists.emplace_back(node, option);
  for (const auto& [key, node] : settings.values) apply(key, *node, path, tool, app, tables_of);
  for (const auto& [node, option] : lists) apply_list(*node, path, *option);
}

}  // namespace st
