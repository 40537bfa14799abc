#include "base/mapped_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <vector>

namespace st {
namespace {

class MappedFile : public testing::Test {
 protected:
  MappedFile() : fd_(mkstemp(path_)) {
    const std::string bytes(kLength, 'x');
    EXPECT_EQ(write(fd_, bytes.data(), bytes.size()), static_cast<ssize_t>(kLength));
  }
  ~MappedFile() override {
    close(fd_);
    unlink(path_);
  }
  static constexpr std::size_t kLength = 5000;
  char path_[32] = "/tmp/mapped_file_XXXXXX";
  int fd_;
};

TEST_F(MappedFile, is_known_by_its_addresses_while_it_is_mapped) {
  std::shared_ptr<const void> first = map_file(fd_, 0, kLength, "first"), second = map_file(fd_, 0, 10, "second");
  const char* bytes = static_cast<const char*>(first.get());
  EXPECT_EQ(bytes[kLength - 1], 'x');
  EXPECT_STREQ(mapped_file_at(bytes), "first");
  EXPECT_STREQ(mapped_file_at(bytes + kLength - 1), "first");
  EXPECT_STREQ(mapped_file_at(second.get()), "second");
  EXPECT_EQ(mapped_file_at(nullptr), nullptr);
  EXPECT_EQ(mapped_file_at(&bytes), nullptr);
  first.reset();
  EXPECT_EQ(mapped_file_at(bytes), nullptr);
  EXPECT_STREQ(mapped_file_at(second.get()), "second");
}

TEST_F(MappedFile, is_mapped_without_a_name_when_there_are_many) {
  std::vector<std::shared_ptr<const void>> many;
  for (int i = 0; i < 100; ++i) {
    many.push_back(map_file(fd_, 0, 1, "file"));
    ASSERT_EQ(*static_cast<const char*>(many.back().get()), 'x');
  }
  EXPECT_EQ(mapped_file_at(many.back().get()), nullptr);
  many.clear();
  const std::shared_ptr<const void> again = map_file(fd_, 0, 1, "again");
  EXPECT_STREQ(mapped_file_at(again.get()), "again");
}

TEST(MappedFileOf, no_open_file_is_null) { EXPECT_EQ(map_file(-1, 0, 1, "none"), nullptr); }

}  // namespace
}  // namespace st
