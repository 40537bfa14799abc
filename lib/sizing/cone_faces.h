// Cells that touch made to tell the same on their common face: so that the size field has no jumps. Internal to sizing.
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
  std::span<const SiteBeside> beside;
  std::vector<std::uint8_t> holds_sample;  ///< [n_sites] 1: the model lies in it

  std::span<const SiteBeside> beside_of(std::int32_t site) const {
    const auto [first, last] = of_beside[static_cast<std::size_t>(site)];
    return beside.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(last - first));
  }
  /// Whether lengths pass from one to the other.
  bool leads(std::int32_t from, std::int32_t to) const {
    const auto all = beside_of(from);
    return std::any_of(all.begin(), all.end(), [to](const SiteBeside& b) { return b.site == to; });
  }
};

/// The samples whose cones each site keeps.
struct SiteSamples {
  std::vector<std::int32_t> first{0};  ///< [n_sites + 1] into `sample`
  std::vector<std::int32_t> sample;
  std::vector<std::int32_t> at_center;  ///< [n_sites] which tells the length there; kNone: the largest length
  std::vector<float> center_length;     ///< [n_sites]
};

/// Gives each site the cones that tell clearly less than its own on a face common with a site that has them, and the
/// one that tells the length at the centre of a site that touches it, where the step from there is above the slope.
/// Until there is none. `cones` are those of all samples. The same on every run. O(faces) in practice.
SiteSamples agree_on_faces(const SiteGraph& sites, std::span<const Cone> cones, float largest, SiteSamples samples);

}  // namespace st
