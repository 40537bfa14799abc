// What all tools share: declaration of arguments, option files, the summary, the single catch and the exit code.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "base/number_option.h"
#include "stages/summary.h"

namespace st {

class Communicator;

/// One command-line tool. main declares its arguments, binding them to the stage's option struct, and hands over to
/// run():
///
///   ProlongStageOptions o;
///   ToolMain tool("st-prolong", "Makes the mesh size specification from a raster.");
///   tool.input("raster", o.raster, "raster artifact");
///   tool.output(o.output);
///   tool.number(o.kSlope, o.slope);
///   return tool.run(argc, argv, [&] { return run_prolong(o); });
class ToolMain {
 public:
  /// What -q does to the summary: a stage drops it, a report is nothing but its summary.
  enum class Kind { kStage, kReport };

  ToolMain(std::string name, const std::string& description, Kind kind = Kind::kStage);

  /// A required positional input file.
  void input(const std::string& name, std::string& path, const std::string& help);
  /// One or more positional input files.
  void inputs(const std::string& name, std::vector<std::string>& paths, const std::string& help);
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
  void flag(const std::string& flag, bool& value, const std::string& help);
  /// --preset: what neither the command line nor the option file sets is taken from a preset (presets.h).
  void preset();
  /// Whether the command line, an option file or a preset sets an option.
  bool is_set(const std::string& flag) const;
  /// Command lines that stand at the end of --help.
  void examples(const std::vector<std::string>& command_lines);

  /// A crash at a face starts the tool again without this face, see restart_after_crashes(); so does the loss of a rank
  /// that was started here, where the stage has kept something.
  void restart_after_crash() { restarts_after_crash_ = true; }
  /// --threads; run_parallel has it by itself.
  void threads();

  /// Parses, runs the stage, reports; returns the exit code of the process. Never throws.
  int run(int argc, char** argv, const std::function<StageSummary()>& stage);
  /// The same for an MPI tool, with --np: ranks but the first are quiet, and an error on any rank ends the job with one
  /// message. Collective when a launcher started the process.
  int run_parallel(int argc, char** argv, const std::function<StageSummary(const Communicator&)>& stage);

 private:
  void add_number(const NumberOption& option, CLI::Option* bound);
  /// Signal handlers, and --json ahead of parsing: a usage error is reported as JSON, too.
  void begin(int argc, char** argv);
  /// Command line, then option file. Returns the text of --help, --version or --print-... when asked for. Throws
  /// Error(kUsage).
  std::optional<std::string> parse(int argc, char** argv);
  std::vector<std::string> reversed_arguments(int argc, char** argv) const;
  struct OutputPaths {
    std::vector<std::string> named, defaults;
  };
  /// What this run writes: what is given, else the defaults.
  OutputPaths outputs_by_origin() const;
  /// All of them.
  std::vector<std::string> output_paths() const;
  /// See run_under_mpirun; what a killed rank leaves half-written is removed.
  std::optional<int> start_ranks(const std::vector<std::string>& arguments) const;
  std::optional<int> start_ranks_once(const std::vector<std::string>& arguments) const;
  /// The files that options and arguments name as inputs.
  std::vector<std::string> input_files() const;
  /// See set_output_rules.
  void set_rules() const;
  /// Ends the run when --wall-limit is over; `report` is told so before.
  void watch_time(const std::function<void(ExitCode, const std::string&)>& report) const;
  /// Prints the summary to stdout. When stdout takes nothing: throws Error(kOutput) for a report and for JSON, which
  /// are lost then; only warns for a stage, whose outputs are complete.
  void print_summary(const StageSummary& summary) const;
  /// Of --help and the like. Throws Error(kOutput) when stdout takes nothing.
  static void print_text(const std::string& text);
  void print_error(ExitCode code, const std::string& message) const;
  /// Runs `action` and catches everything it throws: the one catch of the program. `report` is told the code and the
  /// message.
  static ExitCode guard(const std::function<ExitCode()>& action,
                        const std::function<void(ExitCode, const std::string&)>& report);

  std::string name_;
  Kind kind_;
  CLI::App app_;
  std::string options_file_, preset_;
  int n_ranks_ = 1;
  double wall_limit_ = 86'400;
  std::optional<int> n_threads_;
  bool quiet_ = false, verbose_ = false, json_ = false, restarts_after_crash_ = false, replaces_own_ = false;
  std::vector<CLI::Option*> input_options_, output_options_;
  std::vector<const CLI::Option*> file_options_;  ///< what --print-options shows: the options of the stage
  std::vector<std::string> repeated_flags_;       // that may be followed by several files
};

}  // namespace st
