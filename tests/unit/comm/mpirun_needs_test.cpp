// What Open MPI needs of this machine.
#include "comm/mpirun_needs.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/resource.h>

#include <cstdlib>
#include <string>

#include "base/error.h"

namespace st {
namespace {

/// What is thrown, "" when nothing is.
std::string refusal(int n_ranks, ExitCode code) {
  try {
    require_needs_of_mpirun(n_ranks);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), code) << e.what();
    return e.what();
  }
  return "";
}

class MpirunNeeds : public testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("TMPDIR");
    folder_ = folder ? folder : "/tmp";
    getrlimit(RLIMIT_NOFILE, &limit_);
  }
  void TearDown() override {
    setenv("TMPDIR", folder_.c_str(), 1);
    setrlimit(RLIMIT_NOFILE, &limit_);
  }
  std::string folder_;
  rlimit limit_{};
};

TEST_F(MpirunNeeds, a_folder_for_its_files) {
  EXPECT_EQ(refusal(2, ExitCode::kOutput), "");
  for (const char* folder : {"/etc/passwd", "/nonexistent/folder"}) {
    setenv("TMPDIR", folder, 1);
    EXPECT_NE(refusal(2, ExitCode::kOutput).find(std::string(folder) + ": mpirun cannot keep its files there"),
              std::string::npos);
  }
  setenv("TMPDIR", "", 1);
  EXPECT_EQ(refusal(2, ExitCode::kOutput), "") << "/tmp";
}

TEST_F(MpirunNeeds, open_files_for_each_rank_of_a_limit_that_is_raised) {
  const rlimit low{20, limit_.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &low), 0);
  EXPECT_EQ(refusal(2, ExitCode::kUsage), "") << "up to the hard limit";
  rlimit now{};
  getrlimit(RLIMIT_NOFILE, &now);
  EXPECT_GE(now.rlim_cur, 40u);
  EXPECT_NE(refusal(1'000'000'000, ExitCode::kUsage).find("open files for 1000000000 ranks, and the limit is "),
            std::string::npos);
}

}  // namespace
}  // namespace st
