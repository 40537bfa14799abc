#include "stages/task_trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/packer.h"
#include "base/processor_time.h"
#include "io/file/text_file.h"

namespace st {
namespace {

thread_local std::uint64_t t_asked = 0;  // bytes

}  // namespace

TaskTrace::TaskTrace(const Executor& inner, std::string path) : WrappedExecutor(inner), path_(std::move(path)) {
  begin_serial();
}

void TaskTrace::begin_serial() const {
  serial_start_ = clock_.seconds();
  serial_loops_ = seconds_in_loops();
  serial_processor_ = process_seconds();
}

/// What rank 0 did since then.
void TaskTrace::end_serial() const {
  if (path_.empty() || !is_root()) return;
  Row row{"serial", phase_};
  row.call = n_calls_;
  row.start = serial_start_;
  row.wall = clock_.seconds() - serial_start_;
  row.processor = process_seconds() - serial_processor_;
  row.loops = seconds_in_loops().all - serial_loops_.all;
  row.longest = seconds_in_loops().longest - serial_loops_.longest;
  const std::lock_guard lock(mutex_);
  rows_.push_back(row);
}

void TaskTrace::begin_phase(const char* name) const {
  end_serial();
  phase_ = name;
  begin_serial();
}

void TaskTrace::broadcast(Bytes& bytes) const {
  end_serial();
  Row row{"broadcast", phase_};
  row.call = n_calls_;
  row.start = clock_.seconds();
  inner_.broadcast(bytes);
  row.wall = clock_.seconds() - row.start;
  row.bytes = bytes.size();
  if (is_root() && !path_.empty()) rows_.push_back(row);
  begin_serial();
}

std::int32_t TaskTrace::thread_number() const {
  return threads_.try_emplace(std::this_thread::get_id(), static_cast<std::int32_t>(threads_.size())).first->second;
}

void TaskTrace::run_tasks(std::int32_t, const std::vector<std::int32_t>& order,
                          const std::function<Bytes(std::int32_t)>& compute,
                          const std::function<void(std::int32_t, Bytes&&)>& collect) const {
  run_named_tasks({.order = order,
                   .label =
                       [](std::int32_t task) {
                         return TaskLabel{"task", task};
                       },
                   .made_from = ""},
                  compute, collect);
}

void TaskTrace::run_named_tasks(const NamedTasks& tasks, const std::function<Bytes(std::int32_t)>& compute,
                                const std::function<void(std::int32_t, Bytes&&)>& collect) const {
  if (path_.empty()) return inner_.run_named_tasks(tasks, compute, collect);
  end_serial();
  const std::int32_t call = ++n_calls_;
  double collect_seconds = 0;  // collectors run one at a time
  const auto timed = [&](std::int32_t task) {
    const TaskLabel label = tasks.label(task);
    Row row{"task", label.kind, label.id + 1, label.part, call, rank()};
    row.start = clock_.seconds();
    const double before = thread_seconds();
    const LoopSeconds loops = seconds_in_loops();
    t_asked = 0;
    Bytes result = compute(task);
    row.processor = thread_seconds() - before;
    row.asked = t_asked;
    row.loops = seconds_in_loops().all - loops.all;
    row.longest = seconds_in_loops().longest - loops.longest;
    row.wall = clock_.seconds() - row.start;
    row.bytes = result.size();
    const std::lock_guard lock(mutex_);
    row.thread = thread_number();
    rows_.push_back(row);
    return result;
  };
  inner_.run_named_tasks(tasks, timed, [&](std::int32_t task, Bytes&& result) {
    const double before = thread_seconds();
    collect(task, std::move(result));
    collect_seconds += thread_seconds() - before;
  });
  begin_serial();
  if (!is_root()) return;
  Row row{"collect", phase_};
  row.call = call;
  row.start = serial_start_;
  row.processor = collect_seconds;
  rows_.push_back(row);
}

void TaskTrace::has_own(std::size_t n_bytes) const { t_asked += n_bytes; }

std::vector<Bytes> TaskTrace::ask(const std::vector<Request>& requests) const {
  std::vector<Bytes> answers = inner_.ask(requests);
  for (const Bytes& bytes : answers) t_asked += bytes.size();
  return answers;
}

void TaskTrace::write() {
  end_serial();
  if (path_.empty()) return;
  const std::vector<Bytes> all = gather(packed(rows_));
  if (!is_root()) return;
  std::vector<Row> rows;
  for (const Bytes& bytes : all) {
    std::vector<Row> some;
    unpack(bytes, some);
    rows.insert(rows.end(), some.begin(), some.end());
  }
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
    return std::tie(a.start, a.rank, a.thread) < std::tie(b.start, b.rank, b.thread);
  });
  write_rows(rows);
}

void TaskTrace::write_rows(const std::vector<Row>& rows) const {
  std::string text = "event,name,id,part,call,rank,thread,start,wall,processor,bytes,asked,loops,longest\n";
  const auto number = [](std::int32_t n) { return n == kNothing ? "" : std::to_string(n); };
  for (const Row& r : rows)
    text += fmt::format("{},{},{},{},{},{},{},{:.6f},{:.6f},{:.6f},{},{},{:.6f},{:.6f}\n", r.event, r.name,
                        number(r.id), number(r.part), r.call, r.rank, r.thread, r.start, r.wall, r.processor, r.bytes,
                        r.asked, r.loops, r.longest);
  write_text_file(path_, text);
}

}  // namespace st
