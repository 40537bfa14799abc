// Options of one stage, or of a tool: declared once, bound to a struct, known by name to command lines and option
// files.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "base/number_option.h"
#include "common/option_file.h"

namespace st {

/// What CLI11 says, on one line and in our words.
std::string said_by(const CLI::Error& e);
/// The same, and where to read on.
std::string usage_message(const CLI::Error& e, const std::string& tool);

/// Refuses an empty name: that of a variable that a script forgot to set. To go on without the file would be worst.
CLI::Validator a_name();

/// Type of an option that names an array in a file.
inline constexpr const char* kArrayType = "FILE:ARRAY";

/// What a tool or a stage can be told. `name` is that of the tool, "st-mesh": its table in an option file.
class OptionSet {
 public:
  OptionSet(std::string name, const std::string& description);

  /// A required positional input file.
  void input(const std::string& name, std::string& path, const std::string& help);
  /// One or more positional input files.
  void inputs(const std::string& name, std::vector<std::string>& paths, const std::string& help);
  /// One or more positional arrays in input files: "FILE:ARRAY".
  void input_arrays(const std::string& name, std::vector<std::string>& arrays, const std::string& help);
  /// An optional input file; `flag` with its dashes, as in all functions below.
  void optional_input(const std::string& flag, std::string& path, const std::string& help);
  /// The same, repeatable, and with several files after one flag where the positional inputs stand first.
  void optional_inputs(const std::string& flag, std::vector<std::string>& paths, const std::string& help);
  /// An optional array in an input file: "FILE:ARRAY".
  void optional_array(const std::string& flag, std::string& value, const std::string& help);
  /// -o,--output with the struct's default; required when that is empty.
  void output(std::string& path, const std::string& help = "artifact to write");
  /// A further file to write, with the struct's default.
  void output_option(const std::string& flag, std::string& path, const std::string& help);
  /// A file to write instead of that of -o,--output (declared before), not together with it.
  void output_instead(const std::string& flag, std::string& path, const std::string& help);
  /// A repeatable option naming a further file to write.
  void outputs(const std::string& flag, std::vector<std::string>& paths, const std::string& help);
  /// A folder to write into, with the struct's default.
  void folder(const std::string& flag, std::string& path, const std::string& help);
  /// A length such as 3, 0.1%, 0.25mm or 2in; `default_text` stands in --help for an empty value.
  void length(const std::string& flag, std::string& value, const std::string& default_text, const std::string& help);
  /// A unit of length such as mm or inch.
  void unit(const std::string& flag, std::string& value, const std::string& help);
  /// Free text, shown as `type` in --help.
  void text(const std::string& flag, std::string& value, const std::string& type, const std::string& help);
  /// The same, repeatable, and with several files after one flag where the positional inputs stand first.
  void texts(const std::string& flag, std::vector<std::string>& values, const std::string& type,
             const std::string& help);
  /// A number, bound to the field that `option` describes: double, int or std::optional of them.
  template <class T>
  void number(const NumberOption& option, T& value) {
    CLI::Option* bound = app_.add_option(option.flag, value, option.help);
    if constexpr (std::is_arithmetic_v<T>) bound->capture_default_str();
    add_number(option, bound);
  }
  /// The same of how a tool runs: an option file may have it, but what is made does not depend on it.
  template <class T>
  void execution_number(const NumberOption& option, T& value) {
    number(option, value);
    file_options_.pop_back();
  }
  void flag(const std::string& flag, bool& value, const std::string& help);
  /// --preset: what neither the command line nor the option file sets is taken from a preset (presets.h).
  void preset();
  /// The preset that is asked for; empty: none.
  const std::string& preset_name() const { return preset_; }
  /// Whether the command line, an option file or a preset sets an option.
  bool is_set(const std::string& flag) const;
  const std::string& name() const { return name_; }

  /// The option of this flag ("--lmax"); null where there is none.
  CLI::Option* find(const std::string& flag);
  /// The options of a stage, without those that say how a tool runs.
  const std::vector<const CLI::Option*>& content() const { return file_options_; }
  /// Takes one more value of the option of this flag, as if the command line had it. Throws Error(kUsage).
  void set(const std::string& flag, const std::string& value);
  /// See apply_option_file(). Throws Error(kUsage).
  void apply_file(const std::string& path, OptionFileTop top);
  /// What is not set by now is taken from the preset, where one is asked for. Throws Error(kUsage).
  void apply_preset();
  /// The files that options and arguments name as inputs.
  std::vector<std::string> input_files() const;
  /// What is set, as lines of an option file; "" where nothing is.
  std::string settings_text() const;

 protected:
  void add_number(const NumberOption& option, CLI::Option* bound);

  std::string name_;
  CLI::App app_;
  std::string preset_;
  std::vector<CLI::Option*> input_options_, output_options_;
  std::vector<const CLI::Option*> file_options_;  ///< what --print-options shows: the options of the stage
  std::vector<std::string> repeated_flags_;       // that may be followed by several files
};

}  // namespace st
