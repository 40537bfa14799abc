// STL and OBJ.
#include <cmath>
#include <cstring>
#include <sstream>

#include "io/export/export.h"
#include "io/hdf5/artifact.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

TEST(ExportSurfaces, writes_stl_with_unit_normals_to_the_side_from_which_corners_run_counterclockwise) {
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

TEST(ExportSurfaces, writes_obj_coordinates_that_read_back_exactly) {
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

TEST(ExportSurfaces, writes_a_solid_for_each_group_into_ascii_stl) {
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

TEST(ExportSurfaces, writes_each_group_of_obj_once) {
  TemporaryDirectory dir;
  SurfaceMesh m = sample_mesh().mesh;
  m.triangle_group = {0, 1, 0, 1};
  export_mesh(dir / "m.obj", m);
  EXPECT_NE(read_bytes(dir / "m.obj").find("g body\n# face 1 bottom\nf 1 3 2\n# face 3 Flügel\nf 2 3 4\ng wing\n"),
            std::string::npos)
      << read_bytes(dir / "m.obj");
}

}  // namespace
}  // namespace st
