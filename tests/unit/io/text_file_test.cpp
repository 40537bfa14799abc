// Files read and written whole.
#include "io/file/text_file.h"

#include <gtest/gtest.h>

#include "unit/io/temporary_directory.h"

namespace st {
namespace {

TEST(TextFile, has_the_bytes_that_were_written) {
  const TemporaryDirectory dir;
  const std::string bytes = std::string("a\0b\r\n\xff", 6);
  write_text_file(dir / "t", bytes);
  EXPECT_EQ(read_text_file(dir / "t"), bytes);
  write_text_file(dir / "t", "");
  EXPECT_EQ(read_text_file(dir / "t"), "");
  EXPECT_EQ(dir.files(), std::vector<std::string>{"t"}) << "no temporary is left";
}

TEST(TextFile, begins_after_a_byte_order_mark) {
  const TemporaryDirectory dir;
  write_text_file(dir / "t", "\xef\xbb\xbfsolid");
  EXPECT_EQ(read_text_file(dir / "t"), "solid");
  EXPECT_EQ(without_byte_order_mark("\xef\xbb"), "\xef\xbb");
}

TEST(TextFile, is_mapped_with_all_its_bytes) {
  const TemporaryDirectory dir;
  const std::string bytes = std::string(10000, 'a') + std::string("a\0b", 3);
  write_text_file(dir / "t", bytes);
  EXPECT_EQ(MappedBytes(dir / "t").bytes(), bytes);
  write_text_file(dir / "t", "");
  EXPECT_EQ(MappedBytes(dir / "t").bytes(), "");
  EXPECT_NE(MappedBytes("/proc/self/status").bytes().find("VmPeak"), std::string_view::npos);
  EXPECT_ERROR(MappedBytes(dir / "none"), kInput, "cannot be read");
}

TEST(TextFile, has_more_bytes_than_the_system_tells) {
  EXPECT_NE(read_text_file("/proc/self/status").find("VmPeak"), std::string::npos) << "its size is 0 there";
}

TEST(TextFile, refuses_folders_devices_and_missing_files) {
  const TemporaryDirectory dir;
  EXPECT_ERROR(read_text_file(dir.path()), kInput, "is a directory");
  EXPECT_ERROR(read_text_file(dir / "none"), kInput, "cannot be read");
  EXPECT_ERROR(read_text_file("/dev/null"), kInput, "is a pipe or a device, which might never end");
  EXPECT_ERROR(write_text_file(dir / "none/t", "x"), kOutput, "none");
  EXPECT_TRUE(dir.files().empty());
}

}  // namespace
}  // namespace st
