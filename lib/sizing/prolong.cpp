#include "sizing/prolong.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "sizing/neighbours.h"

namespace st {
namespace {

constexpr int kLargestStep2 = 27;

/// What is prolonged: one length and its cause per cell.
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
      for (int s = 0; s <= kLargestStep2; ++s) weight_[level][s] = static_cast<float>(slope * half * std::sqrt(static_cast<double>(s)));
    }
  }
  float operator()(const CellStep& step) const { return weight_[step.fine_level][step.length2]; }

 private:
  std::array<std::array<float, kLargestStep2 + 1>, kMaxLevel + 1> weight_;
};

/// Cells to be looked at, in rising order of length in steps of 1/8 octave. The order is for speed only: the result does not depend on it.
class LengthBuckets {
 public:
  LengthBuckets(float smallest, float largest) : first_(bucket_bits(smallest)), buckets_(bucket_bits(largest) - first_ + 1) {}
  void push(float length, std::int32_t leaf) { buckets_[bucket_bits(length) - first_].push_back(leaf); }
  std::size_t size() const { return buckets_.size(); }
  std::vector<std::int32_t>& operator[](std::size_t b) { return buckets_[b]; }

 private:
  // The bits of positive floats order like their values; 20 dropped bits leave exponent and 3 bits of mantissa.
  static std::size_t bucket_bits(float length) { return std::bit_cast<std::uint32_t>(length) >> 20; }
  std::size_t first_;
  std::vector<std::vector<std::int32_t>> buckets_;
};

/// Label-correcting shortest paths: start from every cell with a stored length, pass length + slope * distance on until nothing changes.
void pass_lengths(const OctreeView& octree, const Neighbours& neighbours, double slope, CellLengths& cells) {
  const auto [smallest, largest] = std::minmax_element(cells.length.begin(), cells.length.end());
  LengthBuckets buckets(*smallest, *largest);
  const StepWeights weight(octree.edge, slope);
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
      neighbours.for_each(leaf, [&](std::int32_t other, const CellStep& step) {
        const std::size_t o = static_cast<std::size_t>(other);
        const float limit = length + weight(step);
        if (limit > cells.length[o] || (limit == cells.length[o] && cause >= cells.cause[o])) return;
        if (limit == cells.length[o] && cells.cause[o] == kNone) return;  // nothing won over the largest length
        cells.length[o] = limit;
        cells.cause[o] = cause;
        is_waiting[o] = 1;
        buckets.push(limit, other);
      });
    }
    std::vector<std::int32_t>().swap(buckets[b]);
  }
}

/// Normal equations of the least-squares gradient: sum over neighbours of (step . g - difference)^2 / step^2.
struct GradientFit {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0, bx = 0, by = 0, bz = 0;

  void add(double x, double y, double z, double difference) {
    const double w = 1.0 / (x * x + y * y + z * z);
    xx += w * x * x, xy += w * x * y, xz += w * x * z, yy += w * y * y, yz += w * y * z, zz += w * z * z;
    bx += w * x * difference, by += w * y * difference, bz += w * z * difference;
  }
  Vec3 solve() const {
    const double c0 = yy * zz - yz * yz, c1 = xz * yz - xy * zz, c2 = xy * yz - xz * yy;
    const double det = xx * c0 + xy * c1 + xz * c2;
    if (!(det > 1e-9 * (xx + yy + zz) * (xx + yy + zz) * (xx + yy + zz))) return {};
    return {(c0 * bx + c1 * by + c2 * bz) / det, (c1 * bx + (xx * zz - xz * xz) * by + (xy * xz - xx * yz) * bz) / det,
            (c2 * bx + (xy * xz - xx * yz) * by + (xx * yy - xy * xy) * bz) / det};
  }
};

/// Least-squares gradient of one cell, shortened until the slope holds and no corner is below the smallest length around; a ridge is cut
/// off by `upper` instead, so that the field still rises to it.
CellLength fit_cell(const OctreeView& octree, const Neighbours& neighbours, std::span<const float> lengths, std::int32_t leaf,
                    double slope) {
  const double length = static_cast<double>(lengths[leaf]);
  double smallest = length, largest = length;
  GradientFit fit;
  const int level = octree.leaf_levels[leaf];
  neighbours.for_each(leaf, [&](std::int32_t other, const CellStep& step) {
    const double other_length = static_cast<double>(lengths[other]);
    const double unit = step.fine_level > level ? 0.25 : 0.5;  // halves of the smaller cell, in edges of this one
    smallest = std::min(smallest, other_length);
    largest = std::max(largest, other_length);
    fit.add(unit * step.x, unit * step.y, unit * step.z, other_length - length);
  });
  CellLength cell{static_cast<float>(length), {0, 0, 0}, static_cast<float>(largest)};
  if (!(length > smallest)) return cell;
  const double edge = octree.cell_edge(level);
  Vec3 gradient = fit.solve() / edge;
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
CellLengths bounded_lengths(std::span<const float> stored_length, std::span<const std::int32_t> stored_cause, float max_length) {
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

}  // namespace

ProlongedLengths prolong(const OctreeView& octree, std::span<const float> stored_length, std::span<const std::int32_t> stored_cause,
                         const ProlongOptions& options) {
  CellLengths lengths = bounded_lengths(stored_length, stored_cause, static_cast<float>(options.max_length));
  const Neighbours neighbours(octree);
  pass_lengths(octree, neighbours, options.slope, lengths);
  ProlongedLengths result;
  result.cells.resize(lengths.length.size());
  for (std::int32_t leaf = 0; leaf < octree.n_leaves(); ++leaf)
    result.cells[leaf] = fit_cell(octree, neighbours, lengths.length, leaf, options.slope);
  result.cause = std::move(lengths.cause);
  return result;
}

}  // namespace st
