#include "sizing/cones.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "base/limits.h"

namespace st {
namespace {

// Of the length known at a place: less is no gain.
constexpr float kClearly = 0.99F;
constexpr float kClearlyNearby = 0.997F;  // where a sample is near: the mesh's nodes are
constexpr float kWide = 0.25F;            // of half the edge: wider rectangles are looked at in more places
constexpr float kNearby = 3.75F;          // half edges from the centre: one edge from the closest point

using Int4 [[gnu::vector_size(16)]] = std::int32_t;  // of a comparison: -1 where it holds

bool is_any(Int4 v) {
  std::uint64_t half[2];
  std::memcpy(half, &v, sizeof half);
  return (half[0] | half[1]) != 0;
}

Float4 min_of(Float4 a, Float4 b) { return a < b ? a : b; }
Float4 max_of(Float4 a, Float4 b) { return a > b ? a : b; }

float least_of(Float4 v) { return std::min({v[0], v[1], v[2], v[3]}); }

Float4 root_of(Float4 v) {
  Float4 root{};
  for (int i = 0; i < 4; ++i) root[i] = std::sqrt(v[i]);
  return root;
}

Float4 four(float v) { return v - Float4{}; }

/// A cone with each of its numbers four times, to be asked at four places at once.
class WideCone {
 public:
  explicit WideCone(const Cone& cone) : length_(four(cone.length)), slope_(four(cone.slope)) {
    for (; n_sides_ < 2 && cone.half[n_sides_] > 0; ++n_sides_) {
      most_[n_sides_] = four(cone.half[n_sides_]);
      for (int k = 0; k < 3; ++k) side_[n_sides_][k] = four(cone.side[n_sides_][k]);
    }
  }
  /// Distances of places that lie so far from the middle of its rectangle.
  Float4 distance(Float4 x, Float4 y, Float4 z) const {
    for (int e = 0; e < n_sides_; ++e) {
      const Float4(&unit)[3] = side_[e];
      const Float4 along = max_of(min_of(x * unit[0] + y * unit[1] + z * unit[2], most_[e]), -most_[e]);
      x -= along * unit[0];
      y -= along * unit[1];
      z -= along * unit[2];
    }
    return root_of(x * x + y * y + z * z);
  }
  Float4 length_at(Float4 distance) const { return length_ + slope_ * distance; }

 private:
  Float4 length_, slope_, side_[2][3], most_[2];
  int n_sides_ = 0;
};

/// Four places, from the lower corner of the root.
struct FourPlaces {
  Float4 x[3];

  Float4 distance(const Cone& cone, const WideCone& wide) const {
    return wide.distance(x[0] - cone.x[0], x[1] - cone.x[1], x[2] - cone.x[2]);
  }
  Float4 length(const Cone& cone) const {
    const WideCone wide(cone);
    return wide.length_at(distance(cone, wide));
  }
};

// Where the lengths in a cell are compared: its corners, the centres of its faces, its own centre (twice).
constexpr int kGroups = 4;  // of four probes
constexpr Float4 kProbe[kGroups][3] = {{{-1, 1, -1, 1}, {-1, -1, 1, 1}, {-1, -1, -1, -1}},
                                       {{-1, 1, -1, 1}, {-1, -1, 1, 1}, {1, 1, 1, 1}},
                                       {{-1, 1, 0, 0}, {0, 0, -1, 1}, {0, 0, 0, 0}},
                                       {{0, 0, 0, 0}, {0, 0, 0, 0}, {-1, 1, 0, 0}}};
using Lengths = std::array<Float4, kGroups>;

float at_center(const Lengths& lengths) { return lengths[kGroups - 1][3]; }

/// A cube in single precision.
struct Cell {
  float c[3];
  float half;

  /// Of a cone at the probes.
  Lengths lengths(const Cone& cone) const {
    Lengths result;
    const WideCone wide(cone);
    const Float4 x = four(c[0] - cone.x[0]), y = four(c[1] - cone.x[1]), z = four(c[2] - cone.x[2]), h = four(half);
    for (int g = 0; g < kGroups; ++g)
      result[g] = wide.length_at(wide.distance(x + h * kProbe[g][0], y + h * kProbe[g][1], z + h * kProbe[g][2]));
    return result;
  }
  /// The places of the cell closest to those `a` and `b` along the sides of a cone's rectangle.
  FourPlaces closest(const Cone& cone, Float4 a, Float4 b) const {
    FourPlaces places;
    for (int k = 0; k < 3; ++k) {
      const Float4 lo = four(c[k] - half), hi = four(c[k] + half);
      places.x[k] = max_of(lo, min_of(hi, cone.x[k] + a * cone.side[0][k] + b * cone.side[1][k]));
    }
    return places;
  }
  /// From the place closest to the middle of a cone's rectangle towards the centre.
  FourPlaces closest(const Cone& cone) const {
    constexpr Float4 kTowards{0, 0.25F, 0.5F, 0.75F};
    FourPlaces places;
    for (int k = 0; k < 3; ++k) {
      const float from = std::clamp(cone.x[k], c[k] - half, c[k] + half);
      places.x[k] = from + kTowards * (c[k] - from);
    }
    return places;
  }
};

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

    Cell cell;
    Lengths best;                                  // smallest at the probes
    std::int32_t n = 0;                            // its samples, in order
    std::array<std::int32_t, kOwn> own{};          // the first of them
    std::int32_t more = kNone;                     // the last of the rest, into entries_
    std::int32_t refused = kNone;                  // the last sample that was, which others may offer again
    std::pair<std::int32_t, std::int32_t> beside;  // first and after the last in beside_
  };

  Cell cell_of(std::int32_t site) const {
    const std::int32_t leaf = site < octree_.n_leaves() ? site : blanking_->split_leaf[site - octree_.n_leaves()];
    const Vec3 c = octree_.leaf_center(leaf) - octree_.lo;
    return {{static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)},
            static_cast<float>(0.5 * octree_.cell_edge(octree_.leaf_levels[leaf]))};
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
    const bool is_near = is_nearby(sites_[site].cell, cones_[sample], own);
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

  /// Whether lengths are below a share of others at any probe.
  static bool is_below(const Lengths& lengths, float share, const Lengths& others) {
    Int4 is_below{};
    for (int g = 0; g < kGroups; ++g) is_below |= lengths[g] < share * others[g];
    return is_any(is_below);
  }

  /// From afar lengths change evenly over a cell.
  static bool is_nearby(const Cell& cell, const Cone& cone, const Lengths& own) {
    return at_center(own) <= cone.length + cone.slope * kNearby * cell.half;
  }

  /// Whether the sample wins where the site is close to it.
  bool wins_nearby(std::int32_t site, std::int32_t sample) const {
    return wins_nearby(sites_[site].cell, cones_[sample], [&](const auto& is_beaten_by) {
      any_sample(site, [&](std::int32_t other) { return is_beaten_by(cones_[other]); });
    });
  }

  /// `visit_known` calls its argument for other cones of the cell, until it is true.
  template <class VisitKnown>
  bool wins_nearby(const Cell& cell, const Cone& cone, const VisitKnown& visit_known) const {
    if (!(cone.half[0] > kWide * cell.half)) return wins_at(cell.closest(cone), cell, cone, visit_known);
    constexpr float kInside = 0.8F;  // of the sides: further out its neighbours count
    const float a = kInside * cone.half[0], b = kInside * cone.half[1];
    float towards[2];  // of the rectangle the place closest to the cell's centre
    for (int e = 0; e < 2; ++e) {
      const float(&unit)[3] = cone.side[e];
      float along = 0;
      for (int k = 0; k < 3; ++k) along += (cell.c[k] - cone.x[k]) * unit[k];
      towards[e] = std::clamp(along, -kInside * cone.half[e], kInside * cone.half[e]);
    }
    return wins_at(cell.closest(cone, Float4{0, a, -a, towards[0]}, Float4{0, 0, 0, towards[1]}), cell, cone,
                   visit_known) ||
           wins_at(cell.closest(cone, Float4{a, a, -a, -a}, Float4{b, -b, b, -b}), cell, cone, visit_known);
  }

  template <class VisitKnown>
  bool wins_at(const FourPlaces& places, const Cell& cell, const Cone& cone, const VisitKnown& visit_known) const {
    const WideCone wide(cone);
    const Float4 distance = places.distance(cone, wide), limit = (1 / kClearlyNearby) * wide.length_at(distance);
    Int4 wins = (distance < 2 * cell.half) & (limit < largest_);
    if (!is_any(wins)) return false;
    visit_known([&](const Cone& other) {
      wins &= places.length(other) >= limit;
      return !is_any(wins);
    });
    return is_any(wins);
  }

  bool is_still_best(std::int32_t site, std::int32_t sample) const {
    constexpr float kSame = 1.0001F;
    const Lengths own = sites_[site].cell.lengths(cones_[sample]);
    if (is_below(own, kSame, sites_[site].best)) return true;
    if (!is_nearby(sites_[site].cell, cones_[sample], own)) return false;
    return wins_nearby(sites_[site].cell, cones_[sample], [&](const auto& is_beaten_by) {
      any_sample(site, [&](std::int32_t other) { return other != sample && is_beaten_by(cones_[other]); });
    });
  }

  /// Those of the site that win at a probe, or clearly where the site is close to them.
  const std::vector<std::int32_t>& pruned(std::int32_t site) {
    const Cell& cell = sites_[site].cell;
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
      if (!wins(s) && is_nearby(cell, cones_[s], own_[i]) && wins_nearby(cell, cones_[s], visit_kept))
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
