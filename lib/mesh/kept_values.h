// Percentiles of values that are never in memory all at once, and their histograms. Internal to mesh.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <tuple>
#include <vector>

namespace st {

/// Values of which some are kept: the lowest, or the highest.
struct KeptValues {
  std::vector<double> values;

  static auto fields(auto& k) { return std::tie(k.values); }
};

/// The bin of a value among bins of one width from `first`, the last without end.
template <std::size_t n>
std::int64_t& bin_of(std::array<std::int64_t, n>& histogram, double value, double first, double width) {
  const double bin = (value - first) / width;
  if (!(bin > 0)) return histogram[0];  // NaN, too: of coordinates that overflow
  return histogram[static_cast<std::size_t>(std::min(bin, static_cast<double>(n - 1)))];
}

/// Lets the lowest values stay, so many at most. Reorders `values`.
inline void keep_lowest(std::vector<double>& values, std::size_t most) {
  if (values.size() <= most) return;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(most), values.end());
  values.resize(most);
}
inline void keep_highest(std::vector<double>& values, std::size_t most) {
  if (values.size() <= most) return;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(most), values.end(), std::greater<>());
  values.resize(most);
}

/// Pairs of neighbours, or edges, of so many triangles, at most.
inline std::size_t most_sides(std::int64_t n_triangles) { return 3 * static_cast<std::size_t>(n_triangles); }
/// As many of the lowest, or of the highest, are enough for percentiles that leave `share` of up to `n` values there.
inline std::size_t n_kept(std::size_t n, double share) {
  return static_cast<std::size_t>(share * static_cast<double>(n)) + 3;
}

/// Of `n` values the one with `share` of the others below it. `values`: the lowest of them, reordered.
inline double percentile_of_lowest(std::vector<double>& values, std::size_t n, double share) {
  const auto k = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(n - 1));
  std::nth_element(values.begin(), k, values.end());
  return *k;
}
/// `values`: the highest of them.
inline double percentile_of_highest(std::vector<double>& values, std::size_t n, double share) {
  const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(n - 1));
  const auto from_top = values.begin() + (static_cast<std::ptrdiff_t>(n) - 1 - k);
  std::nth_element(values.begin(), from_top, values.end(), std::greater<>());
  return *from_top;
}

}  // namespace st
