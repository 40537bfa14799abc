#include "io/hdf5/composites_io.h"

#include <gtest/gtest.h>

#include "geometry/shape/member_map.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

/// The first two faces of the CAD are the first face of the patches.
Composites sample_composites() {
  Composites c;
  c.member = {0, 1};
  c.member_offsets = {0, 2};
  c.node_xyz = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  c.node_uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  c.node_offsets = {0, 4};
  c.triangle_nodes = {{0, 1, 2}, {0, 2, 3}};
  c.triangle_face = {0, 1};
  c.triangle_uv = {{{{0, 0}, {2, 0}, {2, 2}}}, {{{5, 5}, {7, 7}, {5, 7}}}};
  c.triangle_pole = {kNone, kNone};
  c.triangle_offsets = {0, 2};
  c.uv_bounds = {0, 1, 0, 1};
  return c;
}

TEST(CompositesIo, patches_keep_the_charts) {
  const TemporaryDirectory dir;
  PatchesArtifact p = sample_patches();
  write_patches(dir / "plain.hdf", p);
  EXPECT_TRUE(read_patches(dir / "plain.hdf").composites.empty());
  p.composites = sample_composites();
  write_patches(dir / "p.hdf", p);
  const Composites read = read_patches(dir / "p.hdf").composites;
  EXPECT_EQ(read.member, p.composites.member);
  EXPECT_EQ(read.node_uv, p.composites.node_uv);
  EXPECT_EQ(read.triangle_uv, p.composites.triangle_uv);
  EXPECT_EQ(read.triangle_face, p.composites.triangle_face);
}

TEST(CompositesIo, older_tools_refuse_poles_alone) {
  const TemporaryDirectory dir;
  PatchesArtifact p = sample_patches();
  p.composites = sample_composites();
  write_patches(dir / "p.hdf", p);
  EXPECT_EQ(Hdf5Reader(dir / "p.hdf").int_attribute("/st/composites", "version"), 1);
  EXPECT_EQ(read_patches(dir / "p.hdf").composites.triangle_pole, p.composites.triangle_pole);
  p.composites.triangle_pole = {kNone, PoleCorner{2, true}.code()};
  write_patches(dir / "p.hdf", p);
  EXPECT_EQ(Hdf5Reader(dir / "p.hdf").int_attribute("/st/composites", "version"), 2);
  EXPECT_EQ(read_patches(dir / "p.hdf").composites.triangle_pole, p.composites.triangle_pole);
}

TEST(CompositesIo, patches_refuse_charts_that_lead_nowhere) {
  const TemporaryDirectory dir;
  PatchesArtifact p = sample_patches();
  p.composites = sample_composites();
  p.composites.triangle_nodes[1][2] = 4;
  write_patches(dir / "p.hdf", p);
  EXPECT_ERROR(read_patches(dir / "p.hdf"), kInput, "/st/composites");
}

}  // namespace
}  // namespace st
