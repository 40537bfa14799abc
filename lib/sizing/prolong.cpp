#include "sizing/prolong.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/assert.h"

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
  LengthBuckets buckets(*std::min_element(lengths.begin(), lengths.end()), max_length);
  const StepWeights weight(octree.edge, options.slope);
  std::vector<std::uint8_t> is_waiting(lengths.size(), 0);
  for (std::size_t leaf = 0; leaf < lengths.size(); ++leaf)
    if (lengths[leaf] < max_length) {
      buckets.push(lengths[leaf], static_cast<std::int32_t>(leaf));
      is_waiting[leaf] = 1;
    }
  for (std::size_t b = 0; b < buckets.size(); ++b) {
    for (std::size_t i = 0; i < buckets[b].size(); ++i) {  // grows while cells of this bucket are improved again
      const std::int32_t leaf = buckets[b][i];
      if (!is_waiting[leaf]) continue;
      is_waiting[leaf] = 0;
      const float length = lengths[leaf];
      neighbours.for_each_across_face(leaf, [&](std::int32_t other, const CellStep& step) {
        const std::size_t o = static_cast<std::size_t>(other);
        const float limit = length + weight(step);
        if (limit >= lengths[o]) return;
        lengths[o] = limit;
        is_waiting[o] = 1;
        buckets.push(limit, other);
      });
    }
    std::vector<std::int32_t>().swap(buckets[b]);
  }
  return lengths;
}

}  // namespace st
