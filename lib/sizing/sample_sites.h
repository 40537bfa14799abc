// Where lengths of samples spread: cells and parts of them, and those beside each.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "sizing/cone_cell.h"

namespace st {

/// A site across a face.
struct SiteBeside {
  static constexpr std::int32_t kAlways = 1 << 6;  ///< a link beside a surface

  std::int32_t site;
  std::int32_t towards;  ///< a bit, see sides_ahead() of the kernels; or kAlways
};

/// Sites, and to which beside them lengths pass.
struct SiteGraph {
  std::vector<ConeCell> cell;                                    ///< [n_sites]
  std::vector<std::pair<std::int32_t, std::int32_t>> of_beside;  ///< [n_sites] first and after the last in `beside`
  std::vector<SiteBeside> beside;
  std::vector<std::uint8_t> holds_sample;  ///< [n_sites] 1: the model lies in it

  std::span<const SiteBeside> beside_of(std::int32_t site) const {
    const auto [first, last] = of_beside[static_cast<std::size_t>(site)];
    return std::span(beside).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(last - first));
  }
  /// Whether lengths pass from one to the other.
  bool leads(std::int32_t from, std::int32_t to) const {
    const auto all = beside_of(from);
    return std::any_of(all.begin(), all.end(), [to](const SiteBeside& b) { return b.site == to; });
  }
};

/// Where samples come from, for those who spread them once more.
struct SampleSites {
  SiteGraph graph;
  std::vector<std::pair<std::int32_t, std::int32_t>> own;  ///< sites, and the samples that lie in them
};

}  // namespace st
