#include "io/export/octree_export.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <vector>

#include "base/error.h"
#include "base/radix_sort.h"
#include "io/export/background_export.h"
#include "io/file/temporary_file.h"
#include "io/hdf5/sizing_artifact.h"
#include "io/hdf5/vtu_arrays.h"
#include "sizing/metric_in_space.h"
#include "sizing/refine.h"

namespace st {
namespace {

constexpr std::uint8_t kVtkVoxel = 11, kVtkHexahedron = 12;

/// What is shown: one value per leaf.
struct CellData {
  std::vector<float> size;
  std::vector<std::int32_t> cause;
  std::vector<std::uint8_t> colour;  // empty: nothing is blanked
  std::vector<float> along;          // empty: lengths are the same in all directions
  std::vector<float> direction;      // [3*n_leaves] likewise
  std::vector<float> metric;         // [6*n_leaves] xx yy zz xy yz xz; empty: it has no more than the lengths
  Similarity frame;                  // where the octree lies
};

std::string cell_data(const OctreeView& octree, const CellData& data, VtuArrays& arrays) {
  const std::vector<std::int32_t> level(octree.leaf_levels.begin(), octree.leaf_levels.end());
  std::vector<std::int32_t> kind, id;
  for (const std::int32_t cause : data.cause) {
    kind.push_back(cause == kNone ? kNone : static_cast<std::int32_t>(cause_kind(cause)));
    id.push_back(cause == kNone ? 0 : cause_id(cause) + 1);
  }
  return "      <CellData Scalars=\"size\">\n" + arrays.add("size", "Float32", data.size) +
         arrays.add("level", "Int32", level) + arrays.add("cause_kind", "Int32", kind) +
         arrays.add("cause_id", "Int32", id) + (data.colour.empty() ? "" : arrays.add("colour", "UInt8", data.colour)) +
         (data.along.empty()
              ? ""
              : arrays.add("along", "Float32", data.along) + arrays.add("direction", "Float32", data.direction, 3)) +
         (data.metric.empty() ? "" : arrays.add("metric", "Float32", data.metric, 6)) + "      </CellData>\n";
}

/// Places of a cell's corners among packed_corners(): VTK's voxels lie along the axes, hexahedra need not.
std::array<int, 8> corner_order(const Similarity& frame) {
  if (frame == Similarity()) return {0, 1, 2, 3, 4, 5, 6, 7};
  return frame.is_mirrored() ? std::array{4, 5, 7, 6, 0, 1, 3, 2} : std::array{0, 1, 3, 2, 4, 5, 7, 6};
}

std::string points_and_cells(const OctreeView& octree, const Similarity& frame, VtuArrays& arrays,
                             std::size_t& n_points) {
  const std::size_t n = octree.leaf_keys.size();
  std::vector<std::uint64_t> corners;
  corners.reserve(8 * n);
  for (std::size_t leaf = 0; leaf < n; ++leaf)
    for (const std::uint64_t c : packed_corners(octree.leaf_keys[leaf], octree.leaf_levels[leaf])) corners.push_back(c);
  sort_unique(corners);
  n_points = corners.size();
  std::vector<double> xyz;
  const double unit = octree.edge / kCoordinateEnd;
  for (const std::uint64_t c : corners) {
    const GridPoint p = unpack_corner(c);
    const Vec3 x = frame({octree.lo.x + p.x * unit, octree.lo.y + p.y * unit, octree.lo.z + p.z * unit});
    xyz.insert(xyz.end(), {x.x, x.y, x.z});
  }
  const std::array<int, 8> order = corner_order(frame);
  const std::uint8_t type = frame == Similarity() ? kVtkVoxel : kVtkHexahedron;
  std::vector<std::int64_t> connectivity, offsets;
  connectivity.reserve(8 * n);
  for (std::size_t leaf = 0; leaf < n; ++leaf) {
    const std::array<std::uint64_t, 8> of_leaf = packed_corners(octree.leaf_keys[leaf], octree.leaf_levels[leaf]);
    for (const int k : order)
      connectivity.push_back(std::lower_bound(corners.begin(), corners.end(), of_leaf[k]) - corners.begin());
    offsets.push_back(static_cast<std::int64_t>(8 * (leaf + 1)));
  }
  return "      <Points>\n" + arrays.add("Points", "Float64", xyz, 3) + "      </Points>\n      <Cells>\n" +
         arrays.add("connectivity", "Int64", connectivity) + arrays.add("offsets", "Int64", offsets) +
         arrays.add("types", "UInt8", std::vector<std::uint8_t>(n, type)) + "      </Cells>\n";
}

void write_vtu(const OctreeView& octree, const CellData& data, const std::string& output) {
  VtuArrays arrays;
  std::size_t n_points = 0;
  const std::string cells = cell_data(octree, data, arrays),
                    geometry = points_and_cells(octree, data.frame, arrays, n_points);
  TemporaryFile temporary(output);
  std::ofstream file(temporary.name(), std::ios::binary);
  file << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
          "header_type=\"UInt64\">\n  <UnstructuredGrid>\n"
       << "    <Piece NumberOfPoints=\"" << n_points << "\" NumberOfCells=\"" << octree.leaf_keys.size() << "\">\n"
       << cells << geometry << "    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_"
       << arrays.bytes() << "\n  </AppendedData>\n</VTKFile>\n";
  file.close();
  if (!file) throw Error(ExitCode::kOutput, output + ": cannot be written; check free space and permissions");
  temporary.commit();
}

void add_stretch(const OctreeField& field, const OctreeView& shown, CellData& data) {
  int hint = 0;
  for (std::int32_t leaf = 0; leaf < shown.n_leaves(); ++leaf) {
    const Vec3 center = data.frame(shown.leaf_center(leaf));
    const LocalSize size = field.local(center, hint);
    data.along.push_back(static_cast<float>(size.along));
    for (const double x : {size.direction.x, size.direction.y, size.direction.z})
      data.direction.push_back(static_cast<float>(x));
    if (!field.has_metrics()) continue;
    for (const double m : metric_in_space(field, center, hint)) data.metric.push_back(static_cast<float>(m));
  }
}

}  // namespace

void export_octree(const std::string& artifact, const std::string& output) {
  const bool is_raster = read_header(artifact).schema == "raster";
  if (!is_raster && (output.ends_with(".bac") || output.ends_with(".pos"))) {
    const MappedSizing sizing = map_sizing(artifact);
    output.ends_with(".bac") ? export_bac(*sizing.field, output) : export_pos(*sizing.field, output);
    return;
  }
  if (!output.ends_with(".vtu"))
    throw Error(ExitCode::kUsage,
                output + (is_raster ? ": a raster is exported as .vtu; give that suffix"
                                    : ": a sizing is exported as .vtu, .pos or .bac; give one of these suffixes"));
  CellData data;
  if (is_raster) {
    const RasterArtifact raster = read_raster(artifact);
    data.size = raster.octree.stored_length;
    for (float& size : data.size) size = std::min(size, static_cast<float>(raster.numbers.far_length));
    data.cause = raster.octree.stored_cause;
    write_vtu(raster.octree.shape.view(), data, output);
    return;
  }
  const SizingArtifact sizing = read_sizing(artifact);
  const ShownOctree shown = show_octree(*sizing.field());
  for (const float length : shown.length)
    data.size.push_back(static_cast<float>(sizing.scale * sizing.frame.scale) * length);
  data.cause = shown.cause;
  data.frame = sizing.frame;
  if (const auto field = sizing.field(sizing.frame); field->is_stretched())
    add_stretch(*field, shown.shape.view(), data);
  if (!sizing.blanking.colour.empty())
    for (const std::int32_t leaf : shown.leaf)
      data.colour.push_back(static_cast<std::uint8_t>(sizing.blanking.colour[leaf]));
  write_vtu(shown.shape.view(), data, output);
}

}  // namespace st
