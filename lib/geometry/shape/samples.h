// Where to sample a parameter range so that no polynomial piece is missed.
#pragma once

#include <vector>

namespace st {

/// Ascending parameters from `lo` to `hi` (both included) through `knots` (inside, ascending), each interval between
/// knots cut into as many equal parts as give at least 16 intervals, and at least two.
inline std::vector<double> sample_parameters(double lo, double hi, const std::vector<double>& knots) {
  constexpr int kLeast = 16, kEach = 2;
  const int n_pieces = static_cast<int>(knots.size()) + 1;
  const int n_parts = kLeast > kEach * n_pieces ? (kLeast + n_pieces - 1) / n_pieces : kEach;
  std::vector<double> samples{lo};
  for (int piece = 0; piece < n_pieces; ++piece) {
    const double a = piece == 0 ? lo : knots[piece - 1], b = piece + 1 == n_pieces ? hi : knots[piece];
    for (int k = 1; k < n_parts; ++k) samples.push_back(a + (b - a) * k / n_parts);
    samples.push_back(b);
  }
  return samples;
}

}  // namespace st
