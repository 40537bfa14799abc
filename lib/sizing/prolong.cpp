#include "sizing/prolong.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "base/assert.h"
#include "base/eigen.h"
#include "base/sort_once.h"
#include "base/threads.h"

namespace st {
namespace {

constexpr int kLargestStep2 = 27;

/// What is prolonged: one length and its cause per site: the cells, and the second parts of cells that a surface
/// splits.
struct CellLengths {
  std::vector<float> length;
  std::vector<std::int32_t> cause;
};

/// slope * distance for every step between two cells, as float: a function of level and step only.
class StepWeights {
 public:
  StepWeights(double root_edge, double slope) {
    for (int level = 0; level <= kMaxLevel; ++level) {
      const double half = 0.5 * root_edge / static_cast<double>(1u << level);
      for (int s = 0; s <= kLargestStep2; ++s)
        weight_[level][s] = static_cast<float>(slope * half * std::sqrt(static_cast<double>(s)));
    }
  }
  float operator()(const CellStep& step) const { return weight_[step.fine_level][step.length2]; }

 private:
  std::array<std::array<float, kLargestStep2 + 1>, kMaxLevel + 1> weight_;
};

/// Slopes of sites where they differ.
struct SiteSlopes {
  std::span<const float> cell_slope;  // [n_leaves]
  const Blanking* blanking;

  float at(std::int32_t site) const {
    const auto n = static_cast<std::int32_t>(cell_slope.size());
    return cell_slope[site < n ? site : blanking->split_leaf[site - n]];
  }
  float between(std::int32_t a, std::int32_t b) const { return 0.5F * (at(a) + at(b)); }
};

/// Cells to be looked at, in rising order of length in steps of 1/8 octave. The order is for speed only: the result
/// does not depend on it.
class LengthBuckets {
 public:
  LengthBuckets(float smallest, float largest)
      : first_(bucket_bits(smallest)), buckets_(bucket_bits(largest) - first_ + 1) {}
  void push(float length, std::int32_t leaf) { buckets_[bucket_bits(length) - first_].push_back(leaf); }
  std::size_t size() const { return buckets_.size(); }
  std::vector<std::int32_t>& operator[](std::size_t b) { return buckets_[b]; }

 private:
  // The bits of positive floats order like their values; 20 dropped bits leave exponent and 3 bits of mantissa.
  static std::size_t bucket_bits(float length) { return std::bit_cast<std::uint32_t>(length) >> 20; }
  std::size_t first_;
  std::vector<std::vector<std::int32_t>> buckets_;
};

/// Label-correcting shortest paths: start from every cell with a stored length, pass length + slope * distance on until
/// nothing changes.
void pass_lengths(double root_edge, const Neighbours& neighbours, const Blanking* blanking,
                  const ProlongOptions& options, CellLengths& cells) {
  const auto [smallest, largest] = std::minmax_element(cells.length.begin(), cells.length.end());
  LengthBuckets buckets(*smallest, *largest);
  const bool is_uniform = options.cell_slope.empty();
  const StepWeights weight(root_edge, is_uniform ? options.slope : 1);
  const SiteSlopes slopes{options.cell_slope, blanking};
  std::vector<std::uint8_t> is_waiting(cells.length.size(), 0);
  for (std::size_t leaf = 0; leaf < cells.length.size(); ++leaf)
    if (cells.cause[leaf] != kNone) {
      buckets.push(cells.length[leaf], static_cast<std::int32_t>(leaf));
      is_waiting[leaf] = 1;
    }
  for (std::size_t b = 0; b < buckets.size(); ++b) {
    for (std::size_t i = 0; i < buckets[b].size(); ++i) {  // grows while cells of this bucket are improved again
      const std::int32_t leaf = buckets[b][i];
      if (!is_waiting[leaf]) continue;
      is_waiting[leaf] = 0;
      const float length = cells.length[leaf];
      const std::int32_t cause = cells.cause[leaf];
      const auto pass = [&](std::int32_t other, const CellStep& step) {
        const std::size_t o = static_cast<std::size_t>(other);
        const float rise = is_uniform ? weight(step) : weight(step) * slopes.between(leaf, other);
        const float limit = length + rise;
        if (limit > cells.length[o] || (limit == cells.length[o] && cause >= cells.cause[o])) return;
        if (limit == cells.length[o] && cells.cause[o] == kNone) return;  // nothing won over the largest length
        cells.length[o] = limit;
        cells.cause[o] = cause;
        is_waiting[o] = 1;
        buckets.push(limit, other);
      };
      if (options.across_faces)
        neighbours.for_each_across_face(leaf, pass);
      else
        for_each_link(blanking, neighbours, leaf, pass);
    }
    std::vector<std::int32_t>().swap(buckets[b]);
  }
}

/// Normal equations of the least-squares gradient: sum over neighbours of (step . g - difference)^2 / step^2.
struct GradientFit {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();  // symmetric: the upper half alone is summed
  Eigen::Vector3d right = Eigen::Vector3d::Zero();

  void add(const Eigen::Vector3d& step, double difference) {
    const Eigen::Vector3d weighted = (1 / step.squaredNorm()) * step;
    const Eigen::Matrix3d square = weighted * step.transpose();
    matrix.triangularView<Eigen::Upper>() += square;
    right += difference * weighted;
  }
  Vec3 gradient() const {
    constexpr double kFlat = 1e-9;  // determinant over cubed trace: the neighbours lie in a plane
    const Eigen::Matrix3d full = matrix.selfadjointView<Eigen::Upper>();
    const double trace = matrix.trace();
    return to_vec3(solve(full, right, kFlat * trace * trace * trace).value_or(Eigen::Vector3d::Zero()));
  }
};

/// What gradients are computed from.
struct FitInput {
  const OctreeView& octree;
  const Neighbours& neighbours;
  const Blanking* blanking;
  std::span<const float> lengths;  // [n_sites]
  const ProlongOptions& options;

  bool is_blanked(std::int32_t site) const {
    return site < octree.n_leaves() && blanking->colour[site] == CellColour::kBlanked;
  }
  /// Lengths pass from flow to blanked cells, which must not be seen from the flow.
  bool is_one_way(std::int32_t from, std::int32_t to) const { return blanking && is_blanked(from) != is_blanked(to); }
};

/// Least-squares gradient of one cell, shortened until the slope holds and no corner is below the smallest length
/// around; a ridge is cut off by `upper` instead, so that the field still rises to it.
CellLength fit_cell(const FitInput& in, std::int32_t site) {
  const double length = static_cast<double>(in.lengths[site]);
  if (!in.options.wants_gradients) return {in.lengths[site], {0, 0, 0}, in.lengths[site]};
  double smallest = length, largest = length;
  GradientFit fit;
  const std::int32_t n_leaves = in.octree.n_leaves(),
                     leaf = site < n_leaves ? site : in.blanking->split_leaf[site - n_leaves];
  const int level = in.octree.leaf_levels[leaf];
  for_each_link(in.blanking, in.neighbours, site, [&](std::int32_t other, const CellStep& step) {
    if (in.is_one_way(site, other)) return;
    const double other_length = static_cast<double>(in.lengths[other]);
    const double unit = step.fine_level > level ? 0.25 : 0.5;  // halves of the smaller cell, in edges of this one
    smallest = std::min(smallest, other_length);
    largest = std::max(largest, other_length);
    fit.add(unit * Eigen::Vector3d(step.x, step.y, step.z), other_length - length);
  });
  CellLength cell{static_cast<float>(length), {0, 0, 0}, static_cast<float>(largest)};
  if (!(length > smallest)) return cell;
  const double edge = in.octree.cell_edge(level);
  const double slope =
      in.options.cell_slope.empty() ? in.options.slope : static_cast<double>(in.options.cell_slope[leaf]);
  Vec3 gradient = fit.gradient() / edge;
  const double steepness = norm(gradient);
  if (steepness > slope) gradient = gradient * (slope / steepness);
  const double reach = 0.5 * edge * (std::abs(gradient.x) + std::abs(gradient.y) + std::abs(gradient.z));
  if (reach > length - smallest) gradient = gradient * ((length - smallest) / reach);
  cell.gradient[0] = static_cast<float>(gradient.x);
  cell.gradient[1] = static_cast<float>(gradient.y);
  cell.gradient[2] = static_cast<float>(gradient.z);
  return cell;
}

/// Stored lengths below `max_length` with their causes, `max_length` without a cause elsewhere.
CellLengths bounded_lengths(std::span<const float> stored_length, std::span<const std::int32_t> stored_cause,
                            float max_length) {
  CellLengths cells;
  cells.length.assign(stored_length.begin(), stored_length.end());
  cells.cause.assign(stored_cause.begin(), stored_cause.end());
  for (std::size_t leaf = 0; leaf < cells.length.size(); ++leaf)
    if (!(cells.length[leaf] < max_length)) {
      cells.length[leaf] = max_length;
      cells.cause[leaf] = kNone;
    }
  return cells;
}

/// The label of the site that each length comes from, when lengths are prolonged with `options.slope`; kNone where the
/// largest length holds. All arrays are [n_sites], as in prolong(). Unique: equal lengths take the smallest label.
std::vector<std::int32_t> spread_labels(const Neighbours& neighbours, std::span<const float> stored_length,
                                        std::span<const std::int32_t> label, const ProlongOptions& options,
                                        const Blanking* blanking) {
  CellLengths lengths = bounded_lengths(stored_length, label, static_cast<float>(options.max_length));
  pass_lengths(neighbours.octree().edge, neighbours, blanking, options, lengths);
  return lengths.cause;
}

/// Linear lengths of cells from lengths at their centres, [n_sites] as in prolong(): least-squares gradients, no
/// steeper than the slope, no corner below the smallest length around.
std::vector<CellLength> fit_gradients(const Neighbours& neighbours, std::span<const float> lengths,
                                      const ProlongOptions& options, const Blanking* blanking) {
  const FitInput input{neighbours.octree(), neighbours, blanking, lengths, options};
  constexpr std::size_t kSitesPerPiece = 2'048;
  std::vector<CellLength> cells(lengths.size());
  parallel_for(cells.size(), kSitesPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t site = begin; site < end; ++site) cells[site] = fit_cell(input, static_cast<std::int32_t>(site));
  });
  return cells;
}

}  // namespace

void add_second_parts(const Blanking& blanking, RasterOctree& octree) {
  for (const std::int32_t leaf : blanking.split_leaf) {
    octree.stored_length.push_back(octree.stored_length[leaf]);
    octree.stored_cause.push_back(octree.stored_cause[leaf]);
  }
}

ProlongedLengths prolong(const Neighbours& neighbours, std::span<const float> stored_length,
                         std::span<const std::int32_t> stored_cause, const ProlongOptions& options,
                         const Blanking* blanking) {
  const OctreeView& octree = neighbours.octree();
  ST_ASSERT(stored_length.size() == octree.leaf_keys.size() + (blanking ? blanking->split_leaf.size() : 0));
  ST_ASSERT(stored_cause.size() == stored_length.size());
  ST_ASSERT(options.cell_slope.empty() || options.cell_slope.size() == octree.leaf_keys.size());
  ST_ASSERT(options.slope > 0 && options.max_length > 0 && !(options.across_faces && blanking));
  CellLengths lengths = bounded_lengths(stored_length, stored_cause, static_cast<float>(options.max_length));
  pass_lengths(octree.edge, neighbours, blanking, options, lengths);
  ProlongedLengths result;
  const std::int32_t n = octree.n_leaves();
  result.cells = fit_gradients(neighbours, lengths.length, options, blanking);
  result.second_cells.assign(result.cells.begin() + n, result.cells.end());
  result.cells.resize(static_cast<std::size_t>(n));
  for (std::size_t k = 0; k < result.second_cells.size(); ++k)
    result.cells[blanking->split_leaf[k]].upper *= -1;  // says that there is a second part
  result.second_cause.assign(lengths.cause.begin() + n, lengths.cause.end());
  lengths.cause.resize(static_cast<std::size_t>(n));
  result.cause = std::move(lengths.cause);
  return result;
}

// The label that goes with the lengths is the slope of their origin instead of their cause.
std::vector<float> spread_slopes(const Neighbours& neighbours, std::span<const float> stored_length,
                                 std::span<const float> seed_slope, const ProlongOptions& options,
                                 const Blanking* blanking) {
  const OctreeView& octree = neighbours.octree();
  ST_ASSERT(seed_slope.size() == stored_length.size());
  std::vector<float> kinds(seed_slope.begin(), seed_slope.end());
  for (float& slope : kinds)
    if (!(slope > 0)) slope = static_cast<float>(options.slope);
  const std::vector<float> cell_slope = kinds;
  sort_once(kinds);
  std::vector<std::int32_t> label;
  for (const float slope : cell_slope)
    label.push_back(static_cast<std::int32_t>(std::lower_bound(kinds.begin(), kinds.end(), slope) - kinds.begin()));
  const std::vector<std::int32_t> origin =
      spread_labels(neighbours, stored_length, label, {options.slope, options.max_length}, blanking);
  std::vector<float> result;
  for (std::int32_t leaf = 0; leaf < octree.n_leaves(); ++leaf)
    result.push_back(origin[leaf] == kNone ? static_cast<float>(options.slope) : kinds[origin[leaf]]);
  return result;
}

}  // namespace st
