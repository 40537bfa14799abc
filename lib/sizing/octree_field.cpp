#include "sizing/octree_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
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
    for (const Cone& c : data.cones) min_length = std::min<double>(min_length, c.length);
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

/// Finds the leaf of the place, moved into the root cube.
inline OctreeField::Place OctreeField::locate(Vec3 xyz, int& hint) const {
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
  return {xyz - octree.lo,
          {unit_ * (gx - (p.x & mask) - half), unit_ * (gy - (p.y & mask) - half), unit_ * (gz - (p.z & mask) - half)}};
}

double OctreeField::cone_length(std::int32_t site, const Place& x, std::int32_t* winner) const {
  double least = data_.max_length;
  std::int32_t by = kLargest;
  for (std::int32_t k = data_.first_cone[site]; k < data_.first_cone[site + 1]; ++k) {
    const Cone& cone = data_.cones[data_.site_cones[k]];
    const double room = least - cone.length;
    if (!(room > 0)) break;  // shorter ones come first
    const double slope = cone.slope, nearer = room + slope * (cone.half[0] + cone.half[1]);
    // its rectangle is no closer than its place less half its sides
    if (!(slope * slope * norm2(x.from_lo - Vec3{cone.x[0], cone.x[1], cone.x[2]}) < nearer * nearer)) continue;
    const double distance2 = norm2(cone.way_to(x.from_lo));
    if (!(slope * slope * distance2 < room * room)) continue;
    least = cone.length + slope * std::sqrt(distance2);
    by = data_.site_cones[k];
  }
  if (!data_.other.empty())
    if (const double length = length_in(data_.other[site], x.from_center); length < least) {
      least = length;
      by = kOther;
    }
  if (winner) *winner = by;
  return least;
}

inline std::int32_t OctreeField::find_site(std::int32_t leaf, const Place& x) const {
  if (!(data_.cells[leaf].upper < 0)) [[likely]]
    return leaf;
  const auto it = std::lower_bound(data_.split_leaf.begin(), data_.split_leaf.end(), leaf);
  if (it == data_.split_leaf.end() || *it != leaf) return leaf;
  const auto k = static_cast<std::int32_t>(it - data_.split_leaf.begin());
  const std::int32_t second = data_.octree.n_leaves() + k;
  const CellSplit& s = data_.split[k];
  const Vec3 d = x.from_center;
  const double height = s.normal[0] * d.x + s.normal[1] * d.y + s.normal[2] * d.z - s.offset;
  if (std::abs(height) > s.margin) return height > 0 ? leaf : second;
  return length_at(second, x) < length_at(leaf, x) ? second : leaf;
}

double OctreeField::size(Vec3 xyz, int& hint) const {
  const Place x = locate(xyz, hint);
  return scaled(length_at(find_site(hint, x), x));
}

LocalSize OctreeField::local_in(std::int32_t site, const Place& x) const {
  const double length = scaled(length_at(site, x));
  if (data_.along.empty()) return {length, length, {}};
  const double along = std::min(scaled(length_in(data_.along[site], x.from_center)), data_.max_aspect * length);
  const Vec3 direction = normalized(Vec3(data_.direction[site]));
  if (direction == Vec3{} || !(along > length)) return {length, length, {}};
  return {length, along, direction};
}

LocalSize OctreeField::local(Vec3 xyz, int& hint) const {
  const Place x = locate(xyz, hint);
  return local_in(find_site(hint, x), x);
}

double OctreeField::explain_at(std::int32_t site, const Place& x, Vec3& gradient, std::int32_t& cause,
                               std::int32_t& cone) const {
  const auto linear = [&](const CellLength& c, std::int32_t of, double length) {
    cause = of;
    const bool is_cut_off = length >= std::abs(static_cast<double>(c.upper)) || data_.scale * length <= min_size_;
    gradient = is_cut_off ? Vec3{} : data_.scale * Vec3{c.gradient[0], c.gradient[1], c.gradient[2]};
  };
  const std::int32_t n = data_.octree.n_leaves();
  cone = kLargest;
  const double length =
      data_.first_cone.empty() ? length_in(cell_of(site), x.from_center) : cone_length(site, x, &cone);
  if (data_.first_cone.empty()) {
    linear(cell_of(site), site < n ? data_.cause[site] : data_.second_cause[site - n], length);
  } else if (cone == kOther) {
    linear(data_.other[site], data_.other_cause[site], length);
  } else if (cone == kLargest) {
    gradient = {};
    cause = kNone;
  } else {
    const Cone& c = data_.cones[cone];
    cause = data_.cone_cause[cone];
    gradient = data_.scale * c.slope * normalized(c.way_to(x.from_lo));
  }
  return scaled(length);
}

double OctreeField::size_and_gradient(Vec3 xyz, int& hint, Vec3& gradient, std::int32_t& cause) const {
  const Place x = locate(xyz, hint);
  std::int32_t cone = kLargest;
  return explain_at(find_site(hint, x), x, gradient, cause, cone);
}

CellLength OctreeField::at_center(std::int32_t site, std::int32_t& cause) const {
  const std::int32_t n = data_.octree.n_leaves(), leaf = site < n ? site : data_.split_leaf[site - n];
  Vec3 gradient;
  std::int32_t cone = kLargest;
  const double length =
      explain_at(site, {data_.octree.leaf_center(leaf) - data_.octree.lo, {}}, gradient, cause, cone) / data_.scale;
  const double reach = 0.5 * std::sqrt(3.0) * data_.octree.cell_edge(data_.octree.leaf_levels[leaf]);
  gradient = gradient / data_.scale;
  return {static_cast<float>(length),
          {static_cast<float>(gradient.x), static_cast<float>(gradient.y), static_cast<float>(gradient.z)},
          static_cast<float>(std::min(data_.max_length, length + data_.slope * reach))};
}

ProlongedLengths lengths_at_centers(OctreeFieldData data) {
  const auto n = static_cast<std::size_t>(data.octree.n_leaves());
  ProlongedLengths at;
  at.cells.resize(n);
  at.cause.resize(n);
  at.second_cells.resize(data.split_leaf.size());
  at.second_cause.resize(data.split_leaf.size());
  data.cells = at.cells;
  data.scale = 1;
  const OctreeField field(data, nullptr, std::numeric_limits<double>::min());
  for (std::size_t i = 0; i < n; ++i) at.cells[i] = field.at_center(static_cast<std::int32_t>(i), at.cause[i]);
  for (std::size_t k = 0; k < at.second_cells.size(); ++k) {
    at.second_cells[k] = field.at_center(static_cast<std::int32_t>(n + k), at.second_cause[k]);
    at.cells[data.split_leaf[k]].upper *= -1;  // says that there is a second part
  }
  return at;
}

SizeExplanation OctreeField::explain(Vec3 xyz) const {
  int leaf = 0;
  const Place x = locate(xyz, leaf);
  const std::int32_t site = find_site(leaf, x);
  SizeExplanation result;
  std::int32_t cone = kLargest;
  explain_at(site, x, result.gradient, result.cause, cone);
  const LocalSize local = local_in(site, x);
  result.length = local.length;
  result.along = local.along;
  result.direction = local.direction;
  result.leaf = leaf;
  result.level = data_.octree.leaf_levels[leaf];
  result.cell_edge = data_.octree.cell_edge(result.level);
  if (cone >= 0) {
    const Cone& c = data_.cones[cone];
    result.has_origin = true;
    result.origin = data_.octree.lo + x.from_lo - c.way_to(x.from_lo);
    result.origin_length = data_.scale * c.length;
  }
  return result;
}

}  // namespace st
