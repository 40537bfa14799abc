// Medit, as text and in libMeshb's binary form.
#include <cstring>

#include "io/export/export.h"
#include "io/hdf5/artifact.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

TEST(ExportMedit, writes_the_association_to_the_cad) {
  TemporaryDirectory dir;
  const SurfaceMesh m = sample_mesh().mesh;
  ExportOptions options;
  options.has_parameters = true;
  export_mesh(dir / "m.mesh", {m, all_triangles(m), {}}, options);
  const std::string text = read_bytes(dir / "m.mesh");
  EXPECT_NE(text.find("# reference 2: wing\n"), std::string::npos);
  EXPECT_NE(text.find("VerticesOnGeometricVertices\n2\n1 1\n2 2\nVerticesOnGeometricEdges\n1\n3 5 0.7 5\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("VerticesOnGeometricTriangles\n12\n1 1 0 -0 1\n1 2 "), std::string::npos) << text;
}

TEST(ExportMedit, says_in_binary_where_each_list_ends) {
  TemporaryDirectory dir;
  const SurfaceMesh m = sample_mesh().mesh;
  ExportOptions options;
  options.has_parameters = true;
  export_mesh(dir / "m.meshb", {m, all_triangles(m), {}}, options);
  const std::string bytes = read_bytes(dir / "m.meshb");
  std::vector<std::int32_t> keywords;
  for (std::int64_t at = 8; at != 0;) {  // behind byte order and version
    ASSERT_LE(static_cast<std::size_t>(at) + 12, bytes.size());
    std::int32_t keyword;
    std::memcpy(&keyword, bytes.data() + at, sizeof keyword);
    std::memcpy(&at, bytes.data() + at + 4, sizeof at);
    keywords.push_back(keyword);
  }
  EXPECT_EQ(keywords, (std::vector<std::int32_t>{3, 4, 5, 6, 40, 41, 42, 54}));
}

}  // namespace
}  // namespace st
