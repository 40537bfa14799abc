// VTKHDF of other programs: an UnstructuredGrid in one part.
#include <hdf5.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>

#include "base/error.h"
#include "io/foreign/cell_file.h"
#include "io/foreign/triangulation_file.h"
#include "io/hdf5/hdf5_listing.h"
#include "io/hdf5/hdf5_open.h"

namespace st {
namespace {

class VtkhdfParser {
 public:
  explicit VtkhdfParser(const std::string& path) : path_(path) {
    std::error_code none;
    bytes_ = std::filesystem::file_size(path, none);
    file_ = open_hdf5(path);
    if (file_ < 0) fail("an HDF5 file that cannot be read: damaged or cut off; write it again");
    require_self_contained(file_, path);
  }
  ~VtkhdfParser() { H5Fclose(file_); }
  VtkhdfParser(const VtkhdfParser&) = delete;
  VtkhdfParser& operator=(const VtkhdfParser&) = delete;

  TriangulationFile run() {
    CellFile cells = read_cells();
    const auto face = read<std::int64_t>("CellData/face", H5T_NATIVE_INT64);
    TriangulationFile result;
    result.node_xyz = std::move(cells.node_xyz);
    for (std::size_t c = 0; c < cells.type.size(); ++c) {
      constexpr std::int64_t kTriangle = 5;
      if (cells.type[c] != kTriangle) fail("cell " + std::to_string(c) + " is no triangle; write triangles only");
      if (cells.offset[c + 1] != cells.offset[c] + 3) fail(misfit(c));
      const std::int64_t* n = cells.node.data() + cells.offset[c];
      result.triangles.push_back({n[0], n[1], n[2]});
      if (face && face->size() == cells.type.size()) result.surface.push_back((*face)[c]);
    }
    if (auto size = read<double>("PointData/size", H5T_NATIVE_DOUBLE); size && size->size() == result.node_xyz.size())
      result.node_size = std::move(*size);
    return result;
  }

  CellFile read_with_sizes(const std::string& array) {
    CellFile cells = read_cells();
    for (const char* usual : kUsualSizes) {
      auto values = read<double>("PointData/" + (array.empty() ? usual : array), H5T_NATIVE_DOUBLE);
      if (!values) continue;
      cells.value = std::move(*values);
      add_groups(cells);
      return cells;
    }
    if (!array.empty())
      if (auto values = read<double>("CellData/" + array, H5T_NATIVE_DOUBLE)) {
        cells.cell_value = std::move(*values);
        add_groups(cells);
        return cells;
      }
    std::vector<std::string> names = names_in(file_, "/VTKHDF/PointData");
    std::ranges::copy(names_in(file_, "/VTKHDF/CellData"), std::back_inserter(names));
    fail(missing_sizes(array, names));
  }

 private:
  void add_groups(CellFile& cells) const {
    if (auto group = read<std::int32_t>(std::string("CellData/") + kGroups, H5T_NATIVE_INT32);
        group && group->size() == cells.type.size())
      cells.group = std::move(*group);
    const std::vector<std::string> names = strings("/VTKHDF/FieldData/group_name");
    for (std::size_t i = 0; i < names.size(); ++i)
      cells.group_name.emplace_back(names[i], static_cast<std::int32_t>(i) + 1);
  }
  /// Of a dataset of strings of variable length, as VTK writes and reads them; empty: it is none.
  std::vector<std::string> strings(const std::string& path) const {
    const std::string folder = path.substr(0, path.rfind('/'));
    if (H5Lexists(file_, folder.c_str(), H5P_DEFAULT) <= 0 || H5Lexists(file_, path.c_str(), H5P_DEFAULT) <= 0)
      return {};
    const hid_t dataset = H5Dopen2(file_, path.c_str(), H5P_DEFAULT);
    if (dataset < 0) return {};
    const hid_t type = H5Dget_type(dataset), space = H5Dget_space(dataset);
    const hssize_t n = H5Sget_simple_extent_npoints(space);
    std::vector<std::string> result;
    if (H5Tis_variable_str(type) > 0 && n > 0 && static_cast<std::uint64_t>(n) <= bytes_) {
      std::vector<char*> text(static_cast<std::size_t>(n), nullptr);
      if (H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) >= 0)
        for (const char* t : text) result.emplace_back(t ? t : "");
      H5Dvlen_reclaim(type, space, H5P_DEFAULT, text.data());
    }
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(dataset);
    return result;
  }
  CellFile read_cells() const {
    const auto xyz = require<double>("Points", H5T_NATIVE_DOUBLE);
    const auto n_cells = require<std::int64_t>("NumberOfCells", H5T_NATIVE_INT64);  // of each part
    if (n_cells.size() != 1) fail("has " + std::to_string(n_cells.size()) + " parts; write the mesh as one");
    CellFile cells;
    cells.node = require<std::int64_t>("Connectivity", H5T_NATIVE_INT64);
    cells.offset = require<std::int64_t>("Offsets", H5T_NATIVE_INT64);
    cells.type = require<std::int64_t>("Types", H5T_NATIVE_INT64);
    if (xyz.size() % 3 != 0 || cells.offset.size() != cells.type.size() + 1 ||
        n_cells[0] != static_cast<std::int64_t>(cells.type.size()))
      fail("has arrays that do not fit each other");
    for (std::size_t i = 0; i < xyz.size(); i += 3) cells.node_xyz.push_back({xyz[i], xyz[i + 1], xyz[i + 2]});
    for (std::size_t c = 0; c < cells.type.size(); ++c)
      if (cells.offset[c] < 0 || cells.offset[c + 1] < cells.offset[c] ||
          static_cast<std::size_t>(cells.offset[c + 1]) > cells.node.size())
        fail(misfit(c));
    return cells;
  }
  static std::string misfit(std::size_t cell) {
    return "cell " + std::to_string(cell) + " has offsets that do not fit";
  }

  [[noreturn]] void fail(const std::string& what) const { throw Error(ExitCode::kInput, path_ + ": " + what); }

  /// The whole dataset; nullopt: there is none of this name, or it is not made of numbers.
  template <class Value>
  std::optional<std::vector<Value>> read(const std::string& name, hid_t type) const {
    const std::string path = "/VTKHDF/" + name, group = path.substr(0, path.rfind('/'));
    if (H5Lexists(file_, group.c_str(), H5P_DEFAULT) <= 0 || H5Lexists(file_, path.c_str(), H5P_DEFAULT) <= 0)
      return std::nullopt;
    const hid_t dataset = H5Dopen2(file_, path.c_str(), H5P_DEFAULT);
    if (dataset < 0) return std::nullopt;
    const hid_t space = H5Dget_space(dataset), stored = H5Dget_type(dataset);
    const H5T_class_t kind = H5Tget_class(stored);
    const hssize_t n = H5Sget_simple_extent_npoints(space);
    std::optional<std::vector<Value>> values;
    if (n > 0 && static_cast<double>(n) > kMostExpansion * static_cast<double>(bytes_))
      fail("the dataset " + path + " claims " + std::to_string(n) + " values, too many for a file of " +
           std::to_string(bytes_) + " bytes; write it again");
    if ((kind == H5T_INTEGER || kind == H5T_FLOAT) && n >= 0 && n < 6000000000) {
      values.emplace(static_cast<std::size_t>(n));
      if (H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values->data()) < 0) values.reset();
    }
    H5Tclose(stored);
    H5Sclose(space);
    H5Dclose(dataset);
    return values;
  }
  template <class Value>
  std::vector<Value> require(const std::string& name, hid_t type) const {
    auto values = read<Value>(name, type);
    if (!values) fail("the dataset /VTKHDF/" + name + " is missing or cannot be read");
    return std::move(*values);
  }

  static constexpr double kMostExpansion = 256;  // values per byte of the file: of what compresses best, all alike
  const std::string& path_;
  std::uint64_t bytes_ = 0;
  hid_t file_ = -1;
};

}  // namespace

bool is_foreign_vtkhdf(const std::string& path) {
  if (kept_listing(path)) return false;
  const hid_t file = open_hdf5(path);
  if (file < 0) return false;
  const bool is_foreign = H5Lexists(file, "/st", H5P_DEFAULT) <= 0 && H5Lexists(file, "/VTKHDF", H5P_DEFAULT) > 0;
  H5Fclose(file);
  return is_foreign;
}

TriangulationFile read_vtkhdf(const std::string& path) { return VtkhdfParser(path).run(); }

CellFile read_vtkhdf_cells(const std::string& path, const std::string& array) {
  return VtkhdfParser(path).read_with_sizes(array);
}

}  // namespace st
