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
#include "base/parallel_reserve.h"
#include "base/pieces.h"
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
constexpr std::size_t kSitesPerPiece = 2'048;
constexpr std::size_t kAhead = 8;           // events or offers
constexpr std::size_t kSharedEvents = 512;  // fewer are not worth waking threads for

class ConeSpread {
  using Site = ConeSite;
  using Part = ConePart;
  using Event = ConeEvent;

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
    touch_pages(sites_.data(), n * sizeof(Site));
    sites_.resize(n);
    find_beside();
    make_parts();
  }

  void run() {
    if (!(smallest_ < largest_)) return;
    const std::size_t n_buckets = bucket_bits(largest_) - bucket_bits(smallest_) + 1;
    for (Part& part : parts_) part.buckets.resize(n_buckets);
    for_each_own_site(neighbours_, samples_, blanking_, [&](std::int32_t site, std::int32_t sample) {
      push({site, sample, 0}, cones_[sample].length, part_of(site));
      own_sites_.push_back({site, sample});
    });
    for (now_ = 0; now_ < n_buckets; ++now_)
      while (take_events()) {
        for_each_part([&](Part& part) { pass_on(part); });
        for_each_part([&](Part& part) { take_offers(part); });
      }
    fill_rest();
  }

  ConeTable take(SampleSites* sites) {
    SiteGraph graph = make_graph();
    SiteSamples kept = pruned_sites();
    sites_ = {};  // most of the memory
    parts_ = {};
    const SiteSamples all = agree_on_faces(graph, cones_, largest_, std::move(kept));
    ConeTable table;
    table.of_site.resize(all.sample.size());
    table.at_center.assign(all.at_center.size(), kNone);
    std::vector<std::int32_t> number(cones_.size(), kNone);
    table.sample = used_samples(all, cones_.size());
    for (const std::int32_t s : table.sample) {
      number[s] = static_cast<std::int32_t>(table.cone.size());
      table.cone.push_back(cones_[s]);
      table.cause.push_back(samples_[s].cause);
    }
    table.first = all.first;
    const auto is_shorter = [&](std::int32_t a, std::int32_t b) {
      return table.cone[a].length != table.cone[b].length ? table.cone[a].length < table.cone[b].length : a < b;
    };
    parallel_for(all.at_center.size(), kSitesPerPiece, [&](std::size_t begin, std::size_t end) {
      for (std::int32_t i = table.first[begin]; i < table.first[end]; ++i) table.of_site[i] = number[all.sample[i]];
      for (std::size_t site = begin; site < end; ++site) {
        std::sort(table.of_site.begin() + table.first[site], table.of_site.begin() + table.first[site + 1], is_shorter);
        if (all.at_center[site] != kNone) table.at_center[site] = number[all.at_center[site]];
      }
    });
    if (sites) *sites = {std::move(graph), std::move(own_sites_)};
    return table;
  }

 private:
  void make_parts() {
    constexpr std::size_t kPartsPerThread = 8, kLeastSites = 256;
    const std::size_t n_wanted = kPartsPerThread * static_cast<std::size_t>(threads_of_pieces());
    part_bits_ = std::bit_width(std::max(sites_.size() / n_wanted, kLeastSites));
    parts_.resize((sites_.size() >> part_bits_) + 1);
    for (Part& part : parts_) part.offers.resize(parts_.size());
  }
  Part& part_of(std::int32_t site) { return parts_[static_cast<std::size_t>(site) >> part_bits_]; }
  const Part& part_of(std::int32_t site) const { return parts_[static_cast<std::size_t>(site) >> part_bits_]; }

  /// Of the bucket at hand. Whether there are any.
  bool take_events() {
    n_events_ = 0;
    for (Part& part : parts_) {
      part.events.clear();
      part.events.swap(part.buckets[now_]);
      n_events_ += part.events.size();
    }
    return n_events_ > 0;
  }

  template <class F>
  void for_each_part(const F& f) {
    parallel_for(parts_.size(), n_events_ < kSharedEvents ? parts_.size() : 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) f(parts_[i]);
    });
  }

  SiteGraph make_graph() {
    SiteGraph graph;
    graph.cell.resize(sites_.size());
    graph.of_beside.resize(sites_.size());
    parallel_for(sites_.size(), kSitesPerPiece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t site = begin; site < end; ++site) {
        graph.cell[site] = sites_[site].cell;
        graph.of_beside[site] = sites_[site].beside;
      }
    });
    graph.beside = std::move(beside_);
    graph.holds_sample.resize(sites_.size());
    for (const auto& [site, sample] : own_sites_) graph.holds_sample[site] = 1;
    return graph;
  }

  SiteSamples pruned_sites() const {
    constexpr int kCenter = kProbes - 1;
    std::vector<std::vector<std::int32_t>> pieces((sites_.size() + kSitesPerPiece - 1) / kSitesPerPiece);
    SiteSamples kept;
    kept.first.assign(sites_.size() + 1, 0);
    kept.at_center.resize(sites_.size());
    kept.center_length.resize(sites_.size());
    parallel_for(sites_.size(), kSitesPerPiece, [&](std::size_t begin, std::size_t end) {
      std::vector<std::int32_t>& own = pieces[begin / kSitesPerPiece];
      std::vector<std::int32_t> near;
      for (std::size_t i = begin; i < end; ++i) {
        const Site& site = sites_[i];
        prune(static_cast<std::int32_t>(i), near, own);
        kept.first[i + 1] = static_cast<std::int32_t>(own.size());
        kept.at_center[i] = site.winner[kCenter / 4][kCenter % 4];
        kept.center_length[i] = site.best[kCenter / 4][kCenter % 4];
      }
    });
    const std::vector<std::size_t> start = append_pieces(pieces, kept.sample);
    require_countable(kept.sample.size(), "lengths of samples in cells");
    for (std::size_t i = 0; i < sites_.size(); ++i)
      kept.first[i + 1] += static_cast<std::int32_t>(start[i / kSitesPerPiece]);
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
        part_of(from).any_sample(sites_[from], [&](std::int32_t sample) {
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
    for (const auto& [site, sample] : found) offer(part_of(site), {site, sample}, kSpreadShares, least);
  }

  /// Site by site: so those that are looked at lie beside each other in memory.
  void pass_on(Part& part) {
    std::vector<Event>& events = part.events;
    radix_sort(events, part.sorting, [](const Event& e) { return static_cast<std::uint64_t>(e.site); });
    for (std::size_t i = 0; i < events.size(); ++i) {
      if (i + kAhead < events.size()) fetch(events[i + kAhead].site, events[i + kAhead].sample);
      pass_on(events[i], part);
    }
  }

  /// Offers the sample to the sites beside, of whichever part.
  void pass_on(const Event& e, Part& part) {
    const std::int32_t site = e.site, sample = e.sample;
    float least = 0;
    if (e.n == 0 && !offer(part, {site, sample}, kOwnShares, least)) return;
    if (e.n != 0 && sites_[site].n != e.n && !sites_[site].is_winner(sample)) return;
    const auto [first, last] = sites_[site].beside;
    const std::int32_t ahead = sides_ahead(sites_[site], sample);
    std::vector<SiteSample>* const to_part = part.offers.data();
    for (const SiteBeside *b = beside_.data() + first, *end = beside_.data() + last; b < end; ++b)
      if ((b->towards & ahead) != 0)
        to_part[static_cast<std::size_t>(b->site) >> part_bits_].push_back({b->site, sample});
  }

  /// What all parts offer to sites of this one.
  void take_offers(Part& part) {
    const auto own = static_cast<std::size_t>(&part - parts_.data());
    for (Part& from : parts_) {
      std::vector<SiteSample>& offers = from.offers[own];
      for (std::size_t i = 0; i < offers.size(); ++i) {
        if (i + kAhead < offers.size()) fetch(offers[i + kAhead].site, offers[i + kAhead].sample);
        const auto [site, sample] = offers[i];
        if (float least = 0; offer(part, offers[i], kSpreadShares, least))
          push({site, sample, sites_[site].n}, least, part);
      }
      offers.clear();
    }
  }

  /// Asks the memory for what an event or offer will need. Inlined: else it is taken for a function without effect.
  [[gnu::always_inline]] void fetch(std::int32_t site, std::int32_t sample) const {
    sites_[site].fetch();
    __builtin_prefetch(&cones_[sample]);
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
    std::vector<std::vector<SiteBeside>> pieces((sites_.size() + kSitesPerPiece - 1) / kSitesPerPiece);
    parallel_for(sites_.size(), kSitesPerPiece, [&](std::size_t begin, std::size_t end) {
      std::vector<SiteBeside>& own = pieces[begin / kSitesPerPiece];
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
    const std::vector<std::size_t> start = append_pieces(pieces, beside_);
    require_countable(beside_.size(), "cells beside cells");
    parallel_for(sites_.size(), kSitesPerPiece, [&](std::size_t begin, std::size_t end) {
      const auto first = static_cast<std::int32_t>(start[begin / kSitesPerPiece]);
      for (std::size_t i = begin; i < end; ++i) {
        sites_[i].beside.first += first;
        sites_[i].beside.second += first;
      }
    });
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
  void push(const Event& e, float length, Part& part) const {
    const std::size_t b = bucket_bits(std::min(length, largest_)) - bucket_bits(smallest_);
    part.buckets[std::max(b, now_)].push_back(e);
  }

  /// Takes the sample where it asks for clearly less than all so far; `least`: at the probes. `part`: of the site.
  bool offer(Part& part, const SiteSample& o, const ConeShares& shares, float& least) {
    Site& s = sites_[o.site];
    return !part.has(s, o.sample) && !is_any(s.refused == o.sample) && consider(part, s, o.sample, shares, least);
  }

  /// Likewise, of a sample that is new to the site. Not inlined: most offers end before.
  [[gnu::noinline]] bool consider(Part& part, Site& s, std::int32_t sample, const ConeShares& shares, float& least) {
    Lengths own;
    bool is_near = false;
    const bool is_below =
        kernels_.offer(s.cell.numbers(), cones_[sample].numbers(), numbers(s.best), shares, numbers(own), is_near);
    if (!is_below && !(is_near && wins_nearby(part, s, sample, shares.nearby))) {
      s.refused[s.n_refused++ % 4] = sample;
      return false;
    }
    least = std::min(largest_, kernels_.take(numbers(own), sample, numbers(s.best), numbers(s.winner)));
    part.add(s, sample);
    return true;
  }

  /// Whether the sample wins where the site is close to it.
  bool wins_nearby(const Part& part, const Site& s, std::int32_t sample, float share) const {
    const std::int32_t first = s.winner_towards(cones_[sample]);  // most are beaten by it
    return kernels_.wins_nearby(s.cell.numbers(), cones_[sample].numbers(), share, largest_,
                                {cones_.front().numbers(), first == sample ? kNone : first, sample, numbers(s.own),
                                 std::min(s.n, Site::kOwn), part.entries.data(), s.more});
  }

  /// Keeps those of the site that win at a probe, or clearly where the site is close to them. `near` is overwritten.
  void prune(std::int32_t site, std::vector<std::int32_t>& near, std::vector<std::int32_t>& kept) const {
    const Site& s = sites_[site];
    const std::size_t first = kept.size();
    near.clear();
    part_of(site).any_sample(s, [&](std::int32_t sample) {
      if (s.is_winner(sample))
        kept.push_back(sample);
      else if (kernels_.is_near(s.cell.numbers(), cones_[sample].numbers()))
        near.push_back(sample);
      return false;
    });
    std::sort(near.begin(), near.end(), [&](std::int32_t a, std::int32_t b) {
      return cones_[a].length != cones_[b].length ? cones_[a].length < cones_[b].length : a < b;
    });
    for (const std::int32_t sample : near) {
      const KnownCones known{cones_.front().numbers(),
                             s.winner_towards(cones_[sample]),  // kept as all winners; most are beaten by it
                             kNone,
                             kept.data() + first,
                             static_cast<std::int32_t>(kept.size() - first),
                             nullptr,
                             kNone};
      if (kernels_.wins_nearby(s.cell.numbers(), cones_[sample].numbers(), kOwnShares.nearby, largest_, known))
        kept.push_back(sample);
    }
  }

  const Neighbours& neighbours_;
  const OctreeView& octree_;
  const Blanking* const blanking_;
  const ConeKernels& kernels_ = cone_kernels();
  const std::span<const LengthSample> samples_;
  const float largest_;
  float smallest_ = std::numeric_limits<float>::infinity();
  std::vector<Cone> cones_;
  std::vector<Site> sites_;  // [n_sites]
  std::vector<SiteBeside> beside_;
  std::vector<std::pair<std::int32_t, std::int32_t>> own_sites_;
  std::vector<Part> parts_;
  int part_bits_ = 0;         // log2 of the sites of a part
  std::size_t now_ = 0;       // which bucket
  std::size_t n_events_ = 0;  // at hand, of all parts
};

}  // namespace

ConeTable spread_cones(const Neighbours& neighbours, std::span<const LengthSample> samples,
                       std::span<const float> slope, double max_length, const Blanking* blanking, SampleSites* sites) {
  ConeSpread spread(neighbours, samples, slope, max_length, blanking);
  spread.run();
  return spread.take(sites);
}

}  // namespace st
