#include "comm/mpirun_report.h"

#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>
#include <regex>
#include <sstream>
#include <utility>

#include "base/supervised_program.h"

namespace st {
namespace {

bool is_rule(const std::string& line) {
  constexpr std::size_t kRuleLength = 70;  // mpirun draws 74
  const std::size_t end = line.find_first_not_of('-');
  return end >= kRuleLength && (end == std::string::npos || line.find_first_not_of("\r\n", end) == std::string::npos);
}

/// Whether a banner that begins with this line tells how the job ended.
bool tells_the_end(const std::string& line) {
  static const std::regex beginnings(
      "^(Primary job|(mpirun|mpiexec|prterun|orterun) (noticed|detected)|MPI_ABORT was invoked)");
  return std::regex_search(line, beginnings);
}

/// What Open MPI adds when several ranks abort, or when a terminal stops them.
bool is_repetition(const std::string& line) {
  static const std::regex repetition(
      "^(\\[.*\\] (\\d+ more process(es)? .*mpi-abort|Set MCA parameter .orte_base_help_aggregate.|.*ORTE_ERROR_LOG: "
      ".*show_help)|mpirun: Forwarding signal \\d+ to job)");
  return std::regex_search(line, repetition);
}

std::string advice(int signal) {
  switch (signal) {
    case SIGKILL:
      return "out of memory? see the host's system log; use larger lengths, fewer ranks or a machine with more "
             "memory";
    case SIGSEGV:
    case SIGABRT:
    case SIGBUS:
    case SIGFPE:
    case SIGILL:
      return "a defect of the tool: please report it with the input";
    case SIGXCPU:
    case SIGALRM:
    case SIGPROF:
      return "a time limit was reached: request more time, or use larger lengths";
    default:
      return "somebody or the batch system ended it: run again";
  }
}

/// The rank that this process is, by its environment; -1 for any other process.
int rank_of(int process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/environ");
  const std::string name = "OMPI_COMM_WORLD_RANK=";
  for (std::string entry; std::getline(file, entry, '\0');)
    if (entry.starts_with(name)) return std::stoi(entry.substr(name.size()));
  return -1;
}

std::string host_name() {
  std::array<char, 256> text{};
  if (gethostname(text.data(), text.size() - 1) != 0) return "this host";
  const std::string name = text.data();
  return name.substr(0, name.find('.'));
}

}  // namespace

std::string MpirunReport::add(const std::string& line) {
  read_line(line);
  if (is_rule(line)) {
    block_ += line;
    is_in_block_ = !is_in_block_;
    return is_in_block_ ? "" : rest();
  }
  if (!is_in_block_) return is_repetition(line) ? "" : line;
  is_own_block_ = is_own_block_ || tells_the_end(line);
  block_ += line;
  return "";
}

std::string MpirunReport::rest() {
  std::string text = std::exchange(block_, "");
  if (std::exchange(is_own_block_, false)) text.clear();
  is_in_block_ = false;
  return text;
}

void MpirunReport::add_exit_code(int code) {
  const int signal = code - 128;
  if (!lost_ && signal > 0 && signal < NSIG) lost_ = LostRank{-1, "", signal};
}

void MpirunReport::read_line(const std::string& line) {
  static const std::regex signalled(
      "noticed that process rank (\\d+) with PID \\d+ on node (\\S+) exited on signal (\\d+)");
  static const std::regex process("Process name: \\[\\[\\d+,\\d+\\],(\\d+)\\]"), exit_code("Exit code: +(\\d+)");
  if (lost_) return;
  std::smatch match;
  if (std::regex_search(line, match, signalled)) {
    lost_ = LostRank{std::stoi(match[1]), match[2], std::stoi(match[3])};
  } else if (std::regex_search(line, match, process)) {
    exited_rank_ = std::stoi(match[1]);
  } else if (exited_rank_ >= 0 && std::regex_search(line, match, exit_code) && std::stoi(match[1]) > 128) {
    lost_ = LostRank{exited_rank_, "", std::stoi(match[1]) - 128};
  }
}

std::string describe_lost_rank(const LostRank& lost) {
  return (lost.rank < 0 ? "a rank" : "rank " + std::to_string(lost.rank)) +
         (lost.host.empty() ? "" : " on " + lost.host) + " was ended by " + signal_text(lost.signal) + "; " +
         advice(lost.signal);
}

std::string rank_on_this_host(int rank) { return "rank " + std::to_string(rank) + " on " + host_name(); }

LostRankError stopped_rank(int process, double seconds) {
  const int rank = rank_of(process);
  std::ostringstream text;
  text << (rank < 0 ? "mpirun on " + host_name() : rank_on_this_host(rank)) << " (process " << process
       << ") stood still for " << seconds
       << " s, stopped by a signal; somebody or the batch system did that: run again";
  return {static_cast<ExitCode>(128 + SIGSTOP), rank, text.str()};
}

}  // namespace st
