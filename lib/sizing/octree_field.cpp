#include "sizing/octree_field.h"

#include <algorithm>
#include <utility>

namespace st {

OctreeField::OctreeField(const OctreeFieldData& data, std::shared_ptr<const void> owner, double min_length)
    : data_(data), owner_(std::move(owner)), unit_(data.octree.edge / kCoordinateEnd), to_grid_(kCoordinateEnd / data.octree.edge) {
  if (!(min_length > 0)) {
    const auto smallest = std::min_element(data.cells.begin(), data.cells.end(),
                                           [](const CellLength& a, const CellLength& b) { return a.length < b.length; });
    min_length = smallest->length;
  }
  min_size_ = min_length * data_.scale;
}

double OctreeField::size(Vec3 xyz, int& hint) const {
  const OctreeView& octree = data_.octree;
  // position in grid units, inside the root; the comparison is written so that NaN becomes 0
  const auto to_grid = [this](double x, double origin) {
    const double g = (x - origin) * to_grid_;
    return g > 0 ? std::min(g, static_cast<double>(kCoordinateEnd)) : 0.0;
  };
  const double gx = to_grid(xyz.x, octree.lo.x), gy = to_grid(xyz.y, octree.lo.y), gz = to_grid(xyz.z, octree.lo.z);
  const auto cell = [](double g) { return std::min(static_cast<std::uint32_t>(g), kCoordinateEnd - 1); };
  const GridPoint p{cell(gx), cell(gy), cell(gz)};
  const std::uint64_t key = morton::encode(p);
  int level = 0;
  if (hint >= 0 && hint < octree.n_leaves() && octree.leaf_contains(hint, key))
    level = octree.leaf_levels[hint];
  else
    hint = octree.find_leaf(key, level);
  const std::uint32_t extent = morton::cell_extent(level), mask = ~(extent - 1);
  const double half = 0.5 * extent;
  const CellLength& c = data_.cells[hint];
  const double rise =
      c.gradient[0] * (gx - (p.x & mask) - half) + c.gradient[1] * (gy - (p.y & mask) - half) + c.gradient[2] * (gz - (p.z & mask) - half);
  return std::max(data_.scale * std::min<double>(c.length + unit_ * rise, c.upper), min_size_);
}

double OctreeField::size_and_gradient(Vec3 xyz, int& hint, Vec3& gradient) const {
  const double h = size(xyz, hint);
  const CellLength& c = data_.cells[hint];
  const bool is_cut_off = h >= data_.scale * static_cast<double>(c.upper) || h <= min_size_;
  gradient = is_cut_off ? Vec3{} : data_.scale * Vec3{c.gradient[0], c.gradient[1], c.gradient[2]};
  return h;
}

SizeExplanation OctreeField::explain(Vec3 xyz) const {
  int leaf = 0;
  SizeExplanation result;
  result.length = size(xyz, leaf);
  const std::size_t l = static_cast<std::size_t>(leaf);
  result.leaf = leaf;
  result.level = data_.octree.leaf_levels[l];
  result.cell_edge = data_.octree.cell_edge(result.level);
  const float* g = data_.cells[l].gradient;
  result.gradient = data_.scale * Vec3{g[0], g[1], g[2]};
  result.cause = data_.cause[l];
  return result;
}

}  // namespace st
