// That the CGNS library reads such files is tested in tests/foreign.
#include "io/hdf5/cgns_tree.h"

#include <gtest/gtest.h>

#include "unit/io/temporary_directory.h"

namespace st {
namespace {

std::string small_tree(double value) {
  CgnsTree tree;
  const CgnsTree::Node base = tree.add_integers(tree.root(), "Base", "CGNSBase_t", {2, 3});
  tree.add_text(base, "Flügel", "Descriptor_t", "text");
  tree.add_reals(tree.add(base, "Grid", "GridCoordinates_t"), "X", "DataArray_t", {value, 2});
  return tree.bytes();
}

TEST(CgnsTree, is_an_hdf5_file_of_equal_bytes_for_equal_nodes) {
  EXPECT_EQ(small_tree(1).substr(1, 3), "HDF");
  EXPECT_EQ(small_tree(1), small_tree(1));
  EXPECT_NE(small_tree(1), small_tree(3));
}

TEST(CgnsTree, says_that_single_reals_are_such) {
  const auto bytes_with = [](bool is_single) {
    CgnsTree tree;
    if (is_single)
      tree.add_single_reals(tree.root(), "X", "DataArray_t", {1, 2});
    else
      tree.add_reals(tree.root(), "X", "DataArray_t", {1, 2});
    return tree.bytes();
  };
  EXPECT_EQ(bytes_with(true).find("R8"), std::string::npos);
  EXPECT_NE(bytes_with(false).find("R8"), std::string::npos);
}

TEST(CgnsTree, refuses_two_siblings_of_one_name) {
  CgnsTree tree;
  tree.add(tree.root(), "Base", "CGNSBase_t");
  EXPECT_ERROR(tree.add(tree.root(), "Base", "CGNSBase_t"), kInternal, "HDF5 cannot write Base of a CGNS file");
}

}  // namespace
}  // namespace st
