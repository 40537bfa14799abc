#include "io/foreign/node_array.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

#include "base/error.h"
#include "io/foreign/cell_file.h"
#include "io/foreign/triangulation_file.h"
#include "io/hdf5/hdf5_open.h"

namespace st {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& name, const std::string& what) {
  throw Error(ExitCode::kInput, fmt::format("{}: array '{}' {}", path, name, what));
}

/// Values that are expected: for each node up to `most` of them, all the same number.
struct Expected {
  std::size_t n_nodes = 0, most = 1;
  bool fits(std::int64_t n) const {
    const auto count = static_cast<std::size_t>(std::max<std::int64_t>(n, 0));
    return n_nodes > 0 ? count % n_nodes == 0 && count >= n_nodes && count / n_nodes <= most : n == 0;
  }
};

void require_count(const std::string& path, const std::string& name, std::int64_t n, const Expected& expected) {
  if (!expected.fits(n))
    fail(path, name,
         fmt::format("has {} values, the mesh {} nodes; give {} per node of the mesh to be remeshed", n,
                     expected.n_nodes, expected.most == 1 ? "one length" : "one to nine"));
}

/// Reads a whole dataset as doubles; nullopt: there is none of this name.
std::optional<std::vector<double>> read_dataset(hid_t file, const std::string& path, const std::string& name,
                                                const Expected& expected) {
  const hid_t dataset = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
  if (dataset < 0) return std::nullopt;
  const hid_t space = H5Dget_space(dataset);
  const hssize_t n = H5Sget_simple_extent_npoints(space);
  std::vector<double> values;
  const bool is_expected = expected.fits(n);  // else its size is not to be trusted
  if (is_expected) values.resize(static_cast<std::size_t>(n));
  const bool ok = is_expected && H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0;
  H5Sclose(space);
  H5Dclose(dataset);
  require_count(path, name, n, expected);
  if (!ok) fail(path, name, "cannot be read");
  return values;
}

std::vector<double> read_hdf5(const std::string& path, const std::string& name, const Expected& expected) {
  const hid_t file = open_hdf5(path);
  if (file < 0) throw Error(ExitCode::kInput, path + ": no HDF5 file that can be read; give .vtu or HDF5");
  require_self_contained(file, path);
  std::optional<std::vector<double>> values;
  if (name.find('/') == std::string::npos) values = read_dataset(file, path, "/VTKHDF/PointData/" + name, expected);
  if (!values) values = read_dataset(file, path, name, expected);
  const std::vector<std::string> names = values ? std::vector<std::string>() : names_in(file, "/VTKHDF/PointData");
  H5Fclose(file);
  if (!values)
    fail(path, name,
         "is not in the file, neither as /VTKHDF/PointData/" + name + " nor by that path" + arrays_there(names));
  return *values;
}

std::vector<double> read_vtu(const std::string& path, const std::string& name) {
  std::ifstream in(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  return parse_vtu_point_array(path, bytes, name);
}

std::vector<double> read_array(const std::string& path, const std::string& name, const Expected& expected) {
  if (!std::filesystem::is_regular_file(path)) throw Error(ExitCode::kInput, path + ": no such file");
  std::vector<double> values =
      std::filesystem::path(path).extension() == ".vtu" ? read_vtu(path, name) : read_hdf5(path, name, expected);
  require_count(path, name, static_cast<std::int64_t>(values.size()), expected);
  return values;
}

}  // namespace

std::vector<double> read_node_lengths(const std::string& path, const std::string& name, std::size_t n_nodes) {
  std::vector<double> values = read_array(path, name, {n_nodes, 1});
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(values[i] > 0) || !std::isfinite(values[i]))
      fail(path, name, fmt::format("is {} at node {}; lengths must be positive and finite", values[i], i));
  return values;
}

std::vector<double> read_node_values(const std::string& path, const std::string& name, std::size_t n_nodes) {
  std::vector<double> values = read_array(path, name, {n_nodes, 9});
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      fail(path, name, fmt::format("is {} at node {}; values must be finite", values[i], i * n_nodes / values.size()));
  return values;
}

}  // namespace st
