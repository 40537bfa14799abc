// The task farm behind Communicator::run_tasks. Internal to comm.
//
// Every rank computes on threads of its own and calls MPI from its main thread only, asleep while there is nothing to
// do. Rank 0's main thread hands out tasks and collects results. A rank gets its next task when it sends a result.
// Whose tasks are so short that a message's latency matters gets some ahead; long ones are not given ahead, for a task
// that waits behind another long one could run elsewhere.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <vector>

#include "comm/worker_threads.h"

namespace st {

/// Largest single MPI message: counts are int.
inline constexpr std::uint64_t kMaxMessageBytes = std::uint64_t{1} << 30;

/// Sleeps for longer and longer, up to a millisecond: waiting must not burn a core.
class Backoff {
 public:
  void sleep();
  void lengthen();
  void reset() { next_ = kFirst; }
  std::chrono::microseconds next() const { return next_; }

 private:
  static constexpr std::chrono::microseconds kFirst{30};
  std::chrono::microseconds next_ = kFirst;
};

using Collect = std::function<void(std::int32_t task, Bytes&& result)>;
using Answer = std::function<Bytes(const Bytes& request)>;

/// Rank 0's side: returns when all results are collected. Throws Error with code and text of the first compute that
/// failed, on any rank, and what `collect` throws; the other ranks then wait for more until the job is aborted.
/// `home`: the rank that runs each task, or empty.
void distribute_tasks(int n_ranks, const std::vector<std::int32_t>& order, const std::vector<std::int32_t>& home,
                      const Compute& compute, const Collect& collect, const Answer& answer);

/// Every other rank's side: returns when rank 0 says that there is no more.
void work_on_tasks(const Compute& compute, const Answer& answer);

}  // namespace st
