#include "sizing/cone_faces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "base/limits.h"
#include "base/parallel_reserve.h"
#include "base/threads.h"
#include "sizing/cone_site.h"

namespace st {
namespace {

constexpr std::int32_t kManyCones = 24;  // of both cells: more places of their face are looked at

/// In rounds: what a round finds depends on what was there before it, and is added after it. So the result does not
/// depend on the number of threads.
class FaceAgreement {
 public:
  FaceAgreement(const SiteGraph& sites, std::span<const Cone> cones, float largest, SiteSamples samples)
      : sites_(sites), cones_(cones), largest_(largest), samples_(std::move(samples)), more_(sites.cell.size()) {}

  SiteSamples run() {
    constexpr std::size_t kSitesPerPiece = 2'048;
    add_what(sites_.cell.size(), kSitesPerPiece,
             [this](std::size_t begin, std::size_t end, std::vector<SiteSample>& found) {
               FaceScratch scratch;
               for (std::size_t site = begin; site < end; ++site)
                 settle_faces(static_cast<std::int32_t>(site), scratch, found);
             });
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
  struct More {
    std::int32_t last = kNone;  // of the samples that were added, into links_
    std::int32_t n = 0;
  };
  struct FaceScratch {
    std::vector<FaceCone> on_face;
    std::vector<float> lengths;
  };

  /// Adds what find(begin, end, found) finds for pieces of [0, n), in their order.
  template <class F>
  void add_what(std::size_t n, std::size_t n_per_piece, const F& find) {
    std::vector<std::vector<SiteSample>> found((n + n_per_piece - 1) / n_per_piece);
    parallel_for(n, n_per_piece,
                 [&](std::size_t begin, std::size_t end) { find(begin, end, found[begin / n_per_piece]); });
    for (const std::vector<SiteSample>& piece : found)
      for (const SiteSample& a : piece)
        if (!has(a.site, a.sample)) add(a);
  }

  void settle_faces(std::int32_t site, FaceScratch& scratch, std::vector<SiteSample>& found) const {
    for (const SiteBeside& b : sites_.beside_of(site)) {
      if (!is_looked_at(site, b.site)) continue;
      const bool is_both = sites_.leads(b.site, site);  // else lengths pass one way
      if (!is_both || site < b.site) settle(site, b.site, is_both ? kBothWays : kToSecond, scratch, found);
    }
  }

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

  /// Those that a site had at first.
  std::span<const std::int32_t> own_samples(std::int32_t site) const {
    return std::span(samples_.sample).subspan(samples_.first[site], samples_.first[site + 1] - samples_.first[site]);
  }

  /// Both sites' cones, each once. Whether any is of one site alone.
  bool gather(std::int32_t a, std::int32_t b, std::vector<FaceCone>& on_face) const {
    const std::span<const std::int32_t> first = own_samples(a);
    on_face.clear();
    for (const std::int32_t s : first) on_face.push_back({s, 1});
    std::size_t n_both = 0;
    for (const std::int32_t s : own_samples(b)) {
      const auto at = std::find(first.begin(), first.end(), s);
      if (at == first.end()) {
        on_face.push_back({s, 2});
      } else {
        on_face[static_cast<std::size_t>(at - first.begin())].of = 3;
        ++n_both;
      }
    }
    return n_both < on_face.size();
  }

  void settle(std::int32_t a, std::int32_t b, std::int32_t ways, FaceScratch& scratch,
              std::vector<SiteSample>& found) const {
    std::vector<FaceCone>& on_face = scratch.on_face;
    if (!gather(a, b, on_face)) return;
    const auto n = static_cast<std::int32_t>(on_face.size());
    scratch.lengths.resize(std::max(scratch.lengths.size(), on_face.size() * kFacePlaces));
    const ConeFace face = face_of(a, b);
    const std::int32_t n_sets = n > kManyCones ? kFaceSets : 1;
    for (std::int32_t set = 0; set < n_sets; ++set) {
      if (kernels_.settle_face(face, set, cones_.front().numbers(), largest_, ways, on_face.data(), n,
                               scratch.lengths.data()) == 0)
        continue;
      for (FaceCone& c : on_face) {
        if (c.added == 0) continue;
        found.push_back({c.added == 1 ? a : b, c.sample});
        c.added = 0;
      }
    }
  }

  void add(const SiteSample& a) {
    const auto [site, sample] = a;
    More& more = more_[site];
    links_.push_back({sample, more.last});
    more = {static_cast<std::int32_t>(links_.size()) - 1, more.n + 1};
    added_.push_back(a);
    const float(&c)[3] = sites_.cell[site].c;
    const auto length = static_cast<float>(cones_[sample].length_at({c[0], c[1], c[2]}));
    if (!(length < samples_.center_length[site])) return;
    samples_.center_length[site] = length;
    samples_.at_center[site] = sample;
    lowered_.push_back(site);
  }

  bool has(std::int32_t site, std::int32_t sample) const {
    const std::span<const std::int32_t> own = own_samples(site);
    if (std::find(own.begin(), own.end(), sample) != own.end()) return true;
    std::int32_t k = more_[site].last;
    while (k != kNone && links_[k].sample != sample) k = links_[k].next;
    return k != kNone;
  }

  /// Those that were added, on to the sites beside.
  void pass_on() {
    constexpr std::size_t kAddedPerPiece = 1'024;
    while (!added_.empty()) {
      const std::vector<SiteSample> all = std::exchange(added_, {});
      add_what(all.size(), kAddedPerPiece, [&](std::size_t begin, std::size_t end, std::vector<SiteSample>& found) {
        for (std::size_t i = begin; i < end; ++i) {
          const auto [site, sample] = all[i];
          for (const SiteBeside& b : sites_.beside_of(site))
            if (is_looked_at(site, b.site) && !has(b.site, sample) && wins_on_face(site, b.site, sample))
              found.push_back({b.site, sample});
        }
      });
    }
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
                           more_[to].last};
    const ConeFace face = face_of(from, to);
    for (std::int32_t set = 0; set < (n > kManyCones ? kFaceSets : 1); ++set)
      if (kernels_.wins_on_face(face, set, cones_[sample].numbers(), largest_, known)) return true;
    return false;
  }

  /// So that no step to the centre of a cell that touches passes the slope, but where no length may pass.
  void settle_centers() {
    constexpr std::size_t kLoweredPerPiece = 4'096;
    const std::vector<std::int32_t> lowered = std::exchange(lowered_, {});
    add_what(lowered.size(), kLoweredPerPiece, [&](std::size_t begin, std::size_t end, std::vector<SiteSample>& found) {
      for (std::size_t i = begin; i < end; ++i)
        if (const std::int32_t site = lowered[i]; samples_.at_center[site] != kNone)
          settle_centers_around(site, site, 1, found);
    });
  }

  /// Of the cells beside `at`, which is `site` or touches it. Those across edges and corners are found by ways that
  /// rise, each along the axes in order: `least` is the first side (see SiteBeside) by which the way may go on.
  void settle_centers_around(std::int32_t site, std::int32_t at, std::int32_t least,
                             std::vector<SiteSample>& found) const {
    const std::int32_t sample = samples_.at_center[site];
    const float length = samples_.center_length[at];
    for (const SiteBeside& b : sites_.beside_of(at)) {
      if (b.towards < least || !(samples_.center_length[b.site] > length)) continue;
      if (at != site && (b.towards == SiteBeside::kAlways || !touches(site, b.site))) continue;
      if (is_too_steep(site, b.site) && !has(b.site, sample)) found.push_back({b.site, sample});
      constexpr std::int32_t kLowerOfY = 1 << 2, kLowerOfZ = 1 << 4;
      if (b.towards < kLowerOfZ)
        settle_centers_around(site, b.site, b.towards < kLowerOfY ? kLowerOfY : kLowerOfZ, found);
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

  /// What each site had and what was added, the last first.
  SiteSamples joined() {
    constexpr std::size_t kSitesPerPiece = 4'096;
    const std::size_t n = sites_.cell.size();
    SiteSamples all;
    all.first.assign(n + 1, 0);
    require_countable(samples_.sample.size() + links_.size(), "lengths of samples in cells");
    for (std::size_t site = 0; site < n; ++site)
      all.first[site + 1] = all.first[site] + samples_.first[site + 1] - samples_.first[site] + more_[site].n;
    parallel_reserve(all.sample, samples_.sample.size() + links_.size());
    all.sample.resize(samples_.sample.size() + links_.size());
    parallel_for(n, kSitesPerPiece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t site = begin; site < end; ++site) {
        auto to =
            std::ranges::copy(own_samples(static_cast<std::int32_t>(site)), all.sample.begin() + all.first[site]).out;
        for (std::int32_t k = more_[site].last; k != kNone; k = links_[k].next) *to++ = links_[k].sample;
      }
    });
    all.at_center = std::move(samples_.at_center);
    all.center_length = std::move(samples_.center_length);
    return all;
  }

  const SiteGraph& sites_;
  const std::span<const Cone> cones_;
  const float largest_;
  const ConeKernels& kernels_ = cone_kernels();
  SiteSamples samples_;
  std::vector<More> more_;  // [n_sites]
  std::vector<SampleLink> links_;
  std::vector<SiteSample> added_;
  std::vector<std::int32_t> lowered_;  // sites whose length at the centre is lower than when it was looked at
};

}  // namespace

std::vector<std::int32_t> used_samples(const SiteSamples& kept, std::size_t n_samples) {
  constexpr std::size_t kSitesPerPiece = 16'384;  // more where there are more samples: each piece marks all of them
  const std::size_t n = kept.at_center.size(), n_per_piece = std::max(kSitesPerPiece, n_samples);
  const auto add_new = [&](std::span<const std::int32_t> samples, std::vector<std::int32_t>& used) {
    std::vector<std::uint8_t> is_used(n_samples, 0);
    for (const std::int32_t s : samples)
      if (!std::exchange(is_used[s], 1)) used.push_back(s);
  };
  std::vector<std::vector<std::int32_t>> pieces((n + n_per_piece - 1) / n_per_piece);
  parallel_for(n, n_per_piece, [&](std::size_t begin, std::size_t end) {
    add_new(std::span(kept.sample).subspan(kept.first[begin], kept.first[end] - kept.first[begin]),
            pieces[begin / n_per_piece]);
  });
  std::vector<std::int32_t> all, used;
  for (const std::vector<std::int32_t>& piece : pieces) all.insert(all.end(), piece.begin(), piece.end());
  add_new(all, used);
  return used;
}

SiteSamples agree_on_faces(const SiteGraph& sites, std::span<const Cone> cones, float largest, SiteSamples samples) {
  if (cones.empty()) return samples;
  return FaceAgreement(sites, cones, largest, std::move(samples)).run();
}

}  // namespace st
