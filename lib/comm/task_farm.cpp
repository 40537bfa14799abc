#include "comm/task_farm.h"

#define OMPI_SKIP_MPICXX 1  // the C API alone
#include <mpi.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "base/current_work.h"
#include "base/error.h"
#include "base/threads.h"
#include "comm/mpirun_report.h"

namespace st {
namespace {

constexpr int kTagTask = 1, kTagResult = 2, kTagPayload = 3;
constexpr std::int32_t kStop = -1;
// Whose tasks are short gets as many ahead as make up this time, so that no answer is waited for.
constexpr double kAheadSeconds = 0.010;
constexpr int kMaxAhead = 16;

using Clock = std::chrono::steady_clock;

/// A result, or the failure, of one task.
struct Outcome {
  std::int32_t task = kStop;
  std::int32_t code = 0;  ///< 0, or the ExitCode of the failure whose text is in `bytes`
  double seconds = 0;     ///< time of the computation
  Bytes bytes;
};

/// What goes ahead of the bytes of an outcome.
struct OutcomeMessage {
  std::int32_t task, code;
  double seconds;
  std::uint64_t n_bytes;
};

void require_mpi(int status, const char* what) {
  if (status != MPI_SUCCESS) throw Error(ExitCode::kInternal, std::string("MPI failed: ") + what);
}

Bytes to_bytes(const std::string& text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

/// Runs one task; every exception becomes data, for it has to travel.
Outcome run_task(std::int32_t task, int rank, const Compute& compute) {
  Outcome outcome;
  outcome.task = task;
  const auto start = Clock::now();
  const auto fail = [&](ExitCode code, const std::string& text) {
    outcome.code = static_cast<std::int32_t>(code);
    outcome.bytes = to_bytes(text);
  };
  try {
    outcome.bytes = with_memory_named([&] { return compute(task); });
  } catch (const Error& e) {
    fail(e.code(), (e.code() == ExitCode::kMemory ? rank_on_this_host(rank) + ": " : "") + e.what());
  } catch (const std::exception& e) {
    fail(ExitCode::kInternal, std::string("internal error: ") + e.what());
  } catch (...) {
    fail(ExitCode::kInternal, "internal error: unknown exception");
  }
  outcome.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return outcome;
}

/// The bytes of an outcome on their way, in pieces that MPI can count. Neither side waits for the other: a worker goes
/// on computing.
class Transfer {
 public:
  /// Worker: sends what rank 0 has to know, then the bytes.
  static Transfer send(Outcome&& outcome) {
    Transfer transfer(std::move(outcome));
    OutcomeMessage& message = *transfer.message_;
    MPI_Request request;
    require_mpi(MPI_Isend(&message, sizeof message, MPI_BYTE, 0, kTagResult, MPI_COMM_WORLD, &request), "MPI_Isend");
    transfer.requests_.push_back(request);
    transfer.for_each_piece(
        [&](std::byte* piece, int count) {
          return MPI_Isend(piece, count, MPI_BYTE, 0, kTagPayload, MPI_COMM_WORLD, &request);
        },
        request);
    return transfer;
  }

  /// Rank 0: receives the message that a probe has announced from `rank`, and starts to receive the bytes.
  static Transfer receive(int rank) {
    OutcomeMessage message{};
    require_mpi(MPI_Recv(&message, sizeof message, MPI_BYTE, rank, kTagResult, MPI_COMM_WORLD, MPI_STATUS_IGNORE),
                "MPI_Recv");
    Transfer transfer({message.task, message.code, message.seconds, Bytes(message.n_bytes)});
    MPI_Request request;
    transfer.for_each_piece(
        [&](std::byte* piece, int count) {
          return MPI_Irecv(piece, count, MPI_BYTE, rank, kTagPayload, MPI_COMM_WORLD, &request);
        },
        request);
    return transfer;
  }

  bool is_done() {
    int done = 0;
    require_mpi(MPI_Testall(static_cast<int>(requests_.size()), requests_.data(), &done, MPI_STATUSES_IGNORE),
                "MPI_Testall");
    return done != 0;
  }

  const Outcome& outcome() const { return outcome_; }
  Outcome take() { return std::move(outcome_); }

 private:
  explicit Transfer(Outcome&& outcome)
      : outcome_(std::move(outcome)),
        message_(std::make_unique<OutcomeMessage>(
            OutcomeMessage{outcome_.task, outcome_.code, outcome_.seconds, outcome_.bytes.size()})) {}

  template <class Post>
  void for_each_piece(const Post& post, MPI_Request& request) {
    const std::uint64_t n = outcome_.bytes.size();
    for (std::uint64_t start = 0; start < n; start += kMaxMessageBytes) {
      require_mpi(post(outcome_.bytes.data() + start, static_cast<int>(std::min(kMaxMessageBytes, n - start))),
                  "the transfer of a result");
      requests_.push_back(request);
    }
  }

  Outcome outcome_;
  std::unique_ptr<OutcomeMessage> message_;  ///< stays where it is while it is sent
  std::vector<MPI_Request> requests_;
};

/// Is there a message? The first look may only fetch it, the second one sees it.
bool probe(int source, int tag, MPI_Status& status) {
  for (int look = 0; look < 2; ++look) {
    int is_there = 0;
    require_mpi(MPI_Iprobe(source, tag, MPI_COMM_WORLD, &is_there, &status), "MPI_Iprobe");
    if (is_there) return true;
  }
  return false;
}

/// The computing threads of a rank. They never call MPI.
class WorkerThreads {
 public:
  explicit WorkerThreads(const Compute& compute) {
    int rank = 0;
    require_mpi(MPI_Comm_rank(MPI_COMM_WORLD, &rank), "MPI_Comm_rank");
    for (int i = 0; i < thread_count(); ++i) threads_.emplace_back([this, rank, &compute] { work(rank, compute); });
  }
  ~WorkerThreads() {
    {
      const std::lock_guard lock(mutex_);
      tasks_.assign(threads_.size(), kStop);
    }
    has_task_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }
  WorkerThreads(const WorkerThreads&) = delete;
  WorkerThreads& operator=(const WorkerThreads&) = delete;

  void give(std::int32_t task) {
    {
      const std::lock_guard lock(mutex_);
      tasks_.push_back(task);
    }
    has_task_.notify_one();
  }

  /// A finished outcome, if there is one.
  std::optional<Outcome> take() {
    const std::lock_guard lock(mutex_);
    return take_locked();
  }

  /// Likewise, but sleeps until there is one or the time is over.
  void wait_for_outcome(std::chrono::microseconds time) {
    std::unique_lock lock(mutex_);
    has_outcome_.wait_for(lock, time, [&] { return !outcomes_.empty(); });
  }

 private:
  std::optional<Outcome> take_locked() {
    if (outcomes_.empty()) return std::nullopt;
    Outcome outcome = std::move(outcomes_.front());
    outcomes_.pop_front();
    return outcome;
  }

  void work(int rank, const Compute& compute) {
    while (true) {
      std::int32_t task = kStop;
      {
        std::unique_lock lock(mutex_);
        has_task_.wait(lock, [&] { return !tasks_.empty(); });
        task = tasks_.front();
        tasks_.pop_front();
      }
      if (task == kStop) return;
      Outcome outcome = run_task(task, rank, compute);
      {
        const std::lock_guard lock(mutex_);
        outcomes_.push_back(std::move(outcome));
      }
      has_outcome_.notify_one();
    }
  }

  std::mutex mutex_;
  std::condition_variable has_task_, has_outcome_;
  std::deque<std::int32_t> tasks_;
  std::deque<Outcome> outcomes_;
  std::vector<std::thread> threads_;  // last: they use the members above
};

/// Hands out tasks in order, and counts what is out.
class Distributor {
 public:
  Distributor(int n_ranks, const std::vector<std::int32_t>& order, const Compute& compute, const Collect& collect)
      : order_(order), collect_(collect), n_pending_(n_ranks, 0), local_(compute) {}

  void run() {
    for (int i = 0; i < thread_count(); ++i)
      for (int rank = 0; rank < static_cast<int>(n_pending_.size()); ++rank) give(rank);
    Backoff backoff;
    while (n_collected_ < order_.size()) {
      if (receive_all()) {
        backoff.reset();
      } else {
        local_.wait_for_outcome(backoff.next());
        backoff.lengthen();
      }
      collect_all();
    }
    for (int rank = 1; rank < static_cast<int>(n_pending_.size()); ++rank) send_task(rank, kStop);
  }

 private:
  void send_task(int rank, std::int32_t task) {
    require_mpi(MPI_Send(&task, 1, MPI_INT32_T, rank, kTagTask, MPI_COMM_WORLD), "MPI_Send");
  }

  /// The next task to a rank, if there is one.
  void give(int rank) {
    if (n_given_ == order_.size()) return;
    const std::int32_t task = order_[n_given_++];
    ++n_pending_[rank];
    rank == 0 ? local_.give(task) : send_task(rank, task);
  }

  /// One task less is out; keeps the rank busy. Comes before the bytes are there and before collecting: that may take
  /// its time.
  void answer(int rank, double seconds) {
    --n_pending_[rank];
    const int n_wanted =
        thread_count() + static_cast<int>(std::min<double>(kMaxAhead, kAheadSeconds / std::max(seconds, 1e-9)));
    while (n_pending_[rank] < n_wanted && n_given_ < order_.size()) give(rank);
  }

  void accept(Outcome&& outcome) {
    if (outcome.code == 0) return received_.push_back(std::move(outcome));
    const auto* text = reinterpret_cast<const char*>(outcome.bytes.data());
    throw Error(static_cast<ExitCode>(outcome.code), std::string(text, outcome.bytes.size()));
  }

  /// True when something came.
  bool receive_all() {
    const std::size_t n_before = received_.size() + incoming_.size();
    while (auto outcome = local_.take()) {
      answer(0, outcome->seconds);
      accept(std::move(*outcome));
    }
    for (MPI_Status status; probe(MPI_ANY_SOURCE, kTagResult, status);) {
      incoming_.push_back(Transfer::receive(status.MPI_SOURCE));
      answer(status.MPI_SOURCE, incoming_.back().outcome().seconds);
    }
    const bool has_news = received_.size() + incoming_.size() != n_before;
    return accept_arrived() || has_news;
  }

  /// True when the bytes of an outcome are complete.
  bool accept_arrived() {
    bool has_news = false;
    for (auto it = incoming_.begin(); it != incoming_.end();) {
      if (!it->is_done()) {
        ++it;
        continue;
      }
      accept(it->take());
      it = incoming_.erase(it);
      has_news = true;
    }
    return has_news;
  }

  /// Collects, but answers whoever reports meanwhile.
  void collect_all() {
    while (!received_.empty()) {
      Outcome outcome = std::move(received_.front());
      received_.pop_front();
      collect_(outcome.task, std::move(outcome.bytes));
      ++n_collected_;
      receive_all();
    }
  }

  const std::vector<std::int32_t>& order_;
  const Collect& collect_;
  std::vector<int> n_pending_;  ///< per rank: tasks given, outcome not yet received
  std::size_t n_given_ = 0, n_collected_ = 0;
  std::list<Transfer> incoming_;
  std::deque<Outcome> received_;
  WorkerThreads local_;
};

/// A worker's side: tasks to the threads, their results on the way. The main thread sleeps while there is nothing to
/// pass on.
class Worker {
 public:
  explicit Worker(const Compute& compute) : threads_(compute) {}

  void run() {
    for (Backoff backoff; !is_stopped_ || n_inside_ > 0 || !outgoing_.empty();) {
      const bool has_news = receive_tasks() | send_outcomes();
      outgoing_.remove_if([](Transfer& transfer) { return transfer.is_done(); });
      if (has_news || !outgoing_.empty()) backoff.reset();  // results need this process to get through
      if (has_news) continue;
      threads_.wait_for_outcome(backoff.next());
      backoff.lengthen();
    }
  }

 private:
  bool receive_tasks() {
    bool has_news = false;
    for (MPI_Status status; !is_stopped_ && probe(0, kTagTask, status); has_news = true) {
      std::int32_t task = kStop;
      require_mpi(MPI_Recv(&task, 1, MPI_INT32_T, 0, kTagTask, MPI_COMM_WORLD, MPI_STATUS_IGNORE), "MPI_Recv");
      is_stopped_ = task == kStop;
      if (is_stopped_) continue;
      threads_.give(task);
      ++n_inside_;
    }
    return has_news;
  }

  bool send_outcomes() {
    bool has_news = false;
    for (; auto outcome = threads_.take(); has_news = true) {
      outgoing_.push_back(Transfer::send(std::move(*outcome)));
      --n_inside_;
    }
    return has_news;
  }

  bool is_stopped_ = false;
  int n_inside_ = 0;  ///< tasks whose outcome is not yet sent
  std::list<Transfer> outgoing_;
  WorkerThreads threads_;
};

}  // namespace

void Backoff::sleep() {
  std::this_thread::sleep_for(next_);
  lengthen();
}

void Backoff::lengthen() { next_ = std::min(next_ * 3 / 2, std::chrono::microseconds(1000)); }

void distribute_tasks(int n_ranks, const std::vector<std::int32_t>& order, const Compute& compute,
                      const Collect& collect) {
  Distributor(n_ranks, order, compute, collect).run();
}

void work_on_tasks(const Compute& compute) { Worker(compute).run(); }

}  // namespace st
