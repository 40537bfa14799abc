// raster.hdf written and read.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "unit/io/sample_sizing.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

void expect_equal(const BlankSurface& a, const BlankSurface& b) {
  EXPECT_EQ(a.side, b.side);
  EXPECT_EQ(a.points, b.points);
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  for (std::size_t t = 0; t < a.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(a.triangles[t].n[k], b.triangles[t].n[k]);
}

class RasterArtifacts : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return dir_ / name; }
  TemporaryDirectory dir_;
};

TEST_F(RasterArtifacts, keep_their_surface_and_the_normals_of_their_samples) {
  RasterArtifact raster = sample_raster();
  raster.samples[3].normal = SmallNormal({0.6, -0.8, 0});
  raster.surface = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}}, {{0, 2, 1}}}, BlankSide::kOutside};
  write_raster(file("a.hdf"), raster);
  const RasterArtifact read = read_raster(file("a.hdf"));
  expect_equal(read.surface, raster.surface);
  EXPECT_LT(distance(Vec3(read.samples[3].normal), {0.6, -0.8, 0}), 0.01);
  EXPECT_EQ(Vec3(read.samples[4].normal), Vec3{});
  EXPECT_EQ(read.header.schema_version, 5);
}

TEST_F(RasterArtifacts, of_which_parts_are_missing_say_so_and_older_programs_refuse_them) {
  RasterArtifact raster = sample_raster();
  const std::string complete = write_raster(file("a.hdf"), raster);
  raster.n_not_sampled = 3;
  EXPECT_NE(write_raster(file("b.hdf"), raster), complete);
  EXPECT_EQ(read_raster(file("a.hdf")).n_not_sampled, 0);
  EXPECT_EQ(read_raster(file("b.hdf")).n_not_sampled, 3);
  EXPECT_EQ(read_raster(file("a.hdf")).header.schema_version, 3);
  EXPECT_EQ(read_raster(file("b.hdf")).header.schema_version, 4);
}

TEST_F(RasterArtifacts, far_from_the_origin_have_places_that_count_from_their_middle) {
  RasterArtifact raster = sample_raster();
  raster.model.faces.origin = {1e6, -2e6, 3e6};
  for (LengthSample& s : raster.samples) s.xyz += raster.model.faces.origin;
  write_raster(file("a.hdf"), raster);
  const RasterArtifact read = read_raster(file("a.hdf"));
  EXPECT_EQ(read.header.schema_version, 7);
  EXPECT_EQ(read.model.faces.origin, raster.model.faces.origin);
  for (std::size_t i = 0; i < raster.samples.size(); ++i)
    EXPECT_LT(distance(read.samples[i].xyz, raster.samples[i].xyz), 1e-7) << i;
  EXPECT_EQ(write_raster(file("b.hdf"), read), read.header.content_hash);
}

TEST_F(RasterArtifacts, are_the_same_bytes_after_reading_and_writing) {
  const std::string hash = write_raster(file("a.hdf"), sample_raster());
  EXPECT_EQ(write_raster(file("b.hdf"), read_raster(file("a.hdf"))), hash);
  EXPECT_EQ(read_bytes(file("a.hdf")), read_bytes(file("b.hdf")));
}

TEST_F(RasterArtifacts, whose_links_or_numbers_are_wrong_are_refused) {
  const auto n_leaves = static_cast<std::int32_t>(sample_raster().octree.shape.leaf_keys.size());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<std::pair<const char*, std::function<void(RasterArtifact&)>>> breaks = {
      {"octree", [](auto& r) { r.octree.shape.node_children[3] = 1 << 30; }},
      {"octree", [](auto& r) { std::fill_n(r.octree.shape.node_children.begin(), 8, 0); }},
      {"octree", [&](auto& r) { r.octree.shape.node_children[7] = ~n_leaves; }},
      {"octree", [](auto& r) { r.octree.shape.leaf_levels[0] = 255; }},
      {"octree", [](auto& r) { std::swap(r.octree.shape.leaf_keys[0], r.octree.shape.leaf_keys[1]); }},
      {"octree", [](auto& r) { r.octree.shape.lo.x = std::numeric_limits<double>::infinity(); }},
      {"stored_length", [](auto& r) { r.octree.stored_length[2] = 0; }},
      {"stored_length", [&](auto& r) { r.octree.stored_length[2] = nan; }},
      {"cell_offset", [](auto& r) { r.model.faces.offsets[1] = -1; }},
      {"cell_offset", [](auto& r) { r.model.faces.offsets[1] = 1000; }},
      {"cell_leaf", [&](auto& r) { r.model.faces.leaf[0] = n_leaves; }},
      {"cell_area", [&](auto& r) { r.model.faces.area[0] = nan; }},
      {"cell_plane", [&](auto& r) { r.model.faces.plane[1].normal[0] = nan; }},
      {"sample/point", [&](auto& r) { r.samples[1].xyz.x = nan; }},
      {"sample/length", [](auto& r) { r.samples[1].length = -1; }},
      {"max_length", [](auto& r) { r.numbers.max_length = 0; }},
      {"far_length", [](auto& r) { r.numbers.far_length = 0; }},
      {"far_length", [](auto& r) { r.numbers.far_length = -1; }}};
  for (const auto& [name, break_it] : breaks) {
    RasterArtifact raster = sample_raster();
    break_it(raster);
    write_raster(file("a.hdf"), raster);
    EXPECT_ERROR(read_raster(file("a.hdf")), kInput, name);
  }
}

}  // namespace
}  // namespace st
