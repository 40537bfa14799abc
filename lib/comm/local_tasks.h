// Tasks of a group of one rank: on the threads of this process.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/executor.h"

namespace st {

/// Throws Error(kInternal) unless `order` lists each of the tasks 0 to n_tasks - 1 once. Local.
void require_order(const std::vector<std::int32_t>& order, std::int64_t n_tasks);

/// Communicator::run_tasks at one rank. Throws what require_order says, and the exception of the first task in the
/// order that failed. Local.
void run_local_tasks(const std::vector<std::int32_t>& order, const std::function<Bytes(std::int32_t task)>& compute,
                     const std::function<void(std::int32_t task, Bytes&& result)>& collect);

}  // namespace st
