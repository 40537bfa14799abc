#include "sizing/stretched_cones.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <numeric>
#include <utility>
#include <vector>

#include "base/limits.h"
#include "base/lists_by_key.h"
#include "base/parallel_reserve.h"
#include "base/threads.h"
#include "sizing/cone_cell.h"
#include "sizing/cone_site.h"

namespace st {
namespace {

constexpr float kClearly = 0.99F;  // of the length along that is known: less is no gain
constexpr std::size_t kSitesPerPiece = 2'048;
constexpr std::size_t kLeastAtOnce = 16;  // samples
constexpr float kInfinity = std::numeric_limits<float>::infinity();

class StretchSpread {
 public:
  StretchSpread(const OctreeView& octree, std::span<const LengthSample> samples, std::span<const float> slope,
                const SampleSites& sites, ConeTable& table)
      : graph_(sites.graph), own_sites_(sites.own), samples_(samples), table_(table) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      cones_.emplace_back(samples[i], slope[i], octree.lo);
      stretch_.emplace_back(samples[i].stretch);
    }
  }

  void run() {
    for (const std::int32_t sample : table_.sample) table_.stretch.push_back(stretch_[sample]);
    find_sites();
    find_starts();
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
  /// The directions of the cones that tell the lengths at the probes.
  using Directions = std::array<std::array<float, kProbes>, 3>;
  /// Of the sites of a piece of a loop.
  struct Piece {
    std::vector<Directions> turns;
    std::vector<Lengths> lengths;  // of the cones of the site at hand
    std::vector<std::int32_t> winners, n_winners;
  };

  /// Which sites a sample has come to, but for those where nothing is stretched. One for each thread at work.
  struct Walk {
    std::vector<std::uint64_t> is_seen;  // a bit for each site
    std::vector<std::int32_t> found;     // the first `n` count
    std::size_t n = 0;
    std::vector<std::int32_t> waiting;
    std::vector<AlongGain> gains;

    bool come_to(std::int32_t site) {
      const auto number = static_cast<std::uint32_t>(site);
      std::uint64_t& word = is_seen[number / 64];
      const std::uint64_t bit = std::uint64_t{1} << (number % 64);
      if ((word & bit) != 0) return false;
      word |= bit;
      found[n++] = site;
      return true;
    }
    void come_to_all(std::span<const SiteBeside> sites) {
      make_room(sites.size());
      std::int32_t* to = found.data() + n;
      std::uint64_t* const words = is_seen.data();
      for (const SiteBeside& s : sites) {
        const auto number = static_cast<std::uint32_t>(s.site);
        const std::uint64_t word = words[number / 64], bit = std::uint64_t{1} << (number % 64);
        if ((word & bit) != 0) continue;
        words[number / 64] = word | bit;
        *to++ = s.site;
      }
      n = static_cast<std::size_t>(to - found.data());
    }
    /// For so many that are found.
    void make_room(std::size_t n_more) {
      if (found.size() < n + n_more) found.resize(2 * (n + n_more));
    }
  };
  /// A list of sites for each sample.
  /// Few samples come first, far from each other, then as many as there were before, and so on: so few sites are
  /// lowered again and again, as they are where sample after sample comes nearer.
  static std::uint32_t turn_of(std::int32_t sample) {
    return static_cast<std::uint32_t>(sample) * 0x9E3779B1U;  // golden ratio: neighbours fall far apart
  }

  std::size_t n_sites() const { return graph_.cell.size(); }
  std::span<const std::int32_t> cones_of(std::size_t site) const {
    return std::span(table_.of_site).subspan(table_.first[site], table_.first[site + 1] - table_.first[site]);
  }
  const float* turns() const { return turns_.empty() ? nullptr : turns_[0][0].data(); }
  static AlongCone along_cone(const Cone& cone, const ConeStretch& stretch) {
    return {cone.numbers(), stretch.direction, stretch.along};
  }
  AlongCone along_cone(std::int32_t sample) const { return along_cone(cones_[sample], stretch_[sample]); }

  /// The pieces of a loop over all sites, which `f(site, piece)` fills.
  template <class F>
  std::vector<Piece> over_sites(const F& f) const {
    std::vector<Piece> pieces((n_sites() + kSitesPerPiece - 1) / kSitesPerPiece);
    parallel_for(n_sites(), kSitesPerPiece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t site = begin; site < end; ++site) f(site, pieces[begin / kSitesPerPiece]);
    });
    return pieces;
  }

  void find_sites() {
    parallel_reserve(sites_, n_sites());
    sites_.resize(n_sites());
    std::vector<Piece> pieces = over_sites([&](std::size_t site, Piece& own) { make_site(site, own); });
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const auto first = static_cast<std::int32_t>(turns_.size());
      const std::size_t end = std::min(n_sites(), (i + 1) * kSitesPerPiece);
      for (std::size_t site = i * kSitesPerPiece; first > 0 && site < end; ++site)
        if (sites_[site].turns != kNone) sites_[site].turns += first;
      turns_.insert(turns_.end(), pieces[i].turns.begin(), pieces[i].turns.end());
      pieces[i] = {};
    }
    is_plain_.resize(n_sites() / 64 + 1);
    for (std::size_t site = 0; site < n_sites(); ++site)
      if (!is_stretched(site)) is_plain_[site / 64] |= std::uint64_t{1} << (site % 64);
  }

  /// Whether any cone of the site is.
  bool is_stretched(std::size_t site) const {
    return std::ranges::any_of(cones_of(site), [&](std::int32_t c) { return table_.stretch[c].along > 0; });
  }

  /// Where each sample tells a length.
  void find_starts() {
    starts_ = {samples_.size(), [&](const auto& visit) {
                 for (std::size_t site = 0; site < n_sites(); ++site)
                   for (const std::int32_t c : cones_of(site)) visit(table_.sample[c], static_cast<std::int32_t>(site));
               }};
    lies_in_ = {samples_.size(), [&](const auto& visit) {
                  for (const auto& [site, sample] : own_sites_) visit(sample, site);
                }};
  }

  void make_site(std::size_t site, Piece& own) {
    AlongSite& s = sites_[site];
    const ConeCell& cell = graph_.cell[site];
    std::copy_n(cell.numbers(), 4, s.cell);
    std::fill_n(s.winner, kProbes, kNone);
    std::fill_n(s.best, kProbes, -kInfinity);
    std::fill_n(s.unit, 3, 0.0F);
    s.turns = kNone;
    if (!is_stretched(site)) return;
    const auto cones = cones_of(site);
    own.lengths.clear();
    for (const std::int32_t c : cones) own.lengths.push_back(cell.lengths(kernels_, table_.cone[c]));
    const std::array<Int4, kProbeGroups> told_by = winners_at_probes(cones, own.lengths);
    Directions directions{};
    bool is_turning = false;
    for (int i = 0; i < kProbes; ++i) {
      const std::int32_t c = told_by[i / 4][i % 4];
      if (c == kNone || !(table_.stretch[c].along > 0)) continue;
      s.best[i] = kInfinity;
      for (int k = 0; k < 3; ++k) directions[k][i] = table_.stretch[c].direction[k];
      note_direction(table_.stretch[c], s, is_turning);
    }
    if (is_turning) {
      s.turns = static_cast<std::int32_t>(own.turns.size());
      own.turns.push_back(directions);
    }
    const float* const turns = is_turning ? own.turns[0][0].data() : nullptr;
    for (std::size_t k = 0; k < cones.size(); ++k)
      kernels_.lower_along(numbers(own.lengths[k]), along_cone(table_.cone[cones[k]], table_.stretch[cones[k]]), turns,
                           s);
  }

  /// Which cones, of such lengths, tell the lengths there; kNone: the largest length.
  static std::array<Int4, kProbeGroups> winners_at_probes(std::span<const std::int32_t> cones,
                                                          std::span<const Lengths> lengths) {
    Lengths least;
    least.fill(four(kInfinity));
    std::array<Int4, kProbeGroups> winner;
    winner.fill(Int4{} + kNone);
    for (std::size_t k = 0; k < cones.size(); ++k)
      for (int g = 0; g < kProbeGroups; ++g) {
        winner[g] = lengths[k][g] < least[g] ? Int4{} + cones[k] : winner[g];
        least[g] = min_of(lengths[k][g], least[g]);
      }
    return winner;
  }

  static void note_direction(const ConeStretch& stretch, AlongSite& s, bool& is_turning) {
    const bool is_first = s.unit[0] == 0 && s.unit[1] == 0 && s.unit[2] == 0;
    for (int k = 0; k < 3; ++k) {
      if (is_first) s.unit[k] = stretch.direction[k];
      if (s.unit[k] != stretch.direction[k]) is_turning = true;
    }
  }

  /// All of them against what is known before, so that the result does not depend on the number of threads.
  void spread_all(std::span<const std::int32_t> samples) {
    constexpr std::size_t kParts = 64;
    const std::size_t per_piece = std::clamp<std::size_t>(samples.size() / kParts, 1, 128);
    const std::size_t per_part = n_sites() / kParts + 1;
    std::vector<std::array<std::vector<SiteSample>, kParts>> won((samples.size() + per_piece - 1) / per_piece);
    parallel_for(samples.size(), per_piece, [&](std::size_t begin, std::size_t end) {
      std::unique_ptr<Walk> walk = take_walk();
      const auto note = [&](const SiteSample& w) {
        won[begin / per_piece][static_cast<std::size_t>(w.site) / per_part].push_back(w);
      };
      for (std::size_t i = begin; i < end; ++i) spread(samples[i], *walk, note);
      give_back(std::move(walk));
    });
    parallel_for(kParts, 1, [&](std::size_t part, std::size_t) {
      for (const auto& piece : won)
        for (const auto [site, sample] : piece[part])
          kernels_.take_along(along_cone(sample), sample, turns(), kClearly, sites_[site]);
    });
  }

  std::unique_ptr<Walk> take_walk() {
    const std::lock_guard lock(walks_mutex_);
    if (walks_.empty()) return std::make_unique<Walk>(Walk{is_plain_, {}, 0, {}, {}});
    std::unique_ptr<Walk> walk = std::move(walks_.back());
    walks_.pop_back();
    return walk;
  }
  void give_back(std::unique_ptr<Walk> walk) {
    const std::lock_guard lock(walks_mutex_);
    walks_.push_back(std::move(walk));
  }

  /// Over sites where the sample tells the length along, or nearly. Calls note(win) for each where it does. It begins
  /// where it tells a length, and knows nothing new there, and where it lies.
  template <class F>
  void spread(std::int32_t sample, Walk& walk, const F& note) const {
    walk.n = 0;
    walk.waiting.assign(starts_[sample].begin(), starts_[sample].end());
    walk.make_room(walk.waiting.size() + lies_in_[sample].size());
    for (const std::int32_t site : walk.waiting) walk.come_to(site);
    std::size_t n_offered = walk.n;
    for (const std::int32_t site : lies_in_[sample])
      if (walk.come_to(site) || is_plain(site)) walk.waiting.push_back(site);
    offer_rest(sample, n_offered, walk, note, [](std::int32_t, AlongGain) {});
    while (!walk.waiting.empty()) {
      for (const std::int32_t site : walk.waiting) walk.come_to_all(graph_.beside_of(site));
      walk.waiting.clear();
      offer_rest(sample, n_offered, walk, note, [&](std::int32_t site, AlongGain gain) {
        if (gain != kNoGain) walk.waiting.push_back(site);
      });
    }
    for (const std::int32_t site : std::span(walk.found).first(walk.n))
      walk.is_seen[static_cast<std::size_t>(site) / 64] = is_plain_[static_cast<std::size_t>(site) / 64];
  }
  bool is_plain(std::int32_t site) const {
    return (is_plain_[static_cast<std::size_t>(site) / 64] >> (site % 64) & 1) != 0;
  }

  /// To the sites that are found from the `n_offered`-th on. It leads on where it nearly wins: where directions turn,
  /// it may win further on.
  template <class F, class G>
  void offer_rest(std::int32_t sample, std::size_t& n_offered, Walk& walk, const F& note, const G& told) const {
    constexpr float kNearly = 1.002F;  // of the length along
    const std::span<const std::int32_t> rest = std::span(walk.found).subspan(n_offered, walk.n - n_offered);
    n_offered = walk.n;
    walk.gains.resize(rest.size());
    kernels_.offer_along(along_cone(sample), sites_.data(), turns(), rest.data(),
                         static_cast<std::int32_t>(rest.size()), {kClearly, kNearly}, walk.gains.data());
    for (std::size_t i = 0; i < rest.size(); ++i) {
      if (walk.gains[i] == kClearlyGains) note(SiteSample{rest[i], sample});
      told(rest[i], walk.gains[i]);
    }
  }

  /// What wins and is no cone of the site already.
  void store() {
    std::vector<std::int32_t> number(samples_.size(), kNone);
    for (std::size_t c = 0; c < table_.sample.size(); ++c) number[table_.sample[c]] = static_cast<std::int32_t>(c);
    std::vector<Piece> pieces = over_sites([&](std::size_t site, Piece& own) {
      const std::size_t n = own.winners.size();
      if (!is_plain(static_cast<std::int32_t>(site))) add_winners(site, number, own.winners);
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
  void add_winners(std::size_t site, std::span<const std::int32_t> number, std::vector<std::int32_t>& winners) const {
    const auto first = static_cast<std::ptrdiff_t>(winners.size());
    const auto own = cones_of(site);
    for (const std::int32_t sample : sites_[site].winner) {
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

  const SiteGraph& graph_;
  const std::span<const std::pair<std::int32_t, std::int32_t>> own_sites_;
  const ConeKernels& kernels_ = cone_kernels();
  const std::span<const LengthSample> samples_;
  ConeTable& table_;
  std::vector<Cone> cones_;           // [n_samples]
  std::vector<ConeStretch> stretch_;  // [n_samples]
  std::vector<AlongSite> sites_;      // [n_sites]
  std::vector<Directions> turns_;
  std::vector<std::uint64_t> is_plain_;  // a bit for each site: nothing is stretched there
  ListsByKey<> starts_, lies_in_;        // of each sample: where it tells a length, where it lies
  std::mutex walks_mutex_;
  std::vector<std::unique_ptr<Walk>> walks_;  // not in use
};

}  // namespace

void add_stretch(const OctreeView& octree, std::span<const LengthSample> samples, std::span<const float> slope,
                 const SampleSites& sites, ConeTable& table) {
  if (std::none_of(samples.begin(), samples.end(), [](const LengthSample& s) { return s.stretch.along > 0; })) return;
  StretchSpread(octree, samples, slope, sites, table).run();
}

}  // namespace st
