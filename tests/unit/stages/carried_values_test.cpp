#include "stages/carried_values.h"

#include <gtest/gtest.h>

#include <fstream>

#include "unit/io/temporary_directory.h"

namespace st {
namespace {

std::string write_values(const TemporaryDirectory& dir) {
  std::ofstream out(dir / "v.vtu");
  out << "<VTKFile type=\"UnstructuredGrid\"><PointData>"
         "<DataArray type=\"Float64\" Name=\"p\" format=\"ascii\">1 2 3</DataArray>"
         "<DataArray type=\"Float64\" Name=\"u\" NumberOfComponents=\"2\" format=\"ascii\">1 2 3 4 5 6</DataArray>"
         "<DataArray type=\"Float64\" Name=\"size\" format=\"ascii\">1 2 3</DataArray>"
         "<DataArray type=\"Float64\" Name=\"bad\" format=\"ascii\">1 nan 3</DataArray>"
         "</PointData></VTKFile>";
  return dir / "v.vtu";
}

TEST(CarriedValues, are_read_with_their_components_in_the_order_of_the_mesh) {
  const TemporaryDirectory dir;
  const std::string file = write_values(dir);
  EXPECT_TRUE(read_carried_values("", 3, {}).empty());
  const auto arrays = read_carried_values(file + ":p,u", 3, {});
  ASSERT_EQ(arrays.size(), 2u);
  EXPECT_EQ(arrays[0].name, "p");
  EXPECT_EQ(arrays[1].n_components, 2u);
  EXPECT_EQ(arrays[1].values, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  const auto turned = read_carried_values(file + ":u", 3, std::vector<NodeId>{2, 0});
  EXPECT_EQ(turned[0].values, (std::vector<double>{5, 6, 1, 2}));
}

TEST(CarriedValues, that_cannot_be_are_refused) {
  const TemporaryDirectory dir;
  const std::string file = write_values(dir);
  EXPECT_ERROR(read_carried_values(file, 3, {}), kUsage, "FILE:ARRAY");
  EXPECT_ERROR(read_carried_values(file + ":size", 3, {}), kUsage, "'size'");
  EXPECT_ERROR(read_carried_values(file + ":p,p", 3, {}), kUsage, "twice");
  EXPECT_ERROR(read_carried_values(file + ":p", 2, {}), kInput, "3 values");
  EXPECT_ERROR(read_carried_values(file + ":bad", 3, {}), kInput, "nan at node 1");
  EXPECT_ERROR(read_carried_values(file + ":none", 3, {}), kInput, "none");
}

}  // namespace
}  // namespace st
