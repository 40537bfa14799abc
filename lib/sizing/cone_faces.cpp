#include "sizing/cone_faces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "base/limits.h"

namespace st {
namespace {

constexpr std::int32_t kManyCones = 24;  // of both cells: more places of their face are looked at

class FaceAgreement {
 public:
  FaceAgreement(const SiteGraph& sites, std::span<const Cone> cones, float largest, SiteSamples samples)
      : sites_(sites),
        cones_(cones),
        largest_(largest),
        samples_(std::move(samples)),
        more_(sites.cell.size(), kNone),
        seen_(cones.size(), kNone) {}

  SiteSamples run() {
    const auto n = static_cast<std::int32_t>(sites_.cell.size());
    for (std::int32_t site = 0; site < n; ++site)
      for (const SiteBeside& b : sites_.beside_of(site)) {
        if (!is_looked_at(site, b.site)) continue;
        const bool is_both = sites_.leads(b.site, site);  // else lengths pass one way
        if (!is_both || site < b.site) settle(site, b.site, is_both ? kBothWays : kToSecond);
      }
    pass_on();
    lowered_.resize(sites_.cell.size());
    std::iota(lowered_.begin(), lowered_.end(), 0);
    while (!lowered_.empty()) {
      settle_centers();
      pass_on();
    }
    return joined();
  }

 private:
  static constexpr std::int32_t kToSecond = 1, kToFirst = 2, kBothWays = kToSecond | kToFirst;
  struct Added {
    std::int32_t site, sample;
  };

  bool is_looked_at(std::int32_t a, std::int32_t b) const {
    return (sites_.holds_sample[a] | sites_.holds_sample[b]) != 0;
  }

  /// The common face of two sites, as the kernels want it.
  ConeFace face_of(std::int32_t a, std::int32_t b) const {
    const ConeCell &first = sites_.cell[a], &second = sites_.cell[b],
                   &small = second.half < first.half ? second : first, &large = &small == &first ? second : first;
    ConeFace face{{small.c[0], small.c[1], small.c[2]}, small.half, 0};
    for (int k = 1; k < 3; ++k)
      if (std::abs(large.c[k] - small.c[k]) > std::abs(large.c[face.axis] - small.c[face.axis])) face.axis = k;
    face.c[face.axis] += large.c[face.axis] > small.c[face.axis] ? small.half : -small.half;
    return face;
  }

  template <class F>
  void for_each_sample(std::int32_t site, const F& f) const {
    for (std::int32_t i = samples_.first[site]; i < samples_.first[site + 1]; ++i) f(samples_.sample[i]);
    for (std::int32_t k = more_[site]; k != kNone; k = links_[k].next) f(links_[k].sample);
  }

  /// Both sites' cones, each once. Whether any is of one site alone.
  bool gather(std::int32_t a, std::int32_t b) {
    on_face_.clear();
    const auto take = [&](std::int32_t site, const auto& is_new) {
      const std::size_t before = on_face_.size();
      const std::int32_t begin = samples_.first[site], end = samples_.first[site + 1];
      on_face_.resize(before + static_cast<std::size_t>(end - begin));
      FaceCone* out = on_face_.data() + before;
      for (std::int32_t i = begin; i < end; ++i) {
        *out = {samples_.sample[i], site == a ? 1 : 2};
        out += is_new(samples_.sample[i], static_cast<std::size_t>(out - on_face_.data()));
      }
      on_face_.resize(static_cast<std::size_t>(out - on_face_.data()));
      for (std::int32_t k = more_[site]; k != kNone; k = links_[k].next)
        if (is_new(links_[k].sample, on_face_.size())) on_face_.push_back({links_[k].sample, site == a ? 1 : 2});
    };
    take(a, [&](std::int32_t s, std::size_t at) {
      seen_[s] = static_cast<std::int32_t>(at);
      return true;
    });
    const std::size_t n_first = on_face_.size();
    std::size_t n_both = 0;
    take(b, [&](std::int32_t s, std::size_t) {
      const auto at = static_cast<std::size_t>(seen_[s]);
      if (at >= n_first || on_face_[at].sample != s) return true;
      on_face_[at].of = 3;
      ++n_both;
      return false;
    });
    return n_both < on_face_.size();
  }

  void settle(std::int32_t a, std::int32_t b, std::int32_t ways) {
    if (!gather(a, b)) return;
    const auto n = static_cast<std::int32_t>(on_face_.size());
    lengths_.resize(std::max(lengths_.size(), on_face_.size() * kFacePlaces));
    const ConeFace face = face_of(a, b);
    const std::int32_t n_sets = n > kManyCones ? kFaceSets : 1;
    for (std::int32_t set = 0; set < n_sets; ++set) {
      if (kernels_.settle_face(face, set, cones_.front().numbers(), largest_, ways, on_face_.data(), n,
                               lengths_.data()) == 0)
        continue;
      for (FaceCone& c : on_face_) {
        if (c.added == 0) continue;
        add(c.added == 1 ? a : b, c.sample);
        c.added = 0;
      }
    }
  }

  void add(std::int32_t site, std::int32_t sample) {
    links_.push_back({sample, more_[site]});
    more_[site] = static_cast<std::int32_t>(links_.size()) - 1;
    added_.push_back({site, sample});
    const float(&c)[3] = sites_.cell[site].c;
    const auto length = static_cast<float>(cones_[sample].length_at({c[0], c[1], c[2]}));
    if (!(length < samples_.center_length[site])) return;
    samples_.center_length[site] = length;
    samples_.at_center[site] = sample;
    lowered_.push_back(site);
  }

  bool has(std::int32_t site, std::int32_t sample) const {
    const auto begin = samples_.sample.begin();
    if (std::find(begin + samples_.first[site], begin + samples_.first[site + 1], sample) !=
        begin + samples_.first[site + 1])
      return true;
    std::int32_t k = more_[site];
    while (k != kNone && links_[k].sample != sample) k = links_[k].next;
    return k != kNone;
  }

  /// Those that were added, on to the sites beside.
  void pass_on() {
    for (std::size_t i = 0; i < added_.size(); ++i) {
      const auto [site, sample] = added_[i];
      for (const SiteBeside& b : sites_.beside_of(site))
        if (is_looked_at(site, b.site) && !has(b.site, sample) && wins_on_face(site, b.site, sample))
          add(b.site, sample);
    }
    added_.clear();
  }

  /// Over the cones of `to`.
  bool wins_on_face(std::int32_t from, std::int32_t to, std::int32_t sample) const {
    const std::int32_t first = samples_.first[to], n = samples_.first[to + 1] - first;
    const KnownCones known{cones_.front().numbers(),
                           samples_.at_center[to],
                           sample,
                           samples_.sample.data() + first,
                           n,
                           links_.data(),
                           more_[to]};
    const ConeFace face = face_of(from, to);
    for (std::int32_t set = 0; set < (n > kManyCones ? kFaceSets : 1); ++set)
      if (kernels_.wins_on_face(face, set, cones_[sample].numbers(), largest_, known)) return true;
    return false;
  }

  /// So that no step to the centre of a cell that touches passes the slope, but where no length may pass.
  void settle_centers() {
    std::vector<std::int32_t> lowered = std::exchange(lowered_, {});
    for (const std::int32_t site : lowered)
      if (samples_.at_center[site] != kNone) settle_centers_around(site, site, 1);
  }

  /// Of the cells beside `at`, which is `site` or touches it. Those across edges and corners are found by ways that
  /// rise, each along the axes in order: `least` is the first side (see SiteBeside) by which the way may go on.
  void settle_centers_around(std::int32_t site, std::int32_t at, std::int32_t least) {
    const std::int32_t sample = samples_.at_center[site];
    const float length = samples_.center_length[at];
    for (const SiteBeside& b : sites_.beside_of(at)) {
      if (b.towards < least || !(samples_.center_length[b.site] > length)) continue;
      if (at != site && (b.towards == SiteBeside::kAlways || !touches(site, b.site))) continue;
      if (is_too_steep(site, b.site) && !has(b.site, sample)) add(b.site, sample);
      constexpr std::int32_t kLowerOfY = 1 << 2, kLowerOfZ = 1 << 4;
      if (b.towards < kLowerOfZ) settle_centers_around(site, b.site, b.towards < kLowerOfY ? kLowerOfY : kLowerOfZ);
    }
  }

  bool touches(std::int32_t a, std::int32_t b) const {
    const ConeCell &first = sites_.cell[a], &second = sites_.cell[b];
    // Cells that do not touch are farther apart by the smaller one. Rounding of places in a large cube is far less.
    const float reach = first.half + second.half + std::min(first.half, second.half) / 2;
    for (int k = 0; k < 3; ++k)
      if (std::abs(first.c[k] - second.c[k]) > reach) return false;
    return true;
  }

  /// Whether the step from centre to centre rises by more than the slope.
  bool is_too_steep(std::int32_t from, std::int32_t to) const {
    constexpr float kRounded = 1 + 2e-6F;
    const float slope = cones_[samples_.at_center[from]].slope * kRounded,
                rise = samples_.center_length[to] - samples_.center_length[from];
    float distance2 = 0;
    for (int k = 0; k < 3; ++k) {
      const float d = sites_.cell[to].c[k] - sites_.cell[from].c[k];
      distance2 += d * d;
    }
    return rise > 0 && rise * rise > slope * slope * distance2;
  }

  SiteSamples joined() {
    SiteSamples all;
    for (std::size_t site = 0; site < sites_.cell.size(); ++site) {
      for_each_sample(static_cast<std::int32_t>(site), [&](std::int32_t s) { all.sample.push_back(s); });
      require_countable(all.sample.size(), "lengths of samples in cells");
      all.first.push_back(static_cast<std::int32_t>(all.sample.size()));
    }
    all.at_center = std::move(samples_.at_center);
    all.center_length = std::move(samples_.center_length);
    return all;
  }

  const SiteGraph& sites_;
  const std::span<const Cone> cones_;
  const float largest_;
  const ConeKernels& kernels_ = cone_kernels();
  SiteSamples samples_;
  std::vector<std::int32_t> more_;  // [n_sites] the last sample that was added, into links_
  std::vector<SampleLink> links_;
  std::vector<Added> added_;
  std::vector<std::int32_t> lowered_;  // sites whose length at the centre is lower than when it was looked at
  std::vector<std::int32_t> seen_;     // [n_samples] where in on_face_, if anywhere
  std::vector<FaceCone> on_face_;
  std::vector<float> lengths_;
};

}  // namespace

SiteSamples agree_on_faces(const SiteGraph& sites, std::span<const Cone> cones, float largest, SiteSamples samples) {
  if (cones.empty()) return samples;
  return FaceAgreement(sites, cones, largest, std::move(samples)).run();
}

}  // namespace st
