// Bytes at their places in a file.
#include "io/file/row_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/error.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

TEST(RowFile, writes_at_their_places_what_others_leave_alone) {
  const TemporaryDirectory dir;
  const std::string path = dir / "rows";
  std::ofstream(path) << "0123456789";
  const std::string text = "abc";
  RowFile first(path, "label"), second(path, "label");
  first.write(7, std::as_bytes(std::span(text)), "rows");
  second.write(2, std::as_bytes(std::span(text)), "rows");
  first.write(0, {}, "nothing");
  first.close();
  second.close();
  EXPECT_EQ(read_bytes(path), "01abc56abc");
}

TEST(RowFile, refuses_a_missing_file_and_a_link_by_its_label) {
  const TemporaryDirectory dir;
  std::ofstream(dir / "rows") << "0123456789";
  std::filesystem::create_symlink(dir / "rows", dir / "link");
  for (const char* name : {"missing", "link"}) try {
      RowFile file(dir / name, "out/patches.hdf");
      ADD_FAILURE() << name;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::kOutput);
      EXPECT_EQ(std::string(e.what()).find("out/patches.hdf: cannot write"), 0u) << e.what();
    }
}

TEST(RowFile, says_what_does_not_fit_on_a_full_disk) {
  const std::string text = "abc";
  RowFile file("/dev/full", "out/patches.hdf");
  try {
    file.write(0, std::as_bytes(std::span(text)), "the patch of face 7");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kOutput);
    EXPECT_NE(std::string(e.what()).find("the patch of face 7"), std::string::npos);
  }
}

}  // namespace
}  // namespace st
