#include "stages/report_origin.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "io/hdf5/artifact.h"
#include "io/hdf5/sizing_artifact.h"

namespace st {
namespace {

namespace fs = std::filesystem;

/// A folder of its own with a raster and a sizing made from it.
fs::path origin_folder(const std::string& name, const std::string& raster_hash = "") {
  const fs::path folder = fs::path(testing::TempDir()) / ("report_origin_" + name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  RasterArtifact raster;
  raster.header.schema = "raster";
  raster.header.tool = "st-raster";
  raster.header.options_json = R"({"lmax": 2.5, "preset": "rans"})";
  const std::string hash = write_raster(folder / "raster.hdf", raster);
  SizingArtifact sizing;
  sizing.header.schema = "sizing";
  sizing.header.tool = "st-prolong";
  sizing.header.inputs = {{"raster", "raster.hdf", raster_hash.empty() ? hash : raster_hash}};
  write_sizing(folder / "sizing.hdf", sizing);
  return folder;
}

TEST(ReportOrigin, finds_the_raster_beside_the_sizing) {
  const fs::path folder = origin_folder("found");
  EXPECT_EQ(raster_beside(folder / "sizing.hdf"), (folder / "raster.hdf").string());
  fs::remove(folder / "raster.hdf");
  EXPECT_EQ(raster_beside(folder / "sizing.hdf"), "");
}

TEST(ReportOrigin, takes_no_other_raster) {
  EXPECT_EQ(raster_beside(origin_folder("other", "0123") / "sizing.hdf"), "");
}

TEST(ReportOrigin, tells_what_each_artifact_was_asked_for) {
  const fs::path folder = origin_folder("told");
  const auto list = origins(std::array<std::string, 3>{"", folder / "raster.hdf", folder / "sizing.hdf"});
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0]["file"], "raster.hdf");
  EXPECT_EQ(list[0]["tool"], "st-raster");
  EXPECT_EQ(list[0]["options"]["preset"], "rans");
  EXPECT_EQ(list[1]["inputs"][0]["name"], "raster.hdf");
}

}  // namespace
}  // namespace st
