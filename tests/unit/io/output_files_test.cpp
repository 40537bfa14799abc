// Which files a run may write.
#include "io/file/output_files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "io/file/temporary_file.h"
#include "io/file/text_file.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

/// Rules that hold as long as a test.
class OutputFiles : public testing::Test {
 protected:
  void TearDown() override { set_output_rules({}); }
  void rules(std::vector<std::string> inputs, std::vector<std::string> named, std::vector<std::string> defaults = {}) {
    set_output_rules({std::move(inputs), std::move(named), std::move(defaults),
                      [](const std::string& path) { return read_bytes(path).find("by ST") != std::string::npos; }});
  }
  const TemporaryDirectory dir;
};

TEST_F(OutputFiles, an_input_is_no_output_under_any_name) {
  write_bytes(dir / "a", "mine");
  std::filesystem::create_symlink(dir / "a", dir / "link");
  std::filesystem::create_hard_link(dir / "a", dir / "hard");
  std::filesystem::create_directory(dir / "sub");
  std::filesystem::create_directory_symlink(dir.path(), dir / "sub/there");
  for (const char* name : {"a", "link", "hard", "sub/../a", "sub/there/a"}) {
    EXPECT_ERROR(rules({dir / "a"}, {dir / name}), kUsage, "is an input and would be overwritten");
    EXPECT_ERROR(rules({dir / name}, {}, {dir / "a"}), kUsage, "is an input and would be overwritten");
    rules({dir / "a"}, {});
    EXPECT_ERROR(require_derived_outputs({dir / name}), kUsage, "is an input and would be overwritten");
    EXPECT_ERROR(write_text_file(dir / name, "new"), kUsage, "is an input and would be overwritten");
  }
  EXPECT_EQ(read_bytes(dir / "a"), "mine");
}

TEST_F(OutputFiles, no_file_is_written_twice) {
  EXPECT_ERROR(rules({}, {dir / "a", dir / "./a"}), kUsage, "given twice");
  EXPECT_ERROR(rules({}, {dir / "a"}, {dir / "a"}), kUsage, "given twice");
  rules({}, {dir / "a"}, {dir / "b"});
  EXPECT_ERROR(require_derived_outputs({dir / "c", dir / "a"}), kUsage, "given twice");
  EXPECT_ERROR(require_derived_outputs({dir / "b"}), kUsage, "given twice");
}

TEST_F(OutputFiles, what_the_user_named_is_replaced_and_nothing_else_of_his) {
  for (const char* name : {"named", "default", "derived"}) write_bytes(dir / name, "mine");
  rules({}, {dir / "named"}, {dir / "default"});
  write_text_file(dir / "named", "new");
  EXPECT_EQ(read_bytes(dir / "named"), "new");
  for (const char* name : {"default", "derived"}) {
    EXPECT_ERROR(require_writable(dir / name), kOutput, "ST did not write it");
    EXPECT_ERROR(write_text_file(dir / name, "new"), kOutput, "ST did not write it");
    EXPECT_EQ(read_bytes(dir / name), "mine");
  }
  EXPECT_ERROR(require_derived_outputs({dir / "derived"}), kOutput, "ST did not write it");
}

TEST_F(OutputFiles, what_st_wrote_is_replaced_until_somebody_changes_it) {
  rules({}, {});
  for (const char* text : {"first", "second, longer", "third"}) write_text_file(dir / "a", text);
  write_text_file(dir / "b", "b");
  require_writable(dir / "a");
  write_bytes(dir / "a", "third!");
  EXPECT_ERROR(require_writable(dir / "a"), kOutput, "it was changed since");
  write_bytes(dir / "a", "thirD");
  EXPECT_ERROR(require_writable(dir / "a"), kOutput, "it was changed since");
  write_bytes(dir / "a", "third");
  require_writable(dir / "a");
  require_writable(dir / "b");
}

TEST_F(OutputFiles, the_record_is_as_cksum_prints_it) {
  rules({}, {});
  write_text_file(dir / "a b", std::string(1'000'003, 'x'));
  write_text_file(dir / "c", "123456789");
  write_text_file(dir / "c", "123456789\n");
  EXPECT_EQ(read_bytes(dir / kRecordName), "3781298261 1000003 a b\n1552147931 10 c\n");
}

TEST_F(OutputFiles, artifacts_and_empty_files_are_replaced) {
  rules({}, {});
  write_bytes(dir / "empty", "");
  write_bytes(dir / "artifact", "\x89HDF\r\n\x1a\n by ST");
  write_bytes(dir / "foreign", "\x89HDF\r\n\x1a\n by others");
  write_bytes(dir / "text", "by ST");
  require_writable(dir / "empty");
  require_writable(dir / "artifact");
  EXPECT_ERROR(require_writable(dir / "foreign"), kOutput, "ST did not write it");
  EXPECT_ERROR(require_writable(dir / "text"), kOutput, "ST did not write it");
}

TEST_F(OutputFiles, a_record_that_is_none_neither_blocks_nor_helps) {
  rules({}, {});
  ASSERT_EQ(mkfifo((dir / kRecordName).c_str(), 0600), 0);
  write_text_file(dir / "a", "new");
  EXPECT_ERROR(require_writable(dir / "a"), kOutput, "ST did not write it");
}

}  // namespace
}  // namespace st
