// Outputs that cannot be finished: an error says so, and nothing is left under their names.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "io/export/export_formats.h"
#include "io/export/octree_export.h"
#include "io/file/text_file.h"
#include "io/hdf5/failure_artifact.h"
#include "unit/io/sample_sizing.h"
#include "unit/io/soft_limit.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

constexpr std::size_t kRoom = 4096;

TEST(FullDisk, ends_what_is_written_at_once_and_leaves_nothing) {
  const TemporaryDirectory dir;
  write_raster(dir / "raster.hdf", sample_raster());
  write_sizing(dir / "sizing.hdf", sample_sizing());
  FailureArtifact failures = sample_failures();
  failures.attempts[0].places.resize(200);
  write_failures(dir / "failures.hdf", failures);
  const std::vector<std::pair<const char*, std::function<void(const std::string& path)>>> outputs = {
      {"octree.vtu", [&](const auto& path) { export_octree(dir / "raster.hdf", path); }},
      {"field.pos", [&](const auto& path) { export_octree(dir / "sizing.hdf", path); }},
      {"failures.vtu", [&](const auto& path) { export_failures(dir / "failures.hdf", path); }},
      {"text", [](const auto& path) { write_text_file(path, std::string(2 * kRoom, 'x')); }}};
  for (const auto& [name, write] : outputs) {
    const std::string path = dir / name;
    write(path);
    EXPECT_GT(std::filesystem::file_size(path), kRoom) << name;
    std::filesystem::remove(path);
    const FullDisk disk(kRoom);
    EXPECT_ERROR(write(path), kOutput, path + ": cannot be written;");
    EXPECT_FALSE(std::filesystem::exists(path)) << name;
  }
  EXPECT_EQ(dir.files().size(), 3u);
}

TEST(FullDisk, ends_what_is_written_piece_by_piece) {
  const TemporaryDirectory dir;
  const std::string text(100'000, 'x');
  Output large(dir / "large"), small(dir / "small");
  small.text(text.substr(0, kRoom + 100));  // the last of it in the buffer
  const FullDisk disk(kRoom);
  EXPECT_ERROR(large.text(text), kOutput, dir / "large" + ": cannot be written (File too large)");
  EXPECT_ERROR(small.commit(), kOutput, dir / "small" + ": cannot be written (File too large)");
}

/// A name under /proc, which root cannot remove either.
TEST(FailureArtifact, that_cannot_be_removed_is_an_error) {
  const TemporaryDirectory dir;
  write_failures(dir / "f.hdf", sample_failures());
  const int file = open((dir / "f.hdf").c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_GE(file, 0);
  EXPECT_ERROR(remove_failures("/proc/self/fd/" + std::to_string(file)), kOutput,
               "the failures of an earlier run cannot be removed");
  close(file);
}

}  // namespace
}  // namespace st
