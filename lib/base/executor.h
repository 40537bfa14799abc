// Who runs the tasks of a job: one rank or several. The only way in which algorithms meet other ranks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/packer.h"

namespace st {

/// Tasks in the order in which they are best handed out; ties by number.
inline std::vector<std::int32_t> heaviest_first(const std::vector<double>& weight) {
  std::vector<std::int32_t> order(weight.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) { return weight[a] > weight[b]; });
  return order;
}

/// What a task is for: ("tile", 11, 3).
struct TaskLabel {
  const char* kind;       ///< a literal
  std::int32_t id;        ///< 0-based, of the face or the like
  std::int32_t part = 0;  ///< of it
};

/// Tasks with names: results of one run are of use to another. They may stay on the rank that computes them.
struct NamedTasks {
  std::vector<std::int32_t> order;  ///< as for Executor::run_tasks
  std::function<TaskLabel(std::int32_t task)> label;
  std::string made_from;  ///< digest of all that the results depend on, but for the inputs and options of the run; the
                          ///< same on every rank. Empty: not worth keeping
  std::vector<std::int32_t> home = {};  ///< [n_tasks] the rank that runs each; kNone, or empty: any rank
  /// Where compute() leaves a part of the result on its rank. Local, on the thread of the task: all of it, for a later
  /// run.
  std::function<Bytes(std::int32_t task, const Bytes& result)> record = {};
  /// The way back. Local, on rank 0: takes what record() returned in an earlier run, and returns what compute() did.
  std::function<Bytes(std::int32_t task, Bytes&& whole)> restore = {};
  /// Local, one call at a time, while tasks run: what a task of another rank has asked for by Executor::ask.
  std::function<Bytes(const Bytes& request)> answer = {};
};

/// Of a task, to another rank.
struct Request {
  int rank;
  Bytes bytes;
};

/// The ranks of a job. `comm` has the one over MPI; SerialExecutor is the one of tests and of callers without ranks.
class Executor {
 public:
  virtual ~Executor() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  bool is_root() const { return rank() == 0; }

  /// Whether anyone but rank 0 wants to have what it shares.
  virtual bool has_listeners() const { return size() > 1; }
  /// Local: what follows, in the words of a trace. `name`: a literal.
  virtual void begin_phase(const char* name) const { static_cast<void>(name); }
  /// Collective: rank 0's bytes on every rank.
  virtual void broadcast(Bytes& bytes) const = 0;
  /// Collective: the bytes of every rank on rank 0, by rank; nothing elsewhere.
  virtual std::vector<Bytes> gather(Bytes own) const = 0;
  /// Collective. Runs `compute(task)` once for each task in [0, n_tasks), on any rank and any thread, and
  /// `collect(task, result)` on rank 0 only, in arrival order: a collector that must not depend on it stores by task.
  /// `order`: in which tasks are handed out, heaviest first, a permutation of [0, n_tasks), the same on every rank. An
  /// exception out of `compute` on any rank is thrown on rank 0 as an Error with its text and exit code.
  virtual void run_tasks(std::int32_t n_tasks, const std::vector<std::int32_t>& order,
                         const std::function<Bytes(std::int32_t task)>& compute,
                         const std::function<void(std::int32_t task, Bytes&& result)>& collect) const = 0;

  /// The same, for tasks that are pure functions of what they are made from: some results may come from an earlier run.
  virtual void run_named_tasks(const NamedTasks& tasks, const std::function<Bytes(std::int32_t task)>& compute,
                               const std::function<void(std::int32_t task, Bytes&& result)>& collect) const {
    run_tasks(static_cast<std::int32_t>(tasks.order.size()), tasks.order, compute, collect);
  }
  /// Local, within a task: it did not ask() for so many bytes, because they were on this rank.
  virtual void has_own(std::size_t n_bytes) const { static_cast<void>(n_bytes); }
  /// Within `compute` of run_named_tasks: what NamedTasks::answer of these other ranks returns, in their order. Waits.
  virtual std::vector<Bytes> ask(const std::vector<Request>& requests) const {
    if (!requests.empty()) throw std::logic_error("ask: there is no other rank");
    return {};
  }
};

/// One rank, no threads.
class SerialExecutor : public Executor {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  void broadcast(Bytes&) const override {}
  std::vector<Bytes> gather(Bytes own) const override {
    std::vector<Bytes> all;
    all.push_back(std::move(own));
    return all;
  }
  void run_tasks(std::int32_t, const std::vector<std::int32_t>& order,
                 const std::function<Bytes(std::int32_t)>& compute,
                 const std::function<void(std::int32_t, Bytes&&)>& collect) const override {
    for (const std::int32_t task : order) collect(task, compute(task));
  }
};

}  // namespace st
