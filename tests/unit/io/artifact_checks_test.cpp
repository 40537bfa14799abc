#include "io/hdf5/artifact_checks.h"

#include <gtest/gtest.h>

#include "base/threads.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

/// Rows are looked at in pieces, by several threads: the first bad one is named all the same, on either side of where
/// two pieces meet.
TEST(ArtifactChecks, name_the_first_bad_row) {
  const TemporaryDirectory dir;
  Hdf5Writer(dir / "a.hdf", sample_header()).commit();
  const Hdf5Reader reader(dir / "a.hdf");
  constexpr std::size_t kRows = 5 * kCheckedAtOnce;
  for (const int n_threads : {1, 4}) {
    set_thread_count(n_threads);
    for (const std::size_t bad : {std::size_t{0}, kCheckedAtOnce - 1, kCheckedAtOnce, kCheckedAtOnce + 1, kRows - 1}) {
      std::vector<std::int32_t> ids(kRows, 3), offsets(kRows, 7);
      std::vector<double> lengths(kRows, 0.5);
      ids[bad] = 9, lengths[bad] = -1;
      ids.back() = 9, lengths.back() = -1;
      const std::string row = "row " + std::to_string(bad) + " ";
      EXPECT_ERROR(require_ids(reader, "/ids", ids, 9), kInput, "/ids: " + row + "names entity 9 of 9");
      EXPECT_ERROR(require_lengths(reader, "/lengths", lengths), kInput, "/lengths: " + row + "is not");
      offsets.front() = 0;
      if (bad == 0) continue;
      offsets[bad] = 6;
      EXPECT_ERROR(require_offsets(reader, "/offsets", offsets, static_cast<std::size_t>(offsets.back())), kInput,
                   "/offsets: decreases at row " + std::to_string(bad));
    }
    const std::vector<std::int32_t> good(kRows, 0);
    EXPECT_NO_THROW(require_ids(reader, "/ids", good, 1));
    EXPECT_NO_THROW(require_offsets(reader, "/offsets", good, 0));
  }
  set_thread_count(1);
}

}  // namespace
}  // namespace st
