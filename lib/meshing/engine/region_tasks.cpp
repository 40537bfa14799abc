#include "meshing/engine/region_tasks.h"

#include <algorithm>
#include <iterator>

#include "base/share.h"

namespace st {
namespace {

constexpr double kLight = 0.25;  // of a tile: such regions take less time than cutting a heavy one

}  // namespace

void RegionTasks::run(const std::vector<std::int32_t>& all) {
  std::vector<std::int32_t> sound, light, rest;
  double all_weights = 0;
  for (const std::int32_t r : all) {
    if (!options_.left_out.contains(tiled_.face(r))) sound.push_back(r);
    all_weights += weight_[r];
  }
  Progress progress(steps_.progress, all_weights, steps_.unit);
  if (options_.tile_triangles > 0) tiled_.choose(sound, weight_, options_.tile_triangles);
  if (!tiled_.chosen().empty()) {
    for (const std::int32_t r : all)
      if (weight_[r] < kLight * options_.tile_triangles) light.push_back(r);
    std::vector<Task> tasks = cuts();
    add_whole(light, tasks, progress);
    run(tasks);
    tiled_.share_cuts(executor_);
  }
  for (const std::int32_t r : all)
    if (!tiled_.is_cut(r) && !std::ranges::binary_search(light, r)) rest.push_back(r);
  std::vector<Task> tasks, again;
  add_whole(rest, tasks, progress);
  add_tiles(tasks, progress);
  run(tasks);
  executor_.begin_phase("seams");
  std::vector<std::int32_t> failed = make_seams();
  tiled_.drop_sections();
  share(executor_, failed);
  add_whole(failed, again, progress);
  if (!failed.empty()) run(again);
}

void RegionTasks::run(const std::vector<Task>& tasks) {
  std::vector<double> work;
  for (const Task& task : tasks) work.push_back(task.work);
  executor_.run_named_tasks(
      {.order = heaviest_first(work),
       .label = [&](std::int32_t task) { return tasks[task].label; },
       .made_from = made_from_,
       .record = [&](std::int32_t task, const Bytes& result) { return tasks[task].record(result); },
       .restore = [&](std::int32_t task, Bytes&& whole) { return tasks[task].restore(std::move(whole)); },
       .answer = [&](const Bytes& request) { return tiled_.answer(request); }},
      [&](std::int32_t task) { return tasks[task].compute(); },
      [&](std::int32_t task, Bytes&& result) { tasks[task].collect(std::move(result)); });
}

std::vector<RegionTasks::Task> RegionTasks::cuts() {
  std::vector<Task> tasks;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(tiled_.chosen().size()); ++i)
    tasks.push_back({.label = tiled_.label(steps_.cut, tiled_.chosen()[i]),
                     .work = weight_[tiled_.chosen()[i]],
                     .compute = [this, i] { return tiled_.cut(i); },
                     .collect = [this, i](Bytes&& result) { tiled_.take_cut(i, result); }});
  return tasks;
}

void RegionTasks::add_whole(const std::vector<std::int32_t>& regions, std::vector<Task>& tasks, Progress& progress) {
  for (const std::int32_t r : regions)
    tasks.push_back({.label = tiled_.label(steps_.whole, r),
                     .work = weight_[r],
                     .compute = [this, r] { return steps_.make_whole(r); },
                     .collect =
                         [this, r, &progress](Bytes&& result) {
                           steps_.take_whole(r, std::move(result));
                           progress.advance(weight_[r]);
                         },
                     .record = steps_.record,
                     .restore = steps_.restore});
}

void RegionTasks::add_tiles(std::vector<Task>& tasks, Progress& progress) {
  for (std::int32_t t = 0; t < tiled_.n_sections(); ++t)
    tasks.push_back({.label = tiled_.label_of_tile(steps_.tile, t),
                     .work = tiled_.weight(t),
                     .compute = [this, t] { return tiled_.compute(t, executor_.rank()); },
                     .collect =
                         [this, t, &progress](Bytes&& result) {
                           tiled_.take_place(t, result);
                           progress.advance(tiled_.weight(t));
                         },
                     .record = [this, t](const Bytes&) { return tiled_.record(t); },
                     .restore = [this, t](Bytes&& whole) { return tiled_.restore(t, whole); }});
}

/// Collective. Returns the regions that are to be made as a whole, ascending, on rank 0.
std::vector<std::int32_t> RegionTasks::make_seams() {
  std::vector<std::int32_t> failed;
  if (tiled_.cut_regions().empty()) return failed;
  tiled_.share_places(executor_);
  std::vector<Task> tasks;
  for (const std::int32_t r : tiled_.cut_regions())
    tasks.push_back({.label = tiled_.label(steps_.seams, r),
                     .work = weight_[r],
                     .compute = [this, r] { return steps_.make_seams(r, tiled_); },
                     .collect =
                         [&, r](Bytes&& result) {
                           if (!steps_.take_seams(r, std::move(result))) failed.push_back(r);
                         },
                     .record = steps_.record,
                     .restore = steps_.restore});
  run(tasks);
  if (steps_.finish) std::ranges::copy(steps_.finish(tiled_), std::back_inserter(failed));
  std::ranges::sort(failed);
  return failed;
}

}  // namespace st
