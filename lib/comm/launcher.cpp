// Where ranks come from: the launcher that started this process, or mpirun, started from here. No MPI is called, so
// that a program without ranks loads none.
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <thread>

#include "base/error.h"
#include "base/own_program.h"
#include "base/supervised_program.h"
#include "comm/communicator.h"
#include "comm/mpirun_needs.h"
#include "comm/mpirun_report.h"

namespace st {

int launched_ranks() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const char* text = std::getenv(name)) return std::max(1, std::atoi(text));
  if (std::getenv("PMI_RANK") || std::getenv("PMIX_RANK")) return -1;
  if (std::getenv("SLURM_PROCID") && std::getenv("SLURM_STEP_ID")) {  // srun; a batch script has no step of its own
    const char* text = std::getenv("SLURM_STEP_NUM_TASKS");
    return text ? std::max(1, std::atoi(text)) : -1;
  }
  return 0;
}

namespace {

/// Many containers forbid what Open MPI copies large messages with, and it complains.
bool may_read_other_processes() {
  char from = 1, to = 0;
  iovec local{&to, 1}, remote{&from, 1};
  return process_vm_readv(getpid(), &local, 1, &remote, 1, 0) == 1;
}

/// Whether a program of this name stands in a folder of PATH.
bool is_on_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((folder + "/" + name).c_str(), X_OK) == 0) return true;
  return false;
}

/// What the ranks need of Open MPI. Settings of the user win (no overwriting).
void set_launch_environment() {
  const std::pair<const char*, const char*> settings[] = {
      {"OMPI_ALLOW_RUN_AS_ROOT", "1"},
      {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"},
      {"OMPI_MCA_rmaps_base_oversubscribe", "1"},
      {"OMPI_MCA_mpi_yield_when_idle", "1"},
      {"OMPI_MCA_pml", "ob1"},  // all ranks are on this machine: no search for a network, a fifth of a second
      {"OMPI_MCA_btl", "self,vader"},
      {"OMPI_MCA_hwloc_base_binding_policy", "none"},
      {"OMPI_MCA_opal_signal", ""},                                 // no stack trace: the signal is reported
      {"PMIX_MCA_gds", "hash"},                                     // the default warns where it may not share memory
      {"PRTE_MCA_rmaps_default_mapping_policy", ":oversubscribe"},  // Open MPI 5
      {"PRTE_MCA_hwloc_default_binding_policy", "none"}};
  for (const auto& [name, value] : settings) setenv(name, value, 0);
  // An mpirun that finds neither of them to reach other machines ends; told that there is none it does without.
  if (!is_on_path("ssh") && !is_on_path("rsh")) setenv("OMPI_MCA_plm_rsh_agent", "", 0);
  setenv("OMPI_MCA_orte_execute_quiet", "0",
         1);  // its banners name the rank that a signal ended; they are not passed on
  if (!may_read_other_processes()) setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 0);
}

/// How long a rank may stand still.
double longest_stop() {
  constexpr double kSeconds = 30;
  const char* text = std::getenv("ST_STOPPED_SECONDS");
  const double seconds = text ? std::atof(text) : 0;
  return seconds > 0 ? seconds : kSeconds;
}

/// The code of the job, or what ended it as an Error.
int code_of(const ProgramEnd& end, const std::optional<LostRank>& lost) {
  if (end.passed_signal > 0) return 128 + end.passed_signal;
  if (lost) throw LostRankError(static_cast<ExitCode>(128 + lost->signal), lost->rank, describe_lost_rank(*lost));
  if (end.was_deaf)
    throw Error(ExitCode::kInternal, "mpirun took no note of the end of a rank (a defect of Open MPI); run again");
  if (end.is_signalled)
    throw Error(static_cast<ExitCode>(end.exit_code),
                "mpirun was ended by " + signal_text(end.exit_code - 128) + ", and with it all ranks; run again");
  constexpr int kDocumented[] = {0, 2, 3, 4, 5, 6, 7, 8, 70};  // by ranks; 128 and more: signals
  const bool is_signal = end.exit_code > 128 && end.exit_code <= 128 + 64;
  if (!is_signal && std::find(std::begin(kDocumented), std::end(kDocumented), end.exit_code) == std::end(kDocumented))
    throw Error(ExitCode::kInternal, "mpirun failed with code " + std::to_string(end.exit_code) +
                                         "; the lines above are its own; leave --np out, or see that mpirun works");
  return end.exit_code;
}

/// Started here; a batch system's job may have many machines.
int most_ranks() {
  constexpr int kPerProcessor = 16, kAlways = 64, kInJob = 1 << 16;
  for (const char* job : {"SLURM_JOB_ID", "PBS_JOBID", "LSB_JOBID", "JOB_ID", "OMPI_MCA_orte_default_hostfile"})
    if (std::getenv(job)) return kInJob;
  return std::max(kAlways, kPerProcessor * static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace

std::optional<int> run_under_mpirun(int n, const std::vector<std::string>& arguments_without_np,
                                    const std::function<void(const std::string& text)>& on_error_text) {
  if (n < 1) throw Error(ExitCode::kUsage, "--np: " + std::to_string(n) + " is not a number of ranks; give 1 or more");
  if (launched_ranks() == 0 && n > most_ranks())
    throw Error(ExitCode::kUsage,
                "--np: " + std::to_string(n) + " ranks are more than 16 per processor of this machine (" +
                    std::to_string(most_ranks()) + "); give fewer, or start them with mpirun yourself");
  if (n == 1 || launched_ranks() != 0) return std::nullopt;
  require_needs_of_mpirun(n);
  set_launch_environment();
  const std::string self = own_program();
  if (self.empty())
    throw Error(ExitCode::kInternal,
                "cannot find the path of this program; start it with mpirun -np " + std::to_string(n));
  std::vector<std::string> words = {"mpirun", "-np", std::to_string(n), self};
  words.insert(words.end(), arguments_without_np.begin(), arguments_without_np.end());
  MpirunReport report;
  ProgramEnd end;
  std::optional<LostRankError> stopped;
  const double seconds = longest_stop();
  const StopWatch watch{seconds, [&](pid_t process) { stopped = stopped_rank(process, seconds); }};
  try {
    end = run_supervised(
        words, [&](const std::string& line) { on_error_text(report.add(line)); }, watch);
  } catch (const Error& e) {
    throw Error(e.code(), std::string(e.what()) + "; install Open MPI (openmpi-bin) or leave --np out");
  }
  if (stopped && end.passed_signal == 0) throw LostRankError(*stopped);
  on_error_text(report.rest());
  if (!end.is_signalled) report.add_exit_code(end.exit_code);
  return code_of(end, report.lost_rank());
}

}  // namespace st
