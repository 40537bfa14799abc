// Files of other programs in binary forms: each damage has a message of its own.
#include <gtest/gtest.h>
#include <hdf5.h>
#include <zlib.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "io/foreign/node_array.h"
#include "io/foreign/triangulation_file.h"
#include "io/foreign/triangulation_reader.h"
#include "unit/io/temporary_directory.h"

namespace st {
namespace {

template <class T>
std::string raw_bytes(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

using RawHead = std::vector<std::uint64_t>;  // of an appended array: its size, or the blocks, their sizes ...

/// An array as VTK appends it: in one piece, or as one block of zlib.
std::string appended_array(const std::string& bytes, bool is_compressed) {
  if (!is_compressed) return raw_bytes(RawHead{bytes.size()}) + bytes;
  std::string block(compressBound(bytes.size()), '\0');
  uLongf n = block.size();
  EXPECT_EQ(
      compress(reinterpret_cast<Bytef*>(block.data()), &n, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()),
      Z_OK);
  return raw_bytes(RawHead{1, bytes.size(), 0, n}) + block.substr(0, n);
}

/// A tetrahedron whose arrays stand behind the XML, raw.
std::string appended_vtu(bool is_compressed) {
  std::string xml = "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\" header_type=\"UInt64\"" +
                    std::string(is_compressed ? " compressor=\"vtkZLibDataCompressor\"" : "") +
                    "><UnstructuredGrid><Piece NumberOfPoints=\"4\" NumberOfCells=\"4\"><Points>";
  std::string data;
  const auto add = [&](const std::string& type, const std::string& name, const std::string& bytes) {
    xml += "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"appended\" offset=\"" +
           std::to_string(data.size()) + "\"/>";
    data += appended_array(bytes, is_compressed);
  };
  add("Float64", "Points", raw_bytes(std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}));
  xml += "</Points><Cells>";
  add("Int32", "connectivity", raw_bytes(std::vector<std::int32_t>{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}));
  add("Int64", "offsets", raw_bytes(std::vector<std::int64_t>{3, 6, 9, 12}));
  add("UInt8", "types", "\5\5\5\5");
  return xml + "</Cells></Piece></UnstructuredGrid><AppendedData encoding=\"raw\">_" + data +
         "</AppendedData></VTKFile>\n";
}

/// In the form that is compressed or not, `from` becomes `to`.
struct VtuDamage {
  bool is_compressed;
  std::string from, to, says;
};

std::vector<VtuDamage> vtu_damages() {
  const auto types_of = [](std::uint64_t n) { return raw_bytes(RawHead{n}) + "\5\5\5\5"; };
  const auto points_of = [](std::uint64_t n_blocks, std::uint64_t size) {
    return raw_bytes(RawHead{n_blocks, size, 0});
  };
  const std::string lost = "array 'types' is not complete", not_expanded = "compressed data cannot be expanded";
  return {{false, "LittleEndian", "BigEndian", "written on a machine of another byte order"},
          {false, "encoding=\"raw\">_", "encoding=\"raw\">", "cut off: its appended data are missing"},
          {false, "offset=\"104\"", "offset=\"99999\"", "array 'connectivity' is missing"},
          {false, types_of(4), types_of(100), lost},  // fewer bytes than the file has, and more than are left
          {false, types_of(4), types_of(std::numeric_limits<std::uint64_t>::max()), lost},
          {false, "type=\"UInt8\"", "type=\"String\"", "array 'types' has the type 'String', which is not read"},
          {true, "vtkZLibDataCompressor", "vtkLZ4DataCompressor", "compressed by vtkLZ4DataCompressor"},
          {true, points_of(1, 96), points_of(2, 96), "damaged: array 'Points'"},
          {true, points_of(1, 96), points_of(1, 95), not_expanded},
          {true, points_of(1, 96), points_of(1, 97), not_expanded},
          {true, points_of(1, 96), points_of(1, std::uint64_t{1} << 40), not_expanded}};
}

TEST(ForeignDamage, of_appended_arrays_of_a_vtu_is_told_apart) {
  const TemporaryDirectory dir;
  for (const bool is_compressed : {false, true}) {
    write_bytes(dir / "good.vtu", appended_vtu(is_compressed));
    EXPECT_EQ(read_triangulation(dir / "good.vtu").n_triangles(), 4);
  }
  for (const VtuDamage& damage : vtu_damages()) {
    std::string bytes = appended_vtu(damage.is_compressed);
    const std::size_t at = bytes.find(damage.from);
    ASSERT_NE(at, std::string::npos) << damage.says;
    write_bytes(dir / "bad.vtu", bytes.replace(at, damage.from.size(), damage.to));
    EXPECT_ERROR(read_triangulation(dir / "bad.vtu"), kInput, damage.says);
  }
}

/// Datasets by name; HDF5 makes integers of numbers that are.
using NumberArrays = std::map<std::string, std::vector<double>>;

/// An HDF5 file of these datasets, and of what `add` adds.
std::string make_number_file(const std::string& path, const NumberArrays& arrays,
                             const std::function<void(hid_t)>& add = {}) {
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t links = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(links, 1);
  for (const auto& [name, values] : arrays) {
    const hsize_t n = values.size();
    const hid_t space = H5Screate_simple(1, &n, nullptr);
    const hid_t dataset = H5Dcreate2(file, name.c_str(), H5T_NATIVE_DOUBLE, space, links, H5P_DEFAULT, H5P_DEFAULT);
    EXPECT_GE(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0) << name;
    H5Dclose(dataset);
    H5Sclose(space);
  }
  if (add) add(file);
  H5Pclose(links);
  H5Fclose(file);
  return path;
}

/// A dataset of `n` values of which none is written.
void add_unwritten(hid_t file, const char* name, hid_t type, hsize_t n) {
  const hid_t space = H5Screate_simple(1, &n, nullptr);
  const hid_t dataset = H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(dataset, 0) << name;
  H5Dclose(dataset);
  H5Sclose(space);
}

NumberArrays good_vtkhdf() {
  return {{"/VTKHDF/Points", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}},
          {"/VTKHDF/NumberOfCells", {4}},
          {"/VTKHDF/Connectivity", {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}},
          {"/VTKHDF/Offsets", {0, 3, 6, 9, 12}},
          {"/VTKHDF/Types", {5, 5, 5, 5}}};
}

TEST(ForeignDamage, of_vtkhdf_arrays_is_told_apart) {
  const TemporaryDirectory dir;
  EXPECT_EQ(read_triangulation(make_number_file(dir / "good.hdf", good_vtkhdf())).n_triangles(), 4);
  struct Replacement {
    std::string name;
    std::vector<double> values;
    std::string says;
  };
  const std::string no_fit = "has arrays that do not fit each other";
  const std::vector<Replacement> replacements = {
      {"NumberOfCells", {2, 2}, "has 2 parts; write the mesh as one"},
      {"NumberOfCells", {5}, no_fit},
      {"Points", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, no_fit},
      {"Offsets", {0, 3, 6, 9}, no_fit},
      {"Types", {5, 9, 5, 5}, "cell 1 is no triangle"},
      {"Offsets", {0, 3, 7, 9, 12}, "cell 1 has offsets that do not fit"},
      {"Offsets", {-3, 0, 3, 6, 9}, "cell 0 has offsets that do not fit"},
      {"Connectivity", {0, 2, 1, 0, 1, 3, 1, 2, 3}, "cell 3 has offsets that do not fit"}};
  for (const Replacement& replacement : replacements) {
    NumberArrays arrays = good_vtkhdf();
    arrays["/VTKHDF/" + replacement.name] = replacement.values;
    EXPECT_ERROR(read_triangulation(make_number_file(dir / "bad.hdf", arrays)), kInput, replacement.says);
  }
}

TEST(ForeignDamage, of_whole_vtkhdf_files_is_told_apart) {
  const TemporaryDirectory dir;
  NumberArrays arrays = good_vtkhdf();
  const auto add_link = [](hid_t file) {
    H5Lcreate_external("other.hdf", "/lengths", file, "/VTKHDF/out", H5P_DEFAULT, H5P_DEFAULT);
  };
  EXPECT_ERROR(read_triangulation(make_number_file(dir / "link.hdf", arrays, add_link)), kInput,
               "/VTKHDF/out is a link to another file");
  arrays.erase("/VTKHDF/Types");
  EXPECT_ERROR(read_triangulation(make_number_file(dir / "lost.hdf", arrays)), kInput,
               "the dataset /VTKHDF/Types is missing or cannot be read");
  const auto add_bomb = [](hid_t file) { add_unwritten(file, "/VTKHDF/Types", H5T_NATIVE_DOUBLE, 10000000); };
  EXPECT_ERROR(read_triangulation(make_number_file(dir / "bomb.hdf", arrays, add_bomb)), kInput,
               "/VTKHDF/Types claims 10000000 values, too many for a file of");
  EXPECT_ERROR(read_vtkhdf(dir / "none.hdf"), kInput, "an HDF5 file that cannot be read");
}

/// The lengths on four nodes, and words.
std::string make_length_file(const std::string& path) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  const NumberArrays arrays = {{"/VTKHDF/PointData/good", {1, 2, 3, 4}},
                               {"/VTKHDF/PointData/negative", {1, 2, -1.5, 4}},
                               {"/VTKHDF/PointData/zero", {0, 2, 3, 4}},
                               {"/VTKHDF/PointData/unknown", {1, kNan, 3, 4}},
                               {"/VTKHDF/PointData/endless", {1, 2, 3, kInf}}};
  return make_number_file(path, arrays, [](hid_t file) { add_unwritten(file, "words", H5T_C_S1, 4); });
}

TEST(ForeignDamage, of_lengths_at_nodes_is_told_apart) {
  const TemporaryDirectory dir;
  const std::string hdf = make_length_file(dir / "lengths.hdf"), vtu = dir / "lengths.vtu", text = dir / "text.hdf";
  write_bytes(vtu,
              "<VTKFile type=\"UnstructuredGrid\"><PointData><DataArray Name=\"good\" format=\"ascii\">1 2 3 4"
              "</DataArray></PointData></VTKFile>\n");
  write_bytes(text, "1 2 3 4\n");
  for (const std::string& path : {hdf, vtu}) {
    EXPECT_EQ(read_node_lengths(path, "good", 4), (std::vector<double>{1, 2, 3, 4}));
    EXPECT_ERROR(read_node_lengths(path, "good", 5), kInput, "good' has 4 values, the mesh 5 nodes");
  }
  EXPECT_ERROR(read_node_lengths(vtu, "none", 4), kInput, "array 'none' is not among the point data; there are 'good'");
  EXPECT_ERROR(read_node_lengths(hdf, "none", 4), kInput, "array 'none' is not in the file");
  EXPECT_ERROR(read_node_lengths(hdf, "none", 4), kInput, "nor by that path; there are 'endless', 'good', ");
  EXPECT_ERROR(read_node_lengths(hdf, "words", 4), kInput, "array 'words' cannot be read");
  EXPECT_ERROR(read_node_lengths(hdf, "negative", 4), kInput, "array 'negative' is -1.5 at node 2");
  EXPECT_ERROR(read_node_lengths(hdf, "zero", 4), kInput, "at node 0; lengths must be positive and finite");
  EXPECT_ERROR(read_node_lengths(hdf, "unknown", 4), kInput, "array 'unknown' is nan at node 1");
  EXPECT_ERROR(read_node_lengths(hdf, "endless", 4), kInput, "array 'endless' is inf at node 3");
  EXPECT_ERROR(read_node_lengths(text, "good", 4), kInput, "no HDF5 file that can be read");
  EXPECT_ERROR(read_node_lengths(dir / "none.hdf", "good", 4), kInput, "no such file");
}

}  // namespace
}  // namespace st
