// What the threads of a rank give back, without MPI.
#include "comm/worker_threads.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "base/error.h"

namespace st {
namespace {

constexpr std::chrono::seconds kLongEnough{20};

Outcome outcome_of(const Compute& compute) {
  WorkerThreads threads(0, compute);
  threads.give(7);
  threads.wait(kLongEnough);
  return threads.take().value();
}

std::string text_of(const Outcome& outcome) {
  return {reinterpret_cast<const char*>(outcome.bytes.data()), outcome.bytes.size()};
}

TEST(WorkerThreads, give_back_each_task_with_its_result) {
  const Outcome outcome = outcome_of([](std::int32_t task) { return Bytes(3, static_cast<std::byte>(task)); });
  EXPECT_EQ(outcome.task, 7);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.bytes, Bytes(3, std::byte{7}));
}

TEST(WorkerThreads, make_every_failure_an_outcome) {
  const Outcome bad_input = outcome_of([](std::int32_t) -> Bytes { throw Error(ExitCode::kInput, "no such face"); });
  EXPECT_EQ(bad_input.code, static_cast<std::int32_t>(ExitCode::kInput));
  EXPECT_EQ(text_of(bad_input), "no such face");
  const Outcome odd = outcome_of([](std::int32_t) -> Bytes { throw std::runtime_error("odd"); });
  EXPECT_EQ(odd.code, static_cast<std::int32_t>(ExitCode::kInternal));
  EXPECT_EQ(text_of(odd), "internal error: odd");
}

TEST(WorkerThreads, wait_for_the_answers_to_all_their_questions_in_order) {
  const Compute compute = [](std::int32_t) {
    const std::vector<Bytes> answers = ask_ranks({{1, Bytes(1)}, {2, Bytes(2)}});
    return Bytes(10 * answers[0].size() + answers[1].size());
  };
  WorkerThreads threads(0, compute);
  threads.give(0);
  threads.wait(kLongEnough);
  const Question first = threads.take_question().value(), second = threads.take_question().value();
  EXPECT_EQ(second.request.rank, 2);
  EXPECT_FALSE(threads.take_question());
  threads.answer(second, Bytes(4));
  EXPECT_FALSE(threads.take());
  threads.answer(first, Bytes(3));
  threads.wait(kLongEnough);
  EXPECT_EQ(threads.take().value().bytes.size(), 34u);
}

TEST(WorkerThreads, end_tasks_that_nobody_answers) {
  const Compute compute = [](std::int32_t) { return ask_ranks({{1, {}}})[0]; };
  WorkerThreads threads(0, compute);
  threads.give(0);
  threads.wait(kLongEnough);
  EXPECT_TRUE(threads.take_question());
}

TEST(WorkerThreads, alone_ask_others) {
  EXPECT_TRUE(ask_ranks({}).empty());
  EXPECT_THROW(ask_ranks({{0, {}}}), Error);
}

}  // namespace
}  // namespace st
