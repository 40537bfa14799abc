#include "stages/resumption.h"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <new>

#include "unit/io/temporary_directory.h"

namespace st {
namespace {

constexpr int kTasks = 6;

class ResumptionTest : public ::testing::Test {
 protected:
  /// Tasks computed, in order. Results are checked. The task that is to fail throws `failure`.
  template <class Failure = std::bad_alloc>
  std::vector<std::int32_t> run(int fails_at = kNone, const std::string& made_from = "edges", bool begins_new = false) {
    Resumption resumption(executor_, output(), "inputs", {0, begins_new});
    left_out_ = resumption.left_out();
    std::vector<std::int32_t> computed, collected;
    const NamedTasks tasks{{5, 4, 3, 2, 1, 0}, [](std::int32_t task) { return TaskLabel{"face", task}; }, made_from};
    const auto compute = [&](std::int32_t task) {
      if (task == fails_at) throw Failure();
      computed.push_back(task);
      return packed(made_from + std::to_string(task));
    };
    const auto collect = [&](std::int32_t task, Bytes&& bytes) {
      EXPECT_EQ(bytes, packed(made_from + std::to_string(task)));
      collected.push_back(task);
    };
    try {
      resumption.run_named_tasks(tasks, compute, collect);
      EXPECT_EQ(collected.size(), tasks.order.size());
      EXPECT_EQ(resumption.n_tasks(), kTasks);
      EXPECT_EQ(resumption.n_resumed(), kTasks - static_cast<int>(computed.size()));
      resumption.end();
    } catch (const Failure&) {
    }
    return computed;
  }

  std::string output() const { return directory_ / "p.hdf"; }

  TemporaryDirectory directory_;
  SerialExecutor executor_;
  std::map<FaceId, std::string> left_out_;
};

using Tasks = std::vector<std::int32_t>;
struct Ended : std::exception {};

TEST_F(ResumptionTest, makes_only_what_is_not_finished) {
  EXPECT_EQ(run<Ended>(2), (Tasks{5, 4, 3}));
  EXPECT_EQ(run(), (Tasks{2, 1, 0}));
  EXPECT_TRUE(left_out_.empty());
  EXPECT_EQ(run(), Tasks());
}

TEST_F(ResumptionTest, makes_all_that_is_made_from_something_else) {
  run();
  EXPECT_EQ(run(kNone, "other edges").size(), kTasks);
}

TEST_F(ResumptionTest, begins_anew_when_it_is_told_to) {
  run<Ended>(2);
  EXPECT_EQ(run(kNone, "edges", true).size(), kTasks);
}

TEST_F(ResumptionTest, tries_first_what_ran_out_of_memory_and_leaves_it_out_after_the_second_time) {
  EXPECT_EQ(run(1), (Tasks{5, 4, 3, 2}));
  EXPECT_EQ(run(1), Tasks()) << "first of all";
  run();
  ASSERT_EQ(left_out_.size(), 1u);
  EXPECT_NE(left_out_.at(1).find("two runs"), std::string::npos);
}

TEST_F(ResumptionTest, goes_on_without_the_face_of_a_crash) {
  {
    const Resumption resumption(executor_, output(), "inputs", {});
    note_crash(3, SIGSEGV);
  }
  run();
  ASSERT_EQ(left_out_.size(), 1u);
  EXPECT_NE(left_out_.at(3).find("signal 11"), std::string::npos);
}

TEST_F(ResumptionTest, removes_its_folder_in_the_end) {
  Resumption resumption(executor_, output(), "inputs", {0, false});
  EXPECT_TRUE(std::filesystem::exists(journal_folder(output())));
  resumption.end();
  resumption.remove();
  EXPECT_FALSE(std::filesystem::exists(journal_folder(output())));
}

}  // namespace
}  // namespace st
