#include "sizing/stretched_cones.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <mutex>
#include <numeric>
#include <utility>

#include "base/limits.h"
#include "base/parallel_reserve.h"
#include "base/threads.h"
#include "sizing/cone_cell.h"

namespace st {
namespace {

constexpr float kClearly = 0.99F;  // of the length along that is known: less is no gain
constexpr std::size_t kSitesPerPiece = 2'048;
constexpr std::size_t kLeastAtOnce = 16;  // samples
constexpr float kInfinity = std::numeric_limits<float>::infinity();

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
    std::sort(order.begin(), order.end(), [](std::int32_t a, std::int32_t b) { return turn_of(a) < turn_of(b); });
    for (std::size_t first = 0, n = 0; first < order.size(); first += n) {
      n = std::min(std::max(first, kLeastAtOnce), order.size() - first);
      const auto at_once = std::span(order).subspan(first, n);
      std::sort(at_once.begin(), at_once.end());  // so those that follow each other meet the same sites
      spread_all(at_once);
    }
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
  using Directions = std::array<Lengths, 3>;
  /// Of the sites of a piece of a loop.
  struct Piece {
    std::vector<std::int32_t> number;  // of the sites in `sites`
    std::vector<Site> sites;
    std::vector<Directions> turns;
    std::vector<Lengths> lengths;                // of the cones of the site at hand
    std::vector<std::int32_t> beside, n_beside;  // of all sites
    std::vector<std::int32_t> winners, n_winners;
  };

  /// Which sites a sample has come to. One for each thread at work.
  class Walk {
   public:
    explicit Walk(std::int32_t n_sites) : is_seen_(static_cast<std::size_t>(n_sites) / 64 + 1) {}
    /// Whether it is new.
    bool come_to(std::int32_t site) {
      std::uint64_t& word = is_seen_[static_cast<std::size_t>(site) / 64];
      const std::uint64_t bit = std::uint64_t{1} << (site % 64);
      if ((word & bit) != 0) return false;
      word |= bit;
      seen_.push_back(site);
      return true;
    }
    void forget() {
      for (const std::int32_t site : seen_) is_seen_[static_cast<std::size_t>(site) / 64] = 0;
      seen_.clear();
    }
    std::vector<std::int32_t> waiting;

   private:
    std::vector<std::uint64_t> is_seen_;  // a bit for each site
    std::vector<std::int32_t> seen_;
  };
  struct Win {
    std::int32_t slot, sample;
  };
  /// A list of sites for each of something.
  struct SiteLists {
    std::vector<std::int32_t> first{0}, sites;
    std::span<const std::int32_t> operator[](std::int32_t i) const {
      return std::span(sites).subspan(static_cast<std::size_t>(first[i]),
                                      static_cast<std::size_t>(first[i + 1] - first[i]));
    }
  };

  /// Few samples come first, far from each other, then as many as there were before, and so on: so few sites are
  /// lowered again and again, as they are where sample after sample comes nearer.
  static std::uint32_t turn_of(std::int32_t sample) {
    return static_cast<std::uint32_t>(sample) * 0x9E3779B1U;  // golden ratio: neighbours fall far apart
  }

  std::int32_t n_sites() const { return static_cast<std::int32_t>(table_.first.size()) - 1; }
  std::int32_t leaf_of(std::int32_t site) const {
    return site < octree_.n_leaves() ? site : blanking_->split_leaf[site - octree_.n_leaves()];
  }
  std::span<const std::int32_t> cones_of(std::int32_t site) const {
    return std::span(table_.of_site).subspan(table_.first[site], table_.first[site + 1] - table_.first[site]);
  }

  /// The pieces of a loop over all sites, which `f(site, piece)` fills.
  template <class F>
  std::vector<Piece> over_sites(const F& f) const {
    const auto n = static_cast<std::size_t>(n_sites());
    std::vector<Piece> pieces((n + kSitesPerPiece - 1) / kSitesPerPiece);
    parallel_for(n, kSitesPerPiece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t site = begin; site < end; ++site)
        f(static_cast<std::int32_t>(site), pieces[begin / kSitesPerPiece]);
    });
    return pieces;
  }

  void find_sites() {
    slot_.assign(static_cast<std::size_t>(n_sites()), kNone);
    std::vector<Piece> pieces = over_sites([&](std::int32_t site, Piece& own) {
      const std::size_t n = own.beside.size();
      visit_beside(site, [&](std::int32_t other) { own.beside.push_back(other); });
      own.n_beside.push_back(static_cast<std::int32_t>(own.beside.size() - n));
      const auto cones = cones_of(site);
      if (std::any_of(cones.begin(), cones.end(), [&](std::int32_t c) { return table_.stretch[c].along > 0; })) {
        own.number.push_back(site);
        own.sites.push_back(make_site(site, own));
      }
    });
    std::size_t n_sites = 0, n_beside = 0;
    for (const Piece& own : pieces) {
      n_sites += own.sites.size();
      n_beside += own.beside.size();
    }
    parallel_reserve(sites_, n_sites);
    parallel_reserve(beside_.sites, n_beside);
    for (Piece& own : pieces) {
      for (std::size_t i = 0; i < own.sites.size(); ++i) {
        if (own.sites[i].turns != kNone) own.sites[i].turns += static_cast<std::int32_t>(turns_.size());
        slot_[own.number[i]] = static_cast<std::int32_t>(sites_.size() + i);
      }
      sites_.insert(sites_.end(), own.sites.begin(), own.sites.end());
      turns_.insert(turns_.end(), own.turns.begin(), own.turns.end());
      beside_.sites.insert(beside_.sites.end(), own.beside.begin(), own.beside.end());
      require_countable(beside_.sites.size(), "cells beside cells");
      for (const std::int32_t n : own.n_beside) beside_.first.push_back(beside_.first.back() + n);
      own = {};
    }
    find_starts();
  }

  void find_starts() {
    std::vector<std::pair<std::int32_t, std::int32_t>> all;  // sample, site
    for (std::int32_t site = 0; site < n_sites(); ++site)
      for (const std::int32_t c : cones_of(site)) all.emplace_back(table_.sample[c], site);
    for_each_own_site(neighbours_, samples_, blanking_,
                      [&](std::int32_t site, std::int32_t sample) { all.emplace_back(sample, site); });
    std::vector<std::int32_t>& first = starts_.first;
    first.assign(samples_.size() + 1, 0);
    for (const auto& [sample, site] : all) ++first[sample + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    starts_.sites.resize(all.size());
    std::vector<std::int32_t> next(first.begin(), first.end() - 1);
    for (const auto& [sample, site] : all) starts_.sites[next[sample]++] = site;
  }

  Site make_site(std::int32_t site, Piece& own) const {
    Site s;
    s.cell = ConeCell(octree_, leaf_of(site));
    s.winner.fill(Int4{} + kNone);
    const auto cones = cones_of(site);
    own.lengths.clear();
    for (const std::int32_t c : cones) own.lengths.push_back(s.cell.lengths(kernels_, table_.cone[c]));
    const std::array<Int4, kGroups> told_by = winners_at_probes(cones, own.lengths);
    Directions directions{};
    bool is_turning = false;
    for (int g = 0; g < kGroups; ++g)
      for (int i = 0; i < 4; ++i) {
        const ConeStretch stretch = told_by[g][i] == kNone ? ConeStretch() : table_.stretch[told_by[g][i]];
        s.best[g][i] = stretch.along > 0 ? kInfinity : -kInfinity;
        for (int k = 0; k < 3; ++k) directions[k][g][i] = stretch.direction[k];
        if (stretch.along > 0) note_direction(stretch, s, is_turning);
      }
    if (is_turning) {
      s.turns = static_cast<std::int32_t>(own.turns.size());
      own.turns.push_back(directions);
    }
    for (std::size_t k = 0; k < cones.size(); ++k) {
      const std::int32_t c = cones[k];
      kernels_.lower_along(numbers(own.lengths[k]), way_of(s, table_.cone[c], table_.stretch[c], own.turns),
                           numbers(s.best));
    }
    return s;
  }

  /// Which cones, of such lengths, tell the lengths there; kNone: the largest length.
  static std::array<Int4, kGroups> winners_at_probes(std::span<const std::int32_t> cones,
                                                     std::span<const Lengths> lengths) {
    Lengths least;
    least.fill(four(kInfinity));
    std::array<Int4, kGroups> winner;
    winner.fill(Int4{} + kNone);
    for (std::size_t k = 0; k < cones.size(); ++k)
      for (int g = 0; g < kGroups; ++g) {
        winner[g] = lengths[k][g] < least[g] ? Int4{} + cones[k] : winner[g];
        least[g] = min_of(lengths[k][g], least[g]);
      }
    return winner;
  }

  static void note_direction(const ConeStretch& stretch, Site& s, bool& is_turning) {
    const bool is_first = s.unit[0] == 0 && s.unit[1] == 0 && s.unit[2] == 0;
    for (int k = 0; k < 3; ++k) {
      if (is_first) s.unit[k] = stretch.direction[k];
      if (s.unit[k] != stretch.direction[k]) is_turning = true;
    }
  }

  /// How the lengths along of a cone differ from its lengths in a site. `turns`: those of the sites.
  static LongerWay way_of(const Site& s, const Cone& cone, const ConeStretch& stretch,
                          const std::vector<Directions>& turns) {
    LongerWay way;
    if (!(stretch.along > cone.length)) return way;
    if (s.turns == kNone) {
      way.longer = stretch.length_in(s.unit, cone.length) - cone.length;
      return way;
    }
    const float ratio = cone.length / stretch.along;
    way.directions = numbers(turns[s.turns][0]);
    way.unit = stretch.direction;
    way.squeeze = 1 - ratio * ratio;
    way.length = cone.length;
    return way;
  }

  /// All of them against what is known before, so that the result does not depend on the number of threads.
  void spread_all(std::span<const std::int32_t> samples) {
    constexpr std::size_t kParts = 64;
    const std::size_t per_piece = std::clamp<std::size_t>(samples.size() / kParts, 1, 128);
    const std::size_t per_part = sites_.size() / kParts + 1;
    std::vector<std::array<std::vector<Win>, kParts>> won((samples.size() + per_piece - 1) / per_piece);
    parallel_for(samples.size(), per_piece, [&](std::size_t begin, std::size_t end) {
      std::unique_ptr<Walk> walk = take_walk();
      const auto note = [&](const Win& w) {
        won[begin / per_piece][static_cast<std::size_t>(w.slot) / per_part].push_back(w);
      };
      for (std::size_t i = begin; i < end; ++i) spread(samples[i], *walk, note);
      give_back(std::move(walk));
    });
    parallel_for(kParts, 1, [&](std::size_t part, std::size_t) {
      for (const auto& piece : won)
        for (const auto [slot, sample] : piece[part]) take(sites_[slot], sample);
    });
  }

  std::unique_ptr<Walk> take_walk() {
    const std::lock_guard lock(walks_mutex_);
    if (walks_.empty()) return std::make_unique<Walk>(n_sites());
    std::unique_ptr<Walk> walk = std::move(walks_.back());
    walks_.pop_back();
    return walk;
  }
  void give_back(std::unique_ptr<Walk> walk) {
    const std::lock_guard lock(walks_mutex_);
    walks_.push_back(std::move(walk));
  }

  /// Over sites where the sample tells the length along, or nearly. Calls note(win) for each where it does.
  template <class F>
  void spread(std::int32_t sample, Walk& walk, const F& note) const {
    const auto leads_on = [&](std::int32_t slot) {
      const auto [is_clearly, is_nearly] = offer(sites_[slot], sample);
      if (is_clearly) note(Win{slot, sample});
      return is_nearly;
    };
    for (const std::int32_t site : starts_[sample]) {
      if (!walk.come_to(site)) continue;
      walk.waiting.push_back(site);
      if (slot_[site] != kNone) leads_on(slot_[site]);
    }
    while (!walk.waiting.empty()) {
      const std::int32_t site = walk.waiting.back();
      walk.waiting.pop_back();
      for (const std::int32_t other : beside_[site])
        if (walk.come_to(other) && slot_[other] != kNone && leads_on(slot_[other])) walk.waiting.push_back(other);
    }
    walk.forget();
  }

  template <class F>
  void visit_beside(std::int32_t site, const F& f) const {
    if (!blanking_ || blanking_->site_links[site] == kNone)
      neighbours_.for_each_across_face(site, [&](std::int32_t other, const CellStep&) { f(other); });
    else
      for_each_link_across_face(*blanking_, neighbours_, site, [&](std::int32_t other, const CellStep&) { f(other); });
  }

  /// It leads on where it nearly wins: where directions turn, it may win further on.
  AlongOffer offer(const Site& s, std::int32_t sample) const {
    constexpr float kNearly = 1.002F;  // of the length along
    const Cone& cone = cones_[sample];
    return kernels_.offer_along(s.cell.numbers(), cone.numbers(), way_of(s, cone, stretch_[sample], turns_),
                                {kClearly, kNearly}, numbers(s.best));
  }
  void take(Site& s, std::int32_t sample) const {
    const Cone& cone = cones_[sample];
    kernels_.take_along(s.cell.numbers(), cone.numbers(), way_of(s, cone, stretch_[sample], turns_), sample, kClearly,
                        numbers(s.best), numbers(s.winner));
  }

  /// What wins and is no cone of the site already.
  void store() {
    std::vector<std::int32_t> number(samples_.size(), kNone);
    for (std::size_t c = 0; c < table_.sample.size(); ++c) number[table_.sample[c]] = static_cast<std::int32_t>(c);
    std::vector<Piece> pieces = over_sites([&](std::int32_t site, Piece& own) {
      const std::size_t n = own.winners.size();
      if (slot_[site] != kNone) add_winners(site, number, own.winners);
      own.n_winners.push_back(static_cast<std::int32_t>(own.winners.size() - n));
    });
    table_.first_along.push_back(0);
    for (const Piece& own : pieces) {
      for (const std::int32_t sample : own.winners) store_winner(sample, number);
      require_countable(table_.along_of_site.size(), "lengths along in cells");
      for (const std::int32_t n : own.n_winners) table_.first_along.push_back(table_.first_along.back() + n);
    }
  }

  /// Adds the samples that win in a site and are no cone of it. `number` [n_samples]: which cones they are.
  void add_winners(std::int32_t site, std::span<const std::int32_t> number, std::vector<std::int32_t>& winners) const {
    const auto first = static_cast<std::ptrdiff_t>(winners.size());
    const auto own = cones_of(site);
    const std::int32_t* winner = numbers(sites_[slot_[site]].winner);
    for (int i = 0; i < kProbes; ++i) {
      const std::int32_t sample = winner[i];
      if (sample == kNone || std::find(winners.begin() + first, winners.end(), sample) != winners.end()) continue;
      if (number[sample] == kNone || std::find(own.begin(), own.end(), number[sample]) == own.end())
        winners.push_back(sample);
    }
    std::sort(winners.begin() + first, winners.end(), [&](std::int32_t a, std::int32_t b) {
      return cones_[a].length != cones_[b].length ? cones_[a].length < cones_[b].length : a < b;
    });
  }

  void store_winner(std::int32_t sample, std::vector<std::int32_t>& number) {
    if (number[sample] == kNone) {
      number[sample] = static_cast<std::int32_t>(table_.cone.size());
      table_.cone.push_back(cones_[sample]);
      table_.cause.push_back(samples_[sample].cause);
      table_.sample.push_back(sample);
      table_.stretch.push_back(stretch_[sample]);
    }
    table_.along_of_site.push_back(number[sample]);
  }

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
  SiteLists beside_;  // of each site: to which lengths pass from it
  SiteLists starts_;  // of each sample: where it tells a length or lies
  std::mutex walks_mutex_;
  std::vector<std::unique_ptr<Walk>> walks_;  // not in use
};

}  // namespace

void add_stretch(const Neighbours& neighbours, std::span<const LengthSample> samples, std::span<const float> slope,
                 const Blanking* blanking, ConeTable& table) {
  if (std::none_of(samples.begin(), samples.end(), [](const LengthSample& s) { return s.stretch.along > 0; })) return;
  StretchSpread(neighbours, samples, slope, blanking, table).run();
}

}  // namespace st
