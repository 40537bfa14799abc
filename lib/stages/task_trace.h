// Where the time of a parallel stage goes, task by task, for bench/replay.py.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "base/log.h"
#include "base/threads.h"
#include "base/wrapped_executor.h"

namespace st {

/// An executor that keeps time. Without a file it only passes on.
class TaskTrace : public WrappedExecutor {
 public:
  /// Collective: the clock of every rank starts. `path`: where rank 0 writes in the end, empty: nowhere.
  TaskTrace(const Executor& inner, std::string path);

  /// Collective, at the end: a table of comma-separated values by the order of events. One row for each task and each
  /// broadcast, for collecting the results of each call, and for what rank 0 does in between. Throws Error(kOutput).
  void write();

  void broadcast(Bytes& bytes) const override;
  bool has_listeners() const override { return !path_.empty() || inner_.has_listeners(); }
  void run_tasks(std::int32_t n_tasks, const std::vector<std::int32_t>& order,
                 const std::function<Bytes(std::int32_t task)>& compute,
                 const std::function<void(std::int32_t task, Bytes&& result)>& collect) const override;
  void run_named_tasks(const NamedTasks& tasks, const std::function<Bytes(std::int32_t task)>& compute,
                       const std::function<void(std::int32_t task, Bytes&& result)>& collect) const override;
  void has_own(std::size_t n_bytes) const override;
  std::vector<Bytes> ask(const std::vector<Request>& requests) const override;
  void begin_phase(const char* name) const override;

 private:
  struct Row {
    std::string event, name;  // "task", "collect", "broadcast" or "serial"; kind of task, or phase
    std::int32_t id = kNothing, part = kNothing;
    std::int32_t call = 0, rank = 0, thread = 0;
    double start = 0, wall = 0, processor = 0;  // seconds
    std::uint64_t bytes = 0;                    // of the result, or sent to each rank
    std::uint64_t asked = 0;                    // of other tasks' results, wherever they were
    double loops = 0, longest = 0;              // see LoopSeconds

    static auto fields(auto& r) {
      return std::tie(r.event, r.name, r.id, r.part, r.call, r.rank, r.thread, r.start, r.wall, r.processor, r.bytes,
                      r.asked, r.loops, r.longest);
    }
  };
  static constexpr std::int32_t kNothing = -1;

  void end_serial() const;
  void begin_serial() const;
  std::int32_t thread_number() const;
  void write_rows(const std::vector<Row>& rows) const;

  const std::string path_;
  Timer clock_;
  mutable std::mutex mutex_;  // of rows_ and threads_
  mutable std::vector<Row> rows_;
  mutable std::map<std::thread::id, std::int32_t> threads_;
  mutable const char* phase_ = "load";
  mutable std::int32_t n_calls_ = 0;
  mutable double serial_start_ = 0, serial_processor_ = 0;
  mutable LoopSeconds serial_loops_;
};

}  // namespace st
