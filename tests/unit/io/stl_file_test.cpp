// STL: welded, in parts, binary or text.
#include "io/foreign/stl_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "unit/io/temporary_directory.h"

namespace st {
namespace {

using FloatCorners = std::vector<std::array<float, 9>>;

std::string binary(const FloatCorners& triangles, const std::string& title = "") {
  std::string bytes = title;
  bytes.resize(80, ' ');
  const auto put = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(static_cast<std::uint32_t>(triangles.size()));
  for (const auto& t : triangles) {
    put(std::array<float, 3>{});
    put(t);
    put(std::uint16_t{7});
  }
  return bytes;
}

SurfaceMesh read(const std::string& bytes) {
  const TemporaryDirectory dir;
  write_bytes(dir / "m.stl", bytes);
  return read_stl(dir / "m.stl");
}

void expect_refused(const std::string& bytes, const std::string& says) {
  const TemporaryDirectory dir;
  write_bytes(dir / "m.stl", bytes);
  EXPECT_ERROR(read_stl(dir / "m.stl"), kInput, says);
}

const FloatCorners kTwo{{0, 0, 0, 1, 0, 0, 0, 1, 0}, {1, 0, 0, 1, 1, 0, 0, 1, 0}};

TEST(StlFile, makes_one_node_of_equal_points_in_the_order_of_the_file) {
  const SurfaceMesh m = read(binary(kTwo));
  ASSERT_EQ(m.n_nodes(), 4);
  EXPECT_EQ(m.node_xyz[1], (Vec3{1, 0, 0}));
  EXPECT_EQ(m.node_xyz[3], (Vec3{1, 1, 0}));
  ASSERT_EQ(m.n_triangles(), 2);
  EXPECT_EQ(std::vector<NodeId>(m.triangles[1].n, m.triangles[1].n + 3), (std::vector<NodeId>{1, 3, 2}));
}

TEST(StlFile, welds_many_points_to_as_many_as_differ) {
  constexpr int kSquares = 60;
  FloatCorners c;
  for (int i = 0; i < kSquares; ++i)
    for (int j = 0; j < kSquares; ++j) {
      const auto a = static_cast<float>(i), b = static_cast<float>(j);
      c.push_back({a, b, 0, a + 1, b, 0, a, b + 1, 0});
      c.push_back({a + 1, b, 0, a + 1, b + 1, 0, a, b + 1, 0});
    }
  const SurfaceMesh m = read(binary(c));
  EXPECT_EQ(m.n_nodes(), (kSquares + 1) * (kSquares + 1));
  for (std::size_t t = 0; t < c.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(m.node_xyz[m.triangles[t].n[k]], (Vec3{c[t][3 * k], c[t][3 * k + 1], 0}));
}

TEST(StlFile, takes_minus_zero_for_zero) {
  EXPECT_EQ(read(binary({{0, 0, 0, 1, 0, 0, 0, 1, 0}, {1, -0.0f, 0, 1, 1, 0, -0.0f, 1, 0}})).n_nodes(), 4);
}

TEST(StlFile, leaves_triangles_out_that_name_a_node_twice) {
  FloatCorners c = kTwo;
  c.push_back({0, 0, 0, 0, 0, 0, 5, 5, 5});
  EXPECT_EQ(read(binary(c)).n_triangles(), 2);
}

TEST(StlFile, makes_each_connected_part_a_face) {
  const SurfaceMesh m = read(binary({{9, 9, 9, 8, 9, 9, 9, 8, 9}, kTwo[0], kTwo[1]}));
  EXPECT_EQ(m.triangle_face, (std::vector<FaceId>{0, 1, 1}));
  EXPECT_EQ(m.labels.face_name.size(), 2u);
}

TEST(StlFile, tells_a_binary_file_whose_title_begins_with_solid_by_its_size) {
  EXPECT_EQ(read(binary(kTwo, "solid of some CAD system")).n_triangles(), 2);
}

TEST(StlFile, reads_text_with_signs_exponents_and_any_line_ends) {
  const SurfaceMesh m = read(
      "solid a\r\nfacet normal 0 0 1\r\n outer loop\r\n\tvertex +1.5e1 -2 .5\r\n vertex 1 0 0\r\n vertex 0 1E0 0\r\n "
      "endloop\r\nendfacet\r\nendsolid a\r\n");
  ASSERT_EQ(m.n_triangles(), 1);
  EXPECT_EQ(m.node_xyz[0], (Vec3{15, -2, 0.5}));
}

TEST(StlFile, reads_text_in_capital_letters_and_with_carriage_returns_alone) {
  std::string text =
      "SOLID A B\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 1E0 0\nENDLOOP\nENDFACET\n"
      "ENDSOLID A B\n";
  EXPECT_EQ(read(text).n_triangles(), 1);
  std::ranges::replace(text, '\n', '\r');
  EXPECT_EQ(read(text).n_triangles(), 1);
}

TEST(StlFile, knows_binary_bytes_by_their_size) {
  const std::string two = binary(kTwo);
  EXPECT_EQ(whole_stl_size(two), 184u);
  EXPECT_EQ(whole_stl_size(two.substr(0, 83)), 0u);
  EXPECT_TRUE(is_binary_stl(two, 184));
  EXPECT_TRUE(is_binary_stl(two, 185)) << "a line end, added";
  EXPECT_FALSE(is_binary_stl(two, 234)) << "maybe a third triangle";
  EXPECT_FALSE(is_binary_stl(two, 183));
  EXPECT_FALSE(is_binary_stl(binary({}), 185)) << "triangles that were not counted";
  EXPECT_EQ(read(two + "\n").n_triangles(), 2);
}

TEST(StlFile, says_what_is_wrong) {
  expect_refused("", "neither binary nor ASCII");
  expect_refused("solid a\nendsolid a\n", "no whole triangles");
  expect_refused("solid a\nvertex 0 0 0\nvertex 1 0 0\nendsolid\n", "no whole triangles");
  expect_refused("solid a\nvertex 0 zero 0\n", "no coordinate: zero");
  expect_refused("solid a\nvertex 0 0", "no coordinate");
  expect_refused(binary({{0, 0, 0, 1, 0, 0, 0, std::nanf(""), 0}}), "not finite");
  expect_refused(binary(kTwo).substr(0, 150), "neither binary nor ASCII");
}

TEST(StlFile, refuses_text_that_is_cut_off_in_any_solid) {
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  expect_refused("solid a\n" + facet, "cut off: the last solid 'a' of the ASCII STL file has no endsolid");
  expect_refused("solid a\n" + facet + "endsolid a\nsolid b\n" + facet, "cut off: the last solid 'b'");
  expect_refused("solid a\n" + facet + "endsolid a\nsolid\n" + facet + "facet norm", "cut off: the last solid of");
  EXPECT_EQ(read("solid a\n" + facet + "endsolid a\nsolid vertex\n" + facet + "endsolid vertex\n").n_triangles(), 2);
}

}  // namespace
}  // namespace st
