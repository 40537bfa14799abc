// How a surface turns between the probes of a patch. Internal to sizing.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "base/ids.h"
#include "sizing/patch_walk.h"

namespace st {

struct CurvatureProbe {
  Vec3 x;
  Vec3 normal;           // unit; zero at a singular point
  double curvature = 0;  // largest absolute principal curvature; zero at a singular point
};

/// Pairs of a patch's probes: neighbours along rows, columns and both diagonals. Two that follow each other lie beside
/// each other.
struct ProbePairs {
  static constexpr std::size_t n = 20;
  std::array<std::uint8_t, n> first{}, second{};
  std::array<std::array<std::uint8_t, 8>, 9> of_probe{};  // pairs with it
  std::array<std::uint8_t, 9> n_of_probe{};

  constexpr ProbePairs() {
    constexpr std::uint8_t kFirst[] = {0, 3, 6, 0, 2, 4, 0, 3, 1, 4}, kSecond[] = {1, 4, 7, 3, 5, 7, 4, 7, 3, 6};
    for (std::size_t i = 0; i < n; ++i) {
      first[i] = static_cast<std::uint8_t>(kFirst[i / 2] + i % 2);
      second[i] = static_cast<std::uint8_t>(kSecond[i / 2] + i % 2);
      for (const std::size_t k : {first[i], second[i]}) of_probe[k][n_of_probe[k]++] = static_cast<std::uint8_t>(i);
    }
  }
};
inline constexpr ProbePairs kPairs;

/// How the surface turns between probes inside the loops, by pair; zero where one is outside.
struct PairTurning {
  static constexpr std::size_t n = ProbePairs::n;
  std::array<double, n> angle, rate;  // rate: angle per distance

  /// `noise`: angles up to it say nothing of the rate. Loops are apart so that two pairs are computed at once.
  PairTurning(const Patch<CurvatureProbe>& patch, double noise) {
    std::array<double, n> half{}, length{};
    add_squares(
        patch, [](const CurvatureProbe& p) { return p.normal; }, half);
    add_squares(
        patch, [](const CurvatureProbe& p) { return p.x; }, length);
    int n_large = 0;
    for (std::size_t i = 0; i < n; ++i) {
      half[i] = 0.5 * std::sqrt(half[i]);
      angle[i] = small_angle(half[i]);
    }
    for (std::size_t i = 0; i < n; ++i) n_large += half[i] * half[i] < kSmall2 ? 0 : 1;
    for (std::size_t i = 0; i < n && n_large > 0; ++i)
      if (!(half[i] * half[i] < kSmall2))
        angle[i] = large_angle(half[i], patch.probe[kPairs.first[i]], patch.probe[kPairs.second[i]]);
    for (std::size_t i = 0; i < n; ++i) {
      length[i] = std::sqrt(length[i]) * (1 + angle[i] * angle[i] / 24);  // arc from chord
      const double own = angle[i] / length[i], told = length[i] > 0 ? own : 0;
      rate[i] = angle[i] > noise ? told : 0;
    }
    if (patch.n_inside < 9)
      for (std::size_t i = 0; i < n; ++i)
        if (!patch.is_inside[kPairs.first[i]] || !patch.is_inside[kPairs.second[i]]) angle[i] = rate[i] = 0;
  }
  static double largest_at(std::size_t probe, const std::array<double, n>& of_pairs) {
    double largest = 0;
    for (std::size_t i = 0; i < kPairs.n_of_probe[probe]; ++i)
      largest = std::max(largest, of_pairs[kPairs.of_probe[probe][i]]);
    return largest;
  }

 private:
  static constexpr double kSmall2 = 0.01;  // up to there the next term of the series is below rounding

  /// Squared distances between what `of` gives for both probes of each pair.
  template <class Of>
  static void add_squares(const Patch<CurvatureProbe>& patch, const Of& of, std::array<double, n>& square) {
    std::array<double, 9> value[3];
    for (std::size_t k = 0; k < 9; ++k) {
      const Vec3 v = of(patch.probe[k]);
      value[0][k] = v.x, value[1][k] = v.y, value[2][k] = v.z;
    }
    for (const std::array<double, 9>& axis : value)
      for (std::size_t i = 0; i < n; i += 2)
        for (std::size_t k = 0; k < 2; ++k) {
          const double d = axis[kPairs.second[i] + k] - axis[kPairs.first[i] + k];
          square[i + k] += d * d;
        }
  }
  /// From half the distance between unit normals: twice its arcsine.
  static double small_angle(double half) {
    constexpr double kTerm[] = {1 / 6.0,      3 / 40.0,        15 / 336.0,        105 / 3456.0,
                                945 / 42240., 10395 / 599040., 135135 / 9676800., 2027025 / 175472640.};
    const double square = half * half;
    double sum = 0;
    for (std::size_t i = std::size(kTerm); i-- > 0;) sum = square * (kTerm[i] + sum);
    return 2 * half * (1 + sum);
  }
  static double large_angle(double half, const CurvatureProbe& a, const CurvatureProbe& b) {
    if (a.normal == Vec3{} || b.normal == Vec3{}) return 0;
    return 2 * std::asin(std::min(1.0, half));
  }
};

}  // namespace st
