#include "io/hdf5/hdf5_file.h"
#include "io/file/temporary_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>

#include "base/threads.h"
#include "io/file/row_file.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

ArtifactHeader sizing_header() {
  ArtifactHeader header = sample_header();
  header.schema = "sizing";
  return header;
}

const std::vector<double> kDoubles = {1.0, -0.0, 1e300, 0.1};
const std::vector<std::string> kStrings = {"Flügel", "", "a longer name", "日本"};
const std::vector<Vec3> kPoints = {{1, 2, 3}, {4, 5, 6}};

std::vector<std::int64_t> many_integers() {
  std::vector<std::int64_t> values(5000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::int64_t>(i * i);
  return values;
}

std::string write_sample(const std::string& path, const ArtifactHeader& header = sizing_header()) {
  Hdf5Writer writer(path, header);
  writer.write("/st/doubles", kDoubles);
  writer.write("/st/points", kPoints);
  writer.write("/st/deep/er/integers", many_integers());
  writer.write("/st/table", std::vector<std::int32_t>{1, 2, 3, 4, 5, 6}, 2);
  writer.write("/st/bytes", std::vector<std::uint8_t>{});
  writer.write_strings("/st/strings", kStrings);
  writer.write_vtk_strings("/VTKHDF/FieldData/names", kStrings);
  writer.set_attribute("/st", "count", std::int64_t{42});
  writer.set_attribute("/st", "slope", 0.2);
  writer.set_attribute("/VTKHDF", "Version", std::vector<std::int64_t>{1, 0});
  return writer.commit();
}

TEST(Hdf5File, gives_back_what_was_written) {
  TemporaryDirectory dir;
  const std::string path = dir / "a.hdf", hash = write_sample(path);
  const Hdf5Reader reader(path, "sizing");
  EXPECT_EQ(reader.read<double>("/st/doubles"), kDoubles);
  EXPECT_EQ(reader.read<std::int64_t>("/st/deep/er/integers"), many_integers());
  EXPECT_EQ(reader.read_rows<std::int32_t>("/st/table", 3, 2), (std::vector<std::int32_t>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(reader.read_strings("/st/strings"), kStrings);
  EXPECT_ERROR(reader.read_strings("/VTKHDF/FieldData/names"), kInput, "variable length");
  EXPECT_TRUE(reader.read<std::uint8_t>("/st/bytes").empty());
  const std::vector<Vec3> points = reader.read<Vec3>("/st/points");
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[1].y, 5);
  EXPECT_EQ(reader.int_attribute("/st", "count"), 42);
  EXPECT_EQ(reader.double_attribute("/st", "slope"), 0.2);
  const ArtifactHeader& header = reader.header();
  EXPECT_EQ(header.content_hash, hash);
  EXPECT_EQ(header.options_json, sizing_header().options_json);
  EXPECT_EQ(header.unit, "mm");
  EXPECT_EQ(header.unit_in_m, 0.001);
  EXPECT_EQ(header.geometry_hash, "0123");
  ASSERT_EQ(header.inputs.size(), 1u);
  EXPECT_EQ(header.inputs[0].name, "ra ster.hdf");
}

TEST(Hdf5File, maps_large_and_small_and_empty_arrays) {
  TemporaryDirectory dir;
  write_sample(dir / "a.hdf");
  MappedArray<std::int64_t> large;
  {
    const Hdf5Reader reader(dir / "a.hdf", "sizing");
    large = reader.map<std::int64_t>("/st/deep/er/integers");
    EXPECT_EQ(reader.map<Vec3>("/st/points")[0].z, 3);
    EXPECT_EQ(reader.map<std::uint8_t>("/st/bytes").size(), 0u);
  }
  ASSERT_EQ(large.size(), 5000u);  // outlives the reader
  EXPECT_EQ(large[4999], 4999 * 4999);
}

TEST(Hdf5File, takes_rows_that_others_write_as_its_own) {
  const TemporaryDirectory dir;
  std::vector<std::int64_t> all(1'300'001);  // some pieces of the file
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::int64_t>(i * i);
  const auto write = [&](const std::string& path, bool elsewhere) {
    Hdf5Writer writer(path, sizing_header());
    if (!elsewhere) {
      writer.write("/st/rows", all);
    } else {
      const std::uint64_t begin = writer.rows_elsewhere(writer.begin_rows<std::int64_t>("/st/rows", all.size()));
      RowFile file(writer.temporary_name(), path);
      const auto bytes = std::as_bytes(std::span(all));
      file.write(begin + 4000, bytes.subspan(4000), "rows");
      file.write(begin, bytes.first(4000), "rows");
      file.close();
    }
    writer.write("/st/doubles", kDoubles);
    return writer.commit();
  };
  const std::string whole = write(dir / "whole.hdf", false);
  for (const int n_threads : {1, 3}) {
    set_thread_count(n_threads);
    EXPECT_EQ(write(dir / "rows.hdf", true), whole);
    set_thread_count(1);
    EXPECT_EQ(Hdf5Reader(dir / "rows.hdf", "sizing").read<std::int64_t>("/st/rows"), all);
  }
}

TEST(Hdf5File, writes_equal_content_as_equal_bytes) {
  TemporaryDirectory dir;
  write_sample(dir / "a.hdf");
  write_sample(dir / "b.hdf");
  EXPECT_EQ(read_bytes(dir / "a.hdf"), read_bytes(dir / "b.hdf"));
}

TEST(Hdf5File, hashes_content_and_not_provenance) {
  TemporaryDirectory dir;
  ArtifactHeader other = sizing_header();
  const std::string hash = write_sample(dir / "a.hdf");
  other.tool_version = "9";
  other.options_json = "{}";
  other.inputs.clear();
  other.geometry_hash = "89";
  EXPECT_EQ(write_sample(dir / "b.hdf", other), hash);
  other.unit = "m";
  EXPECT_NE(write_sample(dir / "b.hdf", other), hash);
}

TEST(Hdf5File, keeps_options_longer_than_an_object_header) {
  TemporaryDirectory dir;
  ArtifactHeader header = sizing_header();
  header.options_json = std::string(200000, 'x');
  try {
    write_sample(dir / "a.hdf", header);
    EXPECT_EQ(Hdf5Reader(dir / "a.hdf").header().options_json, header.options_json);
  } catch (const Error& e) {
    FAIL() << e.what();
  }
}

TEST(Hdf5File, says_what_is_wrong_with_a_request) {
  TemporaryDirectory dir;
  write_sample(dir / "a.hdf");
  const Hdf5Reader reader(dir / "a.hdf", "sizing");
  EXPECT_ERROR(reader.read<float>("/st/doubles"), kInput, "is float64, not float32");
  EXPECT_ERROR(reader.read<double>("/st/nothing"), kInput, "/st/nothing: is missing");
  EXPECT_ERROR(reader.read<Vec2>("/st/points"), kInput, "has 3 columns, not 2");
  EXPECT_ERROR(reader.read_rows<Vec3>("/st/points", 7), kInput, "has 2 rows, not 7");
  EXPECT_ERROR(reader.int_attribute("/st", "slope"), kInput, "/st@slope");
  EXPECT_ERROR(Hdf5Reader(dir / "a.hdf", "mesh"), kInput,
               "is a sizing artifact, but a mesh artifact is needed; give the file that st-merge wrote");
}

TEST(Hdf5File, refuses_to_write_what_makes_no_dataset) {
  const TemporaryDirectory dir;
  Hdf5Writer writer(dir / "a.hdf", sizing_header());
  writer.write("/st/bytes", std::vector<std::uint8_t>{});
  EXPECT_ERROR(writer.write("/st/bytes", std::vector<std::uint8_t>{}), kOutput, "cannot write /st/bytes");
  EXPECT_ERROR(writer.write("/st/table", std::vector<std::int32_t>{1, 2, 3}, 2), kInternal,
               "/st/table: 3 values are not rows of 2");
  EXPECT_ERROR(writer.set_attribute("st", "count", std::int64_t{1}), kInternal, "st: not an absolute path");
}

TEST(Hdf5File, leaves_nothing_without_commit) {
  TemporaryDirectory dir;
  {
    Hdf5Writer writer(dir / "a.hdf", sizing_header());
    writer.write("/st/doubles", kDoubles);
    EXPECT_EQ(dir.files().size(), 1u);
  }
  EXPECT_TRUE(dir.files().empty());
}

TEST(Hdf5File, removes_what_a_killed_process_left_of_the_same_file_and_nothing_else) {
  TemporaryDirectory dir;
  const std::string nobody = "4194999", somebody = std::to_string(getpid());  // above the largest process id of Linux
  const auto long_ago = std::filesystem::file_time_type::clock::now() - std::chrono::hours(1);
  const std::vector<std::string> kept = {".a.hdf.tmp." + somebody + ".77", ".b.hdf.tmp." + nobody + ".0", ".a.hdf.tmp.",
                                         "a.hdf.tmp." + nobody + ".0"};
  std::vector<std::string> all = kept;
  all.push_back(".a.hdf.tmp." + nobody + ".0");
  for (const std::string& name : all) {
    write_bytes(dir / name, "x");
    std::filesystem::last_write_time(dir / name, long_ago);
  }
  write_bytes(dir / (".a.hdf.tmp." + nobody + ".1"), "just written");
  write_sample(dir / "a.hdf");
  std::vector<std::string> expected = kept;
  expected.push_back(".a.hdf.tmp." + nobody + ".1");
  expected.push_back("a.hdf");
  std::vector<std::string> files = dir.files();
  std::sort(files.begin(), files.end());
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(files, expected);
}

TEST(Hdf5File, leaves_nothing_after_remove_temporaries) {
  TemporaryDirectory dir;
  Hdf5Writer writer(dir / "a.hdf", sizing_header());
  remove_temporaries();
  EXPECT_TRUE(dir.files().empty());
}

}  // namespace
}  // namespace st
