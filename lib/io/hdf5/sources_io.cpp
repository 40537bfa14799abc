#include "io/hdf5/sources_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "io/hdf5/artifact_checks.h"
#include "io/hdf5/raster_parts_io.h"
#include "sizing/source_types.h"

namespace st {
namespace {

constexpr const char* kSourceKind = "/st/source/kind";
constexpr const char* kSourceNumbers = "/st/source/numbers";
constexpr const char* kSourceSlope = "source_slope";
constexpr const char* kBackgroundNode = "/st/background/node";
constexpr const char* kBackgroundSize = "/st/background/size";
constexpr const char* kBackgroundMetric = "/st/background/metric";
constexpr const char* kBackgroundTet = "/st/background/tet";
constexpr const char* kBackgroundTriangle = "/st/background/triangle";

constexpr std::size_t kSourceColumns = 32;

/// Points, half axes, spacings, extent, aspect, direction.
std::array<double, kSourceColumns> source_row(const SourceSpec& s) {
  std::array<double, kSourceColumns> row{};
  auto out = row.begin();
  const auto add = [&](Vec3 v) {
    for (const double x : {v.x, v.y, v.z}) *out++ = x;
  };
  for (const Vec3 p : s.point) add(p);
  for (const Vec3 h : s.half_axis) add(h);
  for (const SourceSpacing& d : s.spacing) add({d.length, d.radius, d.doubling});
  *out++ = s.extent;
  *out++ = s.aspect;
  add(s.direction);
  return row;
}

SourceSpec source_of(SourceKind kind, const double* in) {
  SourceSpec s;
  s.kind = kind;
  const auto take = [&] {
    const Vec3 v{in[0], in[1], in[2]};
    in += 3;
    return v;
  };
  for (Vec3& p : s.point) p = take();
  for (Vec3& h : s.half_axis) h = take();
  for (SourceSpacing& d : s.spacing) {
    const Vec3 v = take();
    d = {v.x, v.y, v.z};
  }
  s.extent = *in++;
  s.aspect = *in++;
  s.direction = take();
  return s;
}

std::vector<SymmetricTensor> read_metrics(const Hdf5Reader& file, std::size_t n_nodes) {
  const std::vector<double> numbers = file.read_rows<double>(kBackgroundMetric, n_nodes, 6);
  require_finite(file, kBackgroundMetric, numbers);
  std::vector<SymmetricTensor> metrics(n_nodes);
  for (std::size_t i = 0; i < n_nodes; ++i) {
    std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(6 * i), 6, metrics[i].begin());
    if (!(size_of_metric(metrics[i]).length > 0))
      file.fail(kBackgroundMetric, fmt::format("row {} is no metric that is positive definite", i));
  }
  return metrics;
}

BackgroundMesh read_background(const Hdf5Reader& file) {
  BackgroundMesh mesh;
  mesh.node_xyz = file.read<Vec3>(kBackgroundNode);
  const std::vector<double> sizes = file.read_rows<double>(kBackgroundSize, mesh.node_xyz.size(), 5);
  const std::vector<std::int32_t> tets = file.read<std::int32_t>(kBackgroundTet, 4);
  require_finite(file, kBackgroundNode, mesh.node_xyz);
  require_finite(file, kBackgroundSize, sizes);
  require_ids(file, kBackgroundTet, tets, mesh.node_xyz.size());
  for (std::size_t i = 0; i < mesh.node_xyz.size(); ++i) {
    const double* s = sizes.data() + 5 * i;
    if (!(s[0] > 0 && s[1] >= s[0])) file.fail(kBackgroundSize, fmt::format("row {} is no length > 0", i));
    mesh.node_size.push_back({s[0], s[1], {s[2], s[3], s[4]}});
  }
  if (file.has(kBackgroundMetric)) mesh.node_metric = read_metrics(file, mesh.node_xyz.size());
  for (std::size_t t = 0; t + 4 <= tets.size(); t += 4)
    mesh.tets.push_back({tets[t], tets[t + 1], tets[t + 2], tets[t + 3]});
  if (!file.has(kBackgroundTriangle)) return mesh;
  const std::vector<std::int32_t> corners = file.read<std::int32_t>(kBackgroundTriangle, 3);
  require_ids(file, kBackgroundTriangle, corners, mesh.node_xyz.size());
  for (std::size_t t = 0; t + 3 <= corners.size(); t += 3)
    mesh.triangles.push_back({corners[t], corners[t + 1], corners[t + 2]});
  return mesh;
}

}  // namespace

void write_sources(Hdf5Writer& file, const SourceSet& set) {
  file.set_attribute(kSizing, kSourceSlope, set.slope);
  if (!set.sources.empty()) {
    std::vector<std::uint8_t> kinds;
    std::vector<double> numbers;
    for (const SourceSpec& s : set.sources) {
      kinds.push_back(static_cast<std::uint8_t>(s.kind));
      const auto row = source_row(s);
      numbers.insert(numbers.end(), row.begin(), row.end());
    }
    file.write<std::uint8_t>(kSourceKind, kinds);
    file.write<double>(kSourceNumbers, numbers, kSourceColumns);
  }
  if (set.background.is_empty()) return;
  std::vector<double> sizes;
  for (const LocalSize& s : set.background.node_size)
    sizes.insert(sizes.end(), {s.length, s.along, s.direction.x, s.direction.y, s.direction.z});
  std::vector<std::int32_t> tets;
  for (const auto& tet : set.background.tets) tets.insert(tets.end(), tet.begin(), tet.end());
  file.write<Vec3>(kBackgroundNode, set.background.node_xyz);
  file.write<double>(kBackgroundSize, sizes, 5);
  if (!set.background.node_metric.empty()) {
    std::vector<double> metrics;
    for (const SymmetricTensor& m : set.background.node_metric) metrics.insert(metrics.end(), m.begin(), m.end());
    file.write<double>(kBackgroundMetric, metrics, 6);
  }
  file.write<std::int32_t>(kBackgroundTet, tets, 4);
  if (set.background.triangles.empty()) return;
  std::vector<std::int32_t> corners;
  for (const auto& triangle : set.background.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  file.write<std::int32_t>(kBackgroundTriangle, corners, 3);
}

SourceSet read_sources(const Hdf5Reader& file) {
  SourceSet set;
  set.slope = file.double_attribute(kSizing, kSourceSlope);
  if (!is_finite(set.slope) || !(set.slope > 0))
    file.fail(std::string(kSizing) + "@" + kSourceSlope, "is no slope > 0");
  if (file.has(kBackgroundTet)) set.background = read_background(file);
  if (!file.has(kSourceKind)) return set;
  const std::vector<std::uint8_t> kinds = file.read<std::uint8_t>(kSourceKind);
  const std::vector<double> numbers = file.read_rows<double>(kSourceNumbers, kinds.size(), kSourceColumns);
  const std::vector<std::string> names = file.read_strings(kSourceName);
  require_finite(file, kSourceNumbers, numbers);
  if (names.size() != kinds.size()) file.fail(kSourceName, "does not fit the number of sources");
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (!find_source_type(static_cast<SourceKind>(kinds[i]))) file.fail(kSourceKind, "names a kind that is unknown");
    set.sources.push_back(source_of(static_cast<SourceKind>(kinds[i]), numbers.data() + kSourceColumns * i));
    SourceSpec& s = set.sources.back();
    s.name = names[i];
    bool is_good = s.extent >= 0 && s.aspect >= 1;
    for (int k = 0; k < n_spacings(s.kind); ++k) is_good &= s.spacing[k].length > 0 && s.spacing[k].radius >= 0;
    if (!is_good) file.fail(kSourceNumbers, fmt::format("row {} asks for no length > 0", i));
  }
  return set;
}

}  // namespace st
