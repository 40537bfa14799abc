#include "comm/worker_threads.h"

#include <atomic>
#include <string>
#include <system_error>
#include <utility>

#include "base/current_work.h"
#include "base/error.h"
#include "base/threads.h"
#include "comm/mpirun_report.h"

namespace st {
namespace {

using Clock = std::chrono::steady_clock;

std::atomic<WorkerThreads*> g_threads = nullptr;  // of the tasks that run now

Bytes to_bytes(const std::string& text) {
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

Outcome run_task(std::int32_t task, int rank, const Compute& compute) {
  Outcome outcome;
  outcome.task = task;
  const auto start = Clock::now();
  const auto fail = [&](ExitCode code, const std::string& text) {
    outcome.code = static_cast<std::int32_t>(code);
    outcome.bytes = to_bytes(text);
  };
  try {
    outcome.bytes = with_memory_named([&] { return compute(task); });
  } catch (const Error& e) {
    fail(e.code(), (e.code() == ExitCode::kMemory ? rank_on_this_host(rank) + ": " : "") + e.what());
  } catch (const std::exception& e) {
    fail(ExitCode::kInternal, std::string("internal error: ") + e.what());
  } catch (...) {
    fail(ExitCode::kInternal, "internal error: unknown exception");
  }
  outcome.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return outcome;
}

template <class Item>
std::optional<Item> take_first(std::deque<Item>& items) {
  if (items.empty()) return std::nullopt;
  Item first = std::move(items.front());
  items.pop_front();
  return first;
}

}  // namespace

WorkerThreads::WorkerThreads(int rank, const Compute& compute) {
  g_threads = this;
  try {
    for (int i = 0; i < thread_count(); ++i) threads_.emplace_back([this, rank, &compute] { work(rank, compute); });
  } catch (const std::system_error& e) {  // those there are do it
    if (!threads_.empty()) return;
    g_threads = nullptr;
    throw Error(ExitCode::kMemory, std::string("no thread can be started: ") + e.what());
  }
}

WorkerThreads::~WorkerThreads() {
  {
    const std::lock_guard lock(mutex_);
    tasks_.assign(threads_.size(), kStop);
    is_ending_ = true;
  }
  has_task_.notify_all();
  has_answers_.notify_all();
  for (std::thread& thread : threads_) thread.join();
  g_threads = nullptr;
}

void WorkerThreads::give(std::int32_t task) {
  {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(task);
  }
  has_task_.notify_one();
}

std::optional<Outcome> WorkerThreads::take() {
  const std::lock_guard lock(mutex_);
  return take_first(outcomes_);
}

void WorkerThreads::wait(std::chrono::microseconds time) {
  std::unique_lock lock(mutex_);
  has_news_.wait_for(lock, time, [&] { return !outcomes_.empty() || !questions_.empty(); });
}

std::vector<Bytes> WorkerThreads::ask(const std::vector<Request>& requests) {
  std::vector<Bytes> answers(requests.size());
  std::size_t n_missing = requests.size();
  std::unique_lock lock(mutex_);
  for (std::size_t i = 0; i < requests.size(); ++i) questions_.push_back({requests[i], &answers[i], &n_missing});
  has_news_.notify_one();
  has_answers_.wait(lock, [&] { return n_missing == 0 || is_ending_; });
  if (n_missing > 0) throw Error(ExitCode::kInternal, "a task waited for another rank when the job ended");
  return answers;
}

std::optional<Question> WorkerThreads::take_question() {
  const std::lock_guard lock(mutex_);
  return take_first(questions_);
}

void WorkerThreads::answer(const Question& question, Bytes&& bytes) {
  const std::lock_guard lock(mutex_);
  *question.answer = std::move(bytes);
  if (--*question.n_missing == 0) has_answers_.notify_all();
}

void WorkerThreads::work(int rank, const Compute& compute) {
  while (true) {
    std::int32_t task = kStop;
    {
      std::unique_lock lock(mutex_);
      has_task_.wait(lock, [&] { return !tasks_.empty(); });
      task = tasks_.front();
      tasks_.pop_front();
    }
    if (task == kStop) return;
    Outcome outcome = run_task(task, rank, compute);
    {
      const std::lock_guard lock(mutex_);
      outcomes_.push_back(std::move(outcome));
    }
    has_news_.notify_one();
  }
}

std::vector<Bytes> ask_ranks(const std::vector<Request>& requests) {
  WorkerThreads* threads = g_threads;
  if (requests.empty()) return {};
  if (!threads) throw Error(ExitCode::kInternal, "no task runs that could ask other ranks");
  return threads->ask(requests);
}

}  // namespace st
