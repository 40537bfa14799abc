// Meshes and solutions of Medit as background meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "base/error.h"
#include "io/foreign/size_mesh.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

class MeditMeshes : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(dir_ / name, std::ios::binary) << text;
    return dir_ / name;
  }
  TemporaryDirectory dir_;
};

const char* const kMeditMesh = R"(MeshVersionFormatted 2
# of a mesh adapter
Dimension
3
Vertices
6
0 0 0 1
1 0 0 1  # on the wall
0 1 0 1
0 0 1 1
9 9 9 0
1 1 1 7
Corners
1
2
Tetrahedra
2
1 2 3 4 5
2 3 4 6 5
Triangles
1
1 2 3 1
End
)";
const char* const kMeditLengths =
    "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n6\n1 1\n0.1\n0.2\n0.3\n0.4\n0\n0.6\nEnd\n";

std::vector<double> lengths_in(const BackgroundMesh& mesh) {
  std::vector<double> lengths;
  for (const LocalSize& s : mesh.node_size) lengths.push_back(s.length);
  return lengths;
}

TEST_F(MeditMeshes, medit_has_lengths_at_the_nodes_of_tetrahedra) {
  write("m.mesh", kMeditMesh);
  const std::string solution = write("m.sol", kMeditLengths);
  for (const std::string& file : {solution, dir_ / "m.mesh"}) {
    const BackgroundMesh mesh = read_size_mesh(file);
    ASSERT_EQ(mesh.tets.size(), 2u);
    EXPECT_TRUE(mesh.triangles.empty());                                          // the border of the tetrahedra
    EXPECT_EQ(lengths_in(mesh), (std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.6}));  // not that of the node without a cell
    EXPECT_EQ(mesh.tets[1], (std::array<std::int32_t, 4>{1, 2, 3, 4}));
    EXPECT_EQ(mesh.node_xyz[4], (Vec3{1, 1, 1}));
  }
  EXPECT_EQ(files_of_size_mesh(solution), (std::vector<std::string>{dir_ / "m.mesh", solution}));
}

TEST_F(MeditMeshes, medit_of_a_surface_has_triangles) {
  std::string text = kMeditMesh;
  text.erase(text.find("Tetrahedra"), text.find("Triangles") - text.find("Tetrahedra"));
  text.insert(text.find("End"), "Quadrilaterals\n1\n1 2 6 3 4\n");
  write("m.mesh", text);
  const BackgroundMesh mesh = read_size_mesh(write("m.sol", kMeditLengths));
  EXPECT_TRUE(mesh.tets.empty());
  EXPECT_EQ(mesh.triangles.size(), 3u);
}

TEST_F(MeditMeshes, medit_may_have_metrics_after_other_fields) {
  write("m.mesh", kMeditMesh);
  // a vector, a metric xx xy yy xz yz zz, a scalar
  std::string text = "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n6\n3 2 3 1\n";
  for (int n = 0; n < 6; ++n) text += "7 8 9  100 0 25 0 0 100  5\n";
  const BackgroundMesh mesh = read_size_mesh(write("m.sol", text + "End\n"));
  EXPECT_NEAR(mesh.node_size[0].length, 0.1, 1e-15);
  EXPECT_NEAR(mesh.node_size[0].along, 0.2, 1e-15);
  EXPECT_NEAR(std::abs(mesh.node_size[0].direction.y), 1, 1e-12);
}

/// As parallel adapters write fields of a flow and a metric together, and keywords over two lines.
std::string three_fields() {
  std::string text = "MeshVersionFormatted\n 2\n\nDimension\n 3\n\nSolAtVertices\n6\n3 1 2 3\n";
  for (int n = 0; n < 6; ++n) text += " 0.5 7 8 9 100 0 25 0 0 100\r\n";
  return text + "\nReferenceStrings\n3\n62 1 density\n62 2 velocity\n62 3 metric\n\nEnd\n";
}

TEST_F(MeditMeshes, a_field_of_medit_is_named_by_its_number) {
  write("m.mesh", kMeditMesh);
  const std::string solution = write("m.sol", three_fields());
  EXPECT_NEAR(read_size_mesh(solution).node_size[0].length, 0.5, 1e-15);
  EXPECT_NEAR(read_size_mesh(solution + ":1").node_size[0].length, 0.5, 1e-15);
  const BackgroundMesh metric = read_size_mesh(solution + ":3");
  ASSERT_EQ(metric.node_metric.size(), 5u);
  EXPECT_NEAR(metric.node_size[0].along, 0.2, 1e-15);
  EXPECT_NEAR(read_size_mesh(dir_ / "m.mesh:3").node_size[0].along, 0.2, 1e-15);
  EXPECT_ERROR(read_size_mesh(solution + ":2"), kInput, "m.sol: line 9: field 2 is a vector");
  EXPECT_ERROR(read_size_mesh(solution + ":4"), kInput, "has 3 fields; there is no number 4");
  EXPECT_ERROR(read_size_mesh(solution + ":0"), kInput, "fields of Medit have numbers from 1; '0' is none");
  EXPECT_ERROR(read_size_mesh(solution + ":metric"), kInput, "'metric' is none");
}

/// The forms of public files that docs/dev/foreign_sizes.md names, with other numbers.
TEST_F(MeditMeshes, files_as_three_programs_write_them_are_read) {
  const auto rows = [](const std::string& row, int n = 6) {
    std::string text;
    for (int i = 0; i < n; ++i) text += row + "\n";
    return text;
  };
  const std::string mesh = write("m.mesh", kMeditMesh);
  // MMG: a length at each node, blank lines
  const std::string mmg = "MeshVersionFormatted 2\n\nDimension 3\n\nSolAtVertices\n6\n1 1\n";
  EXPECT_EQ(lengths_in(read_size_mesh(write("m.sol", mmg + rows("0.25") + "\nEnd\n"))), std::vector<double>(5, 0.25));
  // ParMmg: keywords on lines of their own, a scalar, a vector and a metric
  const std::string parmmg = "MeshVersionFormatted\n 2\n\nDimension\n 3\n\nSolAtVertices\n6\n3 1 2 3\n";
  const BackgroundMesh third = read_size_mesh(
      mesh + ":" + write("phys.sol", parmmg + rows(" 0.25 0.5 0 0 100 0 25 0 0 100") + "\n\nEnd\n") + ":3");
  EXPECT_NEAR(third.node_size[0].length, 0.1, 1e-12);
  EXPECT_NEAR(std::abs(third.node_size[0].direction.y), 1, 1e-12);
  // the unstructured grid adaptation group: metrics of 16 digits, another name, no End
  const std::string zero = " 0.000000000000000e+00 ", hundred = "9.999999999999999e+01";
  const std::string group = "MeshVersionFormatted 2\n\nDimension 3\n\nSolAtVertices\n      6\n1 3\n\n" +
                            rows(hundred + zero + hundred + zero + zero + "9.000000000000000e+02");
  const BackgroundMesh flat = read_size_mesh(mesh + ":" + write("linear.sol", group));
  ASSERT_EQ(flat.node_metric.size(), 5u);
  EXPECT_NEAR(flat.node_metric[0][2], 900, 1e-9);  // zz
  EXPECT_NEAR(flat.node_size[0].length, 1.0 / 30, 1e-12);
}

TEST_F(MeditMeshes, a_solution_of_another_name_is_named_after_its_mesh) {
  const std::string mesh = write("m.mesh", kMeditMesh), solution = write("m-metric.sol", three_fields());
  EXPECT_ERROR(read_size_mesh(solution), kInput, "one of another name is given as MESH:SOLUTION");
  EXPECT_NEAR(read_size_mesh(mesh + ":" + solution).node_size[0].length, 0.5, 1e-15);
  EXPECT_NEAR(read_size_mesh(mesh + ":" + solution + ":3").node_size[0].along, 0.2, 1e-15);
  EXPECT_EQ(files_of_size_mesh(mesh + ":" + solution + ":3"), (std::vector<std::string>{mesh, solution}));
  EXPECT_TRUE(is_size_mesh(mesh + ":" + solution + ":3"));
}

TEST_F(MeditMeshes, values_at_tetrahedra_are_averaged_and_those_of_the_border_left_out) {
  write("m.mesh", kMeditMesh);
  const std::string head = "MeshVersionFormatted 1\nDimension 3\n", tets = "SolAtTetrahedra\n2\n1 1\n0.1\n0.3\n";
  for (const std::string& text : {head + tets, head + "SolAtTriangles\n1\n1 1\n9\n" + tets + "End\n"}) {
    const std::vector<double> lengths = lengths_in(read_size_mesh(write("m.sol", text)));
    ASSERT_EQ(lengths.size(), 5u);
    EXPECT_NEAR(lengths[0], 0.1, 1e-15);  // of the first cell alone
    EXPECT_NEAR(lengths[1], 0.2, 1e-15);  // of both
    EXPECT_NEAR(lengths[4], 0.3, 1e-15);  // of the second
  }
}

TEST_F(MeditMeshes, tensors_of_medit_have_their_components_in_rows_of_the_lower_triangle) {
  write("m.mesh", kMeditMesh);
  // along (1, 0, 1): xx = zz = 62.5, xz = -37.5, so 25 there, 100 across
  std::string text = "MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n6\n1 3\n";
  for (int n = 0; n < 6; ++n) text += "62.5 0 100 -37.5 0 62.5\n";
  const LocalSize size = read_size_mesh(write("m.sol", text)).node_size[0];
  EXPECT_NEAR(size.along, 0.2, 1e-12);
  EXPECT_NEAR(std::abs(dot(size.direction, normalized({1, 0, 1}))), 1, 1e-12);
}

/// The binary form, as libMeshb's page describes it.
class MeditBinary {
 public:
  explicit MeditBinary(std::int32_t version, bool is_swapped = false) : version_(version), is_swapped_(is_swapped) {
    put<std::int32_t>(1);
    put(version);
    begin(3);
    put<std::int32_t>(3);
    end();
  }
  void begin(std::int32_t keyword) {
    put(keyword);
    hole_ = bytes_.size();
    version_ >= 3 ? put<std::int64_t>(0) : put<std::int32_t>(0);
  }
  void end() {
    const std::string whole = bytes_;
    bytes_.clear();
    version_ >= 3 ? put(static_cast<std::int64_t>(whole.size())) : put(static_cast<std::int32_t>(whole.size()));
    bytes_ = std::string(whole).replace(hole_, bytes_.size(), bytes_);
  }
  void integer(std::int64_t value) { version_ >= 4 ? put(value) : put(static_cast<std::int32_t>(value)); }
  void small(std::int32_t value) { put(value); }
  void real(double value) { version_ == 1 ? put(static_cast<float>(value)) : put(value); }
  std::string done() {
    begin(54);
    return bytes_;
  }

 private:
  template <class T>
  void put(T value) {
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
    if (is_swapped_) std::reverse(bytes.begin(), bytes.end());
    bytes_ += bytes;
  }
  std::int32_t version_;
  bool is_swapped_;
  std::string bytes_;
  std::size_t hole_ = 0;
};

TEST_F(MeditMeshes, binary_medit_of_every_version_is_that_of_the_text) {
  write("t.mesh", kMeditMesh);
  const BackgroundMesh text = read_size_mesh(write("t.sol", kMeditLengths));
  for (const std::int32_t kind : {1, 2, 3, 4, -1, -2, -3, -4}) {  // below 0: written on a machine of another byte order
    const std::int32_t version = std::abs(kind);
    MeditBinary mesh(version, kind < 0), solution(version, kind < 0);
    mesh.begin(4);
    mesh.integer(6);
    for (const Vec3 x : {Vec3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {9, 9, 9}, {1, 1, 1}}) {
      mesh.real(x.x), mesh.real(x.y), mesh.real(x.z);
      mesh.integer(1);
    }
    mesh.end();
    mesh.begin(13);  // corners, which nobody asks for
    mesh.integer(1), mesh.integer(2);
    mesh.end();
    mesh.begin(8);
    mesh.integer(2);
    for (const int n : {1, 2, 3, 4, 5, 2, 3, 4, 6, 5}) mesh.integer(n);
    mesh.end();
    solution.begin(62);
    solution.integer(6), solution.small(1), solution.small(1);
    for (const double h : {0.1, 0.2, 0.3, 0.4, 0.0, 0.6}) solution.real(h);
    solution.end();
    write("b.meshb", mesh.done());
    const BackgroundMesh binary = read_size_mesh(write("b.solb", solution.done()));
    EXPECT_EQ(binary.node_xyz, text.node_xyz) << kind;
    EXPECT_EQ(binary.tets, text.tets) << kind;
    ASSERT_EQ(binary.node_size.size(), text.node_size.size()) << kind;
    for (std::size_t i = 0; i < text.node_size.size(); ++i)
      EXPECT_NEAR(binary.node_size[i].length, text.node_size[i].length, 1e-7) << kind;
  }
}

TEST_F(MeditMeshes, bad_metrics_and_missing_partners_are_named) {
  EXPECT_ERROR(read_size_mesh(write("m.sol", kMeditLengths)), kInput, "m.sol: has no mesh beside it: ");
  EXPECT_ERROR(read_size_mesh(write("n.mesh", kMeditMesh)), kInput, "n.mesh: has no solution beside it: ");
  write("m.mesh", kMeditMesh);
  std::string text = kMeditLengths;
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    return changed.replace(changed.find(from), from.size(), to);
  };
  const auto expect = [&](const std::string& from, const std::string& to, const std::string& says) {
    EXPECT_ERROR(read_size_mesh(write("m.sol", with(from, to))), kInput, says);
  };
  expect("0.3", "-0.3", "1 of 6 nodes have no length above 0, the first is node 2 at (0 1 0)");
  expect("0.3", "nan", "1 of 6 nodes have no length above 0, the first is node 2 at (0 1 0)");
  expect("0.3", "x", "m.sol: line 8: 'x' is no number");
  expect("\n6\n", "\n5\n", "has values for 5 nodes, the mesh 6");
  expect("1 1\n", "1 2\n", "has vectors alone");
  expect("Dimension 3", "Dimension 2", "has 2 dimensions");
  expect("SolAtVertices", "SolAtEdges", "has neither SolAtVertices nor values at cells");
  expect("SolAtVertices\n6", "SolAtTetrahedra\n3", "has values for 3 cells, the mesh 2");
  expect("SolAtVertices\n6", "SolAtTriangles\n1", "has values neither at vertices nor at the 2 cells of VTK's type 10");
  expect("0.4\n0\n0.6\nEnd\n", "", "cut off");
  text = kMeditMesh;
  write("m.sol", kMeditLengths);
  const auto expect_mesh = [&](const std::string& from, const std::string& to, const std::string& says) {
    EXPECT_ERROR(read_size_mesh(write("m.mesh", with(from, to))), kInput, says);
  };
  expect_mesh("1 2 3 4 5", "1 2 3 9 5", "cell 0 names a node that does not exist");
  expect_mesh("Tetrahedra\n2", "Tetrahedra\n2000000000", "cut off");
  expect_mesh("MeshVersionFormatted", "Mesh", "no file of Medit");
}

}  // namespace
}  // namespace st
