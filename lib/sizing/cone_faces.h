// Cells that touch made to tell the same on their common face: so that the size field has no jumps. Internal to sizing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sizing/sample_sites.h"

namespace st {

/// The samples whose cones each site keeps.
struct SiteSamples {
  std::vector<std::int32_t> first{0};  ///< [n_sites + 1] into `sample`
  std::vector<std::int32_t> sample;
  std::vector<std::int32_t> at_center;  ///< [n_sites] which tells the length there; kNone: the largest length
  std::vector<float> center_length;     ///< [n_sites]
};

/// All that sites keep of samples [0, n_samples), each once, in the order in which they come first.
std::vector<std::int32_t> used_samples(const SiteSamples& kept, std::size_t n_samples);

/// Gives each site the cones that tell clearly less than its own on a face common with a site that has them, and the
/// one that tells the length at the centre of a site that touches it, where the step from there is above the slope.
/// Until there is none. `cones` are those of all samples. The same on every run. O(faces) in practice.
SiteSamples agree_on_faces(const SiteGraph& sites, std::span<const Cone> cones, float largest, SiteSamples samples);

}  // namespace st
