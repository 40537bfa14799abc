// Samples with their places, for octrees whose cells are much larger than the lengths they carry.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "sizing/octree.h"
#include "sizing/prolong.h"

namespace st {

/// Up to this cell_per_length lengths are stored by cell; where cells are larger, samples keep their places.
inline constexpr double kStoredByCellUpTo = 2;

/// A raster box without its reach.
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

/// Calls f(site, sample) for all sites that a sample asks something of: the cells that come within one length of it,
/// and with `blanking` (may be null) its own cell, on the side of the surface that it lies on, and those to which a
/// length passes from there. A pair may come several times.
void for_each_seed(const Neighbours& neighbours, std::span<const LengthSample> samples, const Blanking* blanking,
                   const std::function<void(std::int32_t, std::int32_t)>& f);

/// Calls f(site, sample) for the sites that a sample lies in: its leaf, or the part of it on whose surface it lies; of
/// a blanked leaf also the parts beside it, for the surface may bulge a little into what is blanked.
void for_each_own_site(const Neighbours& neighbours, std::span<const LengthSample> samples, const Blanking* blanking,
                       const std::function<void(std::int32_t, std::int32_t)>& f);

/// Takes away the lengths that edges and faces store, before sources are added and samples seeded.
void forget_samples(RasterOctree& octree);

/// Lowers stored lengths to what the samples ask for at the cells' centres: the smallest of length + slope * distance
/// of the samples within one length of which the cell comes; equal ones take the smaller cause.
void seed_lengths(std::span<const LengthSample> samples, double slope, RasterOctree& octree);

/// Likewise with a surface in the octree: a sample asks for its length in its own cell, on the side of the surface that
/// it lies on, and in the cells to which a length passes from there. `octree` after add_second_parts().
void seed_lengths(std::span<const LengthSample> samples, double slope, const Blanking& blanking,
                  const Neighbours& neighbours, RasterOctree& octree);

/// Fits the linear lengths of cells, and second parts of split leaves, to what is requested at the places of the
/// samples in and around them: by the samples themselves, and by prolongation from linked cells. No sample gets more
/// than its length, no centre less than all that is requested around. `blanking` may be null.
void fit_samples(const Neighbours& neighbours, std::span<const LengthSample> samples, double slope,
                 const Blanking* blanking, ProlongedLengths& lengths);

}  // namespace st
