#include "stages/resumption.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <new>
#include <thread>
#include <utility>

#include "base/hash.h"
#include "base/log.h"
#include "base/packer.h"
#include "base/share.h"
#include "base/supervised_program.h"
#include "base/text.h"
#include "io/file/temporary_file.h"

namespace st {
namespace {

constexpr auto kLastBreath = std::chrono::seconds(5);  // ranks of a job that was ended may live a little longer
constexpr auto kPause = std::chrono::milliseconds(50);

/// Another build may mesh otherwise: its size and age stand for the program.
std::string program_mark() {
  struct stat info {};
  if (stat("/proc/self/exe", &info) != 0) return "";
  return fmt::format("{} {} {}", info.st_size, info.st_mtim.tv_sec, info.st_mtim.tv_nsec);
}

WorkKey key_of(const std::string& run) {
  Hasher hasher;
  hasher.add(std::string_view(ST_VERSION));
  hasher.add(std::string_view(program_mark()));
  hasher.add(std::string_view(run));
  return work_key(hasher.hex());
}

Work work_of(const TaskLabel& label, const std::string& made_from) {
  const std::string text = fmt::format("{} {} {} {}", label.kind, label.id, label.part, made_from);
  return {work_key(hash_hex(text.data(), text.size())), label.id};
}

std::string reason_of(int signal) {
  if (signal == SIGUSR1) return "the mesher did not end here, a defect";
  if (signal == SIGKILL)
    return "it was being meshed when two runs were ended by " + signal_text(signal) + ", perhaps for want of memory";
  return "the mesher crashed here by " + signal_text(signal) + ", a defect";
}

}  // namespace

Resumption::Resumption(const Executor& inner, const std::string& output, const std::string& run,
                       const ResumeOptions& options)
    : WrappedExecutor(inner), output_(output) {
  Journal::Place place{journal_folder(output), {}, 0, inner.rank(), options.after};
  if (is_root()) {
    place.run_key = key_of(run);
    read(place.run_key, options);
    place.run = earlier_ ? earlier_->next_run() : 1;
    if (earlier_ && earlier_->is_in_use()) place.run = 0;
    if (earlier_ && (earlier_->is_in_use() || earlier_->is_empty())) earlier_.reset();
    is_resuming_ = earlier_.has_value();
  }
  std::vector<FaceId> faces;
  std::vector<int> signals;
  if (earlier_)
    for (const auto& [face, signal] : earlier_->crashes()) faces.push_back(face), signals.push_back(signal);
  share(inner_, place.run_key, place.run, is_resuming_, faces, signals);
  for (std::size_t i = 0; i < faces.size(); ++i) left_out_[faces[i]] = reason_of(signals[i]);
  if (place.run > 0) journal_.emplace(std::move(place));
}

void Resumption::read(const WorkKey& run_key, const ResumeOptions& options) {
  const std::string folder = journal_folder(output_);
  const auto look = [&] { earlier_.emplace(folder, run_key); };
  look();
  for (const auto start = std::chrono::steady_clock::now();
       earlier_->is_in_use() && std::chrono::steady_clock::now() - start < kLastBreath; look())
    std::this_thread::sleep_for(kPause);
  if (earlier_->is_in_use())
    return log_warning(folder + ": another run is writing the same output; nothing of this one is kept");
  if (earlier_->next_run() > 1) remove_left_temporaries(output_);  // of the run that has ended
  if (options.begins_new || earlier_->is_empty()) {
    earlier_.reset();
    remove_journal(output_);
    return;
  }
  if (earlier_->n_done() > 0)
    log_report(fmt::format("goes on where an earlier run ended: {} finished, in {} (--no-resume begins anew)",
                           counted(earlier_->n_done(), "part is", "parts are"), folder));
}

void Resumption::end() {
  if (journal_) journal_->end();
  if (size() > 1) inner_.gather({});  // rank 0 knows that all have ended
}

void Resumption::remove() {
  if (journal_) remove_journal(output_);
}

/// Local, on rank 0. What an earlier run has made is collected; what is left, in this order.
std::vector<std::int32_t> Resumption::collect_done(const std::vector<Work>& works, const NamedTasks& tasks,
                                                   const Collect& collect) const {
  std::vector<std::int32_t> rest;
  for (const std::int32_t task : tasks.order) {
    auto result = earlier_->result(works[task].key);
    if (!result)
      rest.push_back(task);
    else
      collect(task, tasks.restore ? tasks.restore(task, std::move(*result)) : std::move(*result));
  }
  n_resumed_ += static_cast<std::int64_t>(tasks.order.size() - rest.size());
  return rest;
}

void Resumption::run_named_tasks(const NamedTasks& tasks, const Compute& compute, const Collect& collect) const {
  if (tasks.made_from.empty()) return inner_.run_named_tasks(tasks, compute, collect);
  std::vector<Work> works;
  for (std::int32_t task = 0; task < static_cast<std::int32_t>(tasks.order.size()); ++task)
    works.push_back(work_of(tasks.label(task), tasks.made_from));
  n_tasks_ += static_cast<std::int64_t>(works.size());
  std::vector<std::int32_t> rest = tasks.order, suspects;
  if (is_resuming_) {
    if (is_root()) {
      rest = collect_done(works, tasks, collect);
      const auto others = std::stable_partition(
          rest.begin(), rest.end(), [&](std::int32_t task) { return earlier_->deaths().contains(works[task].key); });
      suspects.assign(rest.begin(), others);
      rest.erase(rest.begin(), others);
    }
    share(inner_, rest, suspects);
  }
  const auto kept = [&](std::int32_t task) {
    if (!journal_) return compute(task);
    journal_->begin(works[task]);
    try {
      Bytes result = compute(task);
      journal_->finish(works[task], [&] { return tasks.record ? tasks.record(task, result) : result; });
      return result;
    } catch (const std::bad_alloc&) {
      journal_->fail(works[task]);
      throw;
    }
  };
  for (const std::int32_t suspect : suspects) run_some(tasks, {suspect}, kept, collect);
  run_some(tasks, rest, kept, collect);
}

/// Collective. These of the tasks, in this order.
void Resumption::run_some(const NamedTasks& tasks, const std::vector<std::int32_t>& some, const Compute& compute,
                          const Collect& collect) const {
  NamedTasks of_some;
  of_some.order.resize(some.size());
  std::iota(of_some.order.begin(), of_some.order.end(), 0);
  of_some.label = [&](std::int32_t i) { return tasks.label(some[i]); };
  of_some.made_from = tasks.made_from;
  if (!tasks.home.empty())
    for (const std::int32_t task : some) of_some.home.push_back(tasks.home[task]);
  of_some.answer = tasks.answer;
  inner_.run_named_tasks(
      of_some, [&](std::int32_t i) { return compute(some[i]); },
      [&](std::int32_t i, Bytes&& bytes) { collect(some[i], std::move(bytes)); });
}

}  // namespace st
