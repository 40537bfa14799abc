#include "sizing/cones.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "base/limits.h"
#include "base/memory.h"
#include "base/radix_sort.h"
#include "base/threads.h"
#include "sizing/cone_cell.h"
#include "sizing/cone_faces.h"
#include "sizing/cone_site.h"

namespace st {
namespace {

// While cones spread, less than these shares of the length known is a gain. What is refused wrongly is found on faces.
constexpr ConeShares kSpreadShares{0.99F, 0.99F};
// In the cell of the sample itself.
constexpr ConeShares kOwnShares{0.997F, 0.99F};

class ConeSpread {
  using Site = ConeSite;

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
    sites_.reserve(n);
    prefer_large_pages(sites_.data(), n * sizeof(Site));
    sites_.resize(n);
    holds_sample_.resize(n);
    find_beside();
  }

  void run() {
    if (!(smallest_ < largest_)) return;
    buckets_.resize(bucket_bits(largest_) - bucket_bits(smallest_) + 1);
    for_each_own_site(neighbours_, samples_, blanking_, [&](std::int32_t site, std::int32_t sample) {
      push({site, sample, 0}, cones_[sample].length);
      holds_sample_[site] = 1;
    });
    for (now_ = 0; now_ < buckets_.size(); ++now_)
      while (!buckets_[now_].empty()) pass_on_in_order(std::exchange(buckets_[now_], {}));
    fill_rest();
  }

  ConeTable take() {
    const SiteGraph graph = make_graph();
    SiteSamples kept = pruned_sites();
    sites_ = {};  // most of the memory
    entries_ = {};
    const SiteSamples all = agree_on_faces(graph, cones_, largest_, std::move(kept));
    ConeTable table;
    table.of_site.reserve(all.sample.size());
    table.at_center.assign(all.at_center.size(), kNone);
    std::vector<std::int32_t> number(cones_.size(), kNone);
    for (const std::int32_t s : all.sample) {
      if (number[s] == kNone) {
        number[s] = static_cast<std::int32_t>(table.cone.size());
        table.cone.push_back(cones_[s]);
        table.cause.push_back(samples_[s].cause);
        table.sample.push_back(s);
      }
      table.of_site.push_back(number[s]);
    }
    table.first = all.first;
    const auto is_shorter = [&](std::int32_t a, std::int32_t b) {
      return table.cone[a].length != table.cone[b].length ? table.cone[a].length < table.cone[b].length : a < b;
    };
    parallel_for(all.at_center.size(), kSitesPerPiece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t site = begin; site < end; ++site) {
        std::sort(table.of_site.begin() + table.first[site], table.of_site.begin() + table.first[site + 1], is_shorter);
        if (all.at_center[site] != kNone) table.at_center[site] = number[all.at_center[site]];
      }
    });
    return table;
  }

 private:
  static constexpr std::size_t kSitesPerPiece = 2'048;
  /// Of the sites of a piece of a loop.
  struct Pruning {
    std::vector<std::int32_t> kept, end;  // samples; of each site the one after its last
    std::vector<std::int32_t> near;       // of the site at hand
  };
  struct Event {
    std::int32_t site, sample;
    std::int32_t n;  // samples of the site with it; 0: it lies there and is not taken yet
  };
  static constexpr std::size_t kAhead = 4;  // events
  SiteGraph make_graph() {
    SiteGraph graph;
    graph.cell.reserve(sites_.size());
    graph.of_beside.reserve(sites_.size());
    for (const Site& site : sites_) {
      graph.cell.push_back(site.cell);
      graph.of_beside.push_back(site.beside);
    }
    graph.beside = beside_;
    graph.holds_sample = std::move(holds_sample_);
    return graph;
  }

  SiteSamples pruned_sites() const {
    constexpr int kCenter = kProbes - 1;
    std::vector<Pruning> pieces((sites_.size() + kSitesPerPiece - 1) / kSitesPerPiece);
    parallel_for(sites_.size(), kSitesPerPiece, [&](std::size_t begin, std::size_t end) {
      Pruning& own = pieces[begin / kSitesPerPiece];
      for (std::size_t site = begin; site < end; ++site) prune(sites_[site], own);
    });
    SiteSamples kept;
    std::size_t n = 0;
    for (const Pruning& own : pieces) n += own.kept.size();
    kept.sample.reserve(n);
    for (const Pruning& own : pieces) {
      const auto first = static_cast<std::int32_t>(kept.sample.size());
      kept.sample.insert(kept.sample.end(), own.kept.begin(), own.kept.end());
      for (const std::int32_t end : own.end) kept.first.push_back(first + end);
    }
    kept.at_center.reserve(sites_.size());
    kept.center_length.reserve(sites_.size());
    for (const Site& site : sites_) {
      kept.at_center.push_back(site.winner[kCenter / 4][kCenter % 4]);
      kept.center_length.push_back(site.best[kCenter / 4][kCenter % 4]);
    }
    return kept;
  }

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
        any_sample(sites_[from], [&](std::int32_t sample) {
          found.push_back({site, sample});
          return false;
        });
      };
      bool has_way = false;
      for_each_link(blanking_, neighbours_, site, [&](std::int32_t to, const CellStep&) {
        if (to < n_leaves && blanking_->colour[to] == CellColour::kBlanked) return;  // no length comes from there
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
    for (const auto& [site, sample] : found) offer(site, sample, kSpreadShares, least);
  }

  /// Site by site: so those that are looked at lie beside each other in memory.
  void pass_on_in_order(std::vector<Event> events) {
    radix_sort(events, sorting_, [](const Event& e) { return static_cast<std::uint64_t>(e.site); });
    for (std::size_t i = 0; i < events.size(); ++i) {
      if (i + 2 * kAhead < events.size()) fetch(events[i + 2 * kAhead]);
      if (i + kAhead < events.size() && events[i + kAhead].site != events[i + kAhead - 1].site)
        fetch_beside(events[i + kAhead].site);
      pass_on(events[i]);
    }
  }

  /// Asks the memory for what an event will need. Inlined: else it is taken for a function without effect.
  [[gnu::always_inline]] void fetch(const Event& e) const {
    sites_[e.site].fetch();
    __builtin_prefetch(&cones_[e.sample]);
  }
  [[gnu::always_inline]] void fetch_beside(std::int32_t site) const {
    const auto [first, last] = sites_[site].beside;
    for (std::int32_t k = first; k < last; ++k) sites_[beside_[k].site].fetch();
  }

  void pass_on(const Event& e) {
    const std::int32_t site = e.site, sample = e.sample;
    float least = 0;
    if (e.n == 0 && !offer(site, sample, kOwnShares, least)) return;
    if (e.n != 0 && sites_[site].n != e.n && !sites_[site].is_winner(sample)) return;
    const auto [first, last] = sites_[site].beside;
    const std::int32_t ahead = sides_ahead(sites_[site], sample);
    for (std::int32_t k = first; k < last; ++k) {
      const auto [other, towards] = beside_[k];
      if ((towards & ahead) != 0 && offer(other, sample, kSpreadShares, least))
        push({other, sample, sites_[other].n}, least);
    }
  }

  /// The sides of a cell by which straight ways from a sample leave the place where it wins: bit 2 * axis for the lower
  /// one, then the upper. From afar it wins at a probe of these sides.
  std::int32_t sides_ahead(const Site& s, std::int32_t sample) const {
    bool is_near = false;
    const std::int32_t sides =
        SiteBeside::kAlways | kernels_.sides_ahead(s.cell.numbers(), cones_[sample].numbers(), is_near);
    return is_near ? sides : sides & (SiteBeside::kAlways | s.sides_won(sample));
  }

  /// Sets the cells of all sites, and which sites lie across their faces: a corner that a sample wins belongs to those,
  /// too. Beside a surface ways are not straight.
  void find_beside() {
    std::vector<std::vector<SiteBeside>> found((sites_.size() + kSitesPerPiece - 1) / kSitesPerPiece);
    parallel_for(sites_.size(), kSitesPerPiece, [&](std::size_t begin, std::size_t end) {
      std::vector<SiteBeside>& own = found[begin / kSitesPerPiece];
      own.reserve(8 * (end - begin));
      for (std::size_t i = begin; i < end; ++i) {
        Site& site = sites_[i];
        site.cell = cell_of(static_cast<std::int32_t>(i));
        site.best.fill(four(largest_));
        site.winner.fill(Int4{} + kNone);
        site.beside.first = static_cast<std::int32_t>(own.size());
        add_beside(static_cast<std::int32_t>(i), own);
        site.beside.second = static_cast<std::int32_t>(own.size());
      }
    });
    std::size_t n = 0;
    for (const auto& own : found) n += own.size();
    require_countable(n, "cells beside cells");
    beside_.reserve(n);
    for (std::size_t i = 0, first = 0; i < sites_.size(); ++i) {
      if (i % kSitesPerPiece == 0) {
        const std::vector<SiteBeside>& own = found[i / kSitesPerPiece];
        first = beside_.size();
        beside_.insert(beside_.end(), own.begin(), own.end());
      }
      sites_[i].beside.first += static_cast<std::int32_t>(first);
      sites_[i].beside.second += static_cast<std::int32_t>(first);
    }
  }

  void add_beside(std::int32_t site, std::vector<SiteBeside>& all) const {
    if (!blanking_ || blanking_->site_links[site] == kNone)
      neighbours_.for_each_across_side(site, [&](std::int32_t other, int side) { all.push_back({other, 1 << side}); });
    else
      for_each_link_across_face(*blanking_, neighbours_, site, [&](std::int32_t other, const CellStep&) {
        all.push_back({other, SiteBeside::kAlways});
      });
  }

  static std::size_t bucket_bits(float length) { return std::bit_cast<std::uint32_t>(length) >> 20; }
  void push(const Event& e, float length) {
    const std::size_t b = bucket_bits(std::min(length, largest_)) - bucket_bits(smallest_);
    buckets_[std::max(b, now_)].push_back(e);
  }

  /// Whether f(sample) is true for any sample of the site.
  template <class F>
  bool any_sample(const Site& s, const F& f) const {
    const std::int32_t n_own = std::min(s.n, Site::kOwn);
    for (std::int32_t i = 0; i < n_own; ++i)
      if (f(s.own_sample(i))) return true;
    for (std::int32_t k = s.more; k != kNone; k = entries_[k].next)
      if (f(entries_[k].sample)) return true;
    return false;
  }

  bool has(const Site& s, std::int32_t sample) const {
    if ((s.may_have & Site::bit_of(sample)) == 0) return false;
    if (is_any((s.own[0] == sample) | (s.own[1] == sample))) return true;
    std::int32_t k = s.more;
    while (k != kNone && entries_[k].sample != sample) k = entries_[k].next;
    return k != kNone;
  }

  /// Takes the sample where it asks for clearly less than all so far; `least`: at the probes.
  bool offer(std::int32_t site, std::int32_t sample, const ConeShares& shares, float& least) {
    Site& s = sites_[site];
    return !is_any(s.refused == sample) && !has(s, sample) && consider(s, sample, shares, least);
  }

  /// Likewise, of a sample that is new to the site. Not inlined: most offers end before.
  [[gnu::noinline]] bool consider(Site& s, std::int32_t sample, const ConeShares& shares, float& least) {
    Lengths own;
    bool is_near = false;
    const bool is_below =
        kernels_.offer(s.cell.numbers(), cones_[sample].numbers(), numbers(s.best), shares, numbers(own), is_near);
    if (!is_below && !(is_near && wins_nearby(s, sample, shares.nearby))) {
      s.refused[s.n_refused++ % 4] = sample;
      return false;
    }
    least = std::min(largest_, kernels_.take(numbers(own), sample, numbers(s.best), numbers(s.winner)));
    add_sample(s, sample);
    return true;
  }

  void add_sample(Site& s, std::int32_t sample) {
    if (s.n < Site::kOwn) {
      s.own[s.n / 4][s.n % 4] = sample;
    } else {
      entries_.push_back({sample, s.more});
      s.more = static_cast<std::int32_t>(entries_.size()) - 1;
    }
    s.may_have |= Site::bit_of(sample);
    ++s.n;
  }

  /// Whether the sample wins where the site is close to it.
  bool wins_nearby(const Site& s, std::int32_t sample, float share) const {
    const std::int32_t first = s.winner_towards(cones_[sample]);  // most are beaten by it
    return kernels_.wins_nearby(s.cell.numbers(), cones_[sample].numbers(), share, largest_,
                                {cones_.front().numbers(), first == sample ? kNone : first, sample, numbers(s.own),
                                 std::min(s.n, Site::kOwn), entries_.data(), s.more});
  }

  /// Keeps those of the site that win at a probe, or clearly where the site is close to them.
  void prune(const Site& s, Pruning& own) const {
    const std::size_t first = own.kept.size();
    own.near.clear();
    any_sample(s, [&](std::int32_t sample) {
      if (s.is_winner(sample))
        own.kept.push_back(sample);
      else if (kernels_.is_near(s.cell.numbers(), cones_[sample].numbers()))
        own.near.push_back(sample);
      return false;
    });
    std::sort(own.near.begin(), own.near.end(), [&](std::int32_t a, std::int32_t b) {
      return cones_[a].length != cones_[b].length ? cones_[a].length < cones_[b].length : a < b;
    });
    for (const std::int32_t sample : own.near) {
      const KnownCones known{cones_.front().numbers(),
                             s.winner_towards(cones_[sample]),  // kept as all winners; most are beaten by it
                             kNone,
                             own.kept.data() + first,
                             static_cast<std::int32_t>(own.kept.size() - first),
                             nullptr,
                             kNone};
      if (kernels_.wins_nearby(s.cell.numbers(), cones_[sample].numbers(), kOwnShares.nearby, largest_, known))
        own.kept.push_back(sample);
    }
    own.end.push_back(static_cast<std::int32_t>(own.kept.size()));
  }

  const Neighbours& neighbours_;
  const OctreeView& octree_;
  const Blanking* const blanking_;
  const ConeKernels& kernels_ = cone_kernels();
  const std::span<const LengthSample> samples_;
  const float largest_;
  float smallest_ = std::numeric_limits<float>::infinity();
  std::vector<Cone> cones_;
  std::vector<Site> sites_;                 // [n_sites]
  std::vector<std::uint8_t> holds_sample_;  // [n_sites]
  std::vector<SiteBeside> beside_;
  std::vector<SampleLink> entries_;  // of sites with many samples
  std::vector<std::vector<Event>> buckets_;
  std::vector<Event> sorting_;
  std::size_t now_ = 0;
};

}  // namespace

ConeTable spread_cones(const Neighbours& neighbours, std::span<const LengthSample> samples,
                       std::span<const float> slope, double max_length, const Blanking* blanking) {
  ConeSpread spread(neighbours, samples, slope, max_length, blanking);
  spread.run();
  return spread.take();
}

}  // namespace st
