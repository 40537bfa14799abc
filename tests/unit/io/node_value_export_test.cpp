// That meshio, VTK and the CGNS library read such values is tested in tests/foreign.
#include "io/export/node_value_export.h"

#include <gtest/gtest.h>

#include "io/foreign/cell_file.h"
#include "io/hdf5/hdf5_handles.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

const std::vector<NodeValues> kValues = {
    {"p", 1, {4, 3, 2, 0.1}}, {"U", 3, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}}, {"a\"b", 2, {1, 2, 3, 4, 5, 6, 7, 8}}};

class NodeValueExport : public testing::Test {
 protected:
  std::string written(const std::string& name, const MidNodes& mid = {}) {
    export_mesh(dir_ / name, {mesh_, all_triangles(mesh_), mid, {}, kValues}, {});
    return read_bytes(dir_ / name);
  }
  TemporaryDirectory dir_;
  SurfaceMesh mesh_ = sample_mesh().mesh;
};

TEST_F(NodeValueExport, gives_gmsh_a_view_for_each_array_and_for_each_number_of_others) {
  for (const char* name : {"m.msh", "m.binary.msh", "m.msh2", "m.binary.msh2"}) {
    const std::string bytes = written(name);
    EXPECT_EQ(parse_msh_cells(name, bytes, "p").value, kValues[0].values) << name;
    EXPECT_EQ(parse_msh_cells(name, bytes, "a'b_1").value, (std::vector<double>{1, 3, 5, 7})) << name;
    EXPECT_EQ(parse_msh_cells(name, bytes, "a'b_2").value, (std::vector<double>{2, 4, 6, 8})) << name;
  }
  EXPECT_NE(written("m.msh").find("$NodeData\n1\n\"U\"\n1\n0\n3\n0\n3\n4\n1 1 2 3\n2 4 5 6\n"), std::string::npos);
}

TEST_F(NodeValueExport, gives_nodes_on_sides_the_mean_of_the_ends) {
  MidNodes mid;
  mid.ends = {{0, 1}, {2, 3}};
  const QuadPairs elements;
  const ExportOptions options;
  const ExportTask task{mesh_, elements, mid, options, {}, {}, ""};
  EXPECT_EQ(values_at_nodes(kValues[0], task), (std::vector<double>{4, 3, 2, 0.1, 3.5, 1.05}));
  EXPECT_EQ(values_at_nodes(kValues[2], task), (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 2, 3, 6, 7}));
}

TEST_F(NodeValueExport, has_a_line_of_csv_for_each_node) {
  const std::string text = written("m.csv");
  EXPECT_EQ(text.substr(0, text.find("\n2,")),
            "node,x,y,z,\"p\",\"U_1\",\"U_2\",\"U_3\",\"a'b_1\",\"a'b_2\"\n0,0,0,0,4,1,2,3,1,2\n1,1,0,0,3,4,5,6,3,4");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 5);
}

TEST_F(NodeValueExport, names_vectors_of_cgns_by_their_axes) {
  written("m.cgns");
  const File file = open_hdf5(dir_ / "m.cgns");
  const auto read = [&](const std::string& name) {
    std::vector<double> values(4);
    const Dataset set = H5Dopen2(file, ("/Base/Zone/NodeValues/" + name + "/ data").c_str(), H5P_DEFAULT);
    EXPECT_GE(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0) << name;
    return values;
  };
  EXPECT_EQ(read("p"), kValues[0].values);
  EXPECT_EQ(read("UX"), (std::vector<double>{1, 4, 7, 10}));
  EXPECT_EQ(read("UZ"), (std::vector<double>{3, 6, 9, 12}));
  EXPECT_EQ(read("a'b_2"), (std::vector<double>{2, 4, 6, 8}));
}

TEST_F(NodeValueExport, leaves_files_as_they_were_without_values) {
  for (const char* name : {"m.msh", "m.cgns"}) {
    export_mesh(dir_ / name, mesh_);
    const std::string bytes = read_bytes(dir_ / name);
    EXPECT_EQ(bytes.find("NodeData"), std::string::npos) << name;
    EXPECT_EQ(bytes.find("NodeValues"), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace st
