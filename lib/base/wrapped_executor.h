// An executor around another.
#pragma once

#include <utility>

#include "base/executor.h"

namespace st {

/// Passes everything on; a class of its own changes what it needs.
class WrappedExecutor : public Executor {
 public:
  /// `inner` outlives the object.
  explicit WrappedExecutor(const Executor& inner) : inner_(inner) {}

  int rank() const override { return inner_.rank(); }
  int size() const override { return inner_.size(); }
  bool has_listeners() const override { return inner_.has_listeners(); }
  void begin_phase(const char* name) const override { inner_.begin_phase(name); }
  void broadcast(Bytes& bytes) const override { inner_.broadcast(bytes); }
  std::vector<Bytes> gather(Bytes own) const override { return inner_.gather(std::move(own)); }
  void run_tasks(std::int32_t n_tasks, const std::vector<std::int32_t>& order,
                 const std::function<Bytes(std::int32_t task)>& compute,
                 const std::function<void(std::int32_t task, Bytes&& result)>& collect) const override {
    inner_.run_tasks(n_tasks, order, compute, collect);
  }
  void run_named_tasks(const NamedTasks& tasks, const std::function<Bytes(std::int32_t task)>& compute,
                       const std::function<void(std::int32_t task, Bytes&& result)>& collect) const override {
    inner_.run_named_tasks(tasks, compute, collect);
  }
  void has_own(std::size_t n_bytes) const override { inner_.has_own(n_bytes); }
  std::vector<Bytes> ask(const std::vector<Request>& requests) const override { return inner_.ask(requests); }

 protected:
  const Executor& inner_;
};

}  // namespace st
