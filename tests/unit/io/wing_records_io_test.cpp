// Lifting surfaces in artifacts.
#include "io/hdf5/wing_records_io.h"

#include <gtest/gtest.h>

#include "unit/io/sample_sizing.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

std::vector<WingRecord> two_wings() {
  WingRecord wing;
  wing.stations = {{{0, 0, 0}, {1, 0, 0}, 1, 0.01}, {{0, 1, 0}, {1, 1, 0}, 1, 0.01}};
  wing.edges = {0};
  wing.faces = {0};
  wing.bases = {1};
  wing.span = 1;
  wing.covered = 0.75;
  wing.base_cells = 2;
  WingRecord other;
  other.stations = {{{}, {5, 0, 0}, 3, 0}};
  other.edges = {0, 1};
  other.span = 2;
  other.has_noses = false;
  return {wing, other};
}

class WingRecords : public testing::Test {
 protected:
  std::string path() const { return dir_ / "a.hdf"; }
  void write_sizing_with(const WingRecord& wing) const {
    SizingArtifact sizing = sample_sizing();
    sizing.model.wings = {wing};
    write_sizing(path(), sizing);
  }
  TemporaryDirectory dir_;
};

TEST_F(WingRecords, are_read_as_they_were_written) {
  RasterArtifact raster = sample_raster();
  raster.model.wings = two_wings();
  const std::string hash = write_raster(path(), raster);
  const std::vector<WingRecord> read = read_raster(path()).model.wings;
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].stations.size(), 2u);
  EXPECT_EQ(read[0].stations[1].nose, (Vec3{0, 1, 0}));
  EXPECT_EQ(read[0].base_cells, 2);
  EXPECT_EQ(read[0].bases, std::vector<FaceId>{1});
  EXPECT_EQ(read[0].covered, 0.75);
  EXPECT_EQ(read[1].edges, (std::vector<EdgeId>{0, 1}));
  EXPECT_FALSE(read[1].has_noses);
  raster.model.wings = read;
  EXPECT_EQ(write_raster(path(), raster), hash);
}

TEST_F(WingRecords, of_a_sizing_are_scaled_and_moved) {
  SizingArtifact sizing = sample_sizing();  // its scale is 1.5
  sizing.model.wings = two_wings();
  sizing.frame.scale = 2;
  write_sizing(path(), sizing);
  const std::vector<WingRecord> read = read_asked_wings(path());
  ASSERT_EQ(read.size(), 2u);
  EXPECT_DOUBLE_EQ(read[0].stations[0].asked, 0.03);
  EXPECT_EQ(read[0].stations[0].chord, 2);
  EXPECT_EQ(read[0].stations[0].trailing, (Vec3{2, 0, 0}));
  EXPECT_EQ(read_sizing(path()).model.wings[0].stations[0].asked, 0.01);
}

TEST_F(WingRecords, that_are_none_are_refused) {
  WingRecord wing = two_wings()[0];
  wing.stations[1].chord = 0;
  write_sizing_with(wing);
  EXPECT_ERROR(read_asked_wings(path()), kInput, "row 1 has no chord > 0");
  wing = two_wings()[0];
  wing.faces = {7};
  write_sizing_with(wing);
  EXPECT_ERROR(read_sizing(path()), kInput, "/st/wing/face");
}

}  // namespace
}  // namespace st
