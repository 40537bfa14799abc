// The computing threads of a rank. They never call MPI. Internal to comm.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "comm/communicator.h"

namespace st {

using Compute = std::function<Bytes(std::int32_t task)>;

inline constexpr std::int32_t kStop = -1;  ///< in place of a task: there is no more

/// A result, or the failure, of one task.
struct Outcome {
  std::int32_t task = kStop;
  std::int32_t code = 0;  ///< 0, or the ExitCode of the failure whose text is in `bytes`
  double seconds = 0;     ///< time of the computation
  Bytes bytes;
};

/// A request to another rank, and who waits for the answer.
struct Question {
  Request request;
  Bytes* answer;
  std::size_t* n_missing;  ///< answers of the thread that asks
};

/// thread_count() threads that run tasks; every exception of one becomes an Outcome, for it has to travel. All
/// functions may be called by several threads. At most one object at a time in a process.
class WorkerThreads {
 public:
  /// `rank`: this one, for texts. `compute` outlives the object. Throws Error(kMemory) where not one thread can be
  /// started.
  WorkerThreads(int rank, const Compute& compute);
  /// Waits for the tasks that run; ends those that wait for answers.
  ~WorkerThreads();
  WorkerThreads(const WorkerThreads&) = delete;
  WorkerThreads& operator=(const WorkerThreads&) = delete;

  void give(std::int32_t task);
  /// A finished outcome, if there is one.
  std::optional<Outcome> take();
  /// Sleeps until there is an outcome or a question, or the time is over.
  void wait(std::chrono::microseconds time);
  /// A question that nobody has passed on, if there is one.
  std::optional<Question> take_question();
  void answer(const Question& question, Bytes&& bytes);
  /// On one of the threads: waits for the answers.
  std::vector<Bytes> ask(const std::vector<Request>& requests);

 private:
  void work(int rank, const Compute& compute);

  std::mutex mutex_;
  std::condition_variable has_task_, has_news_, has_answers_;
  std::deque<std::int32_t> tasks_;
  std::deque<Outcome> outcomes_;
  std::deque<Question> questions_;
  bool is_ending_ = false;
  std::vector<std::thread> threads_;  // last: they use the members above
};

/// Gives within a `compute` the answers of these ranks, in order. Waits. Throws Error(kInternal) elsewhere.
std::vector<Bytes> ask_ranks(const std::vector<Request>& requests);

}  // namespace st
