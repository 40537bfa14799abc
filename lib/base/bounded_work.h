// Work of other libraries that may never end.
#pragma once

#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

namespace st {

/// Whether some work was given up and may still go on: the program must end without the end of its objects.
bool has_abandoned_work();
void note_abandoned_work();

/// What `work` returns, made by a thread of its own; nullopt after `seconds`: it is given up and goes on alone. So it
/// must own all that it uses. What it throws is thrown here.
template <class Work>
auto run_within(double seconds, Work work) -> std::optional<decltype(work())> {
  auto task = std::make_shared<std::packaged_task<decltype(work())()>>(std::move(work));
  auto result = task->get_future();
  std::thread([task] { (*task)(); }).detach();
  if (result.wait_for(std::chrono::duration<double>(seconds)) != std::future_status::ready) {
    note_abandoned_work();
    return std::nullopt;
  }
  return result.get();
}

}  // namespace st
