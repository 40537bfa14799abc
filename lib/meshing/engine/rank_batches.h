// Small jobs, each of one rank, put together to tasks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "base/executor.h"

namespace st {

/// Jobs of one rank that make up a task.
struct RankBatch {
  std::int32_t home;
  double weight = 0;
  std::vector<std::size_t> jobs;
};

/// So many that a message is worth it, not so many that one is long.
template <class Job, class Home, class Weight>
std::vector<RankBatch> batches_of(const std::vector<Job>& jobs, const Home& home, const Weight& weight) {
  constexpr double kEnough = 20'000;
  std::map<std::int32_t, RankBatch> open;  // by rank
  std::vector<RankBatch> batches;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    RankBatch& batch = open.try_emplace(home(jobs[i]), RankBatch{home(jobs[i]), 0, {}}).first->second;
    batch.jobs.push_back(i);
    batch.weight += weight(jobs[i]);
    if (batch.weight < kEnough) continue;
    batches.push_back(std::move(batch));
    open.erase(batches.back().home);
  }
  for (auto& [rank, batch] : open) batches.push_back(std::move(batch));
  return batches;
}

/// A task of each batch, at its rank, the heaviest first; named `kind` and its number.
inline NamedTasks tasks_of(const std::vector<RankBatch>& batches, const char* kind) {
  NamedTasks tasks;
  std::vector<double> weight;
  for (const RankBatch& batch : batches) {
    tasks.home.push_back(batch.home);
    weight.push_back(batch.weight);
  }
  tasks.order = heaviest_first(weight);
  tasks.label = [kind](std::int32_t task) { return TaskLabel{kind, task}; };
  return tasks;
}

}  // namespace st
