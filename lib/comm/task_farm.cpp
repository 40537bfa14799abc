#include "comm/task_farm.h"

#define OMPI_SKIP_MPICXX 1  // the C API alone
#include <mpi.h>

#include <algorithm>
#include <deque>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include "base/error.h"
#include "base/ids.h"
#include "base/threads.h"

namespace st {
namespace {

constexpr int kTagTask = 1;

/// Messages of a kind: what each is, and its bytes.
struct Channel {
  int head, bytes;
};
constexpr Channel kResults{2, 3}, kRequests{4, 5}, kAnswers{6, 7};
// Whose tasks are short gets as many ahead as make up this time, so that no answer is waited for.
constexpr double kAheadSeconds = 0.010;
constexpr int kMaxAhead = 16;

/// What goes ahead of the bytes of an outcome.
struct OutcomeMessage {
  std::int32_t task, code;
  double seconds;
  std::uint64_t n_bytes;
};

void require_mpi(int status, const char* what) {
  if (status != MPI_SUCCESS) throw Error(ExitCode::kInternal, std::string("MPI failed: ") + what);
}

int this_rank() {
  int rank = 0;
  require_mpi(MPI_Comm_rank(MPI_COMM_WORLD, &rank), "MPI_Comm_rank");
  return rank;
}

/// The bytes of an outcome on their way, in pieces that MPI can count. Neither side waits for the other: a worker goes
/// on computing.
class Transfer {
 public:
  /// Sends what the other rank has to know, then the bytes.
  static Transfer send(Outcome&& outcome, int rank, Channel channel) {
    Transfer transfer(std::move(outcome), rank);
    OutcomeMessage& message = *transfer.message_;
    MPI_Request request;
    require_mpi(MPI_Isend(&message, sizeof message, MPI_BYTE, rank, channel.head, MPI_COMM_WORLD, &request),
                "MPI_Isend");
    transfer.requests_.push_back(request);
    transfer.for_each_piece(
        [&](std::byte* piece, int count) {
          return MPI_Isend(piece, count, MPI_BYTE, rank, channel.bytes, MPI_COMM_WORLD, &request);
        },
        request);
    return transfer;
  }

  /// Receives the message that a probe has announced from `rank`, and starts to receive the bytes.
  static Transfer receive(int rank, Channel channel) {
    OutcomeMessage message{};
    require_mpi(MPI_Recv(&message, sizeof message, MPI_BYTE, rank, channel.head, MPI_COMM_WORLD, MPI_STATUS_IGNORE),
                "MPI_Recv");
    Transfer transfer({message.task, message.code, message.seconds, Bytes(message.n_bytes)}, rank);
    MPI_Request request;
    transfer.for_each_piece(
        [&](std::byte* piece, int count) {
          return MPI_Irecv(piece, count, MPI_BYTE, rank, channel.bytes, MPI_COMM_WORLD, &request);
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

  int rank() const { return rank_; }
  const Outcome& outcome() const { return outcome_; }
  Outcome take() { return std::move(outcome_); }

 private:
  Transfer(Outcome&& outcome, int rank)
      : rank_(rank),
        outcome_(std::move(outcome)),
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

  int rank_;  ///< the other one
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

/// Takes what is complete, and forgets it. False: nothing is.
template <class Take>
bool take_arrived(std::list<Transfer>& transfers, const Take& take) {
  return std::erase_if(transfers, [&](Transfer& transfer) {
           if (!transfer.is_done()) return false;
           take(transfer);
           return true;
         }) > 0;
}

/// Passes questions of this rank's tasks on to other ranks, and answers theirs. For the main thread.
class Courier {
 public:
  Courier(WorkerThreads& threads, const Answer& answer) : threads_(threads), answer_(answer) {}

  /// True when there was something to do.
  bool work() {
    // what cannot come is not looked for: each look costs a round through all connections
    const bool has_asked = pass_on(), has_answered = answer_ && answer_others(),
               has_received = !asked_.empty() && receive_answers();
    outgoing_.remove_if([](Transfer& transfer) { return transfer.is_done(); });
    return has_asked || has_answered || has_received;
  }
  /// Something is on its way: sleep no longer than needed.
  bool is_busy() const { return !outgoing_.empty() || !incoming_.empty() || !answers_.empty() || !asked_.empty(); }

 private:
  bool pass_on() {
    bool has_news = false;
    for (; auto question = threads_.take_question(); has_news = true) {
      if (!answer_) throw std::logic_error("ask: no rank answers in this call");
      const std::int32_t number = n_asked_++;
      outgoing_.push_back(
          Transfer::send({number, 0, 0, std::move(question->request.bytes)}, question->request.rank, kRequests));
      asked_.emplace(number, std::move(*question));
    }
    return has_news;
  }

  bool answer_others() {
    bool has_news = false;
    for (MPI_Status status; probe(MPI_ANY_SOURCE, kRequests.head, status); has_news = true)
      incoming_.push_back(Transfer::receive(status.MPI_SOURCE, kRequests));
    return take_arrived(incoming_,
                        [&](Transfer& request) {
                          Bytes answer = answer_(request.outcome().bytes);
                          outgoing_.push_back(Transfer::send({request.outcome().task, 0, 0, std::move(answer)},
                                                             request.rank(), kAnswers));
                        }) ||
           has_news;
  }

  bool receive_answers() {
    bool has_news = false;
    for (MPI_Status status; probe(MPI_ANY_SOURCE, kAnswers.head, status); has_news = true)
      answers_.push_back(Transfer::receive(status.MPI_SOURCE, kAnswers));
    return take_arrived(answers_,
                        [&](Transfer& answer) {
                          const auto question = asked_.find(answer.outcome().task);
                          threads_.answer(question->second, answer.take().bytes);
                          asked_.erase(question);
                        }) ||
           has_news;
  }

  WorkerThreads& threads_;
  const Answer& answer_;
  std::int32_t n_asked_ = 0;
  std::map<std::int32_t, Question> asked_;  ///< without an answer so far, by number
  std::list<Transfer> outgoing_, incoming_, answers_;
};

/// Hands out tasks in order, and counts what is out.
class Distributor {
 public:
  Distributor(int n_ranks, const std::vector<std::int32_t>& order, const std::vector<std::int32_t>& home,
              const Compute& compute, const Collect& collect, const Answer& answer)
      : n_tasks_(order.size()),
        collect_(collect),
        n_pending_(n_ranks, 0),
        own_(n_ranks),
        local_(this_rank(), compute),
        courier_(local_, answer) {
    for (const std::int32_t task : order)
      (home.empty() || home[task] == kNone ? shared_ : own_.at(home[task])).push_back(task);
  }

  void run() {
    for (int i = 0; i < thread_count(); ++i)
      for (int rank = 0; rank < static_cast<int>(n_pending_.size()); ++rank) give(rank);
    Backoff backoff;
    while (n_collected_ < n_tasks_) {
      if (receive_all() || courier_.is_busy()) backoff.reset();
      if (received_.empty()) {
        local_.wait(backoff.next());
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

  /// The next task to a rank. False: there is none.
  bool give(int rank) {
    std::deque<std::int32_t>& tasks = own_[rank].empty() ? shared_ : own_[rank];
    if (tasks.empty()) return false;
    const std::int32_t task = tasks.front();
    tasks.pop_front();
    ++n_pending_[rank];
    rank == 0 ? local_.give(task) : send_task(rank, task);
    return true;
  }

  /// One task less is out; keeps the rank busy. Comes before the bytes are there and before collecting: that may take
  /// its time.
  void answer(int rank, double seconds) {
    --n_pending_[rank];
    const int n_wanted =
        thread_count() + static_cast<int>(std::min<double>(kMaxAhead, kAheadSeconds / std::max(seconds, 1e-9)));
    while (n_pending_[rank] < n_wanted && give(rank)) {
    }
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
    for (MPI_Status status; probe(MPI_ANY_SOURCE, kResults.head, status);) {
      incoming_.push_back(Transfer::receive(status.MPI_SOURCE, kResults));
      answer(status.MPI_SOURCE, incoming_.back().outcome().seconds);
    }
    const bool has_news = received_.size() + incoming_.size() != n_before;
    return courier_.work() | take_arrived(incoming_, [&](Transfer& outcome) { accept(outcome.take()); }) | has_news;
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

  const std::size_t n_tasks_;
  const Collect& collect_;
  std::vector<int> n_pending_;                 ///< per rank: tasks given, outcome not yet received
  std::deque<std::int32_t> shared_;            ///< tasks to be given to any rank
  std::vector<std::deque<std::int32_t>> own_;  ///< likewise to this one
  std::size_t n_collected_ = 0;
  std::list<Transfer> incoming_;
  std::deque<Outcome> received_;
  WorkerThreads local_;
  Courier courier_;
};

/// A worker's side: tasks to the threads, their results on the way. The main thread sleeps while there is nothing to
/// pass on.
class Worker {
 public:
  Worker(const Compute& compute, const Answer& answer) : threads_(this_rank(), compute), courier_(threads_, answer) {}

  void run() {
    for (Backoff backoff; !is_stopped_ || n_inside_ > 0 || !outgoing_.empty() || courier_.is_busy();) {
      const bool has_news = receive_tasks() | send_outcomes() | courier_.work();
      outgoing_.remove_if([](Transfer& transfer) { return transfer.is_done(); });
      // results need this process to get through
      if (has_news || !outgoing_.empty() || courier_.is_busy()) backoff.reset();
      if (has_news) continue;
      threads_.wait(backoff.next());
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
      outgoing_.push_back(Transfer::send(std::move(*outcome), 0, kResults));
      --n_inside_;
    }
    return has_news;
  }

  bool is_stopped_ = false;
  int n_inside_ = 0;  ///< tasks whose outcome is not yet sent
  std::list<Transfer> outgoing_;
  WorkerThreads threads_;
  Courier courier_;
};

}  // namespace

void Backoff::sleep() {
  std::this_thread::sleep_for(next_);
  lengthen();
}

void Backoff::lengthen() { next_ = std::min(next_ * 3 / 2, std::chrono::microseconds(1000)); }

void distribute_tasks(int n_ranks, const std::vector<std::int32_t>& order, const std::vector<std::int32_t>& home,
                      const Compute& compute, const Collect& collect, const Answer& answer) {
  Distributor(n_ranks, order, home, compute, collect, answer).run();
}

void work_on_tasks(const Compute& compute, const Answer& answer) { Worker(compute, answer).run(); }

}  // namespace st
