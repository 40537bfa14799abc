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
#include <sstream>

#include "base/length.h"
#include "base/log.h"
#include "base/mapped_file.h"
#include "base/nearest_name.h"
#include "base/text.h"
#include "base/threads.h"
#include "common/crash_handler.h"
#include "common/option_file.h"
#include "common/presets.h"
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

constexpr NumberOption kWallLimit{"--wall-limit", "SECONDS", "[0.1, 1e9]", ""};

/// Type of an option that names an array in a file.
constexpr const char* kArrayType = "FILE:ARRAY";

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

/// The reading is left to CLI11; only the bounds are checked here, so that "not a number" has one message.
CLI::Validator in_interval(const NumberOption& option) {
  return CLI::Validator(
      [option](std::string& text) {
        double value = 0;
        return CLI::detail::lexical_cast(text, value) ? option.refusal(value) : "'" + text + "' is not a number";
      },
      option.interval);
}

/// 1e6 is a whole number, too: it is written out for options that take one.
CLI::Validator whole_written_out() {
  return CLI::Validator(
      [](std::string& text) {
        constexpr double kMostExact = 9e15;
        double value = 0;
        const bool is_whole = CLI::detail::lexical_cast(text, value) && value == std::floor(value);
        if (is_whole && std::abs(value) < kMostExact) text = std::to_string(static_cast<std::int64_t>(value));
        return std::string();
      },
      "");
}

CLI::Validator a_length(const std::string& flag) {
  return CLI::Validator(
      [flag](std::string& text) {
        try {
          parse_length(text, flag);
          return std::string();
        } catch (const Error& e) {
          return std::string(e.what()).substr(flag.size() + 2);  // the flag's name is put before by CLI11
        }
      },
      "");
}

bool has_argument(int argc, char** argv, std::string_view wanted) {
  return std::any_of(argv + 1, argv + argc, [&](const char* argument) { return argument == wanted; });
}

std::string usage_message(const CLI::ParseError& e, const std::string& tool) {
  std::string text = e.what();
  for (char& c : text)
    if (c == '\n') c = ' ';
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text + "; see " + tool + " --help";
}

/// "--lmn=3" -> ", did you mean '--lmin'"; empty for what is no option, and where nothing is near.
std::string near_option(const std::string& argument, const CLI::App& app) {
  if (!argument.starts_with("-")) return "";
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back(name);
  const std::string word = argument.substr(0, argument.find('='));
  const std::string nearest = nearest_name(word.substr(std::min(word.find_first_not_of('-'), word.size())), names);
  return nearest.empty() ? "" : ", did you mean '--" + nearest + "'";
}

}  // namespace

ToolMain::ToolMain(std::string name, const std::string& description, Kind kind)
    : name_(std::move(name)), kind_(kind), app_(description, name_) {
  app_.get_formatter()->column_width(34);
  app_.footer(kFooter);
  app_.set_help_flag("-h,--help", "print this help and exit");
  app_.set_version_flag("--version", name_ + " " ST_VERSION, "print the version and exit");
  app_.add_option("--options", options_file_,
                  "read options from this file (TOML, long names without dashes); the command line wins")
      ->type_name("FILE");
  app_.add_flag_function(
          "--print-options", [](std::int64_t) {},
          "print an option file that lists every option with its default, and exit")
      ->disable_flag_override();
  app_.add_flag_function(
          "--print-inputs", [](std::int64_t) {}, "print the names of all input files, one per line, and exit")
      ->disable_flag_override();
  app_.add_flag("--replace-own", replaces_own_, "replace a file under the name of an output only where ST wrote it")
      ->disable_flag_override();
  app_.add_option("--wall-limit", wall_limit_, "end with exit code 3 when the run takes longer")
      ->type_name("SECONDS")
      ->check(in_interval(kWallLimit))
      ->capture_default_str();
  auto* quiet = app_.add_flag("-q,--quiet", quiet_, "print errors only")->disable_flag_override();
  app_.add_flag("-v,--verbose", verbose_, "print more about each step")->excludes(quiet)->disable_flag_override();
  app_.add_flag("--json", json_, "print one JSON object as the last line of stdout")->disable_flag_override();
}

void ToolMain::input(const std::string& name, std::string& path, const std::string& help) {
  input_options_.push_back(app_.add_option(name, path, help)->required()->type_name("FILE"));
}

void ToolMain::inputs(const std::string& name, std::vector<std::string>& paths, const std::string& help) {
  input_options_.push_back(app_.add_option(name, paths, help)->required()->type_name("FILE"));
}

void ToolMain::optional_input(const std::string& flag, std::string& path, const std::string& help) {
  input_options_.push_back(app_.add_option(flag, path, help)->type_name("FILE"));
  file_options_.push_back(input_options_.back());
}

void ToolMain::optional_inputs(const std::string& flag, std::vector<std::string>& paths, const std::string& help) {
  input_options_.push_back(app_.add_option(flag, paths, help)->type_name("FILE")->allow_extra_args(false));
  file_options_.push_back(input_options_.back());
  repeated_flags_.push_back(flag);
}

/// The arguments, the last one first; "--sources A B" becomes "--sources A --sources B". Only where the positional
/// arguments stand before: after them B may be one.
std::vector<std::string> ToolMain::reversed_arguments(int argc, char** argv) const {
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
  std::reverse(arguments.begin(), arguments.end());
  return arguments;
}

void ToolMain::optional_array(const std::string& flag, std::string& value, const std::string& help) {
  input_options_.push_back(app_.add_option(flag, value, help)->type_name(kArrayType));
  file_options_.push_back(input_options_.back());
}

void ToolMain::output(std::string& path, const std::string& help) {
  CLI::Option* option = app_.add_option("-o,--output", path, help)->type_name("FILE");
  path.empty() ? option->required() : option->capture_default_str();
  output_options_.push_back(option);
}

void ToolMain::output_option(const std::string& flag, std::string& path, const std::string& help) {
  output_options_.push_back(app_.add_option(flag, path, help)->capture_default_str()->type_name("FILE"));
}

void ToolMain::output_instead(const std::string& flag, std::string& path, const std::string& help) {
  output_option(flag, path, help);
  output_options_.back()->excludes(output_options_.front());
}

void ToolMain::outputs(const std::string& flag, std::vector<std::string>& paths, const std::string& help) {
  output_options_.push_back(app_.add_option(flag, paths, help)->type_name("FILE")->allow_extra_args(false));
}

void ToolMain::length(const std::string& flag, std::string& value, const std::string& default_text,
                      const std::string& help) {
  file_options_.push_back(app_.add_option(flag, value, help)
                              ->type_name("LENGTH")
                              ->default_str(value.empty() ? default_text : value)
                              ->check(a_length(flag)));
}

void ToolMain::unit(const std::string& flag, std::string& value, const std::string& help) {
  const auto check = [](std::string& text) {
    return unit_in_metres(text) ? std::string() : "unknown unit '" + text + "'; write mm, cm, m, in or ft";
  };
  file_options_.push_back(app_.add_option(flag, value, help)->type_name("UNIT")->check(CLI::Validator(check, "")));
}

void ToolMain::text(const std::string& flag, std::string& value, const std::string& type, const std::string& help) {
  CLI::Option* option = app_.add_option(flag, value, help)->type_name(type);
  if (!value.empty()) option->capture_default_str();
  file_options_.push_back(option);
}

void ToolMain::texts(const std::string& flag, std::vector<std::string>& values, const std::string& type,
                     const std::string& help) {
  file_options_.push_back(app_.add_option(flag, values, help)->type_name(type)->allow_extra_args(false));
}

void ToolMain::add_number(const NumberOption& option, CLI::Option* bound) {
  file_options_.push_back(bound->type_name(option.unit)->check(in_interval(option))->transform(whole_written_out()));
}

void ToolMain::flag(const std::string& flag, bool& value, const std::string& help) {
  file_options_.push_back(app_.add_flag(flag, value, help)->disable_flag_override());
}

void ToolMain::threads() {
  static constexpr NumberOption kThreads{
      "--threads", "N", "[1, 4096]", "threads of each process; same result for every number; default: all processors"};
  number(kThreads, n_threads_);
  file_options_.pop_back();  // how a stage runs is no content
}

bool ToolMain::is_set(const std::string& flag) const { return app_.get_option(flag)->count() > 0; }

void ToolMain::preset() {
  text("--preset", preset_, "NAME",
       "settings for a purpose, which all other options override (docs/presets.md): " + preset_names());
}

void ToolMain::examples(const std::vector<std::string>& command_lines) {
  std::string footer = kFooter + std::string("\n\nExamples:");
  for (const std::string& line : command_lines) footer += "\n  " + line;
  app_.footer(footer + "\n\nMore: docs/" + name_ + ".md, installed as " + kPages + name_ + ".md");
}

void ToolMain::begin(int argc, char** argv) {
  g_name = name_.c_str();
  install_crash_handler(g_name);
  occupy_standard_streams();
  install_signal_handlers();
  json_ = has_argument(argc, argv, "--json");
}

std::optional<std::string> ToolMain::parse(int argc, char** argv) {
  if (has_argument(argc, argv, "--print-options")) return option_file_template(name_, file_options_);
  const bool lists_inputs = has_argument(argc, argv, "--print-inputs");
  if (lists_inputs)
    for (CLI::Option* option : app_.get_options()) option->required(false);
  try {
    std::vector<std::string> arguments = reversed_arguments(argc, argv);
    app_.parse(arguments);
  } catch (const CLI::CallForHelp&) {
    return app_.help();
  } catch (const CLI::CallForVersion& e) {
    return std::string(e.what()) + "\n";
  } catch (const CLI::ExtrasError&) {
    const std::string argument = app_.remaining().front();
    throw Error(ExitCode::kUsage,
                "unexpected argument '" + argument + "'" + near_option(argument, app_) + "; see " + name_ + " --help");
  } catch (const CLI::ConversionError& e) {  // what is no number at all has been refused before
    throw Error(ExitCode::kUsage, std::string("a whole number is needed: ").append(usage_message(e, name_)));
  } catch (const CLI::ParseError& e) {
    throw Error(ExitCode::kUsage, usage_message(e, name_));
  }
  if (!options_file_.empty()) apply_option_file(options_file_, name_, app_);
  if (!preset_.empty()) apply_option_text(find_preset(preset_).options, "preset " + preset_, name_, app_);
  if (quiet_ && verbose_) throw Error(ExitCode::kUsage, "--quiet and --verbose cannot be used together; leave one out");
  set_verbosity(quiet_ ? Verbosity::kQuiet : verbose_ ? Verbosity::kVerbose : Verbosity::kNormal);
  set_rules();
  for (const std::string& path : input_files()) refuse_pipe(path);
  if (!lists_inputs) return std::nullopt;
  std::string lines;
  for (const std::string& path : input_files()) lines += path + "\n";
  return lines;
}

std::vector<std::string> ToolMain::input_files() const {
  std::vector<std::string> files;
  for (const CLI::Option* option : input_options_)
    for (const std::string& value : option->results())
      files.push_back(option->get_type_name() == kArrayType ? value.substr(0, value.rfind(':')) : value);
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
  rules.inputs = input_files();
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
  const std::string text = json_ ? summary.json : printable(summary.line);
  if (!text.empty() && (json_ || kind_ == Kind::kReport || !quiet_)) {
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

void ToolMain::print_error(ExitCode code, const std::string& message) const {
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
    const StageSummary summary = stage();
    print_summary(summary);
    return summary.code;
  };
  return static_cast<int>(
      guard(action, [&](ExitCode code, const std::string& message) { print_error(code, message); }));
}

}  // namespace st
