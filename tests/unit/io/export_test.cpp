#include <cmath>
#include <cstring>
#include <sstream>

#include "io/artifact.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

TEST(Export, knows_formats_by_suffix_whatever_its_case) {
  TemporaryDirectory dir;
  for (const char* name : {"m.stl", "m.VTU", "m.Obj", "m.ply"}) {
    EXPECT_NO_THROW(require_export_suffix(dir / name));
    export_mesh(dir / name, sample_mesh().mesh);
    EXPECT_GT(read_bytes(dir / name).size(), 100u) << name;
  }
  EXPECT_EQ(dir.files().size(), 4u);
}

TEST(Export, refuses_unknown_suffixes_before_writing) {
  TemporaryDirectory dir;
  for (const char* name : {"m.xyz", "m", "m.", "m.stl.gz"}) {
    EXPECT_ERROR(require_export_suffix(dir / name), kUsage, "use .stl, .vtu, .obj or .ply");
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
  for (const char* suffix : {".stl", ".vtu", ".obj", ".ply"}) {
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

}  // namespace
}  // namespace st
