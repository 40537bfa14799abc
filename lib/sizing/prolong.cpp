#include "sizing/prolong.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <span>

#include "base/assert.h"
#include "base/threads.h"

namespace st {
namespace {

constexpr int kLargestStep2 = 27;

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

/// A cell that has got this length, and passes it on unless it has got a smaller one since.
struct Lowered {
  std::int32_t leaf;
  float length;
};

/// Cells to be looked at, in rising order of length in steps of 1/8 octave. The order is for speed only: the result
/// does not depend on it.
class LengthBuckets {
 public:
  LengthBuckets(float smallest, float largest)
      : first_(bucket_bits(smallest)), buckets_(bucket_bits(largest) - first_ + 1) {}
  void push(const Lowered& cell) { buckets_[bucket_bits(cell.length) - first_].push_back(cell); }
  std::size_t size() const { return buckets_.size(); }
  void move_to(std::vector<Lowered>& all, std::size_t b) {
    all.insert(all.end(), buckets_[b].begin(), buckets_[b].end());
    std::vector<Lowered>().swap(buckets_[b]);
  }

 private:
  // The bits of positive floats order like their values; 20 dropped bits leave exponent and 3 bits of mantissa.
  static std::size_t bucket_bits(float length) { return std::bit_cast<std::uint32_t>(length) >> 20; }
  std::size_t first_;
  std::vector<std::vector<Lowered>> buckets_;
};

/// Whether `limit` was less. Other threads may do the same.
bool lower(float& length, float limit) {
  const std::atomic_ref<float> shared(length);
  for (float now = shared.load(std::memory_order_relaxed); limit < now;)
    if (shared.compare_exchange_weak(now, limit, std::memory_order_relaxed)) return true;
  return false;
}

/// From these cells to those across their faces; those that get a smaller one become `lowered`.
void pass_on(const Neighbours& neighbours, const StepWeights& weight, std::span<const Lowered> cells,
             std::span<float> lengths, LengthBuckets& lowered) {
  for (const Lowered& cell : cells) {
    if (std::atomic_ref(lengths[cell.leaf]).load(std::memory_order_relaxed) < cell.length) continue;
    neighbours.for_each_across_face(cell.leaf, [&](std::int32_t other, const CellStep& step) {
      const float limit = cell.length + weight(step);
      if (lower(lengths[other], limit)) lowered.push({other, limit});
    });
  }
}

}  // namespace

// Label-correcting shortest paths: start from every cell with a stored length, pass length + slope * distance on until
// nothing changes.
std::vector<float> prolong(const Neighbours& neighbours, std::span<const float> stored_length,
                           const ProlongOptions& options) {
  const OctreeView& octree = neighbours.octree();
  ST_ASSERT(stored_length.size() == octree.leaf_keys.size() && options.slope > 0 && options.max_length > 0);
  const auto max_length = static_cast<float>(options.max_length);
  std::vector<float> lengths(stored_length.begin(), stored_length.end());
  for (float& length : lengths) length = std::min(length, max_length);
  constexpr std::size_t kShares = 8, kLeastShare = 256;  // of the cells of a bucket
  std::vector<LengthBuckets> shares(kShares, {*std::min_element(lengths.begin(), lengths.end()), max_length});
  const StepWeights weight(octree.edge, options.slope);
  for (std::size_t leaf = 0; leaf < lengths.size(); ++leaf)
    if (lengths[leaf] < max_length) shares.front().push({static_cast<std::int32_t>(leaf), lengths[leaf]});
  std::vector<Lowered> cells;
  for (std::size_t b = 0; b < shares.front().size();) {
    cells.clear();
    for (LengthBuckets& own : shares) own.move_to(cells, b);
    if (cells.empty()) ++b;  // else cells of this bucket may be lowered again
    const std::size_t share = std::max(kLeastShare, (cells.size() + kShares - 1) / kShares);
    parallel_for(cells.size(), share, [&](std::size_t begin, std::size_t end) {
      pass_on(neighbours, weight, std::span(cells).subspan(begin, end - begin), lengths, shares[begin / share]);
    });
  }
  return lengths;
}

}  // namespace st
