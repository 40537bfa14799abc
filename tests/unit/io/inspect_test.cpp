#include "io/hdf5/inspect.h"

#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

TEST(Inspect, describes_what_is_in_an_artifact) {
  TemporaryDirectory dir;
  write_geometry(dir / "g.hdf", sample_geometry());
  const ArtifactDescription d = describe_artifact(dir / "g.hdf");
  EXPECT_EQ(d.header.schema, "geometry");
  EXPECT_EQ(d.rows("/st/face/area"), 2);
  EXPECT_EQ(d.rows("/st/none"), 0);
  EXPECT_EQ(d.integer("/st@is_closed"), 1);
  EXPECT_EQ(d.integer("/st@n_shells"), 1);
}

TEST(Inspect, finds_a_flipped_byte) {
  TemporaryDirectory dir;
  write_geometry(dir / "g.hdf", sample_geometry());
  std::string bytes = read_bytes(dir / "g.hdf");
  const std::size_t at = bytes.find("WING_UPPER");
  ASSERT_NE(at, std::string::npos);
  bytes[at] = 'w';
  write_bytes(dir / "g.hdf", bytes);
  EXPECT_ERROR(describe_artifact(dir / "g.hdf"), kInput, "/st/face/name: does not fit its checksum");
}

std::vector<std::string> differences(const TemporaryDirectory& dir, const MeshArtifact& a, const MeshArtifact& b,
                                     double tolerance = 0) {
  write_mesh(dir / "a.hdf", a);
  write_mesh(dir / "b.hdf", b);
  return compare_artifacts(dir / "a.hdf", dir / "b.hdf", tolerance);
}

TEST(Compare, takes_equal_content_for_equal_whatever_the_provenance) {
  TemporaryDirectory dir;
  MeshArtifact other = sample_mesh();
  other.header.tool_version = "7";
  other.header.inputs.clear();
  other.header.options_json = "{}";
  EXPECT_TRUE(differences(dir, sample_mesh(), other).empty());
}

TEST(Compare, says_where_and_how_much) {
  TemporaryDirectory dir;
  MeshArtifact one = sample_mesh();
  one.mesh.labels = {};
  MeshArtifact other = one;
  other.mesh.node_size[1] = 1.75;
  other.mesh.node_size[3] = 2.5;
  other.mesh.triangle_face[2] = 0;
  const std::vector<std::string> found = differences(dir, one, other);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0], "/VTKHDF/CellData/face: 1 of 4 values differ, first in row 2: 3 against 1");
  EXPECT_EQ(found[1],
            "/VTKHDF/PointData/size: 2 of 4 values differ, first in row 1: 1.5 against 1.75; largest difference 0.5");
}

TEST(Compare, sees_flags_names_units_and_shapes) {
  TemporaryDirectory dir;
  MeshArtifact other = sample_mesh();
  other.is_complete = false;
  other.header.unit = "cm";
  other.mesh.labels.face_name[2] = "Wing";
  other.mesh.triangles.pop_back();
  other.mesh.triangle_face.pop_back();
  other.mesh.triangle_group.pop_back();
  other.mesh.corner_uv.resize(9);
  std::string all;
  for (const std::string& difference : differences(dir, sample_mesh(), other, 0.5)) all += difference + "\n";
  for (const char* expected :
       {"/st@is_complete: 1 against 0", "/st@unit: 'mm' against 'cm'", "/st/face/name: 1 of 4",
        "/VTKHDF/Types: shape (4) against (3)", "/st/triangle/corner_uv: shape (12, 2) against (9, 2)"})
    EXPECT_NE(all.find(expected), std::string::npos) << expected << " in\n" << all;
}

TEST(Compare, allows_numbers_to_differ_by_the_tolerance_and_not_by_more) {
  TemporaryDirectory dir;
  MeshArtifact other = sample_mesh();
  other.mesh.node_size[1] = 1.5 * (1 + 1e-6);
  other.mesh.node_xyz[0].x = 1e-9;  // relative to the extent of the mesh, not to zero
  EXPECT_EQ(differences(dir, sample_mesh(), other).size(), 2u);
  EXPECT_EQ(differences(dir, sample_mesh(), other, 1e-7).size(), 1u);
  EXPECT_EQ(differences(dir, sample_mesh(), other, 1.1e-6).size(), 0u);
}

TEST(Compare, allows_no_tolerance_for_integers_and_not_a_number) {
  TemporaryDirectory dir;
  MeshArtifact other = sample_mesh();
  other.mesh.node_entity[0] = 1;
  other.mesh.node_size[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(differences(dir, sample_mesh(), other, 1).size(), 3u);  // its entity, the entity's group, its size
  EXPECT_EQ(differences(dir, other, other).size(), 0u);
}

TEST(Compare, refuses_artifacts_of_different_kinds) {
  TemporaryDirectory dir;
  write_mesh(dir / "a.hdf", sample_mesh());
  write_patches(dir / "b.hdf", sample_patches());
  EXPECT_ERROR(compare_artifacts(dir / "a.hdf", dir / "b.hdf", 0), kMismatch, "compare two of the same kind");
}

}  // namespace
}  // namespace st
