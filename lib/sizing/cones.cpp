#include "sizing/cones.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "base/limits.h"
#include "sizing/cone_cell.h"

namespace st {
namespace {

class ConeSpread {
 public:
  ConeSpread(const Neighbours& neighbours, std::span<const LengthSample> samples, std::span<const float> slope,
             double max_length, const Blanking* blanking)
      : neighbours_(neighbours),
        octree_(neighbours.octree()),
        blanking_(blanking),
        samples_(samples),
        largest_(static_cast<float>(max_length)) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      cones_.emplace_back(samples[i], slope[i], octree_.lo);
      smallest_ = std::min(smallest_, samples[i].length);
    }
    const auto n = static_cast<std::size_t>(blanking ? blanking->n_sites() : octree_.n_leaves());
    sites_.resize(n);
    for (std::size_t site = 0; site < n; ++site) sites_[site].cell = cell_of(static_cast<std::int32_t>(site));
    for (Site& site : sites_) site.best.fill(four(largest_));
  }

  void run() {
    if (!(smallest_ < largest_)) return;
    buckets_.resize(bucket_bits(largest_) - bucket_bits(smallest_) + 1);
    for_each_own_site(neighbours_, samples_, blanking_, [&](std::int32_t site, std::int32_t sample) {
      push({site, sample, 0}, cones_[sample].length);
    });
    for (now_ = 0; now_ < buckets_.size(); ++now_) {
      for (std::size_t i = 0; i < buckets_[now_].size(); ++i) pass_on(buckets_[now_][i]);
      std::vector<Event>().swap(buckets_[now_]);
    }
    fill_rest();
  }

  ConeTable take() {
    ConeTable table;
    std::vector<std::int32_t> number(cones_.size(), kNone);
    table.first.push_back(0);
    for (std::size_t site = 0; site < sites_.size(); ++site) {
      for (const std::int32_t s : pruned(static_cast<std::int32_t>(site))) {
        if (number[s] == kNone) {
          number[s] = static_cast<std::int32_t>(table.cone.size());
          table.cone.push_back(cones_[s]);
          table.cause.push_back(samples_[s].cause);
        }
        table.of_site.push_back(number[s]);
      }
      std::sort(table.of_site.begin() + table.first.back(), table.of_site.end(), [&](std::int32_t a, std::int32_t b) {
        return table.cone[a].length != table.cone[b].length ? table.cone[a].length < table.cone[b].length : a < b;
      });
      require_countable(table.of_site.size(), "lengths of samples in cells");
      table.first.push_back(static_cast<std::int32_t>(table.of_site.size()));
    }
    return table;
  }

 private:
  struct Event {
    std::int32_t site, sample;
    std::int32_t n;  // samples of the site with it; 0: it lies there and is not taken yet
  };
  struct Entry {
    std::int32_t sample, next;
  };
  /// Two lines of the cache: what an offer needs.
  struct Site {
    static constexpr std::int32_t kOwn = 7;

    ConeCell cell;
    Lengths best;                                  // smallest at the probes
    std::int32_t n = 0;                            // its samples, in order
    std::array<std::int32_t, kOwn> own{};          // the first of them
    std::int32_t more = kNone;                     // the last of the rest, into entries_
    std::int32_t refused = kNone;                  // the last sample that was, which others may offer again
    std::pair<std::int32_t, std::int32_t> beside;  // first and after the last in beside_
  };

  ConeCell cell_of(std::int32_t site) const {
    return {octree_, site < octree_.n_leaves() ? site : blanking_->split_leaf[site - octree_.n_leaves()]};
  }

  /// Parts of cut cells that no sample came to across a face are given what is known where links lead. A part that the
  /// surface leaves no way to is given what is known around it on either side: lengths that are too small do no harm
  /// there, too large ones do.
  void fill_rest() {
    if (!blanking_) return;
    const std::int32_t n_leaves = octree_.n_leaves();
    std::vector<std::pair<std::int32_t, std::int32_t>> found;  // site, sample
    for (std::int32_t site = 0; site < blanking_->n_sites(); ++site) {
      const bool is_cut = site >= n_leaves || blanking_->colour[site] == CellColour::kCut;
      if (!is_cut || sites_[site].n > 0) continue;
      const auto take = [&](std::int32_t from) {
        any_sample(from, [&](std::int32_t sample) {
          found.push_back({site, sample});
          return false;
        });
      };
      bool has_way = false;
      for_each_link(blanking_, neighbours_, site, [&](std::int32_t to, const CellStep&) {
        has_way = true;
        take(to);
      });
      if (has_way) continue;
      const auto take_parts = [&](std::int32_t leaf) {
        take(leaf);
        if (const std::int32_t split = blanking_->find_split(leaf); split != kNone) take(n_leaves + split);
      };
      const std::int32_t leaf = site < n_leaves ? site : blanking_->split_leaf[site - n_leaves];
      take_parts(leaf);
      neighbours_.for_each(leaf, [&](std::int32_t other, const CellStep&) { take_parts(other); });
    }
    float least = 0;
    for (const auto& [site, sample] : found) offer(site, sample, least);
  }

  void pass_on(const Event e) {
    float least = 0;
    if (e.n == 0 && !offer(e.site, e.sample, least)) return;
    if (e.n != 0 && sites_[e.site].n != e.n && !is_still_best(e.site, e.sample)) return;
    const auto [first, last] = beside(e.site);
    for (std::int32_t k = first; k < last; ++k) {
      const std::int32_t other = beside_[k];
      if (offer(other, e.sample, least)) push({other, e.sample, sites_[other].n}, least);
    }
  }

  /// Where the sites begin and end in `beside_` that lie across the faces of this one: a corner that a sample wins
  /// belongs to those, too. Found when first asked for.
  std::pair<std::int32_t, std::int32_t> beside(std::int32_t site) {
    auto& [first, last] = sites_[site].beside;
    if (last > first) return {first, last};
    first = static_cast<std::int32_t>(beside_.size());
    if (!blanking_ || blanking_->site_links[site] == kNone)
      neighbours_.for_each_across_face(site, [&](std::int32_t other, const CellStep&) { beside_.push_back(other); });
    else
      for_each_link(blanking_, neighbours_, site, [&](std::int32_t other, const CellStep& step) {
        if (step.is_across_face()) beside_.push_back(other);
      });
    require_countable(beside_.size(), "cells beside cells");
    last = static_cast<std::int32_t>(beside_.size());
    return {first, last};
  }

  static std::size_t bucket_bits(float length) { return std::bit_cast<std::uint32_t>(length) >> 20; }
  void push(const Event& e, float length) {
    const std::size_t b = bucket_bits(std::min(length, largest_)) - bucket_bits(smallest_);
    buckets_[std::max(b, now_)].push_back(e);
  }

  /// Whether f(sample) is true for any sample of the site.
  template <class F>
  bool any_sample(std::int32_t site, const F& f) const {
    const Site& s = sites_[site];
    const std::int32_t n_own = std::min(s.n, Site::kOwn);
    for (std::int32_t i = 0; i < n_own; ++i)
      if (f(s.own[i])) return true;
    for (std::int32_t k = s.more; k != kNone; k = entries_[k].next)
      if (f(entries_[k].sample)) return true;
    return false;
  }

  bool has(std::int32_t site, std::int32_t sample) const {
    return any_sample(site, [sample](std::int32_t other) { return other == sample; });
  }

  /// Takes the sample where it asks for clearly less than all so far; `least`: at the probes.
  bool offer(std::int32_t site, std::int32_t sample, float& least) {
    if (sites_[site].refused == sample || has(site, sample)) return false;
    Lengths& best = sites_[site].best;
    const Lengths own = sites_[site].cell.lengths(cones_[sample]);
    const bool is_near = sites_[site].cell.is_near(cones_[sample], at_center(own));
    const float share = is_near ? kClearlyNearby : kClearly;
    if (!is_below(own, share, best) && !(is_near && wins_nearby(site, sample))) {
      sites_[site].refused = sample;
      return false;
    }
    Float4 smallest = four(largest_);
    for (int g = 0; g < kGroups; ++g) {
      smallest = min_of(smallest, own[g]);
      best[g] = min_of(best[g], own[g]);
    }
    least = least_of(smallest);
    add_sample(site, sample);
    return true;
  }

  void add_sample(std::int32_t site, std::int32_t sample) {
    Site& s = sites_[site];
    if (s.n < Site::kOwn) {
      s.own[s.n] = sample;
    } else {
      entries_.push_back({sample, s.more});
      s.more = static_cast<std::int32_t>(entries_.size()) - 1;
    }
    ++s.n;
  }

  /// Whether the sample wins where the site is close to it.
  bool wins_nearby(std::int32_t site, std::int32_t sample) const {
    return sites_[site].cell.wins_nearby(cones_[sample], largest_, [&](const auto& is_beaten_by) {
      any_sample(site, [&](std::int32_t other) { return is_beaten_by(cones_[other]); });
    });
  }

  bool is_still_best(std::int32_t site, std::int32_t sample) const {
    constexpr float kSame = 1.0001F;
    const Lengths own = sites_[site].cell.lengths(cones_[sample]);
    if (is_below(own, kSame, sites_[site].best)) return true;
    if (!sites_[site].cell.is_near(cones_[sample], at_center(own))) return false;
    return sites_[site].cell.wins_nearby(cones_[sample], largest_, [&](const auto& is_beaten_by) {
      any_sample(site, [&](std::int32_t other) { return other != sample && is_beaten_by(cones_[other]); });
    });
  }

  /// Those of the site that win at a probe, or clearly where the site is close to them.
  const std::vector<std::int32_t>& pruned(std::int32_t site) {
    const ConeCell& cell = sites_[site].cell;
    kept_.clear();
    doubtful_.clear();
    any_sample(site, [&](std::int32_t sample) {
      doubtful_.push_back(sample);
      return false;
    });
    std::sort(doubtful_.begin(), doubtful_.end(), [&](std::int32_t a, std::int32_t b) {
      return cones_[a].length != cones_[b].length ? cones_[a].length < cones_[b].length : a < b;
    });
    std::array<Int4, kGroups> winner;
    winner.fill(Int4{} + kNone);
    Lengths least;
    least.fill(four(largest_));
    own_.clear();
    for (const std::int32_t s : doubtful_) {
      own_.push_back(cell.lengths(cones_[s]));
      for (int g = 0; g < kGroups; ++g) {
        winner[g] = own_.back()[g] < least[g] ? Int4{} + s : winner[g];
        least[g] = min_of(least[g], own_.back()[g]);
      }
    }
    const auto wins = [&](std::int32_t s) {
      return std::any_of(winner.begin(), winner.end(), [&](Int4 w) { return is_any(w == s); });
    };
    for (const std::int32_t s : doubtful_)
      if (wins(s)) kept_.push_back(s);
    for (std::size_t i = 0; i < doubtful_.size(); ++i) {
      const std::int32_t s = doubtful_[i];
      const auto visit_kept = [&](const auto& is_beaten_by) {
        std::any_of(kept_.begin(), kept_.end(), [&](std::int32_t k) { return is_beaten_by(cones_[k]); });
      };
      if (!wins(s) && cell.is_near(cones_[s], at_center(own_[i])) &&
          cell.wins_nearby(cones_[s], largest_, visit_kept))
        kept_.push_back(s);
    }
    return kept_;
  }

  const Neighbours& neighbours_;
  const OctreeView& octree_;
  const Blanking* const blanking_;
  const std::span<const LengthSample> samples_;
  const float largest_;
  float smallest_ = std::numeric_limits<float>::infinity();
  std::vector<Cone> cones_;
  std::vector<Site> sites_;  // [n_sites]
  std::vector<std::int32_t> beside_;
  std::vector<Entry> entries_;  // of sites with many samples
  std::vector<std::vector<Event>> buckets_;
  std::vector<std::int32_t> kept_, doubtful_;
  std::vector<Lengths> own_;
  std::size_t now_ = 0;
};

}  // namespace

Cone::Cone(const LengthSample& sample, float slope, Vec3 lo) : length(sample.length), slope(slope) {
  const Vec3 from_lo = sample.xyz - lo;
  const double place[3] = {from_lo.x, from_lo.y, from_lo.z};
  const float(*reach[2])[3] = {&sample.reach.u, &sample.reach.v};
  for (int e = 0; e < 2; ++e) {
    const float(&r)[3] = *reach[e];
    half[e] = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
    for (int k = 0; k < 3; ++k) side[e][k] = half[e] > 0 ? r[k] / half[e] : 0;
  }
  for (int k = 0; k < 3; ++k) x[k] = static_cast<float>(place[k]);
}

ConeTable spread_cones(const Neighbours& neighbours, std::span<const LengthSample> samples,
                       std::span<const float> slope, double max_length, const Blanking* blanking) {
  ConeSpread spread(neighbours, samples, slope, max_length, blanking);
  spread.run();
  return spread.take();
}

}  // namespace st
