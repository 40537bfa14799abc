#include "io/hdf5/sources_io.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "unit/io/sample_sizing.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

/// A sizing with a line and a background mesh of a tetrahedron and a triangle.
SizingArtifact sizing_with_sources() {
  SizingArtifact sizing = sample_sizing();
  SourceSpec line;
  line.kind = SourceKind::kLine;
  line.name = sizing.source_name.at(0);
  line.point[1] = {1, 2, 3};
  for (SourceSpacing& s : line.spacing) s = {0.05, 0.1, 0.3};
  sizing.sources.sources = {line};
  BackgroundMesh& mesh = sizing.sources.background;
  mesh.node_xyz = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.node_size = {{0.1, 0.1, {}}, {0.1, 0.1, {}}, {0.2, 0.2, {}}, {0.1, 0.4, {1, 0, 0}}};
  mesh.tets = {{0, 1, 2, 3}};
  mesh.triangles = {{2, 1, 0}};
  return sizing;
}

class SourcesOfSizing : public testing::Test {
 protected:
  SizingArtifact kept(const SizingArtifact& sizing) const {
    write_sizing(file_, sizing);
    return read_sizing(file_);
  }
  TemporaryDirectory dir_;
  std::string file_ = dir_ / "a.hdf";
};

TEST_F(SourcesOfSizing, are_kept) {
  const SizingArtifact before = sizing_with_sources();
  const SourceSet after = kept(before).sources;
  ASSERT_EQ(after.sources.size(), 1u);
  EXPECT_EQ(after.sources[0].name, "wake");
  EXPECT_EQ(after.sources[0].kind, SourceKind::kLine);
  EXPECT_EQ(after.sources[0].point[1], (Vec3{1, 2, 3}));
  EXPECT_EQ(after.sources[0].spacing[0].doubling, 0.3);
  EXPECT_EQ(after.slope, 0.2);
  EXPECT_EQ(after.background.node_xyz, before.sources.background.node_xyz);
  EXPECT_EQ(after.background.node_size[3].along, 0.4);
  EXPECT_EQ(after.background.tets, before.sources.background.tets);
  EXPECT_EQ(after.background.triangles, before.sources.background.triangles);
}

TEST_F(SourcesOfSizing, count_in_a_mapped_field) {
  SizingArtifact sizing = sizing_with_sources();
  const Vec3 end{1, 2, 3};
  write_sizing(file_, sizing);
  EXPECT_NEAR(map_sizing(file_).field->size(end), 0.05 * sizing.scale, 1e-9);
  sizing.sources = {};
  sizing.sources.slope = 0.2;
  write_sizing(file_, sizing);
  EXPECT_GT(map_sizing(file_).field->size(end), 0.1);
}

TEST_F(SourcesOfSizing, that_ask_for_no_length_are_refused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<const char*, std::function<void(SourceSet&)>>> breaks = {
      {"source_slope", [](auto& s) { s.slope = 0; }},
      {"source/kind", [](auto& s) { s.sources[0].kind = static_cast<SourceKind>(200); }},
      {"source/numbers", [](auto& s) { s.sources[0].spacing[0].length = 0; }},
      {"source/numbers", [&](auto& s) { s.sources[0].point[0].x = nan; }},
      {"source/name", [](auto& s) { s.sources.push_back(s.sources[0]); }},
      {"background/tet", [](auto& s) { s.background.tets[0][3] = 4; }},
      {"background/triangle", [](auto& s) { s.background.triangles[0][0] = 4; }},
      {"background/size", [](auto& s) { s.background.node_size[1].length = -1; }}};
  for (const auto& [name, break_it] : breaks) {
    SizingArtifact sizing = sizing_with_sources();
    break_it(sizing.sources);
    write_sizing(file_, sizing);
    EXPECT_ERROR(read_sizing(file_), kInput, name);
  }
}

}  // namespace
}  // namespace st
