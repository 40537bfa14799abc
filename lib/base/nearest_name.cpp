#include "base/nearest_name.h"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <vector>

namespace st {
namespace {

/// Letters to insert, delete, replace or swap with the next one (optimal string alignment).
std::size_t n_changes(const std::string& a, const std::string& b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  std::vector<std::size_t> before(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    next[0] = i + 1;
    for (std::size_t k = 0; k < b.size(); ++k) {
      const bool is_same = lower(a[i]) == lower(b[k]);
      next[k + 1] = std::min({row[k + 1] + 1, next[k] + 1, row[k] + !is_same});
      if (i > 0 && k > 0 && lower(a[i]) == lower(b[k - 1]) && lower(a[i - 1]) == lower(b[k]))
        next[k + 1] = std::min(next[k + 1], before[k - 1] + 1);
    }
    before = row;
    row = next;
  }
  return row.back();
}

}  // namespace

/// Two letters that are swapped are one change. A name that ends in `*` is compared with beginnings of names.
std::string nearest_name(const std::string& name, std::span<const std::string> names) {
  std::string nearest;
  const std::string stem = name.substr(0, name.find_last_not_of('*') + 1);  // of a pattern: of beginnings of names
  const bool is_beginning = stem.size() < name.size();
  std::size_t least = (stem.size() + 2) / 3 + 1;
  for (const std::string& candidate : names)
    if (candidate.empty()) {
      continue;
    } else if (const std::size_t n = n_changes(stem, is_beginning ? candidate.substr(0, stem.size()) : candidate);
               n < least) {
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
