// Parsed views of Gmsh as background meshes.
#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "io/foreign/cell_file.h"
#include "io/foreign/size_mesh.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

const char* const kPosTets =
    "View \"lengths\" {\n"
    "// two tetrahedra that share a side\n"
    "TIME{0, 1};\n"
    "SP(0,0,0){9,9};\n"
    "SS(0,0,0, 1,0,0, 0,1,0, 0,0,1){0.1,0.2,+0.3,4e-1, 7,7,7,7};\n"
    "T3(0,0,0,0){\"a text\"};\n"
    "SS(1,0,0,0,1,0,0,0,1,1,1,1){0.2,0.3,0.4,0.6};\n"
    "};\n";

TEST(PosViews, give_cells_at_one_place_one_node_and_take_the_first_step) {
  const CellFile file = parse_pos_cells("a.pos", kPosTets);
  EXPECT_EQ(file.node_xyz.size(), 5U);
  EXPECT_EQ(file.value, (std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.6}));
  EXPECT_EQ(file.node, (std::vector<std::int64_t>{0, 1, 2, 3, 1, 2, 3, 4}));
  EXPECT_EQ(file.type, (std::vector<std::int64_t>{10, 10}));
}

TEST(PosViews, are_read_as_background_meshes) {
  const TemporaryDirectory dir;
  const std::string path = dir / "a.pos";
  std::ofstream(path) << kPosTets;
  const BackgroundMesh mesh = read_size_mesh(path);
  EXPECT_EQ(mesh.tets.size(), 2U);
  EXPECT_EQ(mesh.node_size[4].length, 0.6);
}

TEST(PosViews, hold_metrics_and_surfaces_too) {
  const TemporaryDirectory dir;
  const std::string path = dir / "a.pos", m = "4,0,0,0,1,0,0,0,1";
  std::ofstream(path) << "View \"m\" { TT(0,0,0,1,0,0,0,1,0){" << m << "," << m << "," << m << "}; };";
  const BackgroundMesh mesh = read_size_mesh(path);
  ASSERT_EQ(mesh.triangles.size(), 1U);
  EXPECT_NEAR(mesh.node_size[0].length, 0.5, 1e-12);
  ASSERT_EQ(mesh.node_metric.size(), 3U);
  EXPECT_EQ(mesh.node_metric[0], (SymmetricTensor{4, 1, 1, 0, 0, 0}));
}

TEST(PosViews, that_tell_no_lengths_are_refused_with_the_line) {
  for (const auto& [text, says] : std::initializer_list<std::pair<const char*, const char*>>{
           {"$MeshFormat\n", "a.pos:1: no parsed view of Gmsh"},
           {"View \"a\" {\nVS(0,0,0,1,0,0,0,1,0,0,0,1){1,1,1};\n};", "a.pos:2: vectors are no lengths"},
           {"View \"a\" {\nSS(0,0,0,1,0,0,0,1,0){1,1,1,1};\n};", "wrong number of coordinates"},
           {"View \"a\" {\nSS(0,0,0,1,0,0,0,1,0,0,0,1){1,1};\n};", "too few values"},
           {"View \"a\" {\nSS(0,0,x,1,0,0,0,1,0,0,0,1){1,1,1,1};\n};", "a number expected"},
           {"View \"a\" {\nSS2(0,0,0){1};\n};", "curved cells are not read"},
           {"View \"a\" {\nSP(0,0,0){1};\n};", "no cells with a length or a metric"},
           {"View \"a\" {\nST(0,0,0,1,0,0,0,1,0){1,1,1};\n", "has no end"}}) {
    try {
      parse_pos_cells("a.pos", text);
      FAIL() << text;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace st
