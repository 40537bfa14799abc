#include "sizing/cones.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "base/limits.h"

namespace st {
namespace {

constexpr int kCenter = 8;  // after the corners of a cell
constexpr int kProbes = 9;
constexpr float kClearly = 0.99F;  // of the length known at a probe: less is no gain
constexpr float kWide = 0.25F;     // of half the edge: wider rectangles are looked at in two places
constexpr float kNearby2 = 14;     // squared half edges from the centre: one edge from the closest point

using Lengths = std::array<float, kProbes>;

/// A cube in single precision.
struct Cell {
  float c[3];
  float half;

  /// Squares of the distances of a cone's place from the corners, then from the centre.
  void distances2(const Cone& cone, Lengths& d2) const {
    float side[2][3], mid = 0;
    for (int k = 0; k < 3; ++k) {
      const float d = c[k] - cone.x[k];
      side[0][k] = (d - half) * (d - half);
      side[1][k] = (d + half) * (d + half);
      mid += d * d;
    }
    for (int p = 0; p < 8; ++p) d2[p] = side[p & 1][0] + side[p >> 1 & 1][1] + side[p >> 2][2];
    d2[kCenter] = mid;
  }
  /// Takes off what these have along a side of the rectangle, up to half the side.
  void shorten(const Cone& cone, int e, Lengths& d2) const {
    const float(&unit)[3] = cone.side[e];
    const float reach = cone.half[e];
    float middle = 0, step[3], along[kProbes];
    for (int k = 0; k < 3; ++k) {
      middle += (c[k] - cone.x[k]) * unit[k];
      step[k] = half * unit[k];
    }
    along[0] = middle - step[0] - step[1];
    along[1] = middle + step[0] - step[1];
    along[2] = middle - step[0] + step[1];
    along[3] = middle + step[0] + step[1];
    for (int p = 0; p < 4; ++p) {
      along[p + 4] = along[p] + step[2];
      along[p] -= step[2];
    }
    along[kCenter] = middle;
    for (int p = 0; p < kProbes; ++p) {
      const float beyond = std::abs(along[p]) - reach, rest = beyond > 0 ? beyond : 0;
      const float shorter = d2[p] - along[p] * along[p] + rest * rest;
      d2[p] = shorter > 0 ? shorter : 0;
    }
  }
  /// From those of its place to those of its rectangle.
  void shorten(const Cone& cone, Lengths& d2) const {
    for (int e = 0; e < 2 && cone.half[e] > 0; ++e) shorten(cone, e, d2);
  }
  /// The point of the cell closest to a place.
  void closest(const float (&to)[3], float (&x)[3]) const {
    for (int k = 0; k < 3; ++k) x[k] = std::clamp(to[k], c[k] - half, c[k] + half);
  }
  /// Its place and number.
  int nearest_corner(const float (&to)[3], float (&x)[3]) const {
    int p = 0;
    for (int k = 0; k < 3; ++k) {
      const bool is_high = to[k] > c[k];
      p |= is_high << k;
      x[k] = is_high ? c[k] + half : c[k] - half;
    }
    return p;
  }
};

float distance2_of(const float (&a)[3], const float (&b)[3]) {
  const float x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return x * x + y * y + z * z;
}

/// Of a place from a cone's rectangle.
float distance2_of(const float (&x)[3], const Cone& cone) {
  float d[3], sum = 0;
  for (int k = 0; k < 3; ++k) d[k] = x[k] - cone.x[k];
  for (int e = 0; e < 2; ++e) {
    const float(&unit)[3] = cone.side[e];
    const float along = std::clamp(d[0] * unit[0] + d[1] * unit[1] + d[2] * unit[2], -cone.half[e], cone.half[e]);
    for (int k = 0; k < 3; ++k) d[k] -= along * unit[k];
  }
  for (int k = 0; k < 3; ++k) sum += d[k] * d[k];
  return sum;
}

float length_at(const Cone& c, float distance2) { return c.length + c.slope * std::sqrt(distance2); }

/// Whether the cone asks for less than `limit`; without a root.
bool is_below(const Cone& c, float distance2, float limit) {
  const float room = limit - c.length;
  return (room > 0) & (c.slope * c.slope * distance2 < room * room);
}

/// The place of a cell closest to that of the cone's rectangle which is closest to the cell, well inside its sides.
void place_towards(const Cell& cell, const Cone& cone, float (&x)[3]) {
  constexpr float kInside = 0.8F;
  float to[3];
  std::copy(cone.x, cone.x + 3, to);
  for (int e = 0; e < 2; ++e) {
    const float(&unit)[3] = cone.side[e];
    float along = 0;
    for (int k = 0; k < 3; ++k) along += (cell.c[k] - cone.x[k]) * unit[k];
    along = std::clamp(along, -kInside * cone.half[e], kInside * cone.half[e]);
    for (int k = 0; k < 3; ++k) to[k] += along * unit[k];
  }
  cell.closest(to, x);
}

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
    cells_.resize(n);
    for (std::size_t site = 0; site < n; ++site) cells_[site] = cell_of(static_cast<std::int32_t>(site));
    Lengths far;
    far.fill(largest_);
    best_.assign(n, far);
    head_.assign(n, kNone);
    range_beside_.resize(n);
  }

  void run() {
    if (!(smallest_ < largest_)) return;
    buckets_.resize(bucket_bits(largest_) - bucket_bits(smallest_) + 1);
    for_each_own_site(neighbours_, samples_, blanking_, [&](std::int32_t site, std::int32_t sample) {
      push({site, sample, kNone}, cones_[sample].length);
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
    for (std::size_t site = 0; site < cells_.size(); ++site) {
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
    std::int32_t entry;  // kNone: the sample lies there and is not taken yet
  };
  struct Entry {
    std::int32_t sample, next;
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
      if (!is_cut || head_[site] != kNone) continue;
      const auto take = [&](std::int32_t from) {
        for (std::int32_t k = head_[from]; k != kNone; k = entries_[k].next)
          found.push_back({site, entries_[k].sample});
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
    if (e.entry == kNone && !offer(e.site, e.sample, least)) return;
    if (e.entry != kNone && head_[e.site] != e.entry && !is_still_best(e.site, e.sample)) return;
    const auto [first, last] = beside(e.site);
    for (std::int32_t k = first; k < last; ++k) {
      const std::int32_t other = beside_[k];
      if (offer(other, e.sample, least)) push({other, e.sample, head_[other]}, least);
    }
  }

  /// Where the sites begin and end in `beside_` that lie across the faces of this one: a corner that a sample wins
  /// belongs to those, too. Found when first asked for.
  std::pair<std::int32_t, std::int32_t> beside(std::int32_t site) {
    auto& [first, last] = range_beside_[site];
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

  /// Whether a cone of the site so far asks for at most `limit` at x.
  bool is_known(std::int32_t site, const float (&x)[3], float limit) const {
    for (std::int32_t k = head_[site]; k != kNone; k = entries_[k].next) {
      const Cone& c = cones_[entries_[k].sample];
      if (is_below(c, distance2_of(x, c), limit)) return true;
    }
    return false;
  }

  bool has(std::int32_t site, std::int32_t sample) const {
    for (std::int32_t k = head_[site]; k != kNone; k = entries_[k].next)
      if (entries_[k].sample == sample) return true;
    return false;
  }

  /// Takes the sample where it asks for clearly less than all so far; `least`: at the probes.
  bool offer(std::int32_t site, std::int32_t sample, float& least) {
    const Cell& cell = cells_[site];
    const Cone& cone = cones_[sample];
    Lengths& best = best_[site];
    Lengths d2;
    if (has(site, sample) || !may_win(cell, cone, best, d2)) return false;
    cell.shorten(cone, d2);
    int n_won = 0;
    for (int p = 0; p < kProbes; ++p) n_won += is_below(cone, d2[p], kClearly * best[p]);
    if (n_won == 0 && (d2[kCenter] > kNearby2 * cell.half * cell.half || !wins_nearby(site, cone))) return false;
    least = largest_;
    for (int p = 0; p < kProbes; ++p) {
      const float v = length_at(cone, d2[p]);
      least = std::min(least, v);
      best[p] = std::min(best[p], v);
    }
    entries_.push_back({sample, head_[site]});
    head_[site] = static_cast<std::int32_t>(entries_.size()) - 1;
    return true;
  }

  /// False where a cone as far away as its rectangle at the nearest wins nowhere. `d2`: of its place from the probes.
  static bool may_win(const Cell& cell, const Cone& cone, const Lengths& best, Lengths& d2) {
    constexpr float kOfShorter = 0.4143F;  // the diagonal is no longer than the longer side and this of the shorter
    cell.distances2(cone, d2);
    // half[0] is the larger; from a probe to the closest point of the cell, or of the rectangle, lengths change by no
    // more than this
    const float lowered = cone.length - cone.slope * (cone.half[0] + kOfShorter * cone.half[1]);
    int n = 0;
    for (int p = 0; p < kProbes; ++p) {
      const float room = kClearly * best[p] - lowered;
      n += (room > 0) & (cone.slope * cone.slope * d2[p] < room * room);
    }
    return n > 0 || d2[kCenter] < kNearby2 * cell.half * cell.half;
  }

  /// Whether the sample wins where the site is closest to it. Not from afar, where lengths change evenly over the site.
  bool wins_nearby(std::int32_t site, const Cone& cone) const {
    float x[3];
    cells_[site].closest(cone.x, x);
    if (wins_at(site, cone, x)) return true;
    if (!(cone.half[0] > kWide * cells_[site].half)) return false;
    place_towards(cells_[site], cone, x);
    return wins_at(site, cone, x);
  }

  bool wins_at(std::int32_t site, const Cone& cone, const float (&x)[3]) const {
    const Cell& cell = cells_[site];
    float corner[3];
    const float d2 = distance2_of(x, cone);
    if (d2 > 4 * cell.half * cell.half) return false;
    const float limit = length_at(cone, d2) / kClearly;
    // from the nearest corner lengths rise no faster than the slope
    const int nearest = cell.nearest_corner(x, corner);
    if (best_[site][nearest] + cone.slope * std::sqrt(distance2_of(x, corner)) < limit) return false;
    return !is_known(site, x, limit);
  }

  bool is_still_best(std::int32_t site, std::int32_t sample) const {
    constexpr float kSame = 1.0001F;
    Lengths d2;
    cells_[site].distances2(cones_[sample], d2);
    cells_[site].shorten(cones_[sample], d2);
    for (int p = 0; p < kProbes; ++p)
      if (is_below(cones_[sample], d2[p], kSame * best_[site][p])) return true;
    return wins_nearby(site, cones_[sample]);
  }

  /// Those of the site that win at a probe, or clearly where the site is closest to them.
  const std::vector<std::int32_t>& pruned(std::int32_t site) {
    kept_.clear();
    doubtful_.clear();
    for (std::int32_t k = head_[site]; k != kNone; k = entries_[k].next) doubtful_.push_back(entries_[k].sample);
    std::sort(doubtful_.begin(), doubtful_.end(), [&](std::int32_t a, std::int32_t b) {
      return cones_[a].length != cones_[b].length ? cones_[a].length < cones_[b].length : a < b;
    });
    std::array<std::int32_t, kProbes> winner;
    winner.fill(kNone);
    Lengths least, d2;
    least.fill(largest_);
    for (const std::int32_t s : doubtful_) {
      cells_[site].distances2(cones_[s], d2);
      cells_[site].shorten(cones_[s], d2);
      for (int p = 0; p < kProbes; ++p)
        if (is_below(cones_[s], d2[p], least[p])) least[p] = length_at(cones_[s], d2[p]), winner[p] = s;
    }
    const auto wins = [&](std::int32_t s) { return std::find(winner.begin(), winner.end(), s) != winner.end(); };
    std::copy_if(doubtful_.begin(), doubtful_.end(), std::back_inserter(kept_), wins);
    for (const std::int32_t s : doubtful_)
      if (!wins(s) && wins_where_closest(site, s)) kept_.push_back(s);
    return kept_;
  }

  bool wins_where_closest(std::int32_t site, std::int32_t s) const {
    float x[3];
    cells_[site].closest(cones_[s].x, x);
    if (is_kept_at(s, x)) return true;
    if (!(cones_[s].half[0] > kWide * cells_[site].half)) return false;
    place_towards(cells_[site], cones_[s], x);
    return is_kept_at(s, x);
  }

  bool is_kept_at(std::int32_t s, const float (&x)[3]) const {
    const float limit = length_at(cones_[s], distance2_of(x, cones_[s])) / kClearly;
    return std::none_of(kept_.begin(), kept_.end(),
                        [&](std::int32_t k) { return is_below(cones_[k], distance2_of(x, cones_[k]), limit); });
  }

  const Neighbours& neighbours_;
  const OctreeView& octree_;
  const Blanking* const blanking_;
  const std::span<const LengthSample> samples_;
  const float largest_;
  float smallest_ = std::numeric_limits<float>::infinity();
  std::vector<Cone> cones_;
  std::vector<Cell> cells_;                                          // [n_sites]
  std::vector<Lengths> best_;                                        // [n_sites] smallest at the probes
  std::vector<std::int32_t> head_;                                   // [n_sites] into entries_
  std::vector<std::pair<std::int32_t, std::int32_t>> range_beside_;  // [n_sites] first and after the last in beside_
  std::vector<std::int32_t> beside_;
  std::vector<Entry> entries_;
  std::vector<std::vector<Event>> buckets_;
  std::vector<std::int32_t> kept_, doubtful_;
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
