// The kernels' code, compiled once per kind of processor by the file that includes it, with ST_EIGHT_WIDE where vectors
// hold eight floats. Include nothing here that has code of its own. Here are those of lengths along.
#pragma once

#include "sizing/cone_kernels_code.h"

namespace st {
namespace {

/// What a cone of one length asks for along directions, less that length.
struct LongerAlong {
  const float* direction;  // [3]
  float length, squeeze;   // 1 - (length / length along)^2
  bool is_longer;

  explicit LongerAlong(const AlongCone& of)
      : direction(of.direction), length(of.cone[3]), squeeze(0), is_longer(of.along > length) {
    const float ratio = length / of.along;
    squeeze = 1 - ratio * ratio;
  }
  float along(const float* unit) const {
    const float part = unit[0] * direction[0] + unit[1] * direction[1] + unit[2] * direction[2], square = part * part;
    return length / __builtin_sqrtf(1 - (square < 1 ? square : 1) * squeeze) - length;
  }
  /// Of eight directions, by coordinate.
  F8 along(const F8& x, const F8& y, const F8& z) const {
    const F8 part = x * all(direction[0]) + y * all(direction[1]) + z * all(direction[2]);
    return all(length) / root(all(1) - squeeze * least(part * part, all(1))) - length;
  }
  /// At the probes of a site.
  void at_probes(const AlongSite& site, const float* turns, F8 (&longer)[2]) const {
    if (!is_longer || site.turns < 0) {
      longer[0] = longer[1] = all(is_longer ? along(site.unit) : 0);
      return;
    }
    const float* units = turns + 3 * kProbes * static_cast<std::int64_t>(site.turns);
    for (int g = 0; g < 2; ++g)
      longer[g] = along(load(units + 8 * g), load(units + kProbes + 8 * g), load(units + 2 * kProbes + 8 * g));
  }
};

void lower_along(const float* lengths, const AlongCone& cone, const float* turns, AlongSite& site) {
  F8 longer[2];
  LongerAlong(cone).at_probes(site, turns, longer);
  for (int g = 0; g < 2; ++g)
    store(site.best + 8 * g, least(load(site.best + 8 * g), load(lengths + 8 * g) + longer[g]));
}

void offer_along(const AlongCone& cone, const AlongSite* sites, const float* turns, const std::int32_t* which,
                 std::int32_t n, const AlongShares& shares, AlongGain* gains) {
  const ConeView of(cone.cone);
  const LongerAlong longer(cone);
  for (std::int32_t i = 0; i < n; ++i) {
    const AlongSite& site = sites[which[i]];
    F8 by[2], at[2];
    longer.at_probes(site, turns, by);
    CellView(site.cell).lengths(of, at);
    const F8 known[2] = {load(site.best), load(site.best + 8)};
    for (int g = 0; g < 2; ++g) at[g] = at[g] + by[g];
    const auto are_below = [&](float share) { return is_any((at[0] < share * known[0]) | (at[1] < share * known[1])); };
    gains[i] = !are_below(shares.nearly) ? kNoGain : are_below(shares.clearly) ? kClearlyGains : kNearlyGains;
  }
}

void take_along(const AlongCone& cone, std::int32_t sample, const float* turns, float share, AlongSite& site) {
  F8 at[2], by[2], known[2] = {load(site.best), load(site.best + 8)};
  CellView(site.cell).lengths(ConeView(cone.cone), at);
  LongerAlong(cone).at_probes(site, turns, by);
  for (int g = 0; g < 2; ++g) at[g] = at[g] + by[g];
  if (!is_any((at[0] < share * known[0]) | (at[1] < share * known[1]))) return;
  for (int g = 0; g < 2; ++g) {
    store(site.winner + 8 * g, where(at[g] < known[g], sample, load(site.winner + 8 * g)));
    store(site.best + 8 * g, least(at[g], known[g]));
  }
}

/// What eight cones of such lengths ask for along a direction.
F8 eight_along(const AlongCones& of, const std::int32_t* which, std::int32_t n, std::int32_t k, const F8& length,
               const float* unit) {
  const float* stretch[8];
  for (std::int32_t i = 0; i < 8; ++i)
    stretch[i] = of.stretches + 4 * static_cast<std::int64_t>(which[k + i < n ? k + i : n - 1]);
  F8 x, y, z, along;
  turn_eight(stretch, 0, x, y, z, along);
  const F8 part = unit[0] * x + unit[1] * y + unit[2] * z, ratio = length / along,
           longer = length / root(all(1) - least(part * part, all(1)) * (all(1) - ratio * ratio));
  return select(along > length, longer, length);
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
    const float found = least_of(by + eight_along(of, which, n, k, across, unit));
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
