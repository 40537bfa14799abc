#include "st-run/one_run.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/log.h"
#include "base/own_program.h"
#include "base/progress.h"
#include "base/supervised_program.h"
#include "common/crash_handler.h"
#include "common/stage_options.h"
#include "io/file/output_files.h"
#include "io/file/text_file.h"
#include "io/hdf5/kept_listings.h"

namespace st {
namespace {

namespace fs = std::filesystem;

constexpr char kOptions[] = "st-run.toml";

void make_folder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error || !fs::is_directory(path))
    throw Error(ExitCode::kOutput, path + ": cannot be made as a folder (" +
                                       (error ? error.message() : std::string("a file is there")) +
                                       "); choose another one with --keep");
}

int memory_file() { return memfd_create("said", MFD_CLOEXEC); }

std::string text_of(int file) {
  std::string all;
  char piece[4096];
  for (ssize_t n = 0; (n = pread(file, piece, sizeof piece, static_cast<off_t>(all.size()))) > 0;)
    all.append(piece, static_cast<std::size_t>(n));
  return all;
}

/// What is written to stdout while it lives, by programs that are started, too.
class CapturedOutput {
 public:
  CapturedOutput() : saved_(dup(STDOUT_FILENO)), file_(memory_file()) {
    std::fflush(stdout);
    dup2(file_, STDOUT_FILENO);
  }
  ~CapturedOutput() {
    dup2(saved_, STDOUT_FILENO);
    close(saved_);
    close(file_);
  }
  CapturedOutput(const CapturedOutput&) = delete;
  CapturedOutput& operator=(const CapturedOutput&) = delete;
  std::string text() const { return text_of(file_); }

 private:
  int saved_, file_;
};

/// What a tool says on stderr, without its errors, which are told otherwise, and its tables, where they are not wanted.
void pass_on_line(const std::string& line, const std::string& tool) {
  const bool is_table = line.starts_with("  ") && verbosity() < Verbosity::kNormal;
  if (!line.starts_with(tool + ": error: ") && !is_table && !relay_progress(line))
    std::fputs(without_hidden_folders(line).c_str(), stderr);
}

}  // namespace

OneRun::OneRun() : said_(memory_file()) {
  declare(import_, options.import_options);
  declare(raster_, options.raster);
  declare(prolong_, options.prolong);
  declare(mesh_, options.mesh);
  declare(merge_, options.merge);
  declare(check_, options.check);
  void* shared = mmap(nullptr, sizeof(int), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  part_ = shared == MAP_FAILED ? new int(0) : static_cast<int*>(shared);
}

void OneRun::add_stages(ToolMain& tool) {
  for (OptionSet* set : {&import_, &raster_, &prolong_, &mesh_, &merge_, &check_}) tool.stage(*set);
}

void OneRun::prepare(const ToolMain& tool) {
  note_what_is_set(raster_, options.raster);
  if (!options.keep.empty()) {
    make_folder(options.keep);
    lock_.emplace(options.keep);
    if (fs::exists(options.keep + "/model.ref"))
      throw Error(ExitCode::kOutput,
                  options.keep + ": holds results of make; choose another folder, or run make there");
    if (!tool.is_set("--output")) options.output = options.keep + "/" + options.output;
  }
  require_run_outputs(options);
  keep_listings();
  if (options.keep.empty()) {
    const fs::path beside = fs::path(options.output).parent_path();
    folder_.emplace(beside.empty() ? "." : beside.string());
    for (const std::string& folder : folder_->folders()) hide_folder(folder);
  }
  settings_ = place(kOptions, 0);
  require_derived_outputs({settings_});
  write_text_file(settings_,
                  "# model " + fs::absolute(options.model).lexically_normal().string() + "\n" + tool.settings());
  if (tool.n_ranks() == 1) return;
  of_ranks_ = {"--options", settings_, "--json", "--np", std::to_string(tool.n_ranks())};
  if (const auto n = tool.n_threads()) of_ranks_.insert(of_ranks_.end(), {"--threads", std::to_string(*n)});
}

StageSummary OneRun::run_ranks(RunPart part, const std::vector<std::string>& inputs, const std::string& output) const {
  std::vector<std::string> words{fs::path(own_program()).parent_path() / tool_of(part)};
  words.insert(words.end(), inputs.begin(), inputs.end());
  words.insert(words.end(), {"-o", output});
  words.insert(words.end(), of_ranks_.begin(), of_ranks_.end());
  const CapturedOutput said;
  const ProgramEnd end = run_supervised(words, [&](const std::string& line) { pass_on_line(line, tool_of(part)); });
  const auto code = static_cast<ExitCode>(end.exit_code);
  const std::string text = said.text();
  const auto json = nlohmann::json::parse(text.substr(0, text.find_last_not_of('\n') + 1), nullptr, false);
  if (end.passed_signal > 0) _exit(128 + end.passed_signal);
  if (json.is_discarded() || json.contains("error"))
    throw Error(code, json.is_discarded() ? "ended with code " + std::to_string(end.exit_code)
                                          : json["error"].get<std::string>());
  const double seconds = json.value("seconds", 0.0);
  return {fmt::format("on {} ranks, {:.2f} s", of_ranks_[4], seconds), text, code};
}

std::string OneRun::place(const std::string& name, std::uint64_t bytes) {
  if (!folder_) return options.keep + "/" + name;
  const std::string there = folder_->find(name);
  return there.empty() ? folder_->place(name, bytes) : there;
}

void OneRun::begin_part(RunPart part) {
  *part_ = static_cast<int>(part);
  static std::string name;
  name = std::string(tool_of(part)) + ": ";
  name_part(name.c_str());
  if (part == RunPart::kMesh) watch_late_work();
}

StageSummary OneRun::run() {
  if (n_tries() > 0) {
    options.first = RunPart::kMesh;
    options.said = text_of(said_);
  }
  options.on_said = [this](const std::string& json) {  // grows from part to part
    if (pwrite(said_, json.data(), json.size(), 0) < 0) log_warning("what a stage said cannot be kept in memory");
  };
  options.on_part = [this](RunPart part) { begin_part(part); };
  if (!of_ranks_.empty())
    options.run_ranks = [this](RunPart part, const auto& inputs, const std::string& output) {
      return run_ranks(part, inputs, output);
    };
  return run_all(
      options, [this](const std::string& name, std::uint64_t bytes) { return place(name, bytes); }, Communicator());
}

std::string OneRun::part() const { return tool_of(static_cast<RunPart>(*part_)); }

}  // namespace st
