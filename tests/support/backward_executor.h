// Tasks as they may arrive from other ranks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "base/executor.h"

namespace st::test {

/// Tasks in the opposite order, as they may arrive.
class BackwardExecutor : public SerialExecutor {
 public:
  void run_tasks(std::int32_t, const std::vector<std::int32_t>& order,
                 const std::function<Bytes(std::int32_t)>& compute,
                 const std::function<void(std::int32_t, Bytes&&)>& collect) const override {
    for (auto task = order.rbegin(); task != order.rend(); ++task) collect(*task, compute(*task));
    n_tasks += order.size();
  }
  void run_named_tasks(const NamedTasks& tasks, const std::function<Bytes(std::int32_t)>& compute,
                       const std::function<void(std::int32_t, Bytes&&)>& collect) const override {
    std::set<std::tuple<std::string, std::int32_t, std::int32_t>> names;
    for (const std::int32_t task : tasks.order) {
      const TaskLabel label = tasks.label(task);
      ++n_of[label.kind];
      if (!tasks.made_from.empty() && !names.emplace(label.kind, label.id, label.part).second)
        throw std::logic_error(std::string("two tasks of one name: ") + label.kind);
    }
    SerialExecutor::run_named_tasks(tasks, compute, collect);
  }
  mutable std::size_t n_tasks = 0;
  mutable std::map<std::string, std::size_t> n_of;  // named tasks by kind
};

}  // namespace st::test
