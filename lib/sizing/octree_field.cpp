#include "sizing/octree_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace st {

OctreeField::OctreeField(const OctreeFieldData& data, std::shared_ptr<const void> owner, double min_length)
    : data_(data),
      owner_(std::move(owner)),
      unit_(data.octree.edge / kCoordinateEnd),
      to_grid_(kCoordinateEnd / data.octree.edge) {
  if (!(min_length > 0)) {
    const auto smallest =
        std::min_element(data.cells.begin(), data.cells.end(),
                         [](const CellLength& a, const CellLength& b) { return a.at_centre() < b.at_centre(); });
    min_length = smallest->at_centre();
  }
  min_size_ = min_length * data_.scale;
  top_.resize(std::size_t{1} << (3 * kTopLevel));
  fill_top(data.octree.node_children.empty() ? ~0 : 0, 0, 0);
}

/// Entries from `first` on that lie in `node`, in Morton order.
void OctreeField::fill_top(std::int32_t node, int level, std::size_t first) {
  const std::size_t n = std::size_t{1} << (3 * (kTopLevel - level));
  if (node < 0 || level == kTopLevel) {
    std::fill_n(top_.begin() + static_cast<std::ptrdiff_t>(first), n, node);
    return;
  }
  for (std::size_t o = 0; o < 8; ++o)
    fill_top(data_.octree.node_children[8 * static_cast<std::size_t>(node) + o], level + 1, first + o * (n / 8));
}

/// Finds the leaf; returns xyz (moved into the root cube) from its centre.
inline Vec3 OctreeField::locate(Vec3 xyz, int& hint) const {
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
    hint = find_leaf(key, level);
  const std::uint32_t extent = morton::cell_extent(level), mask = ~(extent - 1);
  const double half = 0.5 * extent;
  return {unit_ * (gx - (p.x & mask) - half), unit_ * (gy - (p.y & mask) - half), unit_ * (gz - (p.z & mask) - half)};
}

std::int32_t OctreeField::find_part(std::int32_t leaf, Vec3 d) const {
  const auto it = std::lower_bound(data_.split_leaf.begin(), data_.split_leaf.end(), leaf);
  if (it == data_.split_leaf.end() || *it != leaf) return kNone;
  const auto k = static_cast<std::int32_t>(it - data_.split_leaf.begin());
  const CellSplit& s = data_.split[k];
  const double height = s.normal[0] * d.x + s.normal[1] * d.y + s.normal[2] * d.z - s.offset;
  if (std::abs(height) > s.margin) return height > 0 ? kNone : k;
  return length_in(data_.second_cells[k], d) < length_in(data_.cells[leaf], d) ? k : kNone;
}

double OctreeField::size(Vec3 xyz, int& hint) const {
  const Vec3 d = locate(xyz, hint);
  const CellLength& cell = data_.cells[hint];
  if (cell.upper < 0) [[unlikely]] {
    const std::int32_t second = find_part(hint, d);
    if (second != kNone) return length_in(data_.second_cells[second], d);
  }
  return length_in(cell, d);
}

LocalSize OctreeField::local_in(std::int32_t leaf, std::int32_t second, Vec3 d) const {
  const double length = length_in(second == kNone ? data_.cells[leaf] : data_.second_cells[second], d);
  if (data_.along.empty()) return {length, length, {}};
  const std::int32_t site = second == kNone ? leaf : data_.octree.n_leaves() + second;
  const double along = std::min(length_in(data_.along[site], d), data_.max_aspect * length);
  const Vec3 direction = normalized(Vec3(data_.direction[site]));
  if (direction == Vec3{} || !(along > length)) return {length, length, {}};
  return {length, along, direction};
}

LocalSize OctreeField::local(Vec3 xyz, int& hint) const {
  const Vec3 d = locate(xyz, hint);
  return local_in(hint, data_.cells[hint].upper < 0 ? find_part(hint, d) : kNone, d);
}

double OctreeField::size_and_gradient(Vec3 xyz, int& hint, Vec3& gradient, std::int32_t& cause) const {
  const Vec3 d = locate(xyz, hint);
  const std::int32_t second = data_.cells[hint].upper < 0 ? find_part(hint, d) : kNone;
  const CellLength& c = second == kNone ? data_.cells[hint] : data_.second_cells[second];
  cause = second == kNone ? data_.cause[hint] : data_.second_cause[second];
  const double h = length_in(c, d);
  const bool is_cut_off = h >= data_.scale * std::abs(static_cast<double>(c.upper)) || h <= min_size_;
  gradient = is_cut_off ? Vec3{} : data_.scale * Vec3{c.gradient[0], c.gradient[1], c.gradient[2]};
  return h;
}

SizeExplanation OctreeField::explain(Vec3 xyz) const {
  int leaf = 0;
  const Vec3 d = locate(xyz, leaf);
  const std::int32_t second = data_.cells[leaf].upper < 0 ? find_part(leaf, d) : kNone;
  const CellLength& c = second == kNone ? data_.cells[leaf] : data_.second_cells[second];
  SizeExplanation result;
  const LocalSize local = local_in(leaf, second, d);
  result.length = local.length;
  result.along = local.along;
  result.direction = local.direction;
  result.leaf = leaf;
  result.level = data_.octree.leaf_levels[leaf];
  result.cell_edge = data_.octree.cell_edge(result.level);
  result.gradient = data_.scale * Vec3{c.gradient[0], c.gradient[1], c.gradient[2]};
  result.cause = second == kNone ? data_.cause[leaf] : data_.second_cause[second];
  return result;
}

}  // namespace st
