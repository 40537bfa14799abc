#include "io/export/displacement_export.h"

#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

TEST(DisplacementExport, writes_places_and_vectors_of_all_nodes) {
  TemporaryDirectory dir;
  SurfaceMesh moved;
  moved.node_xyz = {{0, 0, 0.5}, {1, 0.1, 0}, {0, 1, 0}};
  moved.triangles = {{{0, 1, 2}}};
  const std::vector<Vec3> from{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  export_displacements(dir / "by.csv", from, moved);
  EXPECT_EQ(read_bytes(dir / "by.csv"), "node,x,y,z,dx,dy,dz\n0,0,0,0,0,0,0.5\n1,1,0,0,0,0.1,0\n2,0,1,0,0,0,0\n");
  export_displacements(dir / "by.vtu", from, moved);
  const std::string text = read_bytes(dir / "by.vtu");
  for (const char* part : {"NumberOfPoints=\"3\" NumberOfCells=\"1\"", "Name=\"displacement\"", "</VTKFile>"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

TEST(DisplacementExport, refuses_other_formats) { EXPECT_ERROR(require_displacement_format("by.txt"), kUsage, ".csv"); }

}  // namespace
}  // namespace st
