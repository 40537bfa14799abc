#include "sizing/octree_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/threads.h"

namespace st {
namespace {

/// Of the deepest level, on one axis.
std::uint32_t cell_at(double on_grid) { return std::min(static_cast<std::uint32_t>(on_grid), kCoordinateEnd - 1); }

}  // namespace

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
    for (const Cone& c : data.cones.cone) min_length = std::min<double>(min_length, c.length);
  }
  if (data_.sources) min_length = std::min(min_length, data_.sources->min_size());
  min_size_ = min_length * data_.scale;
  if (!data_.split_leaf.empty()) is_split_.resize(data_.cells.size() / 64 + 1);
  for (const std::int32_t leaf : data_.split_leaf)
    is_split_[static_cast<std::size_t>(leaf) / 64] |= std::uint64_t{1} << (leaf % 64);
  if (data_.sources) near_ = std::make_unique<std::atomic<std::uint64_t>[]>(data_.cells.size());
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
  const std::uint64_t key = morton::encode({cell_at(gx), cell_at(gy), cell_at(gz)});
  int level = 0;
  if (hint < 0 || hint >= octree.n_leaves() || !octree.leaf_contains(hint, key)) hint = find_leaf(key, level);
  return {xyz, xyz - octree.lo, {gx, gy, gz}};
}

Vec3 OctreeField::from_center(std::int32_t leaf, const Place& x) const {
  const std::uint32_t extent = morton::cell_extent(data_.octree.leaf_levels[leaf]), mask = ~(extent - 1);
  const auto from = [&](double g) { return unit_ * (g - (cell_at(g) & mask) - 0.5 * extent); };
  return {from(x.on_grid.x), from(x.on_grid.y), from(x.on_grid.z)};
}

double OctreeField::length_at(std::int32_t site, const Place& x, std::int32_t* winner) const {
  if (data_.cones.empty()) return static_cast<double>(cell_of(site).at_centre());
  const SplitPlace place(x.from_lo);
  const std::int32_t first = data_.cones.first[site];
  const std::int32_t* const own = data_.cones.of_site.data() + first;
  const float length =
      kernels_.least(reinterpret_cast<const float*>(data_.cones.cone.data()), own, data_.cones.first[site + 1] - first,
                     place.numbers(), static_cast<float>(data_.max_length), winner);
  if (winner && *winner != kNone) *winner = own[*winner];
  return static_cast<double>(length);
}

/// Which parts of the leaf the place may lie in: one, or the first and the second where that is not certain.
inline OctreeField::Sites OctreeField::find_sites(std::int32_t leaf, const Place& x) const {
  const auto bit = static_cast<std::size_t>(leaf);
  if (is_split_.empty() || !(is_split_[bit / 64] >> (bit % 64) & 1)) [[likely]]
    return {leaf, kNone};
  const auto it = std::lower_bound(data_.split_leaf.begin(), data_.split_leaf.end(), leaf);
  const auto k = static_cast<std::int32_t>(it - data_.split_leaf.begin());
  const std::int32_t second = data_.octree.n_leaves() + k;
  const CellSplit& s = data_.split[k];
  const Vec3 d = from_center(leaf, x);
  const double height = s.normal[0] * d.x + s.normal[1] * d.y + s.normal[2] * d.z - s.offset;
  if (std::abs(height) > s.margin) return {height > 0 ? leaf : second, kNone};
  return {leaf, second};
}

std::int32_t OctreeField::find_site(std::int32_t leaf, const Place& x) const {
  const auto [first, second] = find_sites(leaf, x);
  return second != kNone && length_at(second, x) < length_at(first, x) ? second : first;
}

FewSources OctreeField::find_near(std::int32_t leaf) const {
  const double radius = 0.5 * std::sqrt(3.0) * data_.octree.cell_edge(data_.octree.leaf_levels[leaf]);
  double upper = std::abs(static_cast<double>(data_.cells[leaf].upper));
  const auto split = std::lower_bound(data_.split_leaf.begin(), data_.split_leaf.end(), leaf);
  if (split != data_.split_leaf.end() && *split == leaf)
    upper = std::max<double>(upper, std::abs(data_.second_cells[split - data_.split_leaf.begin()].upper));
  if (octree_is_stretched()) upper *= data_.max_aspect;
  const FewSources near = data_.sources->find_near(data_.octree.leaf_center(leaf), radius, upper);
  near_[leaf].store(near.bits(), std::memory_order_relaxed);  // whoever finds out, finds the same
  return near;
}

double OctreeField::size(Vec3 xyz, int& hint) const {
  const Place x = locate(xyz, hint);
  const auto [first, second] = find_sites(hint, x);
  double length = length_at(first, x);
  if (second != kNone) length = std::min(length, length_at(second, x));
  return scaled(source_length(hint, x, length));
}

/// The direction is that of the cone that tells the length.
LocalSize OctreeField::cone_local(std::int32_t site, const Place& x) const {
  const std::int32_t own = data_.cones.first[site], more = data_.cones.first_along[site];
  const AlongCones cones{reinterpret_cast<const float*>(data_.cones.cone.data()),
                         reinterpret_cast<const float*>(data_.cones.stretch.data()),
                         data_.cones.of_site.data() + own,
                         data_.cones.along_of_site.data() + more,
                         data_.cones.first[site + 1] - own,
                         data_.cones.first_along[site + 1] - more,
                         data_.max_length,
                         data_.max_aspect};
  const LeastAlong least = kernels_.least_along(cones, SplitPlace(x.from_lo).numbers());
  const double length = scaled(static_cast<double>(least.length)), along = scaled(static_cast<double>(least.along));
  if (least.winner == kNone || !(along > length)) return {length, length, {}};
  const float(&unit)[3] = data_.cones.stretch[least.winner].direction;
  return {length, along, normalized(Vec3{unit[0], unit[1], unit[2]})};
}

LocalSize OctreeField::local_in(std::int32_t site, const Place& x) const {
  if (!data_.cones.stretch.empty()) return cone_local(site, x);
  const double length = scaled(length_at(site, x));
  return {length, length, {}};
}

LocalSize OctreeField::local_on(Vec3 xyz, Vec3 normal, int& hint) const {
  if (!OctreeField::is_stretched()) {
    const double length = OctreeField::size(xyz, hint);
    return {length, length, {}};
  }
  const Place x = locate(xyz, hint);
  const LocalSize own = local_in(find_site(hint, x), x);
  if (!data_.sources || (is_inside(x) && sources_near(hint).are_none())) return own;
  const LocalSize upper{own.length / data_.scale, own.along / data_.scale, own.direction};
  const LocalSize least = OctreeField::has_metrics() && !(normal == Vec3{})
                              ? data_.sources->local_on_below(xyz, normal, upper)
                              : data_.sources->local_below(xyz, upper);
  return {scaled(least.length), scaled(least.along), least.direction};
}

OctreeField::Answer OctreeField::answer_at(std::int32_t site, const Place& x) const {
  Answer answer;
  const double length = length_at(site, x, &answer.cone);
  double least = length;
  if (data_.sources)
    least = is_inside(x) ? data_.sources->size_below(x.xyz, length, sources_near(leaf_of(site)), answer.source)
                         : data_.sources->size_below(x.xyz, length, &answer.source);
  answer.length = scaled(least);
  if (answer.source != kNone) {
    answer.cone = kNone;
    answer.cause = data_.sources->entry(answer.source).cause;
    answer.gradient = data_.scale * data_.sources->gradient(answer.source, x.xyz);
  } else if (answer.cone != kNone) {
    const Cone& c = data_.cones.cone[answer.cone];
    answer.cause = data_.cones.cause[answer.cone];
    answer.gradient = data_.scale * c.slope * normalized(c.way_to(x.from_lo));
  }
  return answer;
}

double OctreeField::size_and_gradient(Vec3 xyz, int& hint, Vec3& gradient, std::int32_t& cause) const {
  const Place x = locate(xyz, hint);
  const Answer answer = answer_at(find_site(hint, x), x);
  gradient = answer.gradient;
  cause = answer.cause;
  return answer.length;
}

ProlongedLengths lengths_at_centers(const OctreeFieldData& data, std::span<const std::int32_t> teller) {
  const auto n = static_cast<std::size_t>(data.octree.n_leaves());
  ProlongedLengths at;
  at.cells.resize(n);
  at.cause.resize(n);
  const auto at_center = [&](std::int32_t leaf, std::int32_t cone, std::int32_t& cause) -> CellLength {
    const auto largest = static_cast<float>(data.max_length);
    cause = kNone;
    if (cone == kNone) return {largest, {0, 0, 0}, largest};
    cause = data.cones.cause[cone];
    const Cone& c = data.cones.cone[cone];
    const Vec3 way = c.way_to(data.octree.leaf_center(leaf) - data.octree.lo);
    const double away = norm(way), length = c.length + c.slope * away,
                 reach = 0.5 * std::sqrt(3.0) * data.octree.cell_edge(data.octree.leaf_levels[leaf]);
    const Vec3 gradient = away > 0 ? (c.slope / away) * way : Vec3{};
    return {static_cast<float>(length),
            {static_cast<float>(gradient.x), static_cast<float>(gradient.y), static_cast<float>(gradient.z)},
            static_cast<float>(std::min(data.max_length, length + data.slope * reach))};
  };
  constexpr std::size_t kCellsPerPiece = 8'192;
  parallel_for(n, kCellsPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      at.cells[i] = at_center(static_cast<std::int32_t>(i), teller[i], at.cause[i]);
  });
  for (std::size_t k = 0; k < data.split_leaf.size(); ++k) {
    const std::int32_t leaf = data.split_leaf[k];
    at.second_cells.push_back(at_center(leaf, teller[n + k], at.second_cause.emplace_back()));
    at.cells[leaf].upper *= -1;  // says that there is a second part
  }
  return at;
}

SizeExplanation OctreeField::explain(Vec3 xyz, Vec3 normal) const {
  int leaf = 0;
  const Place x = locate(xyz, leaf);
  const std::int32_t site = find_site(leaf, x);
  SizeExplanation result;
  const Answer answer = answer_at(site, x);
  result.gradient = answer.gradient;
  result.cause = answer.cause;
  const LocalSize local = OctreeField::local_on(xyz, normal, leaf);
  result.length = local.length;
  result.along = local.along;
  result.direction = local.direction;
  result.leaf = leaf;
  result.level = data_.octree.leaf_levels[leaf];
  result.cell_edge = data_.octree.cell_edge(result.level);
  result.origin = xyz;
  result.origin_length = answer.length;
  if (answer.cone != kNone) {
    const Cone& c = data_.cones.cone[answer.cone];
    result.origin = xyz - c.way_to(x.from_lo);
    result.origin_length = data_.scale * c.length;
  } else if (answer.source != kNone) {
    result.origin = data_.sources->origin(answer.source, xyz);
    result.origin_length = data_.scale * data_.sources->entry(answer.source).source->size(result.origin);
  }
  return result;
}

}  // namespace st
