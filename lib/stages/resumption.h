// Goes on where an earlier run with the same inputs was ended.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "base/ids.h"
#include "base/wrapped_executor.h"
#include "io/file/journal.h"

namespace st {

/// Whether and when results are kept.
struct ResumeOptions {
  double after = 2;         ///< seconds from which on results are kept
  bool begins_new = false;  ///< without what an earlier run has kept
};

/// The executor of a stage with a journal: every rank writes what it has made, and what an earlier run has made is not
/// made again. Work that was under way when an earlier run was ended is done first, and alone: whether it is to blame
/// shows then, and it has all the memory.
class Resumption : public WrappedExecutor {
 public:
  /// Collective. `run`: digest of inputs and options, the same on every rank; the version and the program come on top.
  Resumption(const Executor& inner, const std::string& output, const std::string& run, const ResumeOptions& options);

  /// Faces that are not to be tried again, with the reason; the same on every rank.
  const std::map<FaceId, std::string>& left_out() const { return left_out_; }
  /// Named tasks so far, on rank 0: all, and those of an earlier run.
  std::int64_t n_tasks() const { return n_tasks_; }
  std::int64_t n_resumed() const { return n_resumed_; }

  /// Collective. Nothing more is kept. What was stays until remove().
  void end();
  /// Local, on rank 0, after end(): the output is complete.
  void remove();

  void run_named_tasks(const NamedTasks& tasks, const std::function<Bytes(std::int32_t task)>& compute,
                       const std::function<void(std::int32_t task, Bytes&& result)>& collect) const override;

 private:
  using Compute = std::function<Bytes(std::int32_t)>;
  using Collect = std::function<void(std::int32_t, Bytes&&)>;

  void read(const WorkKey& run_key, const ResumeOptions& options);
  std::vector<std::int32_t> collect_done(const std::vector<Work>& works, const NamedTasks& tasks,
                                         const Collect& collect) const;
  void run_some(const NamedTasks& tasks, const std::vector<std::int32_t>& some, const Compute& compute,
                const Collect& collect) const;

  const std::string output_;
  std::optional<JournalReader> earlier_;  // on rank 0, where there is something of use
  char is_resuming_ = 0;
  std::map<FaceId, std::string> left_out_;
  mutable std::optional<Journal> journal_;
  mutable std::int64_t n_tasks_ = 0, n_resumed_ = 0;
};

}  // namespace st
