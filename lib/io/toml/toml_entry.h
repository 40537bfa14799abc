// Tables [[...]] of a TOML file, read with messages that name file and line. For sources of this layer only: toml++
// shows.
#pragma once

#define TOML_HEADER_ONLY 0
#include <toml++/toml.h>

#include <string>
#include <vector>

#include "base/error.h"
#include "base/length.h"

namespace st {

/// "FILE:LINE" of a place, for messages.
std::string toml_place(const std::string& path, const toml::source_region& region);

/// The table that `text`, the content of `path`, is. Throws Error(code) with file and line for what is no TOML.
toml::table parse_toml(const std::string& path, const std::string& text, ExitCode code);

/// The lists of tables that one key of an option file may give a tool.
struct TomlList {
  std::string key;   ///< of the tables: "size" for [[size]]
  std::string tool;  ///< that takes them: [[<tool>.<key>]] counts, too
  ExitCode code;     ///< of the errors
};

/// The tables [[key]] at the top of a file, then those in the table of the tool. The file may be an option file:
/// plain values, tables of tools and the other lists of option files are passed over. Throws Error(list.code) with
/// file and line for any other table, so that no misspelt one is dropped, and for a `key` that is no list of tables.
std::vector<const toml::table*> toml_list(const std::string& path, const toml::table& file, const TomlList& list);

/// One table of a list. All that fails throws Error(kUsage) with file, line and key.
class TomlEntry {
 public:
  /// Both must outlive the entry.
  TomlEntry(const std::string& path, const toml::table& table) : path_(path), table_(table) {}

  const toml::table& table() const { return table_; }
  std::string where() const { return toml_place(path_, table_.source()); }
  [[noreturn]] void fail(const toml::node& node, const std::string& what) const;

  /// Calls `take` for each value of a list that is not empty; a single value is a list of one.
  template <class Function>
  void for_each(const std::string& key, const toml::node& node, const Function& take) const {
    const toml::array* list = node.as_array();
    if (list && list->empty()) fail(node, key + ": an empty list; leave the key out");
    if (!list) return take(node);
    for (const toml::node& n : *list) take(n);
  }
  /// Texts, not empty; whole numbers, too, where `number` says what they are ("a number").
  std::vector<std::string> names(const std::string& key, const toml::node& node, const std::string& number = "") const;
  /// A positive number in model units, or a text such as "5mm" or "0.1%".
  LengthSpec length(const std::string& key, const toml::node& node) const;

 private:
  const std::string& path_;
  const toml::table& table_;
};

}  // namespace st
