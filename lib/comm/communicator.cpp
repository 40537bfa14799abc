#include "comm/communicator.h"

#define OMPI_SKIP_MPICXX 1  // the C API alone
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "base/error.h"
#include "comm/local_tasks.h"
#include "comm/mpirun_needs.h"
#include "comm/task_farm.h"

namespace st {
namespace {

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
  require_order(order, n_tasks);
  run_named_tasks({.order = order, .label = {}, .made_from = {}}, compute, collect);
}

void Communicator::run_named_tasks(const NamedTasks& tasks, const std::function<Bytes(std::int32_t task)>& compute,
                                   const std::function<void(std::int32_t task, Bytes&& result)>& collect) const {
  const std::vector<std::int32_t>& order = tasks.order;
  if (impl_->size == 1) return run_local_tasks(order, compute, collect);
  require_order(order, static_cast<std::int64_t>(order.size()));
  if (impl_->rank == 0)
    distribute_tasks(impl_->size, order, tasks.home, compute, collect, tasks.answer);
  else
    work_on_tasks(compute, tasks.answer);
}

std::vector<Bytes> Communicator::ask(const std::vector<Request>& requests) const { return ask_ranks(requests); }

}  // namespace st
