// Curves made as tasks: each once, results in their places.
#include "meshing/engine/curve_tasks.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace st {
namespace {

/// Hands out tasks last first, so that results arrive out of order.
class Backwards : public SerialExecutor {
 public:
  void run_tasks(std::int32_t n, const std::vector<std::int32_t>& order,
                 const std::function<Bytes(std::int32_t)>& compute,
                 const std::function<void(std::int32_t, Bytes&&)>& collect) const override {
    SerialExecutor::run_tasks(n, {order.rbegin(), order.rend()}, compute, collect);
  }
};

TEST(CurveTasks, make_each_curve_once_and_keep_its_place) {
  for (const std::int32_t n : {0, 1, 23, 24, 25, 100}) {
    std::vector<int> n_calls(n, 0);
    const auto make = [&](std::int32_t i) {
      ++n_calls[i];
      return EdgeMesh::of_curve({0.0, i + 1.0}, {{0, 0, 0}, {double(i), 0, 0}}, {1.0, double(i)});
    };
    const EdgeMesh made = make_curve_nodes(n, make, Backwards());
    ASSERT_EQ(made.n_edges(), n);
    EXPECT_EQ(std::count(n_calls.begin(), n_calls.end(), 1), n);
    for (std::int32_t i = 0; i < n; ++i) {
      ASSERT_EQ(made.n_nodes(i), 2);
      EXPECT_EQ(made.node_t[2 * i + 1], i + 1.0);
      EXPECT_EQ(made.node_xyz[2 * i + 1].x, i);
      EXPECT_EQ(made.node_size[2 * i + 1], i);
    }
  }
}

}  // namespace
}  // namespace st
