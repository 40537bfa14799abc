#include "sizing/stretched_cells.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "sizing/size_field.h"

namespace st {
namespace {

/// Requested length in direction `t` where `across` is requested but along `direction` (zero: nowhere else).
double length_in(Vec3 t, double across, double along, Vec3 direction) {
  return LocalSize{across, along, direction}.in(t);
}

class StretchProlongation {
 public:
  StretchProlongation(const Neighbours& neighbours, std::span<const LengthSample> samples,
                      const ProlongedLengths& lengths, const ProlongOptions& options, double max_aspect,
                      const Blanking* blanking)
      : octree_(neighbours.octree()),
        neighbours_(neighbours),
        samples_(samples),
        options_(options),
        max_aspect_(max_aspect),
        blanking_(blanking) {
    for (const auto* cells : {&lengths.cells, &lengths.second_cells})
      for (const CellLength& cell : *cells) across_.push_back(cell.at_centre());
    for (std::int32_t leaf = 0; leaf < octree_.n_leaves(); ++leaf) centre_.push_back(octree_.leaf_center(leaf));
    for (std::size_t k = centre_.size(); k < across_.size(); ++k)
      centre_.push_back(centre_[blanking_->split_leaf[k - octree_.n_leaves()]]);
  }

  StretchedCells run(std::span<const float> stored_length) {
    find_directions(stored_length);
    seed(stored_length);
    pass();
    StretchedCells result;
    for (const Vec3& d : direction_) result.direction.push_back(d == Vec3{} ? SmallNormal() : SmallNormal(d));
    result.along = fit_gradients(neighbours_, along_, options_, blanking_);
    return result;
  }

 private:
  /// The direction of the sample that the length of a site goes back to.
  void find_directions(std::span<const float> stored_length) {
    const auto n_samples = static_cast<std::int32_t>(samples_.size());
    std::vector<std::int32_t> origin(stored_length.size(), n_samples);
    for_each_seed(neighbours_, samples_, blanking_, [&](std::int32_t site, std::int32_t sample) {
      const LengthSample& s = samples_[sample];
      const auto length = static_cast<float>(s.length + options_.slope * distance(s.xyz, centre_[site]));
      if (length == stored_length[site]) origin[site] = std::min(origin[site], sample);
    });
    const std::vector<std::int32_t> label = spread_labels(neighbours_, stored_length, origin, options_, blanking_);
    for (const std::int32_t from : label) {
      const bool has_one = from != kNone && from < n_samples && samples_[from].stretch.along > 0;
      direction_.push_back(has_one ? normalized(Vec3(samples_[from].stretch.direction)) : Vec3{});
    }
  }

  /// What samples allow at the sites that they concern.
  void seed(std::span<const float> stored_length) {
    along_.resize(across_.size());
    for (std::size_t site = 0; site < along_.size(); ++site)
      along_[site] = direction_[site] == Vec3{}
                         ? across_[site]
                         : static_cast<float>(std::min(options_.max_length, max_aspect_ * across_[site]));
    std::vector<float> known(along_.size(), std::numeric_limits<float>::infinity());
    for_each_seed(neighbours_, samples_, blanking_, [&](std::int32_t site, std::int32_t sample) {
      const LengthSample& s = samples_[sample];
      const double rise = options_.slope * distance(s.xyz, centre_[site]);
      known[site] = std::min(known[site], static_cast<float>(s.length + rise));
      limit(site, s.length, s.stretch, rise);
    });
    for (std::size_t site = 0; site < along_.size(); ++site)
      if (stored_length[site] < known[site]) lower(static_cast<std::int32_t>(site), stored_length[site]);
  }

  /// By what is asked for at a distance that lengths grow over by `rise`.
  void limit(std::int32_t site, double length, const SampleStretch& stretch, double rise) {
    if (direction_[site] == Vec3{}) return;
    const Vec3 own = stretch.along > 0 ? normalized(Vec3(stretch.direction)) : Vec3{};
    lower(site, length_in(direction_[site], length, std::max<double>(length, stretch.along), own) + rise);
  }

  bool lower(std::int32_t site, double length) {
    const float value = std::max(static_cast<float>(length), across_[site]);
    if (!(value < along_[site])) return false;
    along_[site] = value;
    return true;
  }

  /// The largest lengths that fit: each step lowers, and none undershoots what any order of steps comes to.
  void pass() {
    std::deque<std::int32_t> queue;
    std::vector<std::uint8_t> is_waiting(along_.size(), 1);
    for (std::size_t site = 0; site < along_.size(); ++site) queue.push_back(static_cast<std::int32_t>(site));
    std::stable_sort(queue.begin(), queue.end(), [&](std::int32_t a, std::int32_t b) { return along_[a] < along_[b]; });
    while (!queue.empty()) {
      const std::int32_t from = queue.front();
      queue.pop_front();
      is_waiting[from] = 0;
      for_each_link(blanking_, neighbours_, from, [&](std::int32_t to, const CellStep&) {
        if (direction_[to] == Vec3{}) return;
        const double rise = options_.slope * distance(centre_[from], centre_[to]);
        if (!lower(to, length_in(direction_[to], across_[from], along_[from], direction_[from]) + rise)) return;
        if (!is_waiting[to]) queue.push_back(to);
        is_waiting[to] = 1;
      });
    }
  }

  const OctreeView& octree_;
  const Neighbours& neighbours_;
  std::span<const LengthSample> samples_;
  const ProlongOptions& options_;
  const double max_aspect_;
  const Blanking* blanking_;
  std::vector<Vec3> centre_;     // [n_sites]
  std::vector<float> across_;    // [n_sites] at the centre
  std::vector<float> along_;     // [n_sites]
  std::vector<Vec3> direction_;  // [n_sites]
};

}  // namespace

StretchedCells prolong_stretch(const Neighbours& neighbours, std::span<const LengthSample> samples,
                               std::span<const float> stored_length, const ProlongedLengths& lengths,
                               const ProlongOptions& options, double max_aspect, const Blanking* blanking) {
  return StretchProlongation(neighbours, samples, lengths, options, max_aspect, blanking).run(stored_length);
}

}  // namespace st
