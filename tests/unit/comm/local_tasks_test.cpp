// Tasks of a group of one rank.
#include "comm/local_tasks.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "base/error.h"

namespace st {
namespace {

Bytes byte_of(std::int32_t task) { return Bytes(1, static_cast<std::byte>(task)); }

TEST(LocalTasks, gives_the_result_of_each_task_to_collect_once) {
  std::map<std::int32_t, Bytes> results;
  run_local_tasks({2, 0, 1}, byte_of, [&](std::int32_t task, Bytes&& result) {
    EXPECT_TRUE(results.emplace(task, std::move(result)).second);
  });
  ASSERT_EQ(results.size(), 3u);
  for (const auto& [task, result] : results) EXPECT_EQ(result, byte_of(task));
}

TEST(LocalTasks, refuses_an_order_that_does_not_list_every_task_once) {
  for (const std::vector<std::int32_t>& order : {std::vector<std::int32_t>{0, 0}, {0, 2}, {-1, 0}})
    EXPECT_THROW(run_local_tasks(order, byte_of, [](std::int32_t, Bytes&&) {}), Error);
  EXPECT_THROW(require_order({0, 1}, 3), Error);
  EXPECT_NO_THROW(require_order({1, 0}, 2));
}

TEST(LocalTasks, passes_a_failure_on) {
  const auto fail = [](std::int32_t) -> Bytes { throw Error(ExitCode::kInput, "no such face"); };
  try {
    run_local_tasks({0}, fail, [](std::int32_t, Bytes&&) { FAIL(); });
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(std::string(e.what()), "no such face");
  }
}

}  // namespace
}  // namespace st
