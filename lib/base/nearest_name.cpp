#include "base/nearest_name.h"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <vector>

namespace st {
namespace {

/// Letters to insert, delete or replace (Levenshtein).
std::size_t n_changes(const std::string& a, const std::string& b) {
  const auto is_same = [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); };
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t k = 0; k < b.size(); ++k) {
      const std::size_t replaced = diagonal + !is_same(a[i], b[k]);
      diagonal = row[k + 1];
      row[k + 1] = std::min({row[k] + 1, diagonal + 1, replaced});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest_name(const std::string& name, std::span<const std::string> names) {
  std::string nearest;
  std::size_t least = (name.size() + 2) / 3 + 1;
  for (const std::string& candidate : names)
    if (const std::size_t n = n_changes(name, candidate); n < least) {
      nearest = candidate;
      least = n;
    }
  return nearest;
}

std::string did_you_mean(const std::string& name, std::span<const std::string> names) {
  const std::string nearest = nearest_name(name, names);
  return nearest.empty() ? "" : ", did you mean '" + nearest + "'";
}

}  // namespace st
