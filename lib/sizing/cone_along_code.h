// The kernels' code, compiled once per kind of processor by the file that includes it, with ST_EIGHT_WIDE where vectors
// hold eight floats. Include nothing here that has code of its own. Here are those of lengths along.
#pragma once

#include "sizing/cone_kernels_code.h"

namespace st {
namespace {

/// What a cone asks for along directions, at places where it asks for such lengths across.
struct LongerAlong {
  const float* direction;  // [3]
  float longer;            // along than across, model unit; 0: the same in all directions

  explicit LongerAlong(const AlongCone& of)
      : direction(of.direction), longer(of.along > of.cone[3] ? of.along - of.cone[3] : 0) {}

  /// Both lengths grow by the slope before the direction is asked. `part`: of the direction along the cone's.
  F8 along(const F8& across, const F8& part) const {
    const F8 ratio = across / (across + all(longer));
    return across / root(all(1) - least(part * part, all(1)) * (all(1) - ratio * ratio));
  }
  /// Of the directions of a site's probes.
  void at_probes(const AlongSite& site, const float* turns, F8 (&lengths)[2]) const {
    if (!(longer > 0)) return;
    const float* const units = site.turns < 0 ? nullptr : turns + 3 * kProbes * static_cast<std::int64_t>(site.turns);
    for (int g = 0; g < 2; ++g) {
      const auto unit = [&](int k) { return units ? load(units + k * kProbes + 8 * g) : all(site.unit[k]); };
      lengths[g] =
          along(lengths[g], unit(0) * all(direction[0]) + unit(1) * all(direction[1]) + unit(2) * all(direction[2]));
    }
  }
};

void lower_along(const float* lengths, const AlongCone& cone, const float* turns, AlongSite& site) {
  F8 at[2] = {load(lengths), load(lengths + 8)};
  LongerAlong(cone).at_probes(site, turns, at);
  for (int g = 0; g < 2; ++g) store(site.best + 8 * g, least(load(site.best + 8 * g), at[g]));
}

void offer_along(const AlongCone& cone, const AlongSite* sites, const float* turns, const std::int32_t* which,
                 std::int32_t n, const AlongShares& shares, AlongGain* gains) {
  const ConeView of(cone.cone);
  const LongerAlong longer(cone);
  for (std::int32_t i = 0; i < n; ++i) {
    const AlongSite& site = sites[which[i]];
    F8 at[2];
    CellView(site.cell).lengths(of, at);
    longer.at_probes(site, turns, at);
    const F8 known[2] = {load(site.best), load(site.best + 8)};
    const auto are_below = [&](float share) { return is_any((at[0] < share * known[0]) | (at[1] < share * known[1])); };
    gains[i] = !are_below(shares.nearly) ? kNoGain : are_below(shares.clearly) ? kClearlyGains : kNearlyGains;
  }
}

void take_along(const AlongCone& cone, std::int32_t sample, const float* turns, float share, AlongSite& site) {
  F8 at[2], known[2] = {load(site.best), load(site.best + 8)};
  CellView(site.cell).lengths(ConeView(cone.cone), at);
  LongerAlong(cone).at_probes(site, turns, at);
  if (!is_any((at[0] < share * known[0]) | (at[1] < share * known[1]))) return;
  for (int g = 0; g < 2; ++g) {
    store(site.winner + 8 * g, where(at[g] < known[g], sample, load(site.winner + 8 * g)));
    store(site.best + 8 * g, least(at[g], known[g]));
  }
}

/// What eight cones of such lengths ask for along a direction, where they have grown by `rise`.
F8 eight_along(const AlongCones& of, const std::int32_t* which, std::int32_t n, std::int32_t k, const F8& length,
               const F8& rise, const float* unit) {
  const float* stretch[8];
  for (std::int32_t i = 0; i < 8; ++i)
    stretch[i] = of.stretches + 4 * static_cast<std::int64_t>(which[k + i < n ? k + i : n - 1]);
  F8 x, y, z, along;
  turn_eight(stretch, 0, x, y, z, along);
  const F8 part = unit[0] * x + unit[1] * y + unit[2] * z, across = length + rise, ratio = across / (along + rise),
           longer = across / root(all(1) - least(part * part, all(1)) * (all(1) - ratio * ratio));
  return select(along > length, longer, across);
}

LeastAlong least_along(const AlongCones& of, const float* place) {
  constexpr std::int32_t kKept = 8;  // eights
  F8 rise[kKept], length[kKept];
  std::int32_t winner = -1, n_kept = 0;
  const float own = least_of_cones(of.cones, of.own, of.n_own, place, static_cast<float>(of.largest), &winner,
                                   [&](std::int32_t k, const EightCones& eight, const F8& by) {
                                     if (k >= 8 * kKept) return;
                                     length[k / 8] = eight.length;
                                     rise[k / 8] = by;
                                     n_kept = k + 8;
                                   });
  if (winner >= 0) winner = of.own[winner];
  const float* const unit = of.stretches + 4 * static_cast<std::int64_t>(winner);
  if (winner < 0 || !(unit[3] > 0)) return {own, own, -1};
  const double most_along = of.most_aspect * static_cast<double>(own);
  float result = static_cast<float>(of.largest < most_along ? of.largest : most_along);
  const auto lower = [&](const std::int32_t* which, std::int32_t n, std::int32_t k, const F8& across, const F8& by) {
    const float found = least_of(eight_along(of, which, n, k, across, by, unit));
    if (found < result) result = found;
  };
  const auto is_over = [&](std::int32_t which) {  // the shortest of those from here on
    return !(of.cones[kConeNumbers * static_cast<std::int64_t>(which) + 3] < result);
  };
  const auto ask = [&](const std::int32_t* which, std::int32_t n, std::int32_t from) {
    for (std::int32_t k = from; k < n && !is_over(which[k]); k += 8) {
      const EightCones eight = eight_of(of.cones, which, n, k);
      lower(which, n, k, eight.length, eight.rise_at(place));
    }
  };
  for (std::int32_t k = 0; k < n_kept && !is_over(of.own[k]); k += 8)
    lower(of.own, of.n_own, k, length[k / 8], rise[k / 8]);
  ask(of.own, of.n_own, n_kept);
  ask(of.more, of.n_more, 0);
  return {own, result, winner};
}

constexpr ConeKernels kKernels{is_near_cell, sides_ahead,  cone_lengths, offer_cone,  take_lengths,
                               lower_along,  offer_along,  take_along,   wins_nearby, wins_on_face,
                               settle_face,  least_length, least_along};

}  // namespace
}  // namespace st
