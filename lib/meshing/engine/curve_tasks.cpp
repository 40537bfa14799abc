#include "meshing/engine/curve_tasks.h"

#include <algorithm>
#include <numeric>

#include "base/packer.h"

namespace st {
namespace {

constexpr std::int32_t kCurvesPerTask = 24;

}  // namespace

std::vector<CurveNodes> make_curve_nodes(std::int32_t n, const std::function<CurveNodes(std::int32_t i)>& make,
                                         const Executor& executor) {
  const std::int32_t n_tasks = (n + kCurvesPerTask - 1) / kCurvesPerTask;
  std::vector<std::int32_t> order(n_tasks);
  std::iota(order.begin(), order.end(), 0);
  std::vector<Bytes> results(n_tasks);
  const auto compute = [&](std::int32_t task) {
    Packer p;
    for (std::int32_t i = task * kCurvesPerTask; i < std::min(n, (task + 1) * kCurvesPerTask); ++i) {
      const CurveNodes nodes = make(i);
      p.add(nodes.t);
      p.add(nodes.x);
      p.add(nodes.h);
    }
    return p.take();
  };
  executor.run_tasks(n_tasks, order, compute,
                     [&](std::int32_t task, Bytes&& result) { results[task] = std::move(result); });
  Bytes all;
  for (const Bytes& bytes : results) all.insert(all.end(), bytes.begin(), bytes.end());
  executor.broadcast(all);
  std::vector<CurveNodes> nodes(n);
  Unpacker u(all);
  for (CurveNodes& c : nodes) {
    u.get(c.t);
    u.get(c.x);
    u.get(c.h);
  }
  return nodes;
}

}  // namespace st
