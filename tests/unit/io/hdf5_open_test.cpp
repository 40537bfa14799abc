// What leads out of an HDF5 file or asks for code from elsewhere is refused.
#include "io/hdf5/hdf5_open.h"

#include <gtest/gtest.h>

#include <functional>
#include <tuple>
#include <vector>

#include "io/foreign/node_array.h"
#include "io/hdf5/hdf5_file.h"
#include "unit/io/sample_artifacts.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

/// An HDF5 file that `fill` makes.
std::string make(const std::string& path, const std::function<void(hid_t)>& fill) {
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  fill(file);
  H5Fclose(file);
  return path;
}

/// Ten doubles, stored as `creation` says.
void add_dataset(hid_t file, const char* name, hid_t creation = H5P_DEFAULT) {
  const hsize_t n = 10;
  const std::vector<double> values(n, 1.5);
  const hid_t space = H5Screate_simple(1, &n, nullptr);
  const hid_t dataset = H5Dcreate2(file, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  ASSERT_GE(dataset, 0);
  H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Dclose(dataset);
  H5Sclose(space);
}

hid_t chunked() {
  const hsize_t chunk = 5;
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_chunk(creation, 1, &chunk);
  return creation;
}

struct Case {
  const char* says;
  std::function<void(hid_t)> fill;
};

const std::vector<Case>& leading_out() {
  static const std::vector<Case> cases = {
      {"/out is a link to another file",
       [](hid_t f) { H5Lcreate_external("other.hdf", "/lengths", f, "out", H5P_DEFAULT, H5P_DEFAULT); }},
      {"/raw is stored in another file",
       [](hid_t f) {
         const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
         H5Pset_external(creation, "/dev/zero", 0, 80);
         add_dataset(f, "raw", creation);
       }},
      {"/virtual is put together from other files",
       [](hid_t f) {
         const hsize_t n = 10;
         const hid_t space = H5Screate_simple(1, &n, nullptr), creation = H5Pcreate(H5P_DATASET_CREATE);
         H5Pset_virtual(creation, space, "other.hdf", "/lengths", space);
         H5Dclose(H5Dcreate2(f, "virtual", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, creation, H5P_DEFAULT));
       }},
      {"/filtered is stored with filter 32000",
       [](hid_t f) {
         const hid_t creation = chunked();
         H5Pset_filter(creation, 32000, H5Z_FLAG_OPTIONAL, 0, nullptr);
         add_dataset(f, "filtered", creation);
       }},
      {"lies too deep", [](hid_t f) {
         const hid_t creation = H5Pcreate(H5P_LINK_CREATE);
         H5Pset_create_intermediate_group(creation, 1);
         std::string name;
         for (int i = 0; i < 50; ++i) name += "/a";
         H5Gclose(H5Gcreate2(f, name.c_str(), creation, H5P_DEFAULT, H5P_DEFAULT));
       }}};
  return cases;
}

TEST(Hdf5Open, refuses_foreign_files_that_lead_elsewhere) {
  const TemporaryDirectory dir;
  for (const Case& c : leading_out()) {
    const std::string path = make(dir / "f.hdf", [&](hid_t file) {
      add_dataset(file, "lengths");
      c.fill(file);
    });
    EXPECT_ERROR(read_node_lengths(path, "/lengths", 10), kInput, c.says);
  }
}

TEST(Hdf5Open, takes_foreign_files_with_chunks_own_filters_and_links_in_a_circle) {
  const TemporaryDirectory dir;
  const std::string path = make(dir / "f.hdf", [](hid_t file) {
    const hid_t creation = chunked();
    H5Pset_shuffle(creation);
    H5Pset_deflate(creation, 9);
    add_dataset(file, "lengths", creation);
    H5Lcreate_soft("/lengths", file, "soft", H5P_DEFAULT, H5P_DEFAULT);
    H5Lcreate_hard(file, "/", file, "circle", H5P_DEFAULT, H5P_DEFAULT);
  });
  EXPECT_EQ(read_node_lengths(path, "/soft", 10), std::vector<double>(10, 1.5));
  EXPECT_EQ(read_node_lengths(path, "/circle/circle/lengths", 10), std::vector<double>(10, 1.5));
}

TEST(Hdf5Open, refuses_artifacts_that_are_not_plain) {
  const TemporaryDirectory dir;
  const std::vector<Case> cases = {
      leading_out()[0],
      leading_out()[1],
      leading_out()[2],
      {"/chunks is not stored in one piece", [](hid_t f) { add_dataset(f, "chunks", chunked()); }},
      {"/soft is a link to another name", [](hid_t f) { H5Lcreate_soft("/st", f, "soft", H5P_DEFAULT, H5P_DEFAULT); }},
      {"has more than 10000 parts", [](hid_t f) {
         H5Gclose(H5Gcreate2(f, "/st/empty", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
         for (int i = 0; i <= 5000; ++i) {
           H5Lcreate_hard(f, "/st/empty", f, ("/n" + std::to_string(i)).c_str(), H5P_DEFAULT, H5P_DEFAULT);
           H5Lcreate_hard(f, "/st/empty", f, ("/st/n" + std::to_string(i)).c_str(), H5P_DEFAULT, H5P_DEFAULT);
         }
       }}};
  for (const Case& c : cases) {
    const std::string path = dir / "a.hdf";
    Hdf5Writer(path, sample_header()).commit();
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    c.fill(file);
    H5Fclose(file);
    EXPECT_ERROR(Hdf5Reader{path}, kInput, c.says);
  }
}

TEST(Hdf5Open, refuses_foreign_files_with_too_many_objects) {
  const TemporaryDirectory dir;
  const std::string path = make(dir / "f.hdf", [](hid_t file) {
    add_dataset(file, "lengths");
    for (const char* group : {"/a", "/b"}) {
      H5Gclose(H5Gcreate2(file, group, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
      for (int i = 0; i < 5000; ++i)
        H5Lcreate_hard(file, "/lengths", file, (group + ("/n" + std::to_string(i))).c_str(), H5P_DEFAULT, H5P_DEFAULT);
    }
  });
  EXPECT_ERROR(read_node_lengths(path, "/lengths", 10), kInput, "is one of more than 10000 objects");
}

/// In the oldest form of HDF5, which has no checksums.
TEST(Hdf5Open, refuses_foreign_files_of_which_a_part_is_damaged) {
  const TemporaryDirectory dir;
  std::size_t header = 0;
  const std::string good = make(dir / "good.hdf", [&](hid_t file) {
    add_dataset(file, "lengths");
    H5O_info_t info{};
    H5Oget_info_by_name2(file, "lengths", &info, H5O_INFO_BASIC, H5P_DEFAULT);
    header = info.addr;
    H5Gclose(H5Gcreate2(file, "/group", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    add_dataset(file, "/group/a_b");
  });
  EXPECT_EQ(read_node_lengths(good, "/lengths", 10).size(), 10u);
  const std::string bytes = read_bytes(good);
  const std::size_t index = bytes.rfind("TREE"), name = bytes.find("a_b");  // of the group made last, and in it
  for (const auto& [says, at, damage] : {std::tuple("/lengths cannot be opened", header, '\x7f'),
                                         {"/group cannot be listed", index, '?'},
                                         {"/group/a/b cannot be read", name + 1, '/'}}) {
    ASSERT_LT(at, bytes.size());
    std::string damaged = bytes;
    damaged[at] = damage;
    write_bytes(dir / "f.hdf", damaged);
    EXPECT_ERROR(read_node_lengths(dir / "f.hdf", "/lengths", 10), kInput, dir / "f.hdf" + ": " + says);
  }
}

TEST(Hdf5Open, loads_no_library_that_the_environment_names) {
  unsigned state = 1;
  const hid_t none = open_hdf5("/does/not/exist");
  EXPECT_LT(none, 0);
  ASSERT_GE(H5PLget_loading_state(&state), 0);
  EXPECT_EQ(state, 0u);
}

}  // namespace
}  // namespace st
