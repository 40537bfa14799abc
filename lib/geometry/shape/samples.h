// Where to sample a parameter range so that no polynomial piece is missed.
#pragma once

#include <vector>

namespace st {

// For boxes: what lies between samples is second order in their distance.
constexpr int kBoxSamples = 32, kBoxSamplesPerPiece = 4;

/// Ascending parameters from `lo` to `hi` (both included) through `knots` (inside, ascending), each interval between
/// knots cut into as many equal parts as give at least `n_least` intervals, and at least `n_each`.
inline std::vector<double> sample_parameters(double lo, double hi, const std::vector<double>& knots, int n_least = 16,
                                             int n_each = 2) {
  const int n_pieces = static_cast<int>(knots.size()) + 1;
  const int n_parts = n_least > n_each * n_pieces ? (n_least + n_pieces - 1) / n_pieces : n_each;
  std::vector<double> samples{lo};
  for (int piece = 0; piece < n_pieces; ++piece) {
    const double a = piece == 0 ? lo : knots[piece - 1], b = piece + 1 == n_pieces ? hi : knots[piece];
    for (int k = 1; k < n_parts; ++k) samples.push_back(a + (b - a) * k / n_parts);
    samples.push_back(b);
  }
  return samples;
}

}  // namespace st
