#include "meshing/engine/curve_tasks.h"

#include "base/share.h"

namespace st {
namespace {

constexpr std::int32_t kCurvesPerTask = 8;  // from all over the model: long curves often lie beside each other

}  // namespace

EdgeMesh make_curve_nodes(std::int32_t n, const std::function<EdgeMesh(std::int32_t i)>& make,
                          const Executor& executor) {
  const std::int32_t n_tasks = (n + kCurvesPerTask - 1) / kCurvesPerTask;
  std::vector<EdgeMesh> parts(n_tasks);
  const auto compute = [&](std::int32_t task) {
    EdgeMesh part;
    for (std::int32_t i = task; i < n; i += n_tasks) part.append(make(i));
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
  for (std::int32_t i = 0; i < n && executor.is_root(); ++i) all.append(parts[i % n_tasks], i / n_tasks);
  share(executor, all);
  return all;
}

}  // namespace st
