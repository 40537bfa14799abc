// What a launcher says of its ranks.
#include <gtest/gtest.h>

#include <cstdlib>

#include "base/error.h"
#include "comm/communicator.h"

namespace st {
namespace {

constexpr const char* kVariables[] = {
    "OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMI_RANK", "PMIX_RANK", "SLURM_PROCID", "SLURM_STEP_ID",
    "SLURM_STEP_NUM_TASKS"};

class Launcher : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : kVariables) unsetenv(name);
  }
  void TearDown() override { SetUp(); }
};

TEST_F(Launcher, has_no_ranks_where_none_started_this_process) { EXPECT_EQ(launched_ranks(), 0); }

TEST_F(Launcher, says_how_many_ranks_it_started) {
  setenv("OMPI_COMM_WORLD_SIZE", "3", 1);
  EXPECT_EQ(launched_ranks(), 3);
}

TEST_F(Launcher, may_not_say_how_many) {
  setenv("PMIX_RANK", "0", 1);
  EXPECT_EQ(launched_ranks(), -1);
}

TEST_F(Launcher, is_no_step_of_a_batch_script) {
  setenv("SLURM_PROCID", "0", 1);
  EXPECT_EQ(launched_ranks(), 0);
  setenv("SLURM_STEP_ID", "0", 1);
  setenv("SLURM_STEP_NUM_TASKS", "2", 1);
  EXPECT_EQ(launched_ranks(), 2);
}

TEST_F(Launcher, starts_nothing_for_one_rank_and_refuses_less) {
  const auto ignore = [](const std::string&) {};
  EXPECT_EQ(run_under_mpirun(1, {}, ignore), std::nullopt);
  EXPECT_THROW(run_under_mpirun(0, {}, ignore), Error);
}

}  // namespace
}  // namespace st
