#include "stages/task_trace.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <sstream>
#include <thread>

#include "base/share.h"
#include "base/threads.h"
#include "io/file/text_file.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

/// The rows of a trace, as cells.
std::vector<std::vector<std::string>> rows_of(const std::string& path) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream text(read_text_file(path));
  for (std::string line; std::getline(text, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

void run(TaskTrace& trace) {
  trace.begin_phase("regions");
  std::vector<int> all(3, 0);
  trace.run_named_tasks(
      {{2, 0, 1},
       [](std::int32_t task) {
         return TaskLabel{"tile", 10 + task, task};
       },
       ""},
      [&](std::int32_t task) {
        trace.has_own(7);
        trace.has_own(static_cast<std::size_t>(task));
        parallel_for(2, 1,
                     [](std::size_t, std::size_t) { std::this_thread::sleep_for(std::chrono::microseconds(50)); });
        return Bytes(100 * (task + 1));
      },
      [&](std::int32_t task, Bytes&& bytes) { all[task] = static_cast<int>(bytes.size()); });
  EXPECT_EQ(all, (std::vector<int>{100, 200, 300}));
  trace.begin_phase("crossings");
  parallel_for(2, 1, [](std::size_t, std::size_t) { std::this_thread::sleep_for(std::chrono::milliseconds(1)); });
  share(trace, all);
  trace.write();
}

TEST(TaskTrace, has_a_row_for_each_task_broadcast_and_work_between) {
  const TemporaryDirectory directory;
  const SerialExecutor executor;
  TaskTrace trace(executor, directory / "trace.csv");
  run(trace);
  const auto rows = rows_of(directory / "trace.csv");
  ASSERT_EQ(rows[0][0], "event");
  std::vector<std::string> events, names;
  double last = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), rows[0].size());
    events.push_back(rows[i][0] + " " + rows[i][1] + " " + rows[i][2]);
    EXPECT_GE(std::stod(rows[i][7]), last) << "by their start";
    last = std::stod(rows[i][7]);
  }
  EXPECT_EQ(events, (std::vector<std::string>{"serial load ", "serial regions ", "task tile 13", "task tile 11",
                                              "task tile 12", "collect regions ", "serial regions ",
                                              "serial crossings ", "broadcast crossings ", "serial crossings "}));
  EXPECT_EQ(rows[3][10], "300") << "bytes of the first task that was handed out";
  EXPECT_EQ(rows[3][11], "9") << "bytes that it asked for";
  for (const int row : {3, 8}) EXPECT_GT(std::stod(rows[row][12]), 0) << "seconds in loops";
}

TEST(TaskTrace, without_a_file_only_passes_on) {
  const TemporaryDirectory directory;
  const SerialExecutor executor;
  TaskTrace trace(executor, "");
  EXPECT_FALSE(trace.has_listeners());
  run(trace);
  EXPECT_TRUE(std::filesystem::is_empty(directory / ""));
}

}  // namespace
}  // namespace st
