#include "base/threads.h"

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <list>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/processor_time.h"

namespace st {
namespace {

std::atomic<int> g_thread_count = 1;
thread_local int t_depth = 0;  // loops in whose pieces this thread is
thread_local LoopSeconds t_loops;

/// Adds the time of its life, and of its longest piece; in the life of another one to that one's piece.
class LoopTimer {
 public:
  LoopTimer() : outer_(t_timer), is_counted_(outer_ || t_depth == 0) {
    if (is_counted_) t_timer = this;
  }
  ~LoopTimer() {
    if (!is_counted_) return;
    t_timer = outer_;
    LoopSeconds& sum = outer_ ? outer_->inner_ : t_loops;
    sum.all += thread_seconds() - start_;
    sum.longest += longest_;
  }
  /// Between pieces. Of loops in it the longest pieces count alone.
  void end_piece() {
    if (!is_counted_) return;
    const double now = thread_seconds() - start_;
    longest_ = std::max(longest_, now - last_ - inner_.all + inner_.longest);
    last_ = now;
    inner_ = {};
  }
  LoopTimer(const LoopTimer&) = delete;
  LoopTimer& operator=(const LoopTimer&) = delete;

  static LoopSeconds here() { return t_timer ? t_timer->inner_ : t_loops; }

 private:
  LoopTimer* const outer_;
  const bool is_counted_;
  LoopSeconds inner_;  // of loops in this piece
  double last_ = 0, longest_ = 0;
  const double start_ = thread_seconds();
  static thread_local LoopTimer* t_timer;
};
thread_local LoopTimer* LoopTimer::t_timer = nullptr;

/// The pieces of one loop, taken one after the other by whoever works on it.
class Loop {
 public:
  using Body = std::function<void(std::size_t begin, std::size_t end)>;
  Loop(std::size_t n, std::size_t grain, const Body& body)
      : depth(t_depth + 1), n_(n), grain_(grain), n_pieces_((n + grain - 1) / grain), body_(body) {}

  bool has_more() const { return next_ < n_pieces_ && next_ < failed_piece_; }

  /// Until no piece is left. Every piece ahead of one that failed is done, so that the first failure is always the
  /// same.
  void work() {
    const int depth_before = std::exchange(t_depth, depth);
    for (std::size_t i = next_++; i < n_pieces_ && i < failed_piece_; i = next_++) {
      try {
        body_(i * grain_, std::min(n_, (i + 1) * grain_));
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (i > failed_piece_) continue;
        failure_ = std::current_exception();
        failed_piece_ = i;
      }
    }
    t_depth = depth_before;
  }

  /// After everyone has left.
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

  const int depth;    ///< 1: in no other loop
  int n_helpers = 0;  ///< threads at work but the caller's; guarded by the pool

 private:
  const std::size_t n_, grain_, n_pieces_;
  const Body& body_;
  std::atomic<std::size_t> next_ = 0, failed_piece_ = static_cast<std::size_t>(-1);
  std::mutex mutex_;  // of failure_
  std::exception_ptr failure_;
};

/// The threads of this process, asleep while there is no loop. A loop may stand in a piece of another one.
class Pool {
 public:
  ~Pool() {
    {
      const std::lock_guard lock(mutex_);
      is_ending_ = true;
    }
    is_changed_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

  void run(Loop& loop) {
    {
      const std::lock_guard lock(mutex_);
      add_threads();
      loops_.push_back(&loop);
    }
    is_changed_.notify_all();
    loop.work();
    std::unique_lock lock(mutex_);
    loops_.remove(&loop);
    help(lock, {thread_count(), loop.depth + 1}, [&] { return loop.n_helpers == 0; });
  }

 private:
  void add_threads() {
    try {
      while (static_cast<int>(threads_.size()) < thread_count() - 1)
        threads_.emplace_back([this, number = static_cast<int>(threads_.size()) + 2] {
          std::unique_lock lock(mutex_);
          help(lock, {number, 1}, [this] { return is_ending_; });
        });
    } catch (const std::system_error&) {  // no more threads to be had: those there are do it
    }
  }

  /// The outermost loop first: its pieces are the largest. But who waits for one helps inner ones only, so that no
  /// stack grows with the number of pieces.
  Loop* find_loop(int least_depth) const {
    const auto it = std::find_if(loops_.begin(), loops_.end(),
                                 [&](const Loop* loop) { return loop->depth >= least_depth && loop->has_more(); });
    return it == loops_.end() ? nullptr : *it;
  }

  struct Helper {
    int number;       ///< helps while so many threads are wanted
    int least_depth;  ///< of the loops that it helps
  };

  /// Works on loops until `is_over`; asleep while there is none.
  template <class IsOver>
  void help(std::unique_lock<std::mutex>& lock, Helper helper, const IsOver& is_over) {
    while (true) {
      Loop* loop = nullptr;
      is_changed_.wait(lock, [&] {
        if (!is_over() && thread_count() >= helper.number) loop = find_loop(helper.least_depth);
        return is_over() || loop;
      });
      if (!loop) return;
      ++loop->n_helpers;
      lock.unlock();
      loop->work();
      lock.lock();
      if (--loop->n_helpers == 0) is_changed_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable is_changed_;  // a loop came, the last helper of one left, or the end
  std::list<Loop*> loops_;
  std::vector<std::thread> threads_;
  bool is_ending_ = false;
};

}  // namespace

int thread_count() { return g_thread_count; }

void set_thread_count(int n) {
  if (n < 1) throw Error(ExitCode::kInternal, "a process needs at least one thread");
  g_thread_count = n;
}

int processor_count() {
  cpu_set_t own;
  if (sched_getaffinity(0, sizeof own, &own) == 0) return CPU_COUNT(&own);
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));  // more than the set can tell
}

void parallel_for(std::size_t n, std::size_t grain,
                  const std::function<void(std::size_t begin, std::size_t end)>& body) {
  static Pool pool;
  grain = std::max<std::size_t>(grain, 1);
  if (n <= grain) {  // no more threads speed it up, and asking for the time costs more than a small one
    if (n > 0) body(0, n);
    return;
  }
  LoopTimer timer;
  if (thread_count() == 1) {
    for (std::size_t begin = 0; begin < n; begin += grain, timer.end_piece()) body(begin, std::min(n, begin + grain));
    return;
  }
  Loop loop(n, grain, body);
  pool.run(loop);
  loop.rethrow();
}

LoopSeconds seconds_in_loops() { return LoopTimer::here(); }

void run_jobs(const std::vector<std::function<void()>>& jobs) {
  parallel_for(jobs.size(), 1, [&](std::size_t i, std::size_t) { jobs[i](); });
}

}  // namespace st
