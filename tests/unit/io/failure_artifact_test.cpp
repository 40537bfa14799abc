#include "io/hdf5/failure_artifact.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/error.h"
#include "io/hdf5/hdf5_file.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

TEST(FailureArtifact, holds_the_loops_the_triangles_so_far_and_the_places_as_cells) {
  TemporaryDirectory dir;
  write_failures(dir / "f.hdf", sample_failures());
  const Hdf5Reader r(dir / "f.hdf", "failures");
  EXPECT_EQ(r.read<std::uint8_t>("/VTKHDF/Types"), (std::vector<std::uint8_t>{3, 3, 3, 3, 5, 5, 1}));
  EXPECT_EQ(r.read<std::int64_t>("/VTKHDF/Offsets"), (std::vector<std::int64_t>{0, 2, 4, 6, 8, 11, 14, 15}));
  EXPECT_EQ(r.read<std::int32_t>("/VTKHDF/CellData/face"), std::vector<std::int32_t>(7, 2)) << "counted from 1";
  EXPECT_EQ(r.read<std::int32_t>("/VTKHDF/CellData/edge"), (std::vector<std::int32_t>{5, 6, 7, 8, 0, 0, 0}));
  EXPECT_EQ(r.read<std::int32_t>("/VTKHDF/CellData/loop"), (std::vector<std::int32_t>{1, 1, 1, 1, 0, 0, 0}));
  EXPECT_EQ(r.read<double>("/VTKHDF/PointData/u"), (std::vector<double>{0, 20, 0, 20, 10, 0}));
  EXPECT_EQ(r.read_strings("/st/failure/name"), std::vector<std::string>{"Flügel"});
  EXPECT_EQ(r.read_strings("/st/failure/cause"), std::vector<std::string>{"its loops cross"});
}

TEST(FailureArtifact, numbers_the_points_of_a_second_face_after_those_of_the_first) {
  TemporaryDirectory dir;
  FailureArtifact a = sample_failures();
  a.attempts.push_back(a.attempts[0]);
  a.attempts[1].patch.face = 0;
  write_failures(dir / "f.hdf", a);
  const Hdf5Reader r(dir / "f.hdf", "failures");
  const auto nodes = r.read<std::int64_t>("/VTKHDF/Connectivity");
  ASSERT_EQ(nodes.size(), 30u);
  for (std::size_t i = 0; i < 15; ++i) EXPECT_EQ(nodes[15 + i], nodes[i] + 6);
}

TEST(FailureArtifact, equal_content_gives_equal_bytes) {
  TemporaryDirectory dir;
  EXPECT_EQ(write_failures(dir / "a.hdf", sample_failures()), write_failures(dir / "b.hdf", sample_failures()));
  EXPECT_EQ(read_bytes(dir / "a.hdf"), read_bytes(dir / "b.hdf"));
}

TEST(FailureArtifact, lies_beside_the_patches) {
  EXPECT_EQ(failures_path("patches.hdf"), "patches.failures.hdf");
  EXPECT_EQ(failures_path("a.b/left.wing.hdf"), "a.b/left.wing.failures.hdf");
}

TEST(FailureArtifact, of_an_earlier_run_is_removed_and_nothing_else_is) {
  TemporaryDirectory dir;
  write_failures(dir / "f.hdf", sample_failures());
  write_mesh(dir / "m.hdf", sample_mesh());
  for (const char* name : {"f.hdf", "m.hdf", "none.hdf"}) remove_failures(dir / name);
  EXPECT_FALSE(std::filesystem::exists(dir / "f.hdf"));
  EXPECT_TRUE(std::filesystem::exists(dir / "m.hdf")) << "a mesh of that name is no failure";
}

TEST(FailureArtifact, is_exported_as_vtu_only) {
  TemporaryDirectory dir;
  write_failures(dir / "f.hdf", sample_failures());
  export_failures(dir / "f.hdf", dir / "f.vtu");
  const std::string text = read_bytes(dir / "f.vtu");
  EXPECT_NE(text.find("NumberOfPoints=\"6\" NumberOfCells=\"7\""), std::string::npos);
  EXPECT_THROW(export_failures(dir / "f.hdf", dir / "f.stl"), Error);
  EXPECT_FALSE(std::filesystem::exists(dir / "f.stl"));
  write_mesh(dir / "m.hdf", sample_mesh());
  EXPECT_THROW(export_failures(dir / "m.hdf", dir / "m.vtu"), Error);
}

}  // namespace
}  // namespace st
