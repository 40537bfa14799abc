// OBJ as other programs write it, and its damages.
#include <gtest/gtest.h>

#include "base/error.h"
#include "io/foreign/triangulation_file.h"
#include "io/foreign/triangulation_reader.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

const std::string kObjCorners = "v 0 0 0\nv 1 0 0 1.0\r\nv 1 1 0\nv 0 1 0 0.5 0.5 0.5\n";

TEST(ObjFile, ReadsPolygonsWithAllKindsOfNumbers) {
  const TriangulationFile file =
      parse_obj("a.obj", "# by hand\nmtllib a.mtl\n" + kObjCorners +
                             "vt 0 0\nvn 0 0 1\ns off\nf 1/1/1 2//1 3/1\nf -4 -2 -1\nl 1 2\nf 1 2 3 4\n");
  ASSERT_EQ(file.node_xyz.size(), 4u);
  EXPECT_EQ(file.node_xyz[2].y, 1);
  ASSERT_EQ(file.triangles.size(), 4u);
  const auto sum = [](const auto& t) { return t[0] + t[1] + t[2]; };
  EXPECT_EQ(sum(file.triangles[0]), 0 + 1 + 2);
  EXPECT_EQ(sum(file.triangles[1]), 0 + 2 + 3);
  EXPECT_TRUE(file.surface.empty()) << "without names connected parts are faces";
}

TEST(ObjFile, GroupsAreFacesElseMaterials) {
  const std::string two = kObjCorners + "g inlet  \nusemtl red\nf 1 2 3\ng outer wall\nf 1 3 4\ng inlet\nf 1 2 4\n";
  const TriangulationFile groups = parse_obj("a.obj", two);
  EXPECT_EQ(groups.surface_name, (std::vector<std::string>{"inlet", "outer wall"}));
  EXPECT_EQ(groups.surface, (std::vector<std::int64_t>{0, 1, 0}));
  const TriangulationFile materials =
      parse_obj("a.obj", "o body\n" + kObjCorners + "usemtl red\nf 1 2 3\nusemtl blue\nf 1 3 4\n");
  EXPECT_EQ(materials.surface_name, (std::vector<std::string>{"red", "blue"}));
}

TEST(ObjFile, IsKnownByContentAndNamesItsFaces) {
  const TemporaryDirectory dir;
  const std::string path = dir / "a.txt";
  write_bytes(path, std::string(3000, '#') + "\n" + kObjCorners + "g skin\nf 1 2 3\ng cap\nf 1 3 4\n");
  EXPECT_EQ(triangulation_format(path), "an OBJ mesh");
  const SurfaceMesh mesh = read_triangulation(path);
  EXPECT_EQ(mesh.labels.face_name, (std::vector<std::string>{"skin", "cap"}));
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_TRUE(is_obj("648 216\n" + kObjCorners + "vc 1 0 0\n")) << "lines of their own";
  EXPECT_FALSE(is_obj("v 0 0 0\nsolid s\n"));
  EXPECT_FALSE(is_obj("# remarks alone\n"));
  EXPECT_FALSE(is_obj("ISO-10303-21;\nHEADER;\n"));
}

TEST(ObjFile, DamageHasAMessage) {
  const auto parse = [](const std::string& end) { parse_obj("a.obj", kObjCorners + end); };
  EXPECT_ERROR(parse("f 1 2 9\n"), kInput, "a.obj: line 6: a polygon names a point that does not stand before it");
  EXPECT_ERROR(parse("f 1 2 0\n"), kInput, "does not stand before it");
  EXPECT_ERROR(parse("f 1 2 -9\n"), kInput, "does not stand before it");
  EXPECT_ERROR(parse("f 1 2\n"), kInput, "fewer than three points: ' 1 2'; export");
  EXPECT_ERROR(parse("f 1 2 x\n"), kInput, "not a number of a point in polygon ' 1 2 x'; export");
  EXPECT_ERROR(parse("v 1 2\n"), kInput, "cut off");
  EXPECT_ERROR(parse("v 0,5 1 2\n"), kInput, "line 5: '0,5' is no number; write the file again with decimal points");
}

}  // namespace
}  // namespace st
