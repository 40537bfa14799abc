#include "stages/blank_input.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

/// An ASCII STL of triangles by corner numbers of the unit cube (bits x, y, z).
void write_cube_stl(const std::string& path, const std::vector<std::array<int, 3>>& triangles) {
  std::ofstream out(path);
  out << "solid s\n";
  for (const auto& t : triangles) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const int c : t) out << "vertex " << (c & 1) << " " << (c >> 1 & 1) << " " << (c >> 2) << "\n";
    out << "endloop\nendfacet\n";
  }
  out << "endsolid s\n";
}

const std::vector<std::array<int, 3>> kTetrahedron{{0, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 0, 4}};

std::string message_of(const std::string& path) {
  try {
    read_blank(path, "auto");
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kGeometry);
    return e.what();
  }
  return "";
}

TEST(BlankInput, takes_a_closed_surface_and_turns_its_normals_out) {
  TemporaryDirectory dir;
  auto turned = kTetrahedron;
  for (auto& t : turned) std::swap(t[0], t[1]);
  write_cube_stl(dir / "a.stl", kTetrahedron);
  write_cube_stl(dir / "b.stl", turned);
  for (const char* name : {"a.stl", "b.stl"}) {
    const BlankInput input = read_blank(dir / name, "auto");
    EXPECT_EQ(input.side, BlankSide::kInside);
    EXPECT_EQ(winding_number(input.view(), {0.1, 0.2, 0.15}), 1) << name;
    EXPECT_EQ(winding_number(input.view(), {0.6, 0.6, 0.6}), 0) << name;
  }
}

TEST(BlankInput, refuses_an_open_surface_with_the_places_of_its_edges) {
  TemporaryDirectory dir;
  write_cube_stl(dir / "a.stl", {kTetrahedron[0], kTetrahedron[1], kTetrahedron[2]});
  const std::string message = message_of(dir / "a.stl");
  EXPECT_NE(message.find("3 edges have only one triangle"), std::string::npos) << message;
  EXPECT_NE(message.find("(0, 0.5, 0)"), std::string::npos) << message;
}

TEST(BlankInput, refuses_inner_walls) {
  TemporaryDirectory dir;
  // two tetrahedra on either side of one common triangle
  write_cube_stl(dir / "a.stl", {{0, 2, 1}, {0, 1, 4}, {2, 0, 4}, {1, 2, 4}, {1, 7, 2}, {1, 4, 7}, {2, 7, 4}});
  EXPECT_NE(message_of(dir / "a.stl").find("inner walls"), std::string::npos);
}

TEST(BlankInput, points_are_near_the_cells_that_are_named) {
  const std::vector<RasterBox> boxes = {{{0.1, 0.1, 0.1}, 0.05f, 0.05f}};
  const Box3 root{{0, 0, 0}, {1, 1, 1}};
  const RasterOctree octree = build_octree(root, boxes);
  const OctreeView view = octree.shape.view();
  const std::int32_t leaf = view.find_leaf(morton::encode(view.grid_point({0.1, 0.1, 0.1})));
  const std::vector<std::int32_t> leaves = {leaf};
  EXPECT_EQ(share_near(std::vector<Vec3>{{0.1, 0.1, 0.1}, {0.9, 0.9, 0.9}}, view, leaves), 0.5);
  EXPECT_EQ(share_near(std::vector<Vec3>{{-7, 0.1, 0.1}}, view, leaves), 0) << "outside";
  EXPECT_EQ(share_near({}, view, leaves), 0);
}

}  // namespace
}  // namespace st
