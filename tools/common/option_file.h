// Option files: the long options of a tool as TOML.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace st {

/// Whether keys above all tables are meant for this tool, too. Tables such as [[size]] always are.
enum class OptionFileTop { kHolds, kIsOfAnother };

/// Tables of stages whose option a flag ("--lmax") is; empty: none has it.
using TablesOf = std::function<std::vector<std::string>(const std::string&)>;
inline std::vector<std::string> no_tables(const std::string&) { return {}; }

/// An option file of `tool` that changes nothing: every option at its default, commented out, with its help.
std::string option_file_template(const std::string& tool, const std::vector<const CLI::Option*>& options);

/// Gives every option named in the TOML file `path` its value, unless the command line has set it. Keys are long
/// option names without dashes (`lmin = "0.25mm"`, `alpha = 10`); keys in the table [<tool>] hold for that tool alone
/// and override those at the top, so one file may serve several tools. Tables [[size]], [[source]] and [[group]] may
/// stand in it: it is then one of the files that --sizes, --sources or --groups name. Call after app.parse(). Throws
/// Error(kUsage) with file and line for an unreadable file, bad TOML, an unknown key or table, tables together with a
/// file of them, and a value that the option does not take. An unknown key that `tables_of` knows is said to stand
/// there.
void apply_option_file(const std::string& path, const std::string& tool, CLI::App& app, OptionFileTop top,
                       const TablesOf& tables_of = no_tables);

/// The same for the text of an option file; `path` is what messages name.
void apply_option_text(const std::string& text, const std::string& path, const std::string& tool, CLI::App& app,
                       OptionFileTop top, const TablesOf& tables_of = no_tables);

/// The options that have a value by now, one line for each: `lmax = "2%"`.
std::string option_file_settings(const std::vector<const CLI::Option*>& options);

}  // namespace st
