// Samples with their places, for octrees whose cells are much larger than the lengths they carry.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "sizing/blanking.h"
#include "sizing/octree.h"

namespace st {

/// A raster box without half its edge.
struct LengthSample {
  Vec3 xyz;          ///< model unit; in single precision from where places count
  float length = 0;  ///< model unit, > 0
  std::int32_t cause = kNone;
  SmallNormal normal = {};  ///< of the surface there, out of the solid; unknown on edges
  SampleStretch stretch = {};
  SampleReach reach = {};  ///< around `xyz`
};

/// From where places that are kept in single precision count: the origin of space, or the middle of a model that is far
/// from it, since the steps between such numbers grow with the distance.
Vec3 origin_of_places(const Box3& model);

/// The samples of the boxes, their places rounded to single precision from `origin`, in an order that does not depend
/// on theirs.
std::vector<LengthSample> sorted_samples(std::span<const RasterBox> boxes, Vec3 origin = {});

/// All of some sorted_samples(), in the same order. Each sample is moved about log2 of their number times.
std::vector<LengthSample> merged_samples(std::vector<std::vector<LengthSample>> sorted);

/// Calls f(site, sample) for the sites that a sample lies in: its leaf, or the part of it on whose surface it lies; of
/// a blanked leaf also the parts beside it, for the surface may bulge a little into what is blanked.
void for_each_own_site(const Neighbours& neighbours, std::span<const LengthSample> samples, const Blanking* blanking,
                       const std::function<void(std::int32_t, std::int32_t)>& f);

}  // namespace st
