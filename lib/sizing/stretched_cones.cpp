#include "sizing/stretched_cones.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "base/limits.h"
#include "sizing/cone_cell.h"

namespace st {
namespace {

constexpr float kClearly = 0.99F;  // of the length along that is known: less is no gain

class StretchSpread {
 public:
  StretchSpread(const Neighbours& neighbours, std::span<const LengthSample> samples, std::span<const float> slope,
                const Blanking* blanking, ConeTable& table)
      : neighbours_(neighbours), octree_(neighbours.octree()), blanking_(blanking), samples_(samples), table_(table) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      cones_.emplace_back(samples[i], slope[i], octree_.lo);
      stretch_.emplace_back(samples[i].stretch);
    }
  }

  void run() {
    for (const std::int32_t sample : table_.sample) table_.stretch.push_back(stretch_[sample]);
    find_sites();
    std::vector<std::int32_t> order(samples_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [](std::int32_t a, std::int32_t b) { return round_of(a) < round_of(b); });
    for (const std::int32_t sample : order) spread(sample);
    store();
  }

 private:
  /// A site where some probe has a stretched length.
  struct Site {
    ConeCell cell;
    Lengths best;                      // smallest length along at the probes; below all where nothing is stretched
    float unit[3] = {0, 0, 0};         // the direction of all of these, if it is one
    std::int32_t turns = kNone;        // else into turns_
    std::array<Int4, kGroups> winner;  // the sample of `best`; kNone: a cone of the site
  };
  /// The directions of the cones that tell the lengths at the probes.
  using Directions = std::array<std::array<Float4, 3>, kGroups>;
  using SitesOf = std::vector<std::vector<std::int32_t>>;

  /// In eight rounds each sample takes its turn, those of a round far from each other: so few sites are lowered again
  /// and again, as they are where sample after sample comes nearer.
  static std::uint32_t round_of(std::int32_t sample) {
    return static_cast<std::uint32_t>(sample) * 0x9E3779B1U >> 29;  // golden ratio: neighbours fall far apart
  }

  std::int32_t n_sites() const { return static_cast<std::int32_t>(table_.first.size()) - 1; }
  std::int32_t leaf_of(std::int32_t site) const {
    return site < octree_.n_leaves() ? site : blanking_->split_leaf[site - octree_.n_leaves()];
  }
  std::span<const std::int32_t> cones_of(std::int32_t site) const {
    return std::span(table_.of_site).subspan(table_.first[site], table_.first[site + 1] - table_.first[site]);
  }

  void find_sites() {
    slot_.assign(static_cast<std::size_t>(n_sites()), kNone);
    for (std::int32_t site = 0; site < n_sites(); ++site) {
      const auto own = cones_of(site);
      if (std::none_of(own.begin(), own.end(), [&](std::int32_t c) { return table_.stretch[c].along > 0; })) continue;
      slot_[site] = static_cast<std::int32_t>(sites_.size());
      sites_.push_back(make_site(site));
    }
    starts_.resize(samples_.size());
    for (std::int32_t site = 0; site < n_sites(); ++site)
      for (const std::int32_t c : cones_of(site)) starts_[table_.sample[c]].push_back(site);
    for_each_own_site(neighbours_, samples_, blanking_,
                      [&](std::int32_t site, std::int32_t sample) { starts_[sample].push_back(site); });
  }

  Site make_site(std::int32_t site) {
    Site s;
    s.cell = ConeCell(octree_, leaf_of(site));
    s.winner.fill(Int4{} + kNone);
    const std::array<Int4, kGroups> told_by = winners_at_probes(site, s.cell);
    Directions directions{};
    for (int g = 0; g < kGroups; ++g)
      for (int i = 0; i < 4; ++i) {
        const ConeStretch stretch = told_by[g][i] == kNone ? ConeStretch() : table_.stretch[told_by[g][i]];
        s.best[g][i] = stretch.along > 0 ? kInfinity : -kInfinity;
        for (int k = 0; k < 3; ++k) directions[g][k][i] = stretch.direction[k];
        if (stretch.along > 0) note_direction(stretch, s);
      }
    if (s.turns != kNone) turns_.push_back(directions);
    for (const std::int32_t c : cones_of(site)) {
      const Lengths along = lengths_along(s, table_.cone[c], table_.stretch[c]);
      for (int g = 0; g < kGroups; ++g) s.best[g] = min_of(s.best[g], along[g]);
    }
    return s;
  }

  /// Which cones tell the lengths there; kNone: the largest length.
  std::array<Int4, kGroups> winners_at_probes(std::int32_t site, const ConeCell& cell) const {
    Lengths least;
    least.fill(four(kInfinity));
    std::array<Int4, kGroups> winner;
    winner.fill(Int4{} + kNone);
    for (const std::int32_t c : cones_of(site)) {
      const Lengths lengths = cell.lengths(kernels_, table_.cone[c]);
      for (int g = 0; g < kGroups; ++g) {
        winner[g] = lengths[g] < least[g] ? Int4{} + c : winner[g];
        least[g] = min_of(lengths[g], least[g]);
      }
    }
    return winner;
  }

  void note_direction(const ConeStretch& stretch, Site& s) const {
    const bool is_first = s.unit[0] == 0 && s.unit[1] == 0 && s.unit[2] == 0;
    for (int k = 0; k < 3; ++k) {
      if (is_first) s.unit[k] = stretch.direction[k];
      if (s.unit[k] != stretch.direction[k]) s.turns = static_cast<std::int32_t>(turns_.size());
    }
  }

  Lengths lengths_along(const Site& s, const Cone& cone, const ConeStretch& stretch) const {
    Lengths lengths = s.cell.lengths(kernels_, cone);
    if (!(stretch.along > cone.length)) return lengths;
    if (s.turns == kNone) {
      const float longer = stretch.length_in(s.unit, cone.length) - cone.length;
      for (Float4& four_lengths : lengths) four_lengths += longer;
      return lengths;
    }
    const float ratio = cone.length / stretch.along, squeeze = 1 - ratio * ratio;
    for (int g = 0; g < kGroups; ++g) {
      const auto& d = turns_[s.turns][g];
      const Float4 part = d[0] * stretch.direction[0] + d[1] * stretch.direction[1] + d[2] * stretch.direction[2];
      lengths[g] += cone.length / root_of(1 - squeeze * min_of(part * part, four(1))) - cone.length;
    }
    return lengths;
  }

  /// Over sites where the sample tells the length along, or nearly.
  void spread(std::int32_t sample) {
    if (++n_spread_; seen_.empty()) seen_.assign(static_cast<std::size_t>(n_sites()), 0);
    waiting_ = starts_[sample];
    for (const std::int32_t site : waiting_) {
      if (seen_[site] == n_spread_) continue;
      seen_[site] = n_spread_;
      if (slot_[site] != kNone) offer(sites_[slot_[site]], sample);
    }
    while (!waiting_.empty()) {
      const std::int32_t site = waiting_.back();
      waiting_.pop_back();
      visit_beside(site, [&](std::int32_t other) {
        if (seen_[other] == n_spread_) return;
        seen_[other] = n_spread_;
        if (slot_[other] != kNone && offer(sites_[slot_[other]], sample)) waiting_.push_back(other);
      });
    }
  }

  template <class F>
  void visit_beside(std::int32_t site, const F& f) const {
    if (!blanking_ || blanking_->site_links[site] == kNone)
      neighbours_.for_each_across_face(site, [&](std::int32_t other, const CellStep&) { f(other); });
    else
      for_each_link_across_face(*blanking_, neighbours_, site, [&](std::int32_t other, const CellStep&) { f(other); });
  }

  /// Whether it leads on.
  bool offer(Site& s, std::int32_t sample) const {
    constexpr float kNearly = 1.002F;  // of the length along: where directions turn, it may win further on
    const Lengths along = lengths_along(s, cones_[sample], stretch_[sample]);
    if (is_below(along, kClearly, s.best))
      for (int g = 0; g < kGroups; ++g) {
        s.winner[g] = along[g] < s.best[g] ? Int4{} + sample : s.winner[g];
        s.best[g] = min_of(s.best[g], along[g]);
      }
    return is_below(along, kNearly, s.best);
  }

  /// What wins and is no cone of the site already.
  void store() {
    std::vector<std::int32_t> number(samples_.size(), kNone);
    for (std::size_t c = 0; c < table_.sample.size(); ++c) number[table_.sample[c]] = static_cast<std::int32_t>(c);
    table_.first_along.push_back(0);
    for (std::int32_t site = 0; site < n_sites(); ++site) {
      if (slot_[site] != kNone) store_winners(site, number);
      require_countable(table_.along_of_site.size(), "lengths along in cells");
      table_.first_along.push_back(static_cast<std::int32_t>(table_.along_of_site.size()));
    }
  }

  void store_winners(std::int32_t site, std::vector<std::int32_t>& number) {
    std::vector<std::int32_t> winners;
    for (const Int4& four_winners : sites_[slot_[site]].winner)
      for (int i = 0; i < 4; ++i)
        if (four_winners[i] != kNone) winners.push_back(four_winners[i]);
    std::sort(winners.begin(), winners.end(), [&](std::int32_t a, std::int32_t b) {
      return cones_[a].length != cones_[b].length ? cones_[a].length < cones_[b].length : a < b;
    });
    winners.erase(std::unique(winners.begin(), winners.end()), winners.end());
    const auto own = cones_of(site);
    for (const std::int32_t sample : winners) {
      if (number[sample] == kNone) {
        number[sample] = static_cast<std::int32_t>(table_.cone.size());
        table_.cone.push_back(cones_[sample]);
        table_.cause.push_back(samples_[sample].cause);
        table_.sample.push_back(sample);
        table_.stretch.push_back(stretch_[sample]);
      }
      if (std::find(own.begin(), own.end(), number[sample]) == own.end())
        table_.along_of_site.push_back(number[sample]);
    }
  }

  static constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Neighbours& neighbours_;
  const OctreeView& octree_;
  const Blanking* const blanking_;
  const ConeKernels& kernels_ = cone_kernels();
  const std::span<const LengthSample> samples_;
  ConeTable& table_;
  std::vector<Cone> cones_;           // [n_samples]
  std::vector<ConeStretch> stretch_;  // [n_samples]
  std::vector<std::int32_t> slot_;    // [n_sites] into sites_; kNone: nothing is stretched there
  std::vector<Site> sites_;
  std::vector<Directions> turns_;
  SitesOf starts_;                  // [n_samples] sites where a sample tells a length or lies
  std::vector<std::int32_t> seen_;  // [n_sites] by which spread last
  std::vector<std::int32_t> waiting_;
  std::int32_t n_spread_ = 0;
};

}  // namespace

void add_stretch(const Neighbours& neighbours, std::span<const LengthSample> samples, std::span<const float> slope,
                 const Blanking* blanking, ConeTable& table) {
  if (std::none_of(samples.begin(), samples.end(), [](const LengthSample& s) { return s.stretch.along > 0; })) return;
  StretchSpread(neighbours, samples, slope, blanking, table).run();
}

}  // namespace st
