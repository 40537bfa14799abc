#include "io/hdf5/row_reader.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numeric>

#include "base/error.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

class RowReaderTest : public testing::Test {
 protected:
  RowReaderTest() {
    std::vector<double> values(1000);
    std::iota(values.begin(), values.end(), 0.0);
    ArtifactHeader header = sample_header();
    header.schema = "mesh";
    Hdf5Writer w(path_, header);
    const std::size_t dataset = w.begin_rows<double>("/st/values", values.size());
    w.append(dataset, std::span<const double>(values).first(300));
    w.append(dataset, std::span<const double>(values).subspan(300));
    w.write("/st/empty", std::vector<double>());
    w.commit();
  }
  TemporaryDirectory dir_;
  const std::string path_ = dir_ / "a.hdf";
};

TEST_F(RowReaderTest, gives_rows_from_the_middle) {
  const Hdf5Reader r(path_);
  const RowReader rows(path_, r);
  const auto place = rows.find<double>("/st/values");
  EXPECT_EQ(rows.read<double>(place, 298, 3), (std::vector<double>{298, 299, 300}));
  EXPECT_TRUE(rows.read<double>(place, 1000, 0).empty());
  EXPECT_ERROR(rows.read<double>(place, 999, 2), kInput, "/st/values: has not the rows that its triangles need");
  EXPECT_THROW(rows.find<float>("/st/values"), Error);
}

TEST_F(RowReaderTest, says_which_rows_of_a_file_that_was_removed_or_cut_cannot_be_read) {
  const Hdf5Reader r(path_);
  EXPECT_ERROR(RowReader(dir_ / "none", r), kInput, path_ + ": /st: cannot be read");
  const RowReader rows(path_, r);
  const auto place = rows.find<double>("/st/values");
  std::filesystem::resize_file(path_, static_cast<std::uintmax_t>(place.offset + 80));
  EXPECT_EQ(rows.read<double>(place, 9, 1)[0], 9);
  EXPECT_ERROR(rows.read<double>(place, 9, 2), kInput, "/st/values: cannot be read");
}

TEST_F(RowReaderTest, finds_rows_that_do_not_fit_their_checksum) {
  std::int64_t offset = 0;
  {
    const Hdf5Reader r(path_);
    offset = r.file_offset("/st/values");
    EXPECT_NO_THROW(RowReader(path_, r).verify({"/st/values", "/st/empty"}));
  }
  std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(offset + 8 * 777);
  file.put('x');
  file.close();
  const Hdf5Reader r(path_);
  EXPECT_THROW(RowReader(path_, r).verify({"/st/empty", "/st/values"}), Error);
}

TEST_F(RowReaderTest, of_appended_rows_fewer_or_more_than_announced_are_a_defect) {
  for (const auto& [n, wrong] : {std::pair<std::size_t, const char*>(2, "fewer rows than were announced"),
                                 {4, "more rows than were announced"}}) {
    Hdf5Writer w(dir_ / "b.hdf", sample_header());
    const std::vector<double> values(n);
    w.append(w.begin_rows<double>("/st/values", 3), std::span<const double>(values));
    EXPECT_ERROR(w.commit(), kInternal, wrong);
  }
}

}  // namespace
}  // namespace st
