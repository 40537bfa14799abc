// A cell, or a part of one, while cones spread. Internal to sizing.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "sizing/cone_cell.h"

namespace st {

/// What a site knows while cones spread. What an offer needs comes first.
struct alignas(64) ConeSite {
  static constexpr std::int32_t kOwn = 8;

  ConeCell cell;
  Lengths best;               // smallest at the probes
  std::int32_t n = 0;         // its samples, in order
  std::int32_t more = kNone;  // the last of those beyond `own`, into the entries of its part
  std::int32_t n_refused = 0;
  std::uint64_t may_have = 0;  // a bit for each of its samples, the same one for some
  std::array<Int4, 2> own{Int4{} + kNone, Int4{} + kNone};
  Int4 refused = Int4{} + kNone;                 // the last samples that were, which others may offer again
  std::array<Int4, kProbeGroups> winner;         // the sample of `best`; kNone: the largest length
  std::pair<std::int32_t, std::int32_t> beside;  // first and after the last in beside_

  /// Asks the memory for it. Inlined: else it is taken for a function without effect.
  [[gnu::always_inline]] void fetch() const {
    constexpr std::size_t kLine = 64;  // bytes of the cache
    for (std::size_t at = 0; at < sizeof(ConeSite); at += kLine)
      __builtin_prefetch(reinterpret_cast<const std::byte*>(this) + at);
  }
  std::int32_t own_sample(std::int32_t i) const { return own[i / 4][i % 4]; }
  static std::uint64_t bit_of(std::int32_t sample) {
    return std::uint64_t{1} << (static_cast<std::uint32_t>(sample) * 0x9E3779B1U >> 26);
  }
  /// At the corner closest to a cone.
  std::int32_t winner_towards(const Cone& cone) const {
    return winner[cone.x[2] > cell.c[2]][(cone.x[0] > cell.c[0]) + 2 * (cone.x[1] > cell.c[1])];
  }
  /// The sides with a probe where a sample wins.
  std::int32_t sides_won(std::int32_t sample) const {
    constexpr Int4 kSides[kProbeGroups] = {{1 + 4 + 16, 2 + 4 + 16, 1 + 8 + 16, 2 + 8 + 16},
                                           {1 + 4 + 32, 2 + 4 + 32, 1 + 8 + 32, 2 + 8 + 32},
                                           {1, 2, 4, 8},
                                           {16, 32, 0, 0}};
    Int4 sides{};
    for (int g = 0; g < kProbeGroups; ++g) sides |= (winner[g] == sample) & kSides[g];
    return sides[0] | sides[1] | sides[2] | sides[3];
  }
  bool is_winner(std::int32_t sample) const {
    return is_any((winner[0] == sample) | (winner[1] == sample) | (winner[2] == sample) | (winner[3] == sample));
  }
};

/// A sample that tells the length in a site, and is to be passed on.
struct ConeEvent {
  std::int32_t site, sample;
  std::int32_t n;  ///< samples of the site with it; 0: it lies there and is not taken yet
};

/// A sample, and a site in which it may tell the length, or does.
struct SiteSample {
  std::int32_t site, sample;
};

/// Some sites that follow each other, and what one thread at a time does with them. However sites are split into parts:
/// each site is given the same offers in the same order.
struct ConePart {
  std::vector<std::vector<ConeEvent>> buckets;  ///< by length
  std::vector<ConeEvent> events, sorting;       ///< those at hand, by site
  std::vector<std::vector<SiteSample>> offers;  ///< to sites of each part
  std::vector<SampleLink> entries;              ///< of sites with many samples

  /// Whether f(sample) is true for any sample of a site.
  template <class F>
  bool any_sample(const ConeSite& s, const F& f) const {
    const std::int32_t n_own = std::min(s.n, ConeSite::kOwn);
    for (std::int32_t i = 0; i < n_own; ++i)
      if (f(s.own_sample(i))) return true;
    for (std::int32_t k = s.more; k != kNone; k = entries[k].next)
      if (f(entries[k].sample)) return true;
    return false;
  }
  bool has(const ConeSite& s, std::int32_t sample) const {
    if ((s.may_have & ConeSite::bit_of(sample)) == 0) return false;
    if (is_any((s.own[0] == sample) | (s.own[1] == sample))) return true;
    std::int32_t k = s.more;
    while (k != kNone && entries[k].sample != sample) k = entries[k].next;
    return k != kNone;
  }
  void add(ConeSite& s, std::int32_t sample) {
    if (s.n < ConeSite::kOwn) {
      s.own[s.n / 4][s.n % 4] = sample;
    } else {
      entries.push_back({sample, s.more});
      s.more = static_cast<std::int32_t>(entries.size()) - 1;
    }
    s.may_have |= ConeSite::bit_of(sample);
    ++s.n;
  }
};

}  // namespace st
