#include <cmath>
#include <cstring>
#include <sstream>

#include "io/export/export.h"
#include "io/hdf5/artifact.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

TEST(Export, knows_formats_by_suffix_whatever_its_case) {
  TemporaryDirectory dir;
  for (const char* name : {"m.stl", "m.VTU", "m.Obj", "m.ply", "m.msh", "m.fro", "m.ASCII.stl"}) {
    EXPECT_NO_THROW(require_export_suffix(dir / name));
    export_mesh(dir / name, sample_mesh().mesh);
    EXPECT_GT(read_bytes(dir / name).size(), 80u) << name;
  }
  EXPECT_EQ(dir.files().size(), 7u);
}

TEST(Export, refuses_unknown_suffixes_before_writing) {
  TemporaryDirectory dir;
  for (const char* name : {"m.xyz", "m", "m.", "m.stl.gz"}) {
    EXPECT_ERROR(require_export_suffix(dir / name), kUsage, "use one of .ascii.stl, .stl, .vtu");
    EXPECT_ERROR(export_mesh(dir / name, sample_mesh().mesh), kUsage, name);
  }
  EXPECT_ERROR(require_export_suffix("folder.stl/m"), kUsage, "unknown suffix ''");
  EXPECT_TRUE(dir.files().empty());
}

TEST(Export, leaves_nothing_when_it_cannot_write) {
  EXPECT_ERROR(export_mesh("/none/m.stl", sample_mesh().mesh), kOutput, "/none/m.stl");
  TemporaryDirectory dir;
  EXPECT_ERROR(export_mesh(dir / "none/m.vtu", sample_mesh().mesh), kOutput, "create it first");
  EXPECT_TRUE(dir.files().empty());
}

TEST(Export, writes_equal_meshes_as_equal_bytes) {
  TemporaryDirectory dir;
  for (const char* suffix : {".stl", ".ascii.stl", ".vtu", ".obj", ".ply", ".msh", ".fro"}) {
    export_mesh(dir / "a" + suffix, sample_mesh().mesh);
    export_mesh(dir / "b" + suffix, sample_mesh().mesh);
    EXPECT_EQ(read_bytes(dir / "a" + suffix), read_bytes(dir / "b" + suffix)) << suffix;
  }
}

TEST(Export, writes_stl_with_unit_normals_to_the_side_from_which_corners_run_counterclockwise) {
  TemporaryDirectory dir;
  const SurfaceMesh m = sample_mesh().mesh;
  export_mesh(dir / "m.stl", m);
  const std::string bytes = read_bytes(dir / "m.stl");
  ASSERT_EQ(bytes.size(), 84 + 50 * m.triangles.size());
  EXPECT_NE(bytes.substr(0, 5), "solid");  // that would announce the text format
  float normal[3];
  std::memcpy(normal, bytes.data() + 84, sizeof normal);
  EXPECT_EQ(normal[0], 0);
  EXPECT_EQ(normal[1], 0);
  EXPECT_EQ(normal[2], -1);
}

TEST(Export, writes_obj_coordinates_that_read_back_exactly) {
  TemporaryDirectory dir;
  SurfaceMesh m = sample_mesh().mesh;
  m.node_xyz[1] = {1.0 / 3, -1e-300, 12345678.87654321};
  export_mesh(dir / "m.obj", m);
  std::istringstream text(read_bytes(dir / "m.obj"));
  std::size_t n = 0;
  for (std::string line; std::getline(text, line);) {
    if (line.rfind("v ", 0) != 0) continue;
    Vec3 p;
    ASSERT_EQ(std::sscanf(line.c_str(), "v %lf %lf %lf", &p.x, &p.y, &p.z), 3);
    EXPECT_TRUE(p == m.node_xyz[n++]);
  }
  EXPECT_EQ(n, m.node_xyz.size());
}

TEST(Export, writes_a_solid_for_each_group_into_ascii_stl) {
  TemporaryDirectory dir;
  MeshArtifact sample = sample_mesh();
  sample.mesh.labels.group_name[1] = "wing \t\"left\"";
  sample.mesh.triangle_group = {0, 1, 0, 1};
  export_mesh(dir / "m.ascii.stl", sample.mesh);
  const std::string text = read_bytes(dir / "m.ascii.stl");
  const std::size_t second = text.find("solid wing__'left'\n");
  ASSERT_NE(second, std::string::npos) << text;
  EXPECT_EQ(text.find("solid body\n"), 0u);
  const auto count = [](std::string_view in, std::string_view what) {
    int n = 0;
    for (std::size_t at = in.find(what); at != std::string_view::npos; at = in.find(what, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count(std::string_view(text).substr(0, second), "facet normal"), 2);
  EXPECT_EQ(count(text, "facet normal"), 4);
  EXPECT_EQ(count(text, "vertex 0.1 0.2 1\n"), 3);
}

TEST(Export, writes_every_division_of_the_faces_as_physical_surfaces_of_msh) {
  TemporaryDirectory dir;
  export_mesh(dir / "m.msh", sample_mesh().mesh);
  const std::string text = read_bytes(dir / "m.msh");
  EXPECT_NE(
      text.find(
          "$PhysicalNames\n10\n2 1 \"body\"\n2 2 \"wing\"\n2 3 \"part:Träger/bolt#1\"\n2 4 \"part:Träger/bolt#2\"\n"
          "2 5 \"group_table:hot\"\n2 6 \"group_table:cold\"\n2 7 \"group_table:Öl\"\n"
          "1 8 \"te\"\n1 9 \"group_table:root\"\n0 10 \"tip\"\n$End"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("2 0 0 0 1 0.2 1 3 1 3 7 0\n"), std::string::npos)
      << "face 2 is of body, the first part and Öl: " << text;
}

TEST(Export, writes_the_cad_face_of_each_triangle_into_fro) {
  TemporaryDirectory dir;
  export_mesh(dir / "m.fro", sample_mesh().mesh);
  EXPECT_EQ(read_bytes(dir / "m.fro"),
            "4 4 1 0 0 4 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0.1 0.2 1\n1 1 3 2 1\n2 1 2 4 2\n3 2 3 4 3\n4 3 1 4 4\n");
}

TEST(Export, writes_edges_and_vertices_in_groups_as_lines_and_points_of_msh_and_obj) {
  TemporaryDirectory dir;
  const SurfaceMesh m = sample_mesh().mesh;
  EXPECT_EQ(export_mesh(dir / "m.msh", m), 0u);
  const std::string msh = read_bytes(dir / "m.msh");
  EXPECT_NE(msh.find("\n1 2 1 2\n5 1 3\n6 3 2\n1 4 1 1\n7 2 1\n0 2 15 1\n8 2\n$EndElements"), std::string::npos) << msh;
  EXPECT_NE(msh.find("\n2 0 0 0 1 1 0 1 8 0\n"), std::string::npos)
      << "edge 2 with the box of its segments is in \"te\": " << msh;
  EXPECT_NE(msh.find("\n2 1 0 0 1 10\n"), std::string::npos) << "vertex 2 is in \"tip\": " << msh;
  EXPECT_EQ(export_mesh(dir / "m.obj", m), 0u);
  const std::string obj = read_bytes(dir / "m.obj");
  EXPECT_NE(obj.find("g edge_group_1_te\nl 1 3\nl 3 2\nl 2 1\ng edge_group_2_table:root\ng vertex_group_1_tip\np 2\n"),
            std::string::npos)
      << obj;
}

TEST(Export, says_how_many_groups_of_edges_and_vertices_a_format_cannot_hold) {
  TemporaryDirectory dir;
  const SurfaceMesh m = sample_mesh().mesh;
  for (const char* name : {"m.stl", "m.ascii.stl", "m.fro"}) EXPECT_EQ(export_mesh(dir / name, m), 3u) << name;
  for (const char* name : {"m.vtu", "m.ply"}) EXPECT_EQ(export_mesh(dir / name, m), 0u) << name;
}

}  // namespace
}  // namespace st
