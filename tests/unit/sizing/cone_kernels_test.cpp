#include "sizing/cone_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <iostream>
#include <random>
#include <vector>

#include "sizing/cone_cell.h"
#include "unit/sizing/cases.h"

namespace st {
namespace {

constexpr ConeShares kTestShares{0.997F, 0.99F};

/// Cones and a cell at random: points, lines and rectangles, beside the cell and far from it.
struct RandomCones {
  std::vector<Cone> cone;
  ConeCell cell;

  explicit RandomCones(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(-1, 1);
    cell.half = 0.1F + 0.05F * unit(random);
    for (float& c : cell.c) c = 1 + unit(random);
    for (int i = 0; i < 40; ++i) {
      LengthSample s;
      const double reach = i % 2 == 0 ? 0.3 : 2;
      s.xyz =
          Vec3{cell.c[0] + reach * unit(random), cell.c[1] + reach * unit(random), cell.c[2] + reach * unit(random)};
      s.length = 0.05F + 0.02F * unit(random);
      const Vec3 along{unit(random), unit(random), unit(random)}, across{unit(random), unit(random), unit(random)};
      if (i % 3 != 0) s.reach = reach_of(0.1 * along, i % 3 == 1 ? Vec3{} : 0.06 * across);
      cone.emplace_back(s, 0.2F, Vec3{});
    }
  }
  KnownCones known(const std::vector<std::int32_t>& own) const {
    return {cone.front().numbers(), kNone, kNone, own.data(), static_cast<std::int32_t>(own.size()), nullptr, kNone};
  }
};

TEST(ConeKernels, tell_the_lengths_of_a_cone_at_the_probes) {
  const RandomCones all(1);
  const ConeCell& cell = all.cell;
  for (const Cone& cone : all.cone) {
    const Lengths lengths = cell.lengths(cone_kernels(), cone);
    double least = 1e9;
    for (int k = 0; k < 8; ++k) {  // the corners
      const Vec3 x = Vec3{cell.c[0], cell.c[1], cell.c[2]} +
                     static_cast<double>(cell.half) * Vec3{k & 1 ? 1. : -1, k & 2 ? 1. : -1, k & 4 ? 1. : -1};
      EXPECT_NEAR(lengths[k / 4][k % 4], cone.length_at(x), 1e-6);
      least = std::min(least, cone.length_at(x));
    }
    EXPECT_NEAR(lengths[kProbeGroups - 1][3], cone.length_at({cell.c[0], cell.c[1], cell.c[2]}), 1e-6);
    Lengths best;
    best.fill(four(10));
    std::array<Int4, kProbeGroups> winner{};
    EXPECT_LE(cone_kernels().take(numbers(lengths), 7, numbers(best), numbers(winner)), least + 1e-6);
    EXPECT_EQ(winner[0][0], 7);
    Lengths own;
    bool is_near = false;
    EXPECT_FALSE(
        cone_kernels().offer(cell.numbers(), cone.numbers(), numbers(best), kTestShares, numbers(own), is_near));
    EXPECT_EQ(is_near, cone_kernels().is_near(cell.numbers(), cone.numbers()));
    best[2][1] = 10;
    EXPECT_TRUE(
        cone_kernels().offer(cell.numbers(), cone.numbers(), numbers(best), kTestShares, numbers(own), is_near));
  }
}

/// Unit vectors at the probes of a cell, by coordinate.
std::vector<float> random_directions(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<float> directions(3 * kProbes);
  for (int i = 0; i < kProbes; ++i) {
    const Vec3 d = normalized({unit(random), unit(random), unit(random)});
    const double of[] = {d.x, d.y, d.z};
    for (int k = 0; k < 3; ++k) directions[static_cast<std::size_t>(k * kProbes + i)] = static_cast<float>(of[k]);
  }
  return directions;
}

/// A cell in which nothing is known but at one probe.
AlongSite empty_site(const ConeCell& cell, int known, float length) {
  AlongSite site{};
  std::copy_n(cell.numbers(), 4, site.cell);
  std::fill_n(site.best, kProbes, 10.0F);
  std::fill_n(site.winner, kProbes, kNone);
  site.best[known] = length;
  return site;
}

TEST(ConeKernels, tell_lengths_along_the_directions_of_a_cell) {
  constexpr AlongShares kShares{0.99F, 1.002F};
  const RandomCones all(3);
  const std::vector<float> directions = random_directions(4);
  const float unit[3] = {0, 0.6F, 0.8F};
  ConeStretch stretch;
  stretch.direction[1] = 1;
  for (const Cone& cone : all.cone)
    for (const std::int32_t turns : {0, kNone}) {
      stretch.along = 7 * cone.length;
      const AlongCone along{cone.numbers(), stretch.direction, stretch.along};
      const Lengths lengths = all.cell.lengths(cone_kernels(), cone);
      AlongSite sites[2] = {empty_site(all.cell, 6, 0.1F * cone.length), empty_site(all.cell, 6, 0)};
      AlongSite& site = sites[0];
      site.turns = turns;
      std::copy_n(unit, 3, site.unit);
      std::fill_n(sites[1].best, kProbes, 0.0F);  // where no cone gains
      AlongSite lowered = site;
      const auto gain = [&] {
        constexpr std::int32_t kWhich[2] = {1, 0};
        AlongGain gains[2];
        cone_kernels().offer_along(along, sites, directions.data(), kWhich, 2, kShares, gains);
        EXPECT_EQ(gains[0], kNoGain);
        return gains[1];
      };
      EXPECT_EQ(gain(), kClearlyGains);
      cone_kernels().take_along(along, 7, directions.data(), kShares.clearly, site);
      for (int i = 0; i < kProbes; ++i) {
        if (i == 6) continue;
        const float turning[3] = {directions[i], directions[kProbes + i], directions[2 * kProbes + i]};
        EXPECT_NEAR(
            site.best[i],
            test::length_in(stretch, turns == 0 ? turning : unit, cone.length, lengths[i / 4][i % 4] - cone.length),
            1e-6);
        EXPECT_EQ(site.winner[i], 7);
      }
      EXPECT_EQ(site.best[6], 0.1F * cone.length) << "what is shorter stays";
      EXPECT_EQ(site.winner[6], kNone);
      cone_kernels().lower_along(numbers(lengths), along, directions.data(), lowered);
      EXPECT_TRUE(std::equal(site.best, site.best + kProbes, lowered.best));
      for (float& length : site.best) length *= 0.9985F;  // a sample that is nearly as short leads on
      EXPECT_EQ(gain(), kNearlyGains);
      for (float& length : site.best) length *= 0.99F;
      EXPECT_EQ(gain(), kNoGain);
      cone_kernels().take_along(along, 8, directions.data(), kShares.clearly, site);
      EXPECT_EQ(site.winner[0], 7);
    }
}

TEST(ConeKernels, ask_every_cone_that_is_known) {
  RandomCones all(2);
  Cone& won = all.cone[0];
  std::copy_n(all.cell.c, 3, won.x);  // in the middle of the cell
  won.length = 0.05F;
  for (std::size_t i = 1; i < all.cone.size(); ++i) all.cone[i].length = 1;
  const ConeKernels& kernels = cone_kernels();
  const auto wins = [&](const KnownCones& known) {
    return kernels.wins_nearby(all.cell.numbers(), won.numbers(), 0.997F, 10, known);
  };
  EXPECT_TRUE(wins(all.known({1, 2, 3})));
  all.cone[3] = won;  // as short: no gain
  EXPECT_FALSE(wins(all.known({1, 2, 3})));
  const std::vector<std::int32_t> two{1, 2};
  KnownCones known = all.known(two);
  const SampleLink links[] = {{4, kNone}, {3, 0}};
  known.links = links;
  EXPECT_TRUE(wins(known));
  known.link = 1;
  EXPECT_FALSE(wins(known));
  known.without = 3;
  EXPECT_TRUE(wins(known));
  known.first = 3;
  EXPECT_FALSE(wins(known));
  EXPECT_FALSE(kernels.wins_nearby(all.cell.numbers(), won.numbers(), 0.997F, 0.04F, all.known({})));
}

/// Cones side by side, the shortest lengths first, of which every second is longer along a direction.
struct StretchedCones {
  std::vector<Cone> cones;
  std::vector<ConeStretch> stretches;

  explicit StretchedCones(unsigned seed) {
    for (unsigned i = 0; i < 5; ++i)
      for (const Cone& c : RandomCones(100 * seed + i).cone) cones.push_back(c);
    std::sort(cones.begin(), cones.end(), [](const Cone& a, const Cone& b) { return a.length < b.length; });
    const std::vector<float> directions = random_directions(seed);
    for (std::size_t i = 0; i < cones.size(); ++i) {
      ConeStretch s;
      for (std::size_t k = 0; k < 3; ++k) s.direction[k] = directions[k * kProbes + i / 2 % kProbes];
      s.along = i % 2 == 0 ? static_cast<float>(2 + i % 40) * cones[i].length : 0;
      stretches.push_back(s);
    }
  }
  AlongCones along(const std::vector<std::int32_t>& own, const std::vector<std::int32_t>& more) const {
    return {cones[0].numbers(),
            stretches[0].direction,
            own.data(),
            more.data(),
            static_cast<std::int32_t>(own.size()),
            static_cast<std::int32_t>(more.size()),
            3,
            30};
  }
  /// One by one, in the direction of a cone.
  float least_along(const std::vector<std::int32_t>& asked, std::int32_t of, Vec3 x, float least) const {
    for (const std::int32_t c : asked)
      least = std::min(least, test::length_in(stretches[c], stretches[of].direction, cones[c].length,
                                              static_cast<float>(cones[c].length_at(x)) - cones[c].length));
    return least;
  }
};

TEST(ConeKernels, tell_the_least_length_along_the_direction_of_the_cone_that_tells_the_length) {
  int n_along = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const StretchedCones all(seed);
    std::vector<std::int32_t> own, more;
    const std::int32_t n = seed % 2 == 0 ? 7 : static_cast<std::int32_t>(all.cones.size());
    for (std::int32_t i = 0; i < n; ++i) (i % 5 == 4 ? more : own).push_back(i);
    const Vec3 x = Vec3{all.cones[seed].x[0], all.cones[seed].x[1], all.cones[seed].x[2]} + Vec3{0.01, 0.02, 0.005};
    const SplitPlace place(x);
    const LeastAlong found = cone_kernels().least_along(all.along(own, more), place.numbers());
    std::int32_t winner = kNone;
    EXPECT_EQ(found.length, cone_kernels().least(all.cones[0].numbers(), own.data(),
                                                 static_cast<std::int32_t>(own.size()), place.numbers(), 3, &winner));
    winner = own[static_cast<std::size_t>(winner)];
    const bool is_stretched = all.stretches[static_cast<std::size_t>(winner)].along > 0;
    EXPECT_EQ(found.winner, is_stretched ? winner : kNone);
    if (!is_stretched) continue;
    ++n_along;
    const float least = all.least_along(own, winner, x, std::min(3.0F, 30 * found.length));
    EXPECT_NEAR(found.along, all.least_along(more, winner, x, least), 1e-6);
  }
  EXPECT_GT(n_along, 10);
}

/// Expects of cones, the shortest lengths first, what they tell one by one at a place.
void expect_least(const ConeKernels& kernels, const std::vector<Cone>& cones, const std::vector<std::int32_t>& own,
                  Vec3 x, float largest) {
  const SplitPlace place(x);
  double least = static_cast<double>(largest);
  std::int32_t teller = kNone, winner = -5;
  for (std::size_t i = 0; i < own.size(); ++i)
    if (const double length = cones[own[i]].length_at(x); length < least) {
      least = length;
      teller = static_cast<std::int32_t>(i);
    }
  const auto n = static_cast<std::int32_t>(own.size());
  const float length = kernels.least(cones.front().numbers(), own.data(), n, place.numbers(), largest, &winner);
  EXPECT_NEAR(length, least, 1e-6 * least);
  EXPECT_EQ(length, kernels.least(cones.front().numbers(), own.data(), n, place.numbers(), largest, nullptr));
  EXPECT_EQ(winner, teller);
}

TEST(ConeKernels, find_the_least_of_cones_at_a_place) {
  std::vector<const ConeKernels*> kernels{&detail::cone_kernels_anywhere()};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) kernels.push_back(&detail::cone_kernels_avx2());
#endif
  for (unsigned seed = 0; seed < 30; ++seed) {
    RandomCones all(seed);
    std::sort(all.cone.begin(), all.cone.end(), [](const Cone& a, const Cone& b) { return a.length < b.length; });
    const double at = 0.1 * (seed % 7);
    const Vec3 x{all.cell.c[0] + at, all.cell.c[1] - at, all.cell.c[2] + 1e-9};
    std::vector<std::int32_t> own;
    for (std::int32_t i = 0; i < 40; i += 1 + static_cast<std::int32_t>(seed) % 3) {
      for (const ConeKernels* k : kernels)
        for (const float largest : {0.06F, 0.2F}) expect_least(*k, all.cone, own, x, largest);
      own.push_back(i);
    }
    for (const ConeKernels* k : kernels) expect_least(*k, all.cone, {own[3], own[3], own[3]}, x, 1);
  }
}

#if defined(__x86_64__)
/// Whether the cone wins on a face of the cell over those known, by both kinds of kernels; likewise what they add to
/// two cells, of which one has the cones of even numbers.
bool expect_same_on_face(const RandomCones& all, std::int32_t i, const std::vector<std::int32_t>& known) {
  const auto axis = i % 3, set = i / 3 % kFaceSets;
  ConeFace face{{all.cell.c[0], all.cell.c[1], all.cell.c[2]}, all.cell.half, axis};
  face.c[axis] += face.half;
  const ConeKernels* const kernels[] = {&detail::cone_kernels_anywhere(), &detail::cone_kernels_avx2()};
  bool wins[2];
  std::int32_t n_added[2];
  std::vector<FaceCone> on_face[2];
  for (int k = 0; k < 2; ++k) {
    wins[k] = kernels[k]->wins_on_face(face, set, all.cone[i].numbers(), 0.3F, all.known(known));
    for (const std::int32_t cone : known) on_face[k].push_back({cone, cone % 2 + 1});
    std::vector<float> lengths(known.size() * kFacePlaces);
    n_added[k] = kernels[k]->settle_face(face, set, all.cone.front().numbers(), 0.3F, 1 + i % 3, on_face[k].data(),
                                         static_cast<std::int32_t>(known.size()), lengths.data());
  }
  EXPECT_EQ(wins[0], wins[1]);
  EXPECT_EQ(n_added[0], n_added[1]);
  for (std::size_t k = 0; k < known.size(); ++k) {
    EXPECT_EQ(on_face[0][k].of, on_face[1][k].of);
    EXPECT_EQ(on_face[0][k].added, on_face[1][k].added);
  }
  return wins[0];
}

/// Likewise the lengths along of a cell, in one direction and in several.
void expect_same_along(const RandomCones& all, std::size_t i) {
  const ConeKernels* const kernels[] = {&detail::cone_kernels_anywhere(), &detail::cone_kernels_avx2()};
  const std::vector<float> directions = random_directions(static_cast<unsigned>(i));
  const Cone& cone = all.cone[i];
  const float unit[3] = {0.6F, 0, 0.8F};
  const AlongCone along{cone.numbers(), unit, 6 * cone.length};
  for (const std::int32_t turns : {0, kNone}) {
    AlongSite site[2];
    AlongGain gain[2];
    for (int k = 0; k < 2; ++k) {
      site[k] = empty_site(all.cell, 3, 0.4F);
      site[k].turns = turns;
      site[k].unit[1] = 1;
      constexpr std::int32_t kFirst = 0;
      kernels[k]->offer_along(along, &site[k], directions.data(), &kFirst, 1, {0.99F, 1.002F}, &gain[k]);
      kernels[k]->take_along(along, 3, directions.data(), 0.99F, site[k]);
      kernels[k]->lower_along(numbers(all.cell.lengths(*kernels[k], cone)), along, directions.data(), site[k]);
    }
    EXPECT_EQ(gain[0], gain[1]);
    EXPECT_EQ(std::memcmp(&site[0], &site[1], sizeof(AlongSite)), 0);
  }
}

/// Likewise at a place.
void expect_same_least_along(unsigned seed) {
  const StretchedCones all(seed);
  const std::vector<std::int32_t> own{0, 3, 4, 8, 9, 12, 15, 17, 20}, more{2, 5};
  const SplitPlace place({1.01, 0.98, 1.1});
  const AlongCones along = all.along(own, more);
  const LeastAlong a = detail::cone_kernels_anywhere().least_along(along, place.numbers()),
                   b = detail::cone_kernels_avx2().least_along(along, place.numbers());
  EXPECT_EQ(a.length, b.length);
  EXPECT_EQ(a.along, b.along);
  EXPECT_EQ(a.winner, b.winner);
}
#endif

TEST(ConeKernels, give_the_same_bits_on_every_processor) {
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("avx2")) {
    std::cout << "SKIPPED: ConeKernels.give_the_same_bits_on_every_processor: this processor has no AVX2" << std::endl;
    GTEST_SKIP();
  }
  const ConeKernels &anywhere = detail::cone_kernels_anywhere(), &avx2 = detail::cone_kernels_avx2();
  int n_won = 0, n_won_on_face = 0;
  for (unsigned seed = 0; seed < 50; ++seed) {
    const RandomCones all(seed);
    Lengths best[2];
    std::array<Int4, kProbeGroups> winner[2];
    for (int k = 0; k < 2; ++k) {
      best[k].fill(four(0.2F));
      winner[k].fill(Int4{} + kNone);
    }
    std::vector<std::int32_t> own;
    for (std::size_t i = 0; i < all.cone.size(); ++i) {
      Lengths lengths[2];
      bool is_near[2], is_below[2];
      float least[2];
      for (int k = 0; k < 2; ++k) {
        const ConeKernels& kernels = k == 0 ? anywhere : avx2;
        is_below[k] = kernels.offer(all.cell.numbers(), all.cone[i].numbers(), numbers(best[k]), kTestShares,
                                    numbers(lengths[k]), is_near[k]);
        least[k] =
            kernels.take(numbers(lengths[k]), static_cast<std::int32_t>(i), numbers(best[k]), numbers(winner[k]));
      }
      EXPECT_EQ(is_below[0], is_below[1]);
      EXPECT_EQ(is_near[0], is_near[1]);
      EXPECT_EQ(least[0], least[1]);
      EXPECT_EQ(std::memcmp(&lengths[0], &lengths[1], sizeof(Lengths)), 0);
      EXPECT_EQ(std::memcmp(&best[0], &best[1], sizeof(Lengths)), 0);
      EXPECT_EQ(std::memcmp(&winner[0], &winner[1], sizeof winner[0]), 0);
      expect_same_along(all, i);
      expect_same_least_along(static_cast<unsigned>(i) + 40 * seed);
      const bool wins = anywhere.wins_nearby(all.cell.numbers(), all.cone[i].numbers(), 0.997F, 0.3F, all.known(own));
      EXPECT_EQ(wins, avx2.wins_nearby(all.cell.numbers(), all.cone[i].numbers(), 0.997F, 0.3F, all.known(own)));
      n_won += wins;
      n_won_on_face += expect_same_on_face(all, static_cast<std::int32_t>(i), own);
      own.push_back(static_cast<std::int32_t>(i));
    }
  }
  EXPECT_GT(n_won, 50);
  EXPECT_GT(n_won_on_face, 50);
#else
  std::cout << "SKIPPED: ConeKernels.give_the_same_bits_on_every_processor: one kind of processor only" << std::endl;
  GTEST_SKIP();
#endif
}

}  // namespace
}  // namespace st
