#include "meshing/engine/curve_tasks.h"

#include <algorithm>

#include "base/share.h"

namespace st {
namespace {

constexpr std::int32_t kCurvesPerTask = 8;

}  // namespace

EdgeMesh make_curve_nodes(std::int32_t n, const std::function<EdgeMesh(std::int32_t i)>& make,
                          const Executor& executor) {
  const std::int32_t n_tasks = (n + kCurvesPerTask - 1) / kCurvesPerTask;
  std::vector<EdgeMesh> parts(n_tasks);
  const auto compute = [&](std::int32_t task) {
    EdgeMesh part;
    for (std::int32_t i = task * kCurvesPerTask; i < std::min(n, (task + 1) * kCurvesPerTask); ++i)
      part.append(make(i));
    return packed(part);
  };
  executor.run_named_tasks({.order = heaviest_first(std::vector<double>(n_tasks, 1)),
                            .label =
                                [](std::int32_t task) {
                                  return TaskLabel{"curves", task};
                                },
                            .made_from = ""},
                           compute, [&](std::int32_t task, Bytes&& result) { unpack(result, parts[task]); });
  EdgeMesh all = EdgeMesh::of_edges(0);
  for (const EdgeMesh& part : parts)
    for (EdgeId i = 0; i < part.n_edges(); ++i) all.append(part, i);
  share(executor, all);
  return all;
}

}  // namespace st
