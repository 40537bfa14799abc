// That the CGNS library and VTK read such files is tested in tests/foreign.
#include "io/export/export.h"
#include "io/hdf5/artifact.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

TEST(ExportCgns, has_families_conditions_by_role_and_the_unit) {
  TemporaryDirectory dir;
  const SurfaceMesh m = sample_mesh().mesh;
  ExportOptions options;
  options.unit = "mm";
  export_mesh(dir / "m.cgns", {m, all_triangles(m), {}}, options);
  const std::string bytes = read_bytes(dir / "m.cgns");
  for (const char* text : {"body", "wing", "BCWall", "BCSymmetryPlane", "Millimeter", "FamilySpecified"})
    EXPECT_NE(bytes.find(text), std::string::npos) << text;
  export_mesh(dir / "n.cgns", m);
  EXPECT_EQ(read_bytes(dir / "n.cgns").find("Millimeter"), std::string::npos);
}

}  // namespace
}  // namespace st
