#include "io/foreign/size_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/error.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

class SizeMeshes : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(dir_ / name, std::ios::binary) << text;
    return dir_ / name;
  }
  TemporaryDirectory dir_;
};

std::string vtu_of(const std::string& data, int n_components) {
  return R"(<?xml version="1.0"?><VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">
<UnstructuredGrid><Piece NumberOfPoints="8" NumberOfCells="2"><PointData>
<DataArray type="Float64" Name="other" format="ascii">0 0 0 0 0 0 0 0</DataArray>
<DataArray type="Float64" Name="metric" NumberOfComponents=")" +
         std::to_string(n_components) + R"(" format="ascii">)" + data + R"(</DataArray></PointData><Points>
<DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3 4 5 6 7 0 1 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">8 12</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">12 9</DataArray></Cells>
</Piece></UnstructuredGrid></VTKFile>)";
}

TEST_F(SizeMeshes, vtu_has_cells_of_all_kinds_and_an_array_by_name) {
  std::string metrics;
  for (int n = 0; n < 8; ++n) metrics += "100 25 100 0 0 0 ";
  const std::string file = write("m.vtu", vtu_of(metrics, 6));
  for (const char* array : {"", ":metric"}) {
    const BackgroundMesh mesh = read_size_mesh(file + array);
    EXPECT_GE(mesh.tets.size(), 5u);
    EXPECT_LE(mesh.tets.size(), 6u);
    EXPECT_NEAR(mesh.node_size[0].along, 0.2, 1e-15);
    EXPECT_NEAR(std::abs(mesh.node_size[0].direction.y), 1, 1e-12);
  }
  EXPECT_ERROR(read_size_mesh(file + ":other"), kInput, "8 of 8 nodes have no length above 0, the first is node 0");
  EXPECT_ERROR(read_size_mesh(file + ":none"), kInput, "m.vtu: has no array 'none'");
  EXPECT_ERROR(read_size_mesh(write("v.vtu", vtu_of("1 2 3 1 2 3 1 2 3 1 2 3 1 2 3 1", 2))), kInput,
               "16 values for 8 nodes");
}

}  // namespace
}  // namespace st
