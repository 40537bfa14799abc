// The part of ToolMain that knows of ranks; apart, so that serial tools do not load MPI.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <thread>

#include "base/log.h"
#include "base/memory.h"
#include "base/progress.h"
#include "base/threads.h"
#include "comm/communicator.h"
#include "comm/mpirun_report.h"
#include "common/crash_handler.h"
#include "common/tool_main.h"
#include "io/file/journal.h"
#include "io/file/temporary_file.h"
#include "io/hdf5/artifact.h"

namespace st {
namespace {

constexpr std::chrono::seconds kLongestEnd{30};  // that mpirun may need to end all ranks

/// The arguments after the program's name, without --np N and --np=N.
std::vector<std::string> arguments_without_np(int argc, char** argv) {
  std::vector<std::string> arguments;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--np") == 0)
      ++i;
    else if (std::strncmp(argv[i], "--np=", 5) != 0)
      arguments.emplace_back(argv[i]);
  }
  return arguments;
}

/// Most errors strike all ranks at once. The first rank speaks for all; another speaks only when the job is still alive
/// after this time.
void wait_for_lower_ranks(int rank) {
  if (rank > 0) std::this_thread::sleep_for(std::chrono::milliseconds(1000 + 200 * std::min(rank, 20)));
}

/// A rank was ended by a signal that neither the user nor the batch system sends to end a job.
bool is_defect_or_kill(ExitCode code) {
  const int signal = static_cast<int>(code) - 128;
  return signal == SIGSEGV || signal == SIGABRT || signal == SIGBUS || signal == SIGFPE || signal == SIGILL ||
         signal == SIGKILL;
}

/// Tells the same of ranks that ended themselves: a late face, or no memory.
bool is_defect_or_memory(int code) {
  return code == static_cast<int>(ExitCode::kInternal) || code == static_cast<int>(ExitCode::kMemory);
}

/// Deaths and crashes in the journals of these outputs.
std::size_t n_noted(const std::vector<std::string>& outputs) {
  std::size_t n = 0;
  for (const std::string& path : outputs) n += count_deaths(path);
  return n;
}

/// "; it was at face 12", by the journals of these outputs; "" where they do not know.
std::string faces_of(int rank, const std::vector<std::string>& outputs) {
  std::string text;
  for (const std::string& path : outputs)
    for (const FaceId face : faces_under_way(path, rank)) text += (text.empty() ? "" : ", ") + std::to_string(face + 1);
  return text.empty() ? "" : "; it was at face " + text;
}

/// What ranks say, as it comes.
void print_error_text(const std::string& text) {
  if (relay_progress(text)) return;
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

}  // namespace

std::optional<int> ToolMain::start_ranks_once(const std::vector<std::string>& arguments) const {
  const auto clean_up = [&] {
    for (const std::string& path : output_paths()) remove_left_temporaries(path);
  };
  try {
    return run_under_mpirun(n_ranks_, arguments, print_error_text);
  } catch (const LostRankError& e) {
    clean_up();
    throw Error(e.code(), e.what() + faces_of(e.rank(), output_paths()));
  } catch (const Error&) {
    clean_up();
    throw;
  }
}

std::optional<int> ToolMain::start_ranks(const std::vector<std::string>& arguments) const {
  if (n_ranks_ > 1) offer_progress_relay();
  for (;; count_try()) {
    const bool is_last = !restarts_after_crash_ || n_ranks_ == 1 || n_tries() >= kMostTries;
    const std::size_t n_before = is_last ? 0 : n_noted(output_paths());
    const auto has_news = [&] { return !is_last && n_noted(output_paths()) > n_before; };
    try {
      const std::optional<int> code = start_ranks_once(arguments);
      if (!code || !is_defect_or_memory(*code) || !has_news()) return code;
      log_warning("going on with what is finished");
    } catch (const Error& e) {
      if (!is_defect_or_kill(e.code()) || !has_news()) throw;
      log_warning(std::string(e.what()) + "; going on with what is finished");
    }
  }
}

int ToolMain::run_parallel(int argc, char** argv, const std::function<StageSummary(const Communicator&)>& stage) {
  begin(argc, argv);
  ranks();
  threads();
  std::optional<std::string> text;
  std::optional<int> job_code;  // of ranks that were started here
  std::exception_ptr usage_error;
  std::unique_ptr<Communicator> comm;
  const auto start = [&] {
    try {
      text = parse(argc, argv);
      if (!text) job_code = start_ranks(arguments_without_np(argc, argv));
    } catch (...) {
      usage_error = std::current_exception();
    }
    if (job_code) return;
    comm = std::make_unique<Communicator>();
    if (usage_error) std::rethrow_exception(usage_error);
  };
  const auto report = [&](ExitCode code, const std::string& message) {
    if (comm) wait_for_lower_ranks(comm->rank());
    const bool has_rank = !comm || comm->size() == 1 || message.starts_with("rank ");
    print_error(code,
                code == ExitCode::kMemory && !has_rank ? rank_on_this_host(comm->rank()) + ": " + message : message);
    if (comm && comm->size() > 1) comm->abort(static_cast<int>(code));
  };
  const auto action = [&] {
    start();
    if (job_code) return static_cast<ExitCode>(*job_code);
    if (!comm->is_root()) set_verbosity(Verbosity::kQuiet);
    if (text) {
      if (comm->is_root()) print_text(*text);
      return ExitCode::kOk;
    }
    watch_time([&](ExitCode code, const std::string& message) {
      if (!comm->is_root()) std::this_thread::sleep_for(kLongestEnd);
      report(code, message);
    });
    set_thread_count(n_threads_.value_or(comm->size() > 1 ? 1 : processor_count()));
    if (restarts_after_crash_) watch_late_work();
    if (restarts_after_crash_ && comm->size() == 1) restart_after_crashes(argv);
    end_with_memory();
    const StageSummary summary = stage(*comm);
    if (comm->is_root()) print_summary(summary);
    return summary.code;
  };
  return static_cast<int>(guard(action, report));
}

}  // namespace st
