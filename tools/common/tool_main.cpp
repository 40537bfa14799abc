#include "common/tool_main.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "base/log.h"
#include "base/mapped_file.h"
#include "base/memory.h"
#include "base/nearest_name.h"
#include "base/supervised_program.h"
#include "base/text.h"
#include "base/threads.h"
#include "comm/communicator.h"
#include "common/crash_handler.h"
#include "common/option_file.h"
#include "common/wall_limit.h"
#include "io/file/journal.h"
#include "io/file/json_text.h"
#include "io/file/output_files.h"
#include "io/file/temporary_file.h"
#include "io/file/text_file.h"
#include "io/hdf5/artifact.h"

namespace st {
namespace {

constexpr const char* kFooter =
    "Lengths: 3 (model unit), 0.25mm, 2in, 0.1% (of the model's diagonal).\n"
    "Exit codes: 0 ok, 2 usage, 3 input, 4 geometry, 5 incomplete or check failed, 6 output, 7 inputs do not belong "
    "together, 8 out of memory, 70 internal.";
constexpr std::size_t kHelpColumn = 34;  // where the texts of --help start
/// Where the package puts the pages.
constexpr const char* kPages = "/usr/share/doc/st/docs/";

const char* g_name = "st";  // of the tool, for messages of signal handlers

extern "C" void end_on_signal(int signal) {
  remove_temporaries();
  note_end();
  _exit(128 + signal);
}

void print(const char* text) {
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) _exit(static_cast<int>(ExitCode::kInput));
}

/// A mapped file was cut by another program, or lies on a disk that fails: the place that was read is no longer there.
extern "C" void end_on_lost_page(int signal, siginfo_t* info, void*) {
  const char* file = mapped_file_at(info->si_addr);
  remove_temporaries();
  if (!file) {
    std::signal(signal, SIG_DFL);
    return;  // the access is tried again, and ends the program
  }
  print(g_name);
  print(": error: ");
  print(file);
  print(": got shorter or unreadable while it was used; make it again, and leave it alone until this run ends\n");
  _exit(static_cast<int>(ExitCode::kInput));
}

constexpr NumberOption kWallLimit{"--wall-limit", "SECONDS", "[0.1, 1e9]",
                                  "end with exit code 3 when the run takes longer"};

/// Temporaries go when the user or the batch system ends the run; a signal ignored by the parent (nohup) stays ignored.
void install_signal_handlers() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction old {};
    if (sigaction(signal, nullptr, &old) == 0 && old.sa_handler == SIG_IGN) continue;
    struct sigaction action {};
    action.sa_handler = end_on_signal;
    sigaction(signal, &action, nullptr);
  }
  struct sigaction lost {};
  lost.sa_sigaction = end_on_lost_page;
  lost.sa_flags = SA_SIGINFO;
  sigaction(SIGBUS, &lost, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);  // a file beyond the limit of its size: the write fails and says so
}

/// A stream that the parent closed must not become an output file: it stays one that takes and gives nothing.
void occupy_standard_streams() {
  for (int fd = 0; fd <= 2; ++fd)
    if (fcntl(fd, F_GETFD) < 0 && errno == EBADF && open("/dev/null", fd == 0 ? O_WRONLY : O_RDONLY) < 0) return;
}

bool has_argument(int argc, char** argv, std::string_view wanted) {
  return std::any_of(argv + 1, argv + argc, [&](const char* argument) { return argument == wanted; });
}

/// "--lmn=3" -> ", did you mean '--lmin'"; empty for what is no option, and where nothing is near.
std::string near_option(const std::string& argument, const std::vector<std::string>& names) {
  if (!argument.starts_with("-")) return "";
  const std::string word = argument.substr(0, argument.find('='));
  const std::string nearest = nearest_name(word.substr(std::min(word.find_first_not_of('-'), word.size())), names);
  return nearest.empty() ? "" : ", did you mean '--" + nearest + "'";
}

[[noreturn]] void refuse_argument(const std::string& argument, const std::vector<std::string>& names,
                                  const std::string& tool) {
  std::error_code none;
  const bool is_file = argument.starts_with("-") && std::filesystem::exists(argument, none);
  throw Error(ExitCode::kUsage, "unexpected argument '" + argument + "'" + near_option(argument, names) +
                                    (is_file ? "; write ./" + argument + " for the file" : "") + "; see " + tool +
                                    " --help");
}

}  // namespace

ToolMain::ToolMain(std::string name, const std::string& description, Kind kind)
    : OptionSet(std::move(name), description), kind_(kind) {
  app_.get_formatter()->column_width(kHelpColumn);
  app_.footer(kFooter);
  app_.set_help_flag("-h,--help", "print the options that matter first, and exit");
  app_.set_help_all_flag("--help-all", "print all options and exit");
  app_.set_version_flag("--version", name_ + " " ST_VERSION, "print the version and exit");
  app_.add_option("--options", options_file_,
                  "read options from this file (TOML, long names without dashes); the command line wins")
      ->type_name("FILE")
      ->check(a_name());
  app_.add_flag_function(
          "--print-options", [](std::int64_t) {},
          "print an option file that lists every option with its default, and exit")
      ->disable_flag_override();
  app_.add_flag_function(
          "--print-inputs", [](std::int64_t) {}, "print the names of all input files, one per line, and exit")
      ->disable_flag_override();
  app_.add_flag("--replace-own", replaces_own_, "replace a file under the name of an output only where ST wrote it")
      ->disable_flag_override();
  execution_number(kWallLimit, wall_limit_);
  auto* quiet = app_.add_flag("-q,--quiet", quiet_, "print errors only")->disable_flag_override();
  app_.add_flag("-v,--verbose", verbose_, "print more about each step")->excludes(quiet)->disable_flag_override();
  app_.add_flag("--json", json_, "print one JSON object as the last line of stdout")->disable_flag_override();
  for (const CLI::Option* option : app_.get_options())
    if (option != app_.get_help_ptr() && option != app_.get_help_all_ptr()) common_options_.push_back(option);
}

/// The arguments, the last one first; "--sources A B" becomes "--sources A --sources B". Only where the positional
/// arguments stand before: after them B may be one.
std::vector<std::string> ToolMain::reversed_arguments(int argc, char** argv) {
  std::vector<std::string> arguments;
  const auto is_flag = [](const std::string& a) { return a.starts_with("-"); };
  const bool is_led = argc > 1 && !is_flag(argv[1]);
  for (int i = 1; i < argc; ++i) {
    const std::string flag = argv[i];
    arguments.push_back(flag);
    if (!is_led || std::find(repeated_flags_.begin(), repeated_flags_.end(), flag) == repeated_flags_.end()) continue;
    for (bool is_first = true; i + 1 < argc && !is_flag(argv[i + 1]); is_first = false) {
      if (!is_first) arguments.push_back(flag);
      arguments.push_back(argv[++i]);
    }
  }
  arguments = own_arguments(arguments);
  std::reverse(arguments.begin(), arguments.end());
  return arguments;
}

std::vector<OptionSet*> ToolMain::stages_with(const std::string& flag) const {
  std::vector<OptionSet*> found;
  if (flag.size() > 2 && flag.starts_with("--") && !app_.get_option_no_throw(flag))
    std::copy_if(stages_.begin(), stages_.end(), std::back_inserter(found),
                 [&](OptionSet* set) { return set->find(flag) != nullptr; });
  return found;
}

std::vector<std::string> ToolMain::own_arguments(const std::vector<std::string>& arguments) {
  std::vector<std::string> own;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::size_t equals = arguments[i].starts_with("--") ? arguments[i].find('=') : std::string::npos;
    const std::string flag = arguments[i].substr(0, equals);
    const std::vector<OptionSet*> sets = stages_with(flag);
    if (sets.empty()) {
      own.push_back(arguments[i]);
      continue;
    }
    const bool takes_value = sets[0]->find(flag)->get_expected_max() > 0;
    if (takes_value && equals == std::string::npos && i + 1 == arguments.size())
      throw Error(ExitCode::kUsage, flag + ": a value must follow; see " + name_ + " --help-all");
    if (!takes_value && equals != std::string::npos)
      throw Error(ExitCode::kUsage, flag + ": takes no value; see " + name_ + " --help-all");
    const std::string value = !takes_value                  ? "true"
                              : equals != std::string::npos ? arguments[i].substr(equals + 1)
                                                            : arguments[++i];
    for (OptionSet* set : sets) set->set(flag, value);
  }
  return own;
}

void ToolMain::threads() {
  static constexpr NumberOption kThreads{
      "--threads", "N", "[1, 4096]", "threads of each process; same result for every number; default: all processors"};
  execution_number(kThreads, n_threads_);
}

void ToolMain::ranks() {
  app_.add_option("--np", n_ranks_,
                  "number of MPI ranks; the tool starts itself under mpirun; same result for every number")
      ->type_name("N")
      ->capture_default_str();
}

void ToolMain::examples(const std::vector<std::string>& command_lines) {
  std::string footer = kFooter + std::string("\n\nExamples:");
  for (const std::string& line : command_lines) footer += "\n  " + line;
  app_.footer(footer + "\n\nMore: docs/" + name_ + ".md, installed as " + kPages + name_ + ".md");
}

std::string ToolMain::print_options() const {
  std::string text = option_file_template(name_, file_options_);
  for (const OptionSet* set : stages_)
    text += "\n[" + set->name() + "]\n" + option_file_template(set->name(), set->content());
  return text;
}

std::string ToolMain::settings_by_table() const {
  std::string text =
      "# What was asked for: " + name_ + " and each tool take it by --options.\n[" + name_ + "]\n" + settings_text();
  for (const OptionSet* set : stages_) text += "\n[" + set->name() + "]\n" + set->settings_text();
  return text;
}

bool ToolMain::is_shown_first(const CLI::Option* option) const {
  const auto has = [&](const auto& list) { return std::find(list.begin(), list.end(), option) != list.end(); };
  if (option == app_.get_help_ptr() || option == app_.get_help_all_ptr() || option->get_positional()) return true;
  if (main_flags_.empty()) return !has(common_options_);
  const bool is_main = std::any_of(main_flags_.begin(), main_flags_.end(),
                                   [&](const std::string& flag) { return option->check_name(flag); });
  return is_main || (has(output_options_) && option->check_name("-o"));
}

std::string ToolMain::help(HelpDetail detail) {
  std::size_t n_hidden = 0;
  const auto is_hidden = [&](const CLI::Option* option) {
    const bool hides = detail == HelpDetail::kMain && !is_shown_first(option);
    n_hidden += hides;
    return hides;
  };
  for (CLI::Option* option : app_.get_options())
    if (is_hidden(option)) option->group("");
  std::string of_stages;
  CLI::Formatter formatter;
  formatter.column_width(kHelpColumn);
  std::set<std::string> seen;  // an option of several stages is shown once
  for (OptionSet* set : stages_) {
    std::vector<const CLI::Option*> shown = set->content();
    shown.erase(
        std::remove_if(shown.begin(), shown.end(),
                       [&](const CLI::Option* o) { return !seen.insert(o->get_lnames()[0]).second || is_hidden(o); }),
        shown.end());
    if (shown.empty()) continue;
    const std::string group = formatter.make_group("Options of " + set->name(), false, shown);
    of_stages += of_stages.empty() ? group.substr(1) : group;
  }
  if (!of_stages.empty()) of_stages += "\n";
  const std::string rest = n_hidden > 0 ? std::to_string(n_hidden) + " more options: " + name_ + " --help-all\n" : "";
  app_.footer(of_stages + rest + app_.get_footer());
  return app_.help();
}

void ToolMain::begin(int argc, char** argv) {
  prepare_heap();
  g_name = name_.c_str();
  install_crash_handler(g_name);
  occupy_standard_streams();
  install_signal_handlers();
  json_ = has_argument(argc, argv, "--json");
}

std::vector<std::string> ToolMain::long_names() const {
  std::vector<std::string> names;
  const auto add = [&](const CLI::Option* option) {
    for (const std::string& name : option->get_lnames()) names.push_back(name);
  };
  for (const CLI::Option* option : app_.get_options()) add(option);
  for (const OptionSet* set : stages_)
    for (const CLI::Option* option : set->content()) add(option);
  return names;
}

std::optional<std::string> ToolMain::parse(int argc, char** argv) {
  if (has_argument(argc, argv, "--print-options")) return print_options();
  const bool lists_inputs = has_argument(argc, argv, "--print-inputs");
  if (lists_inputs)
    for (CLI::Option* option : app_.get_options()) option->required(false);
  try {
    std::vector<std::string> arguments = reversed_arguments(argc, argv);
    app_.parse(arguments);
  } catch (const CLI::CallForHelp&) {
    return help(HelpDetail::kMain);
  } catch (const CLI::CallForAllHelp&) {
    return help(HelpDetail::kAll);
  } catch (const CLI::CallForVersion& e) {
    return std::string(e.what()) + "\n";
  } catch (const CLI::ExtrasError&) {
    refuse_argument(app_.remaining().front(), long_names(), name_);
  } catch (const CLI::ParseError& e) {
    if (!app_.remaining().empty())
      refuse_argument(app_.remaining().front(), long_names(), name_);  // the cause of what is missing
    throw Error(ExitCode::kUsage, usage_message(e, name_));
  }
  if (!options_file_.empty()) {
    const auto tables_of = [&](const std::string& flag) {
      std::vector<std::string> tables;
      for (const OptionSet* stage : stages_with(flag)) tables.push_back(stage->name());
      return tables;
    };
    apply_option_file(options_file_, name_, app_, OptionFileTop::kHolds, tables_of);
    for (OptionSet* set : stages_) set->apply_file(options_file_, OptionFileTop::kIsOfAnother);
  }
  settings_ = settings_by_table();
  apply_preset();
  for (OptionSet* set : stages_) set->apply_preset();
  if (quiet_ && verbose_) throw Error(ExitCode::kUsage, "--quiet and --verbose cannot be used together; leave one out");
  const Verbosity usual = stages_.empty() ? Verbosity::kNormal : Verbosity::kBrief;
  set_verbosity(quiet_ ? Verbosity::kQuiet : verbose_ ? Verbosity::kVerbose : usual);
  set_rules();
  for (const std::string& path : all_input_files()) refuse_pipe(path);
  if (!lists_inputs) return std::nullopt;
  std::string lines;
  for (const std::string& path : all_input_files()) lines += path + "\n";
  return lines;
}

std::vector<std::string> ToolMain::all_input_files() const {
  std::vector<std::string> files = input_files();
  for (const OptionSet* set : stages_)
    for (const std::string& path : set->input_files()) files.push_back(path);
  return files;
}

std::vector<std::string> ToolMain::settings_files() const {
  std::vector<std::string> files;
  if (!options_file_.empty()) files.push_back(options_file_);
  for (const OptionSet* set : stages_)
    for (const std::string& path : set->input_files()) files.push_back(path);
  return files;
}

ToolMain::OutputPaths ToolMain::outputs_by_origin() const {
  const auto is_replaced = [](const CLI::Option* option) {
    const auto& others = option->get_excludes();
    return std::any_of(others.begin(), others.end(), [](const CLI::Option* other) { return other->count() > 0; });
  };
  OutputPaths outputs;
  for (const CLI::Option* option : output_options_) {
    const auto paths = option->results();
    outputs.named.insert(outputs.named.end(), paths.begin(), paths.end());
    if (paths.empty() && !is_replaced(option) && !option->get_default_str().empty())
      outputs.defaults.push_back(option->get_default_str());
  }
  return outputs;
}

std::vector<std::string> ToolMain::output_paths() const {
  auto [paths, defaults] = outputs_by_origin();
  paths.insert(paths.end(), defaults.begin(), defaults.end());
  return paths;
}

void ToolMain::set_rules() const {
  OutputRules rules;
  rules.inputs = all_input_files();
  if (!options_file_.empty()) rules.inputs.push_back(options_file_);
  OutputPaths outputs = outputs_by_origin();
  rules.named = replaces_own_ ? std::vector<std::string>() : std::move(outputs.named);
  rules.defaults = replaces_own_ ? output_paths() : std::move(outputs.defaults);
  rules.is_artifact = [](const std::string& path) {
    try {
      return !read_header(path).schema.empty();
    } catch (const Error&) {
      return false;
    }
  };
  set_output_rules(std::move(rules));
}

void ToolMain::watch_time(const std::function<void(ExitCode, const std::string&)>& report) const {
  std::string where;  // the first of the inputs
  for (const std::string& path : input_files())
    if (where.empty()) where = path + ": ";
  std::ostringstream seconds;
  seconds << wall_limit_;
  const std::string message = where + "not done within " + seconds.str() +
                              " s: the input is damaged, or needs more; give it more with --wall-limit";
  watch_wall_time(wall_limit_, [report, message] {
    remove_temporaries();
    note_end();
    report(ExitCode::kInput, message);
    return static_cast<int>(ExitCode::kInput);
  });
}

void ToolMain::print_summary(const StageSummary& summary) const {
  const std::string text = without_hidden_folders(json_ ? summary.json : printable(summary.line));
  const bool is_said = json_ || kind_ == Kind::kReport || !quiet_ || summary.code != ExitCode::kOk;
  if (!text.empty() && is_said) {
    std::fputs(text.c_str(), stdout);
    if (text.back() != '\n') std::fputc('\n', stdout);
  }
  if (std::fflush(stdout) == 0) return;
  if (kind_ == Kind::kReport || json_) throw Error(ExitCode::kOutput, "stdout: cannot write the summary");
  log_warning("stdout cannot be written; the output files are complete");
}

void ToolMain::print_text(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  if (std::fflush(stdout) != 0) throw Error(ExitCode::kOutput, "stdout: cannot be written");
}

void ToolMain::print_error(ExitCode code, const std::string& whole_message) const {
  const std::string message = without_hidden_folders(whole_message);
  if (json_) {
    const nlohmann::json object = {{"error", message}, {"exit_code", static_cast<int>(code)}, {"tool", name_}};
    std::puts(json_text(object).c_str());
    std::fflush(stdout);
  }
  const std::string line = name_ + ": error: " + one_line(message) + "\n";
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
}

ExitCode ToolMain::guard(const std::function<ExitCode()>& action,
                         const std::function<void(ExitCode, const std::string&)>& report) {
  const auto fail = [&](ExitCode code, const std::string& message) {
    report(code, message);
    return code;
  };
  try {
    return action();
  } catch (const Error& e) {
    return fail(e.code(), e.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::kMemory, out_of_memory("").what());
  } catch (const std::exception& e) {
    return fail(ExitCode::kInternal, std::string("internal error: ") + e.what());
  } catch (...) {
    return fail(ExitCode::kInternal, "internal error: unknown exception");
  }
}

int ToolMain::run(int argc, char** argv, const std::function<StageSummary()>& stage) {
  begin(argc, argv);
  const auto action = [&] {
    if (const auto text = parse(argc, argv)) {
      print_text(*text);
      return ExitCode::kOk;
    }
    watch_time([&](ExitCode code, const std::string& message) { print_error(code, message); });
    set_thread_count(n_threads_.value_or(processor_count()));
    end_with_memory();
    const StageSummary summary = stage();
    print_summary(summary);
    return summary.code;
  };
  return static_cast<int>(
      guard(action, [&](ExitCode code, const std::string& message) { print_error(code, message); }));
}

int ToolMain::work(const Worker& worker) const {
  const auto report = [&](ExitCode code, const std::string& message) { print_error(code, message); };
  const auto action = [&] {
    if (worker.is_timed()) watch_time(report);
    set_thread_count(n_threads_.value_or(processor_count()));
    if (n_tries() < kMostTries) leave_restart_to_parent();
    const StageSummary summary = worker.stage();
    print_summary(summary);
    return summary.code;
  };
  return static_cast<int>(guard(action, report));
}

int ToolMain::run_in_worker(int argc, char** argv, const Worker& worker) {
  begin(argc, argv);
  const auto action = [&] {
    if (const auto text = parse(argc, argv)) {
      print_text(*text);
      return ExitCode::kOk;
    }
    if (launched_ranks() > 1)
      throw Error(ExitCode::kUsage, "each of " + std::to_string(launched_ranks()) +
                                        " ranks would do the whole run; start " + name_ +
                                        " without a launcher, and give it the number of ranks by --np");
    worker.prepare();
    ProgramEnd end;
    for (;; count_try()) {
      end = run_forked([&] { return work(worker); });
      if (end.exit_code != kAgain) break;
    }
    if (!end.is_signalled) return static_cast<ExitCode>(end.exit_code);
    const int signal = end.exit_code - 128;
    throw Error(static_cast<ExitCode>(end.exit_code),
                worker.where() + ": was ended by " + signal_text(signal) +
                    (signal == SIGKILL ? "; out of memory? use larger lengths, or a machine with more memory"
                                       : "; a defect: please report it with the CAD file"));
  };
  return static_cast<int>(
      guard(action, [&](ExitCode code, const std::string& message) { print_error(code, message); }));
}

}  // namespace st
