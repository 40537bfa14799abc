#include "stages/same_inputs.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/packer.h"

namespace st {
namespace {

/// Three ranks, of which one has read other contents.
class ThreeRanks : public SerialExecutor {
 public:
  explicit ThreeRanks(std::string of_last) : of_last_(std::move(of_last)) {}
  int size() const override { return 3; }
  std::vector<Bytes> gather(Bytes own) const override {
    Packer last;
    for (const std::string& text : {std::string("node7"), std::string("aa"), of_last_}) last.add(text);
    return {own, own, last.take()};
  }

 private:
  std::string of_last_;
};

const std::vector<OpenedFile> kFiles = {{"/home/g.hdf", "aa"}, {"/home/s.hdf", "bb"}};

TEST(SameInputs, pass_where_all_ranks_read_the_same) {
  EXPECT_NO_THROW(require_same_inputs(ThreeRanks("bb"), kFiles));
  EXPECT_NO_THROW(require_same_inputs(SerialExecutor(), kFiles));
}

TEST(SameInputs, name_file_rank_and_host_of_an_old_copy) {
  try {
    require_same_inputs(ThreeRanks("cc"), kFiles);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kMismatch);
    for (const char* part : {"/home/s.hdf", "rank 2 on node7", "(cc)", "(bb)"})
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    EXPECT_EQ(std::string(e.what()).find("g.hdf"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace st
