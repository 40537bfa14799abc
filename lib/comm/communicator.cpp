#include "comm/communicator.h"

#define OMPI_SKIP_MPICXX 1  // the C API alone
#include <mpi.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <thread>
#include <utility>

#include "base/current_work.h"
#include "base/error.h"
#include "base/own_program.h"
#include "base/supervised_program.h"
#include "base/threads.h"
#include "comm/mpirun_needs.h"
#include "comm/mpirun_report.h"
#include "comm/task_farm.h"

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

void require_mpi(int status, const char* what) {
  if (status != MPI_SUCCESS) throw Error(ExitCode::kInternal, std::string("MPI failed: ") + what);
}

constexpr int kTagGather = 4;  // task_farm.cpp has the others

/// Bytes in pieces that MPI can count.
template <class Transfer>
void for_each_piece(Bytes& bytes, const Transfer& transfer) {
  for (std::uint64_t start = 0; start < bytes.size(); start += kMaxMessageBytes)
    require_mpi(transfer(bytes.data() + start,
                         static_cast<int>(std::min<std::uint64_t>(kMaxMessageBytes, bytes.size() - start))),
                "the transfer of bytes");
}

/// Waits for a request asleep.
void wait_asleep(MPI_Request& request) {
  for (Backoff backoff;; backoff.sleep()) {
    int done = 0;
    require_mpi(MPI_Test(&request, &done, MPI_STATUS_IGNORE), "MPI_Test");
    if (done) return;
  }
}

}  // namespace

struct Communicator::Impl {
  int rank = 0, size = 1;
  bool is_initialised = false;
};

Communicator::Communicator() : impl_(std::make_unique<Impl>()) {
  const int launched = launched_ranks();
  if (launched == 0) return;
  setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
  choose_folder_of_messages(std::max(launched, 1));
  int provided = 0;
  require_mpi(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided), "MPI_Init_thread");
  impl_->is_initialised = true;
  MPI_Comm_rank(MPI_COMM_WORLD, &impl_->rank);
  MPI_Comm_size(MPI_COMM_WORLD, &impl_->size);
  if (launched > 1 && impl_->size == 1)
    throw Error(ExitCode::kUsage, "the launcher started " + std::to_string(launched) +
                                      " processes, but MPI does not connect them; start with Open MPI's mpirun, " +
                                      "with srun --mpi=pmix, or with --np N and no launcher");
}

Communicator::~Communicator() {
  if (!impl_->is_initialised) return;
  try {
    barrier();  // MPI_Finalize itself would spin
  } catch (const Error&) {
  }
  MPI_Finalize();
}

int Communicator::rank() const { return impl_->rank; }
int Communicator::size() const { return impl_->size; }

void Communicator::barrier() const {
  if (impl_->size == 1) return;
  MPI_Request request;
  require_mpi(MPI_Ibarrier(MPI_COMM_WORLD, &request), "MPI_Ibarrier");
  wait_asleep(request);
}

namespace {

constexpr int kMinScattered = 1 << 20;  // bytes

/// Rank 0's bytes on every rank: a share to each, and all shares to all. However many ranks there are, they pass each
/// link about twice (Van de Geijn, Global combine operations, J. Parallel Distrib. Comput. 22, 1994).
int scatter_and_gather(std::byte* bytes, int count, int n_ranks, bool is_root) {
  const int share = count / n_ranks, rest = count % n_ranks;
  void* in_place = MPI_IN_PLACE;
  int rank = 0, failed = MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  std::byte* own = bytes + static_cast<std::ptrdiff_t>(rank) * share;
  if (!failed)
    failed = MPI_Scatter(bytes, share, MPI_BYTE, is_root ? in_place : own, share, MPI_BYTE, 0, MPI_COMM_WORLD);
  if (!failed) failed = MPI_Allgather(in_place, 0, MPI_BYTE, bytes, share, MPI_BYTE, MPI_COMM_WORLD);
  if (!failed) failed = MPI_Bcast(bytes + count - rest, rest, MPI_BYTE, 0, MPI_COMM_WORLD);
  return failed;
}

}  // namespace

void Communicator::broadcast(Bytes& bytes) const {
  if (impl_->size == 1) return;
  barrier();  // whoever comes early waits asleep
  std::uint64_t n = bytes.size();
  require_mpi(MPI_Bcast(&n, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD), "MPI_Bcast");
  bytes.resize(n);
  const auto in_pieces = [&](std::byte* piece, int count) {
    return count < kMinScattered ? MPI_Bcast(piece, count, MPI_BYTE, 0, MPI_COMM_WORLD)
                                 : scatter_and_gather(piece, count, impl_->size, is_root());
  };
  for_each_piece(bytes, in_pieces);
}

std::vector<Bytes> Communicator::gather(Bytes own) const {
  std::vector<Bytes> all;
  if (impl_->size > 1) barrier();  // whoever comes early waits asleep
  std::uint64_t n = own.size();
  std::vector<std::uint64_t> counts(static_cast<std::size_t>(impl_->size), n);
  if (impl_->size > 1)
    require_mpi(MPI_Gather(&n, 1, MPI_UINT64_T, counts.data(), 1, MPI_UINT64_T, 0, MPI_COMM_WORLD), "MPI_Gather");
  if (is_root()) {
    all.push_back(std::move(own));
    for (int rank = 1; rank < impl_->size; ++rank) {
      all.emplace_back(counts[static_cast<std::size_t>(rank)]);
      for_each_piece(all.back(), [&](std::byte* piece, int count) {
        return MPI_Recv(piece, count, MPI_BYTE, rank, kTagGather, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
      });
    }
  } else {
    for_each_piece(own, [](std::byte* piece, int count) {
      return MPI_Send(piece, count, MPI_BYTE, 0, kTagGather, MPI_COMM_WORLD);
    });
  }
  return all;
}

void Communicator::reduce_min(std::vector<std::uint64_t>& values) const {
  if (impl_->size == 1) return;
  barrier();  // whoever comes early waits asleep
  constexpr std::uint64_t kPiece = kMaxMessageBytes / sizeof(std::uint64_t);
  for (std::uint64_t start = 0; start < values.size(); start += kPiece) {
    std::uint64_t* piece = values.data() + start;
    const int count = static_cast<int>(std::min<std::uint64_t>(kPiece, values.size() - start));
    require_mpi(MPI_Reduce(is_root() ? MPI_IN_PLACE : piece, is_root() ? piece : nullptr, count, MPI_UINT64_T, MPI_MIN,
                           0, MPI_COMM_WORLD),
                "MPI_Reduce");
  }
}

void Communicator::abort(int exit_code) const {
  if (impl_->is_initialised) MPI_Abort(MPI_COMM_WORLD, exit_code);
  _exit(exit_code);
}

void Communicator::run_tasks(std::int32_t n_tasks, const std::vector<std::int32_t>& order,
                             const std::function<Bytes(std::int32_t task)>& compute,
                             const std::function<void(std::int32_t task, Bytes&& result)>& collect) const {
  if (n_tasks < 0 || order.size() != static_cast<std::size_t>(n_tasks))
    throw Error(ExitCode::kInternal, "run_tasks: the order does not list every task once");
  run_named_tasks({.order = order, .label = {}, .made_from = {}}, compute, collect);
}

void Communicator::run_named_tasks(const NamedTasks& tasks, const std::function<Bytes(std::int32_t task)>& compute,
                                   const std::function<void(std::int32_t task, Bytes&& result)>& collect) const {
  const std::vector<std::int32_t>& order = tasks.order;
  std::vector<char> is_listed(order.size(), 0);
  for (const std::int32_t task : order)
    if (task < 0 || static_cast<std::size_t>(task) >= order.size() || is_listed[task]++)
      throw Error(ExitCode::kInternal, "run_tasks: the order is no permutation of the tasks");
  if (impl_->size == 1) {
    std::mutex mutex;
    parallel_for(order.size(), 1, [&](std::size_t i, std::size_t) {
      Bytes result = with_memory_named([&] { return compute(order[i]); });
      const std::lock_guard lock(mutex);
      collect(order[i], std::move(result));
    });
  } else if (impl_->rank == 0) {
    distribute_tasks(impl_->size, order, tasks.home, compute, collect, tasks.answer);
  } else {
    work_on_tasks(compute, tasks.answer);
  }
}

std::vector<Bytes> Communicator::ask(const std::vector<Request>& requests) const { return ask_ranks(requests); }

namespace {

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
