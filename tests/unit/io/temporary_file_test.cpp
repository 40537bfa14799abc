// Files that appear under their name only when they are complete.
#include "io/file/temporary_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "unit/io/temporary_directory.h"

namespace st {
namespace {

TEST(TemporaryFile, appears_under_its_name_when_it_is_committed) {
  const TemporaryDirectory dir;
  write_bytes(dir / "a", "old");
  TemporaryFile file(dir / "a");
  EXPECT_EQ(file.path(), dir / "a");
  write_bytes(file.name(), "new");
  EXPECT_EQ(read_bytes(dir / "a"), "old") << "untouched so far";
  file.commit();
  EXPECT_EQ(read_bytes(dir / "a"), "new");
  EXPECT_EQ(dir.files(), std::vector<std::string>{"a"});
}

TEST(TemporaryFile, leaves_nothing_when_it_is_not) {
  const TemporaryDirectory dir;
  {
    const TemporaryFile file(dir / "a");
    write_bytes(file.name(), "half of it");
  }
  EXPECT_TRUE(dir.files().empty());
}

TEST(TemporaryFile, has_a_name_of_its_own_each) {
  const TemporaryDirectory dir;
  const TemporaryFile a(dir / "a"), b(dir / "a");
  EXPECT_NE(a.name(), b.name());
}

TEST(TemporaryFile, removes_what_a_killed_process_left_a_minute_ago_and_nothing_else) {
  namespace fs = std::filesystem;
  const TemporaryDirectory dir;
  const std::string dead = ".a.tmp.999999999.0";  // above the largest number of a process
  const std::string just_now = ".a.tmp.999999998.0", alive = ".a.tmp." + std::to_string(getppid()) + ".0";
  for (const std::string& name :
       {dead, just_now, alive, std::string(".b.tmp.999999999.0"), std::string(".a.tmp.x.0")}) {
    write_bytes(dir / name, "");
    if (name != just_now) fs::last_write_time(dir / name, fs::file_time_type::clock::now() - std::chrono::minutes(2));
  }
  TemporaryFile file(dir / "a");
  write_bytes(file.name(), "");
  file.commit();
  std::vector<std::string> left = dir.files();
  std::sort(left.begin(), left.end());
  std::vector<std::string> expected{"a", just_now, alive, ".b.tmp.999999999.0", ".a.tmp.x.0"};
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(left, expected);
}

TEST(TemporaryFile, is_refused_where_it_cannot_be_written) {
  const TemporaryDirectory dir;
  EXPECT_ERROR(TemporaryFile(dir / "none/a"), kOutput, "none");
  EXPECT_ERROR(TemporaryFile(dir.path()), kOutput, "director");
}

TEST(TemporaryFile, is_refused_by_what_is_wrong_with_its_name) {
  const TemporaryDirectory dir;
  write_bytes(dir / "file", "");
  ASSERT_EQ(mkfifo((dir / "pipe").c_str(), 0600), 0);
  for (const auto& [name, wrong] : {std::pair<std::string, const char*>("none/", "is a directory name"),
                                    {"pipe", "is a device, a pipe or a socket and would be replaced"},
                                    {"file/a", "file is not a directory"},
                                    {"wing.STEP", "is the name of a CAD file"},
                                    {"wing.igs", "is the name of a CAD file"},
                                    {std::string(224, 'n'), "the name is too long"}})
    EXPECT_ERROR(TemporaryFile(dir / name), kOutput, wrong);
  EXPECT_EQ(dir.files().size(), 2u);
}

TEST(TemporaryFile, that_is_gone_or_cannot_get_its_name_is_an_error) {
  const TemporaryDirectory dir;
  TemporaryFile gone(dir / "a"), late(dir / "b");
  std::filesystem::remove(gone.name());
  EXPECT_ERROR(gone.commit(), kOutput, dir / "a" + ": cannot be synced (No such file or directory)");
  std::filesystem::create_directory(dir / "b");
  EXPECT_ERROR(late.commit(), kOutput, dir / "b" + ": cannot be renamed into place (Is a directory)");
}

}  // namespace
}  // namespace st
