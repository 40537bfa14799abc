#include "st-run/campaign.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/error.h"
#include "base/log.h"
#include "base/own_program.h"
#include "base/threads.h"
#include "io/file/json_text.h"
#include "io/file/output_files.h"
#include "io/file/temporary_file.h"
#include "io/file/text_file.h"
#include "io/hdf5/artifact.h"
#include "stages/report_stage.h"
#include "stages/thumbnail.h"

namespace st {
namespace {

namespace fs = std::filesystem;

/// The child: becomes st-run, with its output in these files. `program`, `words`: made before the fork.
[[noreturn]] void become(const std::string& program, std::vector<char*> words, const std::string& said,
                         const std::string& log) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  const auto send = [](int stream, const std::string& path) {
    const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file >= 0) dup2(file, stream);
  };
  send(STDOUT_FILENO, said);
  send(STDERR_FILENO, log);
  execv("/proc/self/exe", words.data());  // this very file, where a newer one has its name by now
  execv(program.c_str(), words.data());
  _exit(127);
}

std::string text_or_nothing(const std::string& path) {
  try {
    return read_text_file(path);
  } catch (const Error&) {
    return "";
  }
}

/// "" where the mesh cannot be read.
std::string picture_of(const std::string& mesh) {
  try {
    return thumbnail(read_mesh(mesh).mesh);
  } catch (const Error&) {
    return "";
  }
}

}  // namespace

void Campaign::prepare(const ToolMain& tool) {
  for (const char* flag : {"--output", "--export", "--report", "--keep"})
    if (tool.is_set(flag))
      throw Error(ExitCode::kUsage,
                  std::string(flag) + ": is for one model; results of several are in the folders of --into");
  std::error_code error;
  fs::create_directories(o_.into, error);
  if (!fs::is_directory(o_.into))
    throw Error(ExitCode::kOutput, o_.into + ": cannot be made as a folder; choose another one with --into");
  lock_.emplace(o_.into);
  const std::string settings = o_.into + "/st-run.toml";
  if (o_.table.empty()) o_.table = o_.into + "/results.csv";
  require_derived_outputs({settings});
  require_writable(o_.table);
  if (!o_.page.empty()) require_page(o_.page);
  write_text_file(settings, tool.settings());
  const int threads = tool.n_threads().value_or(std::max(1, processor_count() / o_.jobs));
  arguments_ = {"--options",
                settings,
                "--json",
                "--threads",
                std::to_string(threads),
                "--np",
                std::to_string(tool.n_ranks()),
                "--wall-limit",
                fmt::format("{}", tool.wall_limit())};
  const std::vector<CampaignRow> earlier = read_campaign_table(text_or_nothing(o_.table));
  const std::vector<std::string> names = campaign_names(o_.models, earlier);
  const std::string settings_key = campaign_key(tool.settings() + o_.into, tool.settings_files());
  for (std::size_t i = 0; i < names.size(); ++i) {
    CampaignRow row;
    row.model = o_.models[i];
    row.name = names[i];
    row.key = settings_key.empty() ? "" : campaign_key(settings_key, {&row.model, 1});
    rows_.push_back(std::move(row));
  }
  take_earlier_rows(earlier);
}

void Campaign::take_earlier_rows(const std::vector<CampaignRow>& earlier) {
  for (const CampaignRow& e : earlier) {
    const auto row = std::find_if(rows_.begin(), rows_.end(), [&](const CampaignRow& r) { return r.name == e.name; });
    if (row == rows_.end())
      others_.push_back(e);
    else if (!row->key.empty() && row->key == e.key && e.verdict != "error" &&
             fs::exists(o_.into + "/" + e.name + "/mesh.hdf"))
      *row = e;
  }
}

Campaign::Job Campaign::start(std::size_t model) const {
  const std::string at = folder(model);
  fs::create_directories(at);
  std::vector<std::string> words{"st-run", o_.models[model], "-o", at + "/mesh.hdf", "--report", at + "/report.html"};
  words.insert(words.end(), arguments_.begin(), arguments_.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const std::string said = at + "/said.json", log = at + "/log.txt", program = own_program();
  Job job;
  job.model = model;
  job.process = fork();
  if (job.process == 0) become(program, argv, said, log);
  if (job.process < 0)
    throw Error(ExitCode::kInternal, std::string("fork: ") + std::strerror(errno) + "; end some processes");
  return job;
}

void Campaign::finish(const Job& job, int status) {
  CampaignRow& row = rows_[job.model];
  const int code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  const std::string key = row.key;
  row = campaign_row(row.model, row.name, code, text_or_nothing(folder(job.model) + "/said.json"), job.timer.seconds());
  row.key = key;
  ++n_done_;
  log_step(fmt::format("{}/{} {}: {}{}{}, {} s", n_done_, rows_.size(), row.name, row.verdict,
                       row.triangles.empty() ? "" : ", " + row.triangles + " triangles",
                       row.reason.empty() ? "" : ", " + (row.message.empty() ? row.reason : row.message), row.seconds));
  write_table();
}

void Campaign::write_table() const {
  std::vector<CampaignRow> done = others_;
  for (const CampaignRow& row : rows_)
    if (!row.verdict.empty()) done.push_back(row);
  write_text_file(o_.table, campaign_table(done));
}

void Campaign::write_page() const {
  if (o_.page.empty()) return;
  std::vector<std::string> pictures;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    pictures.push_back(rows_[i].verdict == "error" ? "" : picture_of(folder(i) + "/mesh.hdf"));
  }
  const fs::path beside = fs::absolute(o_.page).parent_path();
  write_text_file(o_.page, campaign_page(rows_, pictures, fs::absolute(o_.into).lexically_relative(beside).string()));
}

StageSummary Campaign::run() {
  std::vector<Job> jobs;
  std::size_t next = 0;
  n_done_ = static_cast<std::size_t>(
      std::count_if(rows_.begin(), rows_.end(), [](const auto& r) { return !r.verdict.empty(); }));
  if (n_done_ > 0) log_step(fmt::format("{} of {} models are done already, see {}", n_done_, rows_.size(), o_.table));
  for (;;) {
    while (next < rows_.size() && jobs.size() < static_cast<std::size_t>(o_.jobs)) {
      if (!is_done(next)) jobs.push_back(start(next));
      ++next;
    }
    if (jobs.empty()) break;
    int status = 0;
    const pid_t process = waitpid(-1, &status, 0);
    if (process < 0 && errno != EINTR)
      throw Error(ExitCode::kInternal, std::string("waitpid: ") + std::strerror(errno));
    const auto job = std::find_if(jobs.begin(), jobs.end(), [&](const Job& j) { return j.process == process; });
    if (job == jobs.end()) continue;
    finish(*job, status);
    jobs.erase(job);
  }
  write_table();
  write_page();
  const auto n_passing = static_cast<std::size_t>(
      std::count_if(rows_.begin(), rows_.end(), [](const auto& r) { return r.verdict == "passes"; }));
  StageSummary summary;
  summary.code = n_passing == rows_.size() ? ExitCode::kOk : ExitCode::kIncomplete;
  summary.line = fmt::format("{} models: {}; {}{}", rows_.size(), campaign_summary(rows_), o_.table,
                             o_.page.empty() ? "" : ", " + o_.page);
  summary.json = json_text(nlohmann::json{
      {"tool", "st-run"}, {"models", rows_.size()}, {"passing", n_passing}, {"table", o_.table}, {"page", o_.page}});
  return summary;
}

}  // namespace st
