// OpenFOAM's feature edges.
#include "io/export/export.h"
#include "io/hdf5/artifact.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

TEST(ExportEmesh, has_the_features_and_no_other_node) {
  TemporaryDirectory dir;
  SurfaceMesh m = sample_mesh().mesh;
  m.node_xyz.insert(m.node_xyz.begin(), Vec3{9, 9, 9});  // of no triangle
  for (Triangle& t : m.triangles)
    for (NodeId& n : t.n) ++n;
  ExportOptions options;
  options.feature_angle_deg = 30;
  export_mesh(dir / "m.eMesh", {m, all_triangles(m), {}}, options);
  const std::string text = read_bytes(dir / "m.eMesh");
  EXPECT_NE(text.find("class featureEdgeMesh;"), std::string::npos);
  EXPECT_NE(text.find("}\n\n4\n(\n(0 0 0)\n(1 0 0)\n"), std::string::npos) << text;
  EXPECT_NE(text.find(")\n\n6\n(\n(0 1)\n(0 2)\n(0 3)\n(1 2)\n(1 3)\n(2 3)\n)\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace st
