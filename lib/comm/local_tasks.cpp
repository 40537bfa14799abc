#include "comm/local_tasks.h"

#include <mutex>

#include "base/current_work.h"
#include "base/error.h"
#include "base/threads.h"

namespace st {

void require_order(const std::vector<std::int32_t>& order, std::int64_t n_tasks) {
  std::vector<char> is_listed(order.size(), 0);
  bool is_complete = static_cast<std::int64_t>(order.size()) == n_tasks;
  for (const std::int32_t task : order)
    is_complete = is_complete && task >= 0 && task < n_tasks && !is_listed[static_cast<std::size_t>(task)]++;
  if (!is_complete) throw Error(ExitCode::kInternal, "run_tasks: the order does not list every task once");
}

void run_local_tasks(const std::vector<std::int32_t>& order, const std::function<Bytes(std::int32_t task)>& compute,
                     const std::function<void(std::int32_t task, Bytes&& result)>& collect) {
  require_order(order, static_cast<std::int64_t>(order.size()));
  std::mutex mutex;
  parallel_for(order.size(), 1, [&](std::size_t i, std::size_t) {
    Bytes result = with_memory_named([&] { return compute(order[i]); });
    const std::lock_guard lock(mutex);
    collect(order[i], std::move(result));
  });
}

}  // namespace st
