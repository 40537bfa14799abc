// Triangulations of other programs: every format gives the same mesh, every damage a message.
#include "io/foreign/triangulation_reader.h"
#include "io/export/export.h"
#include "io/foreign/triangulation_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <functional>

#include "base/error.h"
#include "io/hdf5/artifact.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

const std::vector<Vec3> kNodes{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::vector<std::array<int, 3>> kTriangles{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
const std::vector<int> kSurface{7, 7, 3, 3};

template <class T>
void put(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string text(double x) { return std::to_string(x).append(1, ' '); }

std::string ascii_stl() {
  std::string s = "solid s\n";
  for (const auto& t : kTriangles) {
    s += "facet normal 0 0 0\nouter loop\n";
    for (const int n : t) s += "vertex " + text(kNodes[n].x) + text(kNodes[n].y) + text(kNodes[n].z) + "\n";
    s += "endloop\nendfacet\n";
  }
  return s + "endsolid s\n";
}

std::string binary_stl() {
  std::string s(80, '\0');
  put(s, static_cast<std::uint32_t>(kTriangles.size()));
  for (const auto& t : kTriangles) {
    for (int k = 0; k < 3; ++k) put(s, 0.0f);
    for (const int n : t)
      for (const double x : {kNodes[n].x, kNodes[n].y, kNodes[n].z}) put(s, static_cast<float>(x));
    put(s, std::uint16_t{0});
  }
  return s;
}

/// Nodes are numbered 5, 10, 15, 20; a point and a line come first.
std::string text_msh2() {
  std::string s =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"$Nodes\"\n$EndPhysicalNames\n$Nodes\n4\n";
  for (int n = 0; n < 4; ++n)
    s += std::to_string(5 * (n + 1)) + " " + text(kNodes[n].x) + text(kNodes[n].y) + text(kNodes[n].z) + "\n";
  s += "$EndNodes\n$Elements\n6\n1 15 2 0 1 5\n2 1 2 0 1 5 10\n";
  for (int t = 0; t < 4; ++t) {
    s += std::to_string(t + 3) + " 2 2 0 " + std::to_string(kSurface[t]);
    for (const int n : kTriangles[t]) s.append(1, ' ').append(std::to_string(5 * (n + 1)));
    s += "\n";
  }
  return s + "$EndElements\n";
}

std::string binary_msh2() {
  std::string s = "$MeshFormat\n2.2 1 8\n";
  put(s, std::int32_t{1});
  s += "\n$EndMeshFormat\n$Nodes\n4\n";
  for (int n = 0; n < 4; ++n) {
    put(s, std::int32_t{n + 1});
    for (const double x : {kNodes[n].x, kNodes[n].y, kNodes[n].z}) put(s, x);
  }
  s += "\n$EndNodes\n$Elements\n4\n";
  for (const std::int32_t i : {2, 4, 2}) put(s, i);
  for (int t = 0; t < 4; ++t) {
    for (const std::int32_t i : {t + 1, 0, kSurface[t]}) put(s, i);
    for (const int n : kTriangles[t]) put(s, std::int32_t{n + 1});
  }
  return s + "\n$EndElements\n";
}

std::string text_msh4() {
  std::string s = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n2 4 1 4\n0 1 0 1\n1\n" + text(0) + text(0) + text(0) +
                  "\n2 7 1 3\n2\n3\n4\n";
  for (int n = 1; n < 4; ++n) s += text(kNodes[n].x) + text(kNodes[n].y) + text(kNodes[n].z) + "0.5 0.5\n";
  s += "$EndNodes\n$Elements\n3 5 1 5\n0 1 15 1\n1 1\n";
  for (int b = 0; b < 2; ++b) {
    s.append("2 ").append(std::to_string(kSurface[2 * b])).append(" 2 2\n");
    for (int t = 2 * b; t < 2 * b + 2; ++t) {
      s += std::to_string(t + 2);
      for (const int n : kTriangles[t]) s.append(1, ' ').append(std::to_string(n + 1));
      s += "\n";
    }
  }
  return s + "$EndElements\n";
}

std::string fro() {
  std::string s = "  4 4 1 0 0 2 0 0\n";
  for (int n = 0; n < 4; ++n)
    s += std::to_string(n + 1) + " " + text(kNodes[n].x) + text(kNodes[n].y) + " " + std::to_string(kNodes[n].z) +
         "D+00 0 0\n";
  for (int t = 0; t < 4; ++t) {
    s += std::to_string(t + 1);
    for (const int n : kTriangles[t]) s.append(1, ' ').append(std::to_string(n + 1));
    s.append(1, ' ').append(std::to_string(kSurface[t])).append(1, '\n');
  }
  return s;
}

std::string ascii_vtu() {
  std::string s =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
      "byte_order=\"LittleEndian\"><UnstructuredGrid>\n";
  s += "<Piece NumberOfPoints=\"4\" NumberOfCells=\"4\"><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" "
       "format=\"ascii\">\n";
  for (const Vec3 x : kNodes) s += text(x.x) + text(x.y) + text(x.z);
  s += "</DataArray></Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">";
  for (const auto& t : kTriangles)
    for (const int n : t) s += std::to_string(n) + " ";
  s += "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3 6 9 12</DataArray>";
  s += "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5 5 5 5</DataArray></Cells>";
  s += "<CellData><DataArray type=\"Int32\" Name=\"face\" format=\"ascii\">7 7 3 3</DataArray></CellData>";
  return s + "</Piece></UnstructuredGrid></VTKFile>\n";
}

struct Sample {
  const char* name;
  std::string bytes;
  bool has_surfaces;
};
std::vector<Sample> samples() {
  return {{"ascii.stl", ascii_stl(), false},    {"binary.stl", binary_stl(), false}, {"text2.msh", text_msh2(), true},
          {"binary2.msh", binary_msh2(), true}, {"text4.msh", text_msh4(), true},    {"a.fro", fro(), true},
          {"ascii.vtu", ascii_vtu(), true}};
}

class TriangulationReader : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& bytes) {
    std::ofstream(dir_ / name, std::ios::binary) << bytes;
    return dir_ / name;
  }
  /// Message of the Error(kInput) that reading must end with.
  std::string message(const std::string& bytes) {
    try {
      read_triangulation(write("bad", bytes));
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::kInput);
      return e.what();
    }
    return "no error";
  }
  void expect_message(const std::string& bytes, const std::string& part) {
    const std::string said = message(bytes);
    EXPECT_NE(said.find(part), std::string::npos) << said;
  }
  TemporaryDirectory dir_;
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST_F(TriangulationReader, reads_the_same_mesh_from_every_format_whatever_the_suffix) {
  for (const Sample& sample : samples()) {
    const SurfaceMesh m = read_triangulation(write("mesh.dat", sample.bytes));
    ASSERT_EQ(m.n_triangles(), 4) << sample.name;
    ASSERT_EQ(m.n_nodes(), 4) << sample.name;
    for (int t = 0; t < 4; ++t)
      for (int k = 0; k < 3; ++k)
        EXPECT_TRUE(m.node_xyz[m.triangles[t].n[k]] == kNodes[kTriangles[t][k]]) << sample.name;
    const std::vector<FaceId> face = sample.has_surfaces ? std::vector<FaceId>{1, 1, 0, 0} : std::vector<FaceId>(4, 0);
    EXPECT_EQ(m.triangle_face, face) << sample.name;
    EXPECT_EQ(m.corner_uv.size(), 12u);
    EXPECT_TRUE(is_foreign_mesh(dir_ / "mesh.dat"));
    EXPECT_FALSE(triangulation_format(dir_ / "mesh.dat").empty());
  }
}

TEST_F(TriangulationReader, refuses_cuts_of_every_format) {
  for (const Sample& sample : samples())
    for (std::size_t n = 0; n + 3 < sample.bytes.size(); n += 7)  // the last characters may be blanks and a name
      EXPECT_NE(message(sample.bytes.substr(0, n)), "no error") << sample.name << " of " << n << " bytes";
}

TEST_F(TriangulationReader, survives_flipped_bits) {
  for (const Sample& sample : samples())
    for (std::size_t i = 0; i < sample.bytes.size(); i += 11) {
      std::string bytes = sample.bytes;
      bytes[i] = static_cast<char>(bytes[i] ^ (1 << (i % 8)));
      message(bytes);  // an error or another mesh
    }
}

TEST_F(TriangulationReader, says_what_is_wrong_and_where) {
  expect_message("nothing of use\n", "give STL, Gmsh MSH 2.2 or 4.1, VTU, .fro");
  expect_message(replaced(text_msh2(), "3 2 2 0 7 5 15 10", "3 2 2 0 7 5 15 11"), "node 11");
  expect_message(replaced(text_msh2(), "3 2 2 0 7 5 15 10", "3 3 2 0 7 5 15 10 20"), "quadrangles");
  expect_message(replaced(text_msh2(), "5 0.000000", "5 nan"), "node 1 are not finite");
  expect_message(replaced(text_msh2(), "5 0.000000", "5 zero"), "line 10: 'zero' is no number");
  expect_message(replaced(text_msh2(), "2.2 0 8", "1.0 0 8"), "only MSH 2.2 and 4.1");
  expect_message(replaced(fro(), "1 1 3 2 7", "1 1 3 9 7"), "triangle 1 names node 9 of 4");
  expect_message(replaced(fro(), "4 4 1", "4000000 4 1"), "it should have 4000000 triangles, more than there is room");
  expect_message(replaced(fro(), "4 4 1", "0 4 1"), "no triangles in it");
  expect_message(replaced(fro(), "  4 4 1", " 1 4 4 1"), "has 1 quadrangles");
  expect_message(replaced(fro(), "\n2 ", "\n3 "), "the nodes are not numbered");
  expect_message(replaced(fro(), "1 1 3 2 7", "7 1 3 2 7"), "the triangles are not numbered");
  expect_message(text_msh2().substr(0, text_msh2().find("\n$Nodes") + 1), "there is no $Nodes section");
  expect_message(text_msh2().substr(0, text_msh2().find("\n$Elements") + 1), "there is no $Elements section");
  expect_message(replaced(ascii_vtu(), "5 5 5 5", "5 5 9 5"), "cell 2 is no triangle");
  expect_message(replaced(ascii_vtu(), "0 2 1 ", "0 2 4 "), "triangle 1 names node 5 of 4");
  expect_message(replaced(ascii_vtu(), "UnstructuredGrid", "PolyData"), "PolyData");
  expect_message(binary_stl().substr(0, 100), "cut off: a binary STL file");
  EXPECT_ERROR(read_triangulation(write("m.stl", binary_stl() + std::string(50, '-'))), kInput,
               "damaged: a binary STL file of this many triangles has 284 bytes, this one 334; write it again");
  EXPECT_ERROR(parse_fro("a.fro", "4\n"), kInput, "begins with the numbers of triangles and nodes");
}

TEST_F(TriangulationReader, passes_byte_order_marks_and_what_stands_behind_a_binary_stl_file) {
  EXPECT_EQ(read_triangulation(write("m.msh", "\xef\xbb\xbf" + text_msh2())).n_triangles(), 4);
  EXPECT_EQ(read_triangulation(write("m.stl", binary_stl() + "\r\n")).n_triangles(), 4);
}

TEST_F(TriangulationReader, says_why_a_path_is_no_file_to_read) {
  EXPECT_ERROR(read_triangulation(dir_.path()), kInput, "is a directory; name a file");
  EXPECT_ERROR(read_triangulation(dir_ / "none"), kInput, "no such file; check the path");
  EXPECT_ERROR(read_triangulation(write("empty", "")), kInput, "empty, or it cannot be read");
}

TEST_F(TriangulationReader, tells_each_damage_of_a_gmsh_text_from_the_others) {
  const char *const node = "\n$Nodes\n4\n", *const triangle = "3 2 2 0 7";
  expect_message(replaced(text_msh2(), "2.2 0 8", "2.2 0 4"), "only 8 bytes per number are read");
  expect_message(replaced(text_msh2(), "$EndNodes\n", "$EndNodes\nrubbish\n"), "'rubbish' is no section");
  expect_message(replaced(text_msh2(), "$EndNodes\n", "$EndOfThem\n"), "cut off: $EndNodes is missing");
  expect_message(replaced(text_msh2(), node, "\n$Nodes\n-4\n"), "a negative number of nodes");
  expect_message(replaced(text_msh2(), node, "\n$Nodes\n4000\n"), "should have 4000 nodes, more than there is room");
  expect_message(replaced(text_msh2(), "\n10 ", "\n5 "), "has two nodes of the number 5");
  expect_message(replaced(text_msh2(), triangle, "3 two 2 0 7"), "'two' is no integer");
  expect_message(replaced(text_msh2(), triangle, "3 99 2 0 7"), "elements of the unknown type 99");
  expect_message(replaced(text_msh2(), triangle, "3 2 -1 0 7"), "an element has -1 tags");
  expect_message(replaced(text_msh2(), triangle, "3 2 1001 0 7"), "an element has 1001 tags");
}

TEST_F(TriangulationReader, tells_each_damage_of_a_binary_gmsh_file_from_the_others) {
  const auto integers = [](const std::vector<std::int32_t>& values) {
    std::string bytes;
    for (const std::int32_t value : values) put(bytes, value);
    return bytes;
  };
  const std::string good = binary_msh2(), block = integers({2, 4, 2});
  expect_message(replaced(good, integers({1}) + "\n$End", integers({1 << 24}) + "\n$End"), "of another byte order");
  for (const std::int32_t n : {0, 5})
    expect_message(replaced(good, block, integers({2, n, 2})), "another number of them than announced");
  expect_message(good.substr(0, good.rfind("\n$EndElements") - 4), "cut off: the file ends inside its data");
}

TEST_F(TriangulationReader, tells_each_damage_of_a_vtu_text_from_the_others) {
  const char *const head = "<UnstructuredGrid>", *const types = "5 5 5 5", *const offsets = "3 6 9 12";
  const std::string good = ascii_vtu(), piece = "<Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"></Piece>";
  expect_message(replaced(good, "<Piece", "<Peace"), "there is no piece of a mesh in it");
  expect_message(replaced(good, head, head + piece), "has several pieces");
  expect_message(replaced(good, "Points=\"4\"", "Points=\"four\""), "NumberOfPoints 'four' is no number of them");
  expect_message(replaced(good, "Cells=\"4\"", "Cells=\"3000000000\""), "Cells '3000000000' is no number of them");
  expect_message(replaced(good, offsets, "3 6 9"), "array 'offsets' has 3 values instead of 4");
  expect_message(replaced(good, offsets, "3 7 9 12"), "cell 1 has offsets that do not fit");
  expect_message(replaced(replaced(good, types, "1 5 5 5"), offsets, "99 102 9 12"), "cell 1 has offsets that do not");
  expect_message(replaced(good, "ascii\">3 6", "hexadecimal\">3 6"), "array 'offsets' is written as 'hexadecimal'");
  for (const char* const value : {"1.5", "nan", "-1e300"})
    expect_message(replaced(good, "ascii\">0 2", std::string("ascii\">").append(value).append(" 2")),
                   "array 'connectivity' has the value");
  for (const char* const length : {"-1", "inf", "nan"}) {
    const std::string sizes = std::string("Name=\"size\" format=\"ascii\">1 ") + length + " 1 1</DataArray>";
    expect_message(replaced(good, "<CellData>", "<PointData><DataArray " + sizes + "</PointData><CellData>"),
                   "the length (point data 'size') of node 2 is not positive and finite");
  }
}

TEST_F(TriangulationReader, reads_numbers_written_as_text_whatever_the_head_says_of_bytes) {
  for (const char* const head : {"byte_order=\"BigEndian\"", "compressor=\"vtkLZ4DataCompressor\""}) {
    const std::string vtu = replaced(ascii_vtu(), "byte_order=\"LittleEndian\"", head);
    EXPECT_EQ(read_triangulation(write("text.vtu", vtu)).n_triangles(), 4) << head;
  }
}

TEST_F(TriangulationReader, leaves_artifacts_and_missing_files_to_their_own_reader) {
  EXPECT_FALSE(is_foreign_mesh(dir_ / "none"));
  EXPECT_FALSE(is_foreign_mesh(dir_ / "."));
  MeshArtifact artifact;
  artifact.mesh = read_triangulation(write("a.fro", fro()));
  write_mesh(dir_ / "mesh.hdf", artifact);
  EXPECT_FALSE(is_foreign_mesh(dir_ / "mesh.hdf"));
  EXPECT_EQ(read_triangulation(dir_ / "mesh.hdf").n_triangles(), 4);
}

TEST_F(TriangulationReader, reads_what_is_exported) {
  MeshArtifact artifact;
  artifact.mesh = read_triangulation(write("a.fro", fro()));
  artifact.mesh.node_size = {1, 2, 3, 4};
  export_mesh(dir_ / "m.vtu", artifact.mesh);
  const SurfaceMesh m = read_triangulation(dir_ / "m.vtu");
  EXPECT_EQ(m.node_size, artifact.mesh.node_size);
  EXPECT_EQ(m.triangle_face, artifact.mesh.triangle_face);
  EXPECT_TRUE(std::equal(m.node_xyz.begin(), m.node_xyz.end(), artifact.mesh.node_xyz.begin()));
  std::ifstream file(dir_ / "m.vtu", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  for (std::size_t n = 0; n + 40 < bytes.size(); n += 29) message(bytes.substr(0, n));
}

}  // namespace
}  // namespace st
