// Sample lengths inside a trimmed surface.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "geometry/shape/loop_polygons.h"
#include "geometry/shape/surface.h"
#include "sizing/gap_patch.h"
#include "sizing/octree.h"
#include "sizing/size_limits.h"
#include "sizing/wing_sizes.h"

namespace st {

/// What sampling a face found.
struct FaceRasterReport {
  double area = 0;                 ///< of the trimmed surface as sampled, model unit squared
  std::int64_t n_patches = 0;      ///< raster boxes made
  std::int64_t n_evaluations = 0;  ///< of the surface
};

/// Appends raster boxes that cover the trimmed surface without holes, each with the length that curvature allows: alpha
/// times the smallest principal radius, clamped to the limits.
///
/// The parameter rectangle is halved, always across its longer side in space, until each patch is no larger than its
/// raster box; patches outside the loops are dropped. A patch is probed at 3 x 3 points by curvature and by the angle
/// between the normals of neighbouring points, and the two watch each other: an angle that curvature does not explain
/// (a fillet between two probes) makes the patch split; a curvature that no angle confirms after three halvings is
/// noise of the parametrisation and is cut down to what the angles show. Sizes in space decide, so poles and stretched
/// iso-lines cost nothing special. (The paper probes along iso-curves and adds boxes where stencil points lie too far
/// apart; halving patches covers the surface by construction.) `patches`, where wanted, gets one patch per box whose
/// middle is no singular point; normals are along du x dv. `chord`, where given, is a second largest length that
/// depends on the place. Throws TooManyCells beyond max_samples boxes.
///
/// Of a composite surface each member is halved by itself, in its own (u,v), as whole_spline(); `loops` are not asked.
/// `on_area` gets the area of every thousand boxes: faces may have a hundred millions of them.
FaceRasterReport raster_face(const Surface& surface, const LoopPolygons& loops, const SamplingLimits& limits,
                             std::int32_t cause, std::vector<RasterBox>& boxes,
                             std::vector<GapPatch>* patches = nullptr, const ChordLimit* chord = nullptr,
                             const std::function<void(double area)>& on_area = {});

/// The spline that a face is a part of: patches of it are where they would be without the cut. nullptr where the
/// surface is none, or goes beyond its knots.
std::unique_ptr<Surface> whole_spline(const Surface& part);

}  // namespace st
