// Surfaces of .msh are tested in triangulation_reader_test.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <string>

#include "io/foreign/cell_file.h"
#include "io/foreign/size_mesh.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

const std::string kMsh2 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
4
1 0 0 0
2 1 0 0
5 0 1 0
7 0 0 1
$EndNodes
$Elements
2
1 2 2 0 1 1 2 5
2 4 2 0 1 1 2 5 7
$EndElements
$NodeData
1
"length"
1
0
3
0
1
4
7 0.4
1 0.1
2 0.2
5 0.3
$EndNodeData
)";

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("no " + from);
  return text.replace(at, from.size(), to);
}

/// Values as bytes.
template <class... T>
std::string bytes_of(T... values) {
  std::string all;
  const auto add = [&](auto v) {
    char raw[sizeof v];
    std::memcpy(raw, &v, sizeof v);
    all.append(raw, sizeof v);
  };
  (add(values), ...);
  return all;
}

/// The same mesh and lengths in version 4.1, with a quadratic tetrahedron whose nodes between have no lengths, and a
/// view of vectors before.
std::string msh4(bool is_binary) {
  const auto item = [&](auto v) { return is_binary ? bytes_of(v) : std::to_string(v) + " "; };
  const auto size = [&](std::uint64_t v) { return item(v); };
  const auto integer = [&](std::int32_t v) { return item(v); };
  std::string text = std::string("$MeshFormat\n4.1 ") + (is_binary ? "1" : "0") + " 8\n";
  if (is_binary) text += bytes_of(std::int32_t{1}) + "\n";
  text += "$EndMeshFormat\n$Nodes\n" + size(1) + size(10) + size(1) + size(16);
  text += integer(3) + integer(1) + integer(0) + size(10);
  for (const std::uint64_t n : {1, 2, 5, 7, 11, 12, 13, 14, 15, 16}) text += size(n);
  const double corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int i = 0; i < 10; ++i)
    for (int k = 0; k < 3; ++k) text += item(i < 4 ? corners[i][k] : 0.5);
  text += "\n$EndNodes\n$Elements\n" + size(1) + size(1) + size(1) + size(1);
  text += integer(3) + integer(1) + integer(11) + size(1) + size(1);
  for (const std::uint64_t n : {1, 2, 5, 7, 11, 12, 13, 14, 15, 16}) text += size(n);
  text += "\n$EndElements\n";
  text += "$NodeData\n1\n\"flow\"\n1\n0\n3\n0\n3\n1\n" + integer(1) + item(1.0) + item(2.0) + item(3.0);
  text += "\n$EndNodeData\n$NodeData\n1\n\"my length\"\n1\n0\n3\n0\n1\n4\n";
  const double length[] = {0.1, 0.2, 0.3, 0.4};
  const std::int32_t number[] = {1, 2, 5, 7};
  for (int i = 0; i < 4; ++i) text += integer(number[i]) + item(length[i]);
  return text + "\n$EndNodeData\n";
}

class MshFile : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& bytes) {
    std::ofstream(dir_ / name, std::ios::binary) << bytes;
    return dir_ / name;
  }
  BackgroundMesh read(const std::string& bytes, const std::string& view = "") {
    return read_size_mesh(write("m.msh", bytes) + view);
  }
  TemporaryDirectory dir_;
};

void expect_lengths(const BackgroundMesh& mesh) {
  ASSERT_EQ(mesh.tets.size(), 1u);
  ASSERT_EQ(mesh.node_size.size(), 4u);
  for (const std::int32_t n : mesh.tets[0]) {
    const Vec3 x = mesh.node_xyz[n];
    EXPECT_NEAR(mesh.node_size[n].length, 0.1 + 0.1 * x.x + 0.2 * x.y + 0.3 * x.z, 1e-12);
  }
}

TEST_F(MshFile, has_lengths_at_nodes_by_their_numbers) {
  expect_lengths(read(kMsh2));
  expect_lengths(read(msh4(false), ":my length"));
  expect_lengths(read(msh4(true), ":my length"));
}

TEST_F(MshFile, of_a_surface_has_triangles) {
  const BackgroundMesh mesh = read(with(with(kMsh2, "$Elements\n2", "$Elements\n1"), "2 4 2 0 1 1 2 5 7\n", ""));
  EXPECT_TRUE(mesh.tets.empty());
  EXPECT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.node_size.size(), 3u);
}

TEST_F(MshFile, may_have_metrics_at_the_nodes) {
  std::string text = with(kMsh2, "0\n1\n4\n", "0\n9\n4\n");
  text = with(text, "1 0.1\n", "1 100 0 0 0 100 0 0 0 100\n");
  text = with(text, "2 0.2\n", "2 25 0 0 0 6.25 0 0 0 25\n");
  text = with(text, "5 0.3\n", "5 2.5 1.5 0 1.5 2.5 0 0 0 4\n");  // lengths 1, 0.5, 0.5; the long one along (1, -1, 0)
  text = with(text, "7 0.4\n", "7 4 0 0 0 4 0 0 0 4\n");
  const BackgroundMesh mesh = read(text);
  ASSERT_EQ(mesh.node_size.size(), 4u);
  const double length[] = {0.1, 0.2, 0.5, 0.5}, along[] = {0.1, 0.4, 1, 0.5};
  const Vec3 direction[] = {{}, {0, 1, 0}, normalized(Vec3{1, -1, 0}), {}};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(mesh.node_size[k].length, length[k], 1e-12);
    EXPECT_NEAR(mesh.node_size[k].along, along[k], 1e-12);
    EXPECT_NEAR(norm(cross(mesh.node_size[k].direction, direction[k])), 0, 1e-12);
  }
  EXPECT_ERROR(read(with(text, "2 25 0", "2 -25 0")), kInput, "1 of 4 nodes have no metric that is positive definite");
}

TEST_F(MshFile, is_a_field_for_metrics_too) {
  const FieldMesh field = read_field_mesh(write("f.msh", with(kMsh2, "7 0.4", "7 -3")));
  EXPECT_EQ(field.value, (std::vector<double>{0.1, 0.2, 0.3, -3}));
}

/// Two tetrahedra on either side of the triangle 2, 5, 7, and a triangle of the border.
const std::string kTwoTets = R"($MeshFormat
2.1 0 8
$EndMeshFormat
$Nodes
5
1 0 0 0
2 1 0 0
5 0 1 0
7 0 0 1
8 1 1 1
$EndNodes
$Elements
4
1 15 2 0 1 1
12 2 2 0 1 1 2 5
14 4 2 0 1 1 2 5 7
13 4 2 0 1 2 5 7 8
$EndElements
)";

TEST_F(MshFile, values_at_elements_are_averaged_at_nodes) {
  const std::string head = "1\n\"h\"\n1\n0\n3\n0\n1\n4\n";
  const BackgroundMesh mesh = read(kTwoTets + "$ElementData\n" + head + "12 9\n13 0.3\n14 0.1\n1 9\n$EndElementData\n");
  ASSERT_EQ(mesh.node_size.size(), 5u);
  const double expected[] = {0.1, 0.2, 0.2, 0.2, 0.3};
  for (std::size_t n = 0; n < 5; ++n) EXPECT_NEAR(mesh.node_size[n].length, expected[n], 1e-15) << n;
}

TEST_F(MshFile, values_at_corners_of_elements_are_averaged_at_nodes) {
  const std::string data =
      "$ElementNodeData\n1\n\"h\"\n1\n-1\n3\n0\n1\n4\n1 1 9\n12 3 9 9 9\n"
      "14 4 0.1 0.2 0.3 0.4\n13 4 0.4 0.3 0.4 0.5\n$EndElementNodeData\n";
  const BackgroundMesh mesh = read(kTwoTets + data);
  ASSERT_EQ(mesh.node_size.size(), 5u);
  const double expected[] = {0.1, 0.3, 0.3, 0.4, 0.5};
  for (std::size_t n = 0; n < 5; ++n) EXPECT_NEAR(mesh.node_size[n].length, expected[n], 1e-15) << n;
  EXPECT_ERROR(read(kTwoTets + with(data, "13 4 0.4 0.3 0.4 0.5", "13 3 0.4 0.3 0.4")), kInput,
               "element 13 has too few values");
  EXPECT_ERROR(read(kTwoTets + with(data, "4\n1 1 9\n12 3 9 9 9\n14 4 0.1 0.2 0.3 0.4\n", "1\n")), kInput,
               "1 of 5 nodes have no length above 0, the first is node 0");
}

TEST_F(MshFile, damage_is_told_with_its_line) {
  const auto expect = [&](const std::string& text, const std::string& message, const std::string& view = "") {
    EXPECT_ERROR(read(text, view), kInput, message);
  };
  expect(with(kMsh2, "5 0 1 0\n", "2 0 1 0\n"), "has two nodes of the number 2");
  expect(with(kMsh2, "1 2 5 7\n", "1 2 5 8\n"), "an element names node 8, which does not exist");
  expect(with(kMsh2, "7 0.4", "8 0.4"), "$NodeData names node 8, which does not exist");
  expect(with(kMsh2, "7 0.4", "7.5 0.4"), "line 25: '7.5' is no integer");
  expect(with(kMsh2, "7 0.4", "7 0"), "1 of 4 nodes have no length above 0");
  expect(with(kMsh2, "4\n7 0.4\n", "3\n"), "1 of 4 nodes have no length above 0");
  expect(with(kMsh2, "0\n1\n4\n", "0\n3\n4\n"), "$NodeData 'length' has 3 components; a length per node");
  expect(with(kMsh2, "0\n1\n4\n", "0\n1\n4000\n"), "should have 4000 values");
  expect(with(with(kMsh2, "$NodeData", "$Comments"), "$EndNodeData", "$EndComments"), "has no $NodeData; write");
  expect(kMsh2, "has no $NodeData 'size'; there are 'length'", ":size");
  expect(msh4(false), "$NodeData 'flow' has 3 components");
}

}  // namespace
}  // namespace st
