// The only MPI of the project: ranks, broadcast, and a task farm that hands out work on demand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/executor.h"

namespace st {

/// The process group of this run. Without a launcher MPI is never initialised and the group has one rank.
class Communicator : public Executor {
 public:
  /// Initialises MPI when a launcher (Open MPI, PMI/PMIx, Slurm) started this process. One object per process, made in
  /// main.
  Communicator();
  /// Collective: finalises MPI.
  ~Communicator() override;
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;

  int rank() const override;
  int size() const override;

  void broadcast(Bytes& bytes) const override;
  std::vector<Bytes> gather(Bytes own) const override;
  /// Collective: entry by entry the smallest of all ranks' values, on rank 0; the other ranks' are left as they are.
  /// Same length everywhere.
  void reduce_min(std::vector<std::uint64_t>& values) const;
  /// Collective: waits for all ranks without burning a core.
  void barrier() const;
  /// Local: ends every rank at once with this exit code (mpirun takes some tenths of a second). Call after the message
  /// was printed.
  [[noreturn]] void abort(int exit_code) const;

  /// As Executor says. `compute` runs on thread_count() threads of each rank, so it must not call MPI nor share
  /// unguarded state with `collect`, which runs under a lock: at one rank on the thread of the task, at more on the
  /// main thread of rank 0. Of several exceptions one rank throws the one of the first task in the order, several ranks
  /// the first that arrives; the other ranks stay in the call, so the job can then only be ended with abort().
  void run_tasks(std::int32_t n_tasks, const std::vector<std::int32_t>& order,
                 const std::function<Bytes(std::int32_t task)>& compute,
                 const std::function<void(std::int32_t task, Bytes&& result)>& collect) const override;
  void run_named_tasks(const NamedTasks& tasks, const std::function<Bytes(std::int32_t task)>& compute,
                       const std::function<void(std::int32_t task, Bytes&& result)>& collect) const override;
  std::vector<Bytes> ask(const std::vector<Request>& requests) const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Number of ranks that a launcher says it started, 0 without a launcher, -1 when it does not say how many.
int launched_ranks();

/// Runs `mpirun -np n <same command without --np>` with the Open MPI settings it needs (root, more ranks than cores,
/// idle ranks that yield, no binding) and waits for its end. Returns the exit code of the job; nothing, and nothing was
/// run, when n == 1 or a launcher already started us. Without mpirun's banners: a rank that a signal ended is a
/// LostRankError with rank, host and signal, of code 128 + signal. So is one that a signal stopped for 30 s (or
/// ST_STOPPED_SECONDS of the environment): the job is ended then. Signals to this process reach the ranks.
/// `on_error_text` gets what the ranks write to stderr. Throws Error(kUsage) when n < 1 and Error(kInternal) when
/// mpirun is missing.
std::optional<int> run_under_mpirun(int n, const std::vector<std::string>& arguments_without_np,
                                    const std::function<void(const std::string& text)>& on_error_text);

}  // namespace st
