#include "io/file/run_folder.h"

#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <memory>

#include "base/error.h"
#include "unit/io/temporary_directory.h"

namespace {
bool g_run_folder_no_locks = false;
}

/// In place of the one of libc: a file system without locks, on demand.
extern "C" int flock(int file, int operation) noexcept {
  if (!g_run_folder_no_locks) return static_cast<int>(syscall(SYS_flock, file, operation));
  errno = ENOLCK;
  return -1;
}

namespace st {
namespace {

namespace fs = std::filesystem;

std::size_t n_entries(const std::string& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(RunFolder, is_gone_at_the_end_with_what_is_in_it) {
  const TemporaryDirectory disk, memory;
  {
    RunFolder run(disk.path(), memory.path());
    std::ofstream(run.place("a.hdf", 10)) << "a";
    std::ofstream(run.place("b.hdf", 10 * RunFolder::kMostInMemory)) << "b";
    fs::create_directories(run.place("c.journal", 10));
  }
  EXPECT_EQ(n_entries(disk.path()), 0U);
  EXPECT_EQ(n_entries(memory.path()), 0U);
}

TEST(RunFolder, small_files_are_in_memory_and_large_ones_on_the_disk) {
  const TemporaryDirectory disk, memory;
  RunFolder run(disk.path(), memory.path());
  if (fs::space(memory.path()).available >= 2 * RunFolder::kMostInMemory) {
    EXPECT_TRUE(run.place("a.hdf", RunFolder::kMostInMemory).starts_with(memory.path()));
  }
  EXPECT_TRUE(run.place("b.hdf", RunFolder::kMostInMemory + 1).starts_with(disk.path()));
}

TEST(RunFolder, finds_a_file_or_its_journal_where_it_was_placed) {
  const TemporaryDirectory disk, memory;
  RunFolder run(disk.path(), memory.path());
  EXPECT_EQ(run.find("a.hdf"), "");
  const std::string a = run.place("a.hdf", 2 * RunFolder::kMostInMemory), b = run.place("b.hdf", 0);
  std::ofstream(a) << "a";
  fs::create_directories(b + ".journal");
  EXPECT_EQ(run.find("a.hdf"), a);
  EXPECT_EQ(run.find("b.hdf"), b);
}

TEST(RunFolder, does_without_memory_where_there_is_none) {
  const TemporaryDirectory disk;
  RunFolder run(disk.path(), "/no/such/folder");
  EXPECT_TRUE(run.place("a.hdf", 1).starts_with(disk.path()));
  EXPECT_EQ(run.folders().size(), 1U);
}

TEST(RunFolder, removes_what_a_killed_run_left_and_nothing_else) {
  const TemporaryDirectory disk;
  RunFolder alive(disk.path(), "/no/such/folder");
  std::ofstream(alive.place("a.hdf", 1)) << "a";
  fs::create_directory(disk / ".st-run.left");
  std::ofstream(disk / ".st-run.left/a.hdf") << "a";
  fs::create_directory(disk / "mine");
  std::ofstream(disk / ".st-run.file") << "mine";
  const RunFolder next(disk.path(), "/no/such/folder");
  EXPECT_FALSE(fs::exists(disk / ".st-run.left"));
  EXPECT_TRUE(fs::exists(disk / "mine"));
  EXPECT_TRUE(fs::exists(disk / ".st-run.file"));
  EXPECT_NE(alive.find("a.hdf"), "");
}

TEST(RunFolder, is_one_folder_where_nothing_can_be_locked) {
  const TemporaryDirectory disk;
  g_run_folder_no_locks = true;
  {
    const RunFolder run(disk.path(), "/no/such/folder");
    EXPECT_EQ(n_entries(disk.path()), 1U);
  }
  g_run_folder_no_locks = false;
  EXPECT_EQ(n_entries(disk.path()), 0U);
}

TEST(RunFolder, a_folder_that_is_none_is_an_output_error) {
  try {
    const RunFolder run("/no/such/folder", "/none/either");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kOutput);
  }
}

}  // namespace
}  // namespace st
