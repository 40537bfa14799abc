#include "io/hdf5/sizing_artifact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <sstream>

#include "io/export/octree_export.h"
#include "unit/io/sample_sizing.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

class SizingArtifacts : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return dir_ / name; }
  TemporaryDirectory dir_;
};

TEST_F(SizingArtifacts, sizing_is_the_same_bytes_after_reading_and_writing) {
  const std::string hash = write_sizing(file("a.hdf"), sample_sizing());
  EXPECT_EQ(write_sizing(file("b.hdf"), read_sizing(file("a.hdf"))), hash);
  EXPECT_EQ(read_bytes(file("a.hdf")), read_bytes(file("b.hdf")));
}

TEST_F(SizingArtifacts, stretched_ones_are_the_same_bytes_after_reading_and_writing) {
  RasterArtifact raster = sample_raster();
  raster.numbers.max_aspect = 8;
  raster.samples[2].stretch = {SmallNormal(Vec3{0, 0, 1}), 0.7F};
  const std::string hash = write_raster(file("a.hdf"), raster);
  const RasterArtifact read = read_raster(file("a.hdf"));
  EXPECT_EQ(read.samples[2].stretch.along, 0.7F);
  EXPECT_EQ(read.header.schema_version, 6);
  EXPECT_EQ(write_raster(file("b.hdf"), read), hash);
}

TEST_F(SizingArtifacts, stretched_cones_are_kept_and_mapped) {
  const SizingArtifact sizing = sizing_of_stretched_cones();
  const std::string hash = write_sizing(file("a.hdf"), sizing);
  const SizingArtifact read = read_sizing(file("a.hdf"));
  EXPECT_EQ(read.header.schema_version, 8);
  EXPECT_EQ(write_sizing(file("b.hdf"), read), hash);
  const MappedSizing mapped = map_sizing(file("a.hdf"));
  EXPECT_TRUE(mapped.field->is_stretched());
  int hint = 0, other_hint = 0, n_stretched = 0;
  const auto field = sizing.field();
  for (double x = 0; x < 0.8; x += 0.005) {
    const LocalSize a = field->local({x, 0.5, 0.3}, hint), b = mapped.field->local({x, 0.5, 0.3}, other_hint);
    ASSERT_EQ(a.length, b.length);
    ASSERT_EQ(a.along, b.along);
    ASSERT_EQ(a.length, mapped.field->size({x, 0.5, 0.3}, other_hint));
    n_stretched += a.along > a.length;
  }
  EXPECT_GT(n_stretched, 10);
}

TEST_F(SizingArtifacts, lengths_on_surfaces_are_kept_and_count) {
  SizingArtifact sizing = sizing_of_stretched_cones();
  sizing.sources.background.node_xyz = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  sizing.sources.background.node_size.assign(3, {1e-3, 1e-3, {}});
  sizing.sources.background.triangles = {{0, 1, 2}};
  const std::string hash = write_sizing(file("a.hdf"), sizing);
  const SizingArtifact read = read_sizing(file("a.hdf"));
  EXPECT_EQ(read.header.schema_version, 9);
  EXPECT_EQ(read.sources.background.triangles, sizing.sources.background.triangles);
  EXPECT_EQ(write_sizing(file("b.hdf"), read), hash);
  int hint = 0;
  EXPECT_NEAR(map_sizing(file("a.hdf")).field->size({0.2, 0.2, 0.01}, hint), sizing.scale * (1e-3 + 0.2 * 0.01), 1e-12);
  sizing.sources.background.triangles[0][2] = 3;
  write_sizing(file("c.hdf"), sizing);
  EXPECT_ERROR(read_sizing(file("c.hdf")), kInput, "/st/background/triangle: row 2 names entity 3 of");
}

TEST_F(SizingArtifacts, metrics_of_a_background_are_kept_and_mapped) {
  SizingArtifact sizing = sizing_of_stretched_cones();
  BackgroundMesh& background = sizing.sources.background;
  background.node_xyz = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  background.node_metric.assign(4, {1e6, 1, 4, 0, 0, 0});
  background.node_size.assign(4, size_of_metric(background.node_metric[0]));
  background.tets = {{0, 1, 2, 3}};
  const std::string hash = write_sizing(file("a.hdf"), sizing);
  const SizingArtifact read = read_sizing(file("a.hdf"));
  EXPECT_EQ(read.header.schema_version, kSizingVersion);
  EXPECT_EQ(read.sources.background.node_metric, background.node_metric);
  EXPECT_EQ(write_sizing(file("b.hdf"), read), hash);
  const MappedSizing mapped = map_sizing(file("a.hdf"));
  EXPECT_TRUE(mapped.field->has_metrics());
  int hint = 0;
  const LocalSize floor = mapped.field->local_on({0.1, 0.1, 0.1}, {0, 0, 1}, hint);
  EXPECT_NEAR(floor.length, 1e-3 * sizing.scale, 1e-9);
  EXPECT_GT(floor.along, 50 * floor.length);
  background.node_metric[2] = {1, 1, -1, 0, 0, 0};
  write_sizing(file("c.hdf"), sizing);
  EXPECT_ERROR(read_sizing(file("c.hdf")), kInput, "/st/background/metric: row 2 is no metric");
}

TEST_F(SizingArtifacts, stretched_cones_that_do_not_fit_are_refused) {
  const auto refuses = [&](const char* what, const auto& damage) {
    SizingArtifact torn = sizing_of_stretched_cones();
    damage(torn.cones);
    write_sizing(file("b.hdf"), torn);
    EXPECT_ERROR(read_sizing(file("b.hdf")), kInput, what);
    EXPECT_ERROR(map_sizing(file("b.hdf")), kInput, what);
  };
  refuses("stretch", [](ConeTable& t) { t.stretch.pop_back(); });
  refuses("stretch", [](ConeTable& t) { t.stretch[0].along = -1; });
  refuses("first_along", [](ConeTable& t) { t.first_along.pop_back(); });
  refuses("along_of_site", [](ConeTable& t) { t.along_of_site[0] = 1000; });
}

TEST_F(SizingArtifacts, a_stretched_field_is_exported_as_metric_spacings_and_arrays) {
  const SizingArtifact sizing = sizing_of_stretched_cones(1);
  write_sizing(file("a.hdf"), sizing);
  export_octree(file("a.hdf"), file("a.pos"));
  const std::string pos = read_bytes(file("a.pos"));
  EXPECT_NE(pos.find("TH("), std::string::npos);
  EXPECT_EQ(pos.find("SH("), std::string::npos);
  // nine numbers at each corner: 1/length^2 but along y, where it is less
  const std::size_t at = pos.find("){") + 2;
  double m[9];
  std::string values = pos.substr(at, pos.find('}', at) - at);
  std::replace(values.begin(), values.end(), ',', ' ');
  std::istringstream stream(values);
  for (double& x : m) stream >> x;
  int hint = 0;
  const LocalSize size = sizing.field()->local(sizing.shape.lo, hint);
  ASSERT_GT(size.along, 1.3 * size.length);
  EXPECT_NEAR(m[0] / m[4], std::pow(size.along / size.length, 2), 1e-3 * m[0] / m[4]);
  EXPECT_EQ(m[0], m[8]);
  EXPECT_NEAR(m[1], 0, 1e-6 * m[0]);
  export_octree(file("a.hdf"), file("a.bac"));
  EXPECT_NE(read_bytes(file("a.bac")).find("\n0 1 0 "), std::string::npos);
  export_octree(file("a.hdf"), file("a.vtu"));
  EXPECT_NE(read_bytes(file("a.vtu")).find("\"along\""), std::string::npos);
  EXPECT_NE(read_bytes(file("a.vtu")).find("\"direction\""), std::string::npos);
}

TEST_F(SizingArtifacts, name_what_causes_a_length) {
  write_sizing(file("a.hdf"), sample_sizing());
  const CauseNames names = read_cause_names(file("a.hdf"));
  EXPECT_EQ(cause_text(names, pack_cause(CauseKind::kEdge, 0)), "edge 1 \"TE\"");
  EXPECT_EQ(cause_text(names, pack_cause(CauseKind::kEdge, 1)), "edge 2");
  EXPECT_EQ(cause_text(names, pack_cause(CauseKind::kFace, 1)), "face 2 \"tip\"");
  EXPECT_EQ(cause_text(names, pack_cause(CauseKind::kSource, 0)), "source 1 \"wake\"");
  EXPECT_EQ(cause_text(names, kNone), "the largest length");
}

TEST_F(SizingArtifacts, numbers_are_content) {
  SizingArtifact sizing = sample_sizing();
  const std::string hash = write_sizing(file("a.hdf"), sizing);
  sizing.slope = 0.3;
  EXPECT_NE(write_sizing(file("b.hdf"), sizing), hash);
}

TEST_F(SizingArtifacts, mapped_field_answers_like_the_one_in_memory) {
  const SizingArtifact sizing = sample_sizing();
  write_sizing(file("a.hdf"), sizing);
  const MappedSizing mapped = map_sizing(file("a.hdf"));
  const OctreeField field(sizing.field_data(nullptr), nullptr);
  EXPECT_EQ(mapped.field->min_size(), field.min_size());
  EXPECT_EQ(mapped.field->slope(), field.slope());
  EXPECT_EQ(mapped.face_weight, sizing.face_weight);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-0.1, 1.1);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 x{uniform(random), uniform(random), uniform(random)};
    ASSERT_EQ(static_cast<const SizeField&>(*mapped.field).size(x), static_cast<const SizeField&>(field).size(x));
  }
}

TEST_F(SizingArtifacts, of_older_versions_without_cones_are_refused) {
  SizingArtifact sizing = sample_sizing();
  sizing.cones = {};
  write_sizing(file("a.hdf"), sizing);
  EXPECT_ERROR(read_sizing(file("a.hdf")), kInput, "without cones; run st-raster and st-prolong again");
  EXPECT_ERROR(map_sizing(file("a.hdf")), kInput, "without cones; run st-raster and st-prolong again");
  sizing.lengths.cause.assign(sizing.lengths.cause.size(), kNone);  // as with --only: the largest length alone
  write_sizing(file("a.hdf"), sizing);
  EXPECT_NO_THROW(read_sizing(file("a.hdf")));
  EXPECT_NO_THROW(map_sizing(file("a.hdf")));
}

TEST_F(SizingArtifacts, mapped_field_outlives_the_name_of_its_file) {
  write_sizing(file("a.hdf"), sample_sizing());
  const std::unique_ptr<SizeField> field = open_sizing(file("a.hdf"), nullptr);
  std::filesystem::remove(file("a.hdf"));
  EXPECT_TRUE(std::isfinite(field->size(Vec3{0.5, 0.5, 0.5})));
}

TEST_F(SizingArtifacts, refuse_each_other) {
  write_raster(file("r.hdf"), sample_raster());
  write_sizing(file("s.hdf"), sample_sizing());
  EXPECT_ERROR(read_sizing(file("r.hdf")), kInput, "st-prolong");
  EXPECT_ERROR(open_sizing(file("r.hdf"), nullptr), kInput, "st-prolong");
  EXPECT_ERROR(read_raster(file("s.hdf")), kInput, "st-raster");
}

TEST_F(SizingArtifacts, refuse_arrays_that_do_not_fit) {
  SizingArtifact sizing = sample_sizing();
  sizing.shape.leaf_levels.pop_back();
  write_sizing(file("a.hdf"), sizing);
  EXPECT_ERROR(read_sizing(file("a.hdf")), kInput, "/st/octree: array lengths");
  EXPECT_ERROR(map_sizing(file("a.hdf")), kInput, "/st/octree: array lengths");
  sizing = sample_sizing();
  sizing.lengths.cells.pop_back();
  write_sizing(file("a.hdf"), sizing);
  EXPECT_ERROR(read_sizing(file("a.hdf")), kInput, "cell");
  EXPECT_ERROR(map_sizing(file("a.hdf")), kInput, "cell");
}

TEST_F(SizingArtifacts, a_sizing_whose_links_or_numbers_are_wrong_is_refused) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<std::pair<const char*, std::function<void(SizingArtifact&)>>> breaks = {
      {"octree", [](auto& s) { std::fill(s.shape.node_children.begin(), s.shape.node_children.end(), 0); }},
      {"octree", [](auto& s) { std::fill(s.shape.node_children.begin(), s.shape.node_children.end(), -1); }},
      {"octree", [](auto& s) { s.shape.leaf_keys[4] = ~std::uint64_t{0}; }},
      {"octree/cell", [&](auto& s) { s.lengths.cells[3].length = nan; }},
      {"octree/cell", [](auto& s) { s.lengths.cells[3].length = 0; }},
      {"octree/cell", [&](auto& s) { s.lengths.cells[3].gradient[1] = nan; }},
      {"octree/cell", [](auto& s) { s.lengths.cells[3].upper = std::numeric_limits<float>::infinity(); }},
      {"scale", [](auto& s) { s.scale = 0; }},
      {"scale", [&](auto& s) { s.scale = nan; }},
      {"slope", [](auto& s) { s.slope = -1; }},
      {"face/weight", [&](auto& s) { s.face_weight[0] = nan; }}};
  for (const auto& [name, break_it] : breaks) {
    SizingArtifact sizing = sample_sizing();
    break_it(sizing);
    write_sizing(file("a.hdf"), sizing);
    EXPECT_ERROR(read_sizing(file("a.hdf")), kInput, name);
    EXPECT_ERROR(map_sizing(file("a.hdf")), kInput, name);
  }
  SizingArtifact sizing = sample_sizing();
  sizing.scale = 1e-300;
  write_sizing(file("a.hdf"), sizing);
  EXPECT_ERROR(map_sizing(file("a.hdf")), kUsage, "--scale");
}

TEST_F(SizingArtifacts, export_needs_a_vtu_name_and_an_octree) {
  write_raster(file("r.hdf"), sample_raster());
  write_mesh(file("m.hdf"), sample_mesh());
  EXPECT_ERROR(export_octree(file("r.hdf"), file("r.stl")), kUsage, ".vtu");
  EXPECT_ERROR(export_octree(file("m.hdf"), file("m.vtu")), kInput, "mesh");
  export_octree(file("r.hdf"), file("r.vtu"));
  EXPECT_GT(read_bytes(file("r.vtu")).size(), 1000u);
}

}  // namespace
}  // namespace st
