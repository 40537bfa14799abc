// What all tools share: declaration of arguments, option files, the summary, the single catch and the exit code.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/option_set.h"
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
class ToolMain : public OptionSet {
 public:
  /// What -q does to the summary: a stage drops it, a report is nothing but its summary.
  enum class Kind { kStage, kReport };

  ToolMain(std::string name, const std::string& description, Kind kind = Kind::kStage);

  /// What --help shows besides inputs and outputs; all other options are left to --help-all. Not called: all but those
  /// that every tool has.
  void main_options(const std::vector<std::string>& flags) { main_flags_ = flags; }
  /// The tool runs this stage, too: its options are taken by their own names, from the command line and from its table
  /// of the option file. `set` outlives the tool. A name that several stages have goes to all of them.
  void stage(OptionSet& set) { stages_.push_back(&set); }
  /// What is set for the tool and its stages, as an option file with a table for each.
  const std::string& settings() const { return settings_; }
  /// The option file, and the files that options of stages name.
  std::vector<std::string> settings_files() const;
  /// Command lines that stand at the end of --help.
  void examples(const std::vector<std::string>& command_lines);

  /// A crash at a face starts the tool again without this face, see restart_after_crashes(); so does the loss of a rank
  /// that was started here, where the stage has kept something.
  void restart_after_crash() { restarts_after_crash_ = true; }
  /// --threads; run_parallel has it by itself.
  void threads();
  /// --np; likewise.
  void ranks();
  int n_ranks() const { return n_ranks_; }
  double wall_limit() const { return wall_limit_; }
  std::optional<int> n_threads() const { return n_threads_; }

  /// Parses, runs the stage, reports; returns the exit code of the process. Never throws.
  int run(int argc, char** argv, const std::function<StageSummary()>& stage);
  /// The same for an MPI tool, with --np: ranks but the first are quiet, and an error on any rank ends the job with one
  /// message. Collective when a launcher started the process.
  int run_parallel(int argc, char** argv, const std::function<StageSummary(const Communicator&)>& stage);
  /// The same in a fork of this process, which survives whatever happens there: `prepare` is called here before, with
  /// what it makes still there until the end. A face that crashes st-mesh is left out by another fork.
  struct Worker {
    std::function<void()> prepare;
    std::function<StageSummary()> stage;
    std::function<std::string()> where;                    ///< "st-mesh": what was being done when a signal ended it
    std::function<bool()> is_timed = [] { return true; };  ///< whether --wall-limit is for the whole of it
  };
  int run_in_worker(int argc, char** argv, const Worker& worker);

 private:
  /// Signal handlers, and --json ahead of parsing: a usage error is reported as JSON, too.
  void begin(int argc, char** argv);
  /// Command line, then option file. Returns the text of --help, --version or --print-... when asked for. Throws
  /// Error(kUsage).
  std::optional<std::string> parse(int argc, char** argv);
  /// The options of stages are given to them; what stays is the tool's own.
  std::vector<std::string> own_arguments(const std::vector<std::string>& arguments);
  std::vector<std::string> reversed_arguments(int argc, char** argv);
  std::vector<std::string> long_names() const;
  std::vector<OptionSet*> stages_with(const std::string& flag) const;
  std::vector<std::string> all_input_files() const;
  std::string print_options() const;
  std::string settings_by_table() const;
  bool is_shown_first(const CLI::Option* option) const;
  enum class HelpDetail { kMain, kAll };
  std::string help(HelpDetail detail);
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
  /// The fork: its exit code.
  int work(const Worker& worker) const;
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

  Kind kind_;
  std::string options_file_;
  std::string settings_;
  std::vector<OptionSet*> stages_;
  std::vector<std::string> main_flags_;
  std::vector<const CLI::Option*> common_options_;  ///< that every tool has
  int n_ranks_ = 1;
  double wall_limit_ = 86'400;
  std::optional<int> n_threads_;
  bool quiet_ = false, verbose_ = false, json_ = false, restarts_after_crash_ = false, replaces_own_ = false;
};

}  // namespace st
