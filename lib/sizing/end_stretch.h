// Shorter lengths along, where a face ends across its stretch.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "features/lifting_surface.h"
#include "sizing/gap_patch.h"
#include "sizing/octree.h"
#include "sizing/space_sides.h"

namespace st {

/// Length along over length across, at most, where nothing goes on along: half a rectangle of 3 to 1 is 1.9 times as
/// large, as sides go, as the equilateral triangle beyond. From there lengths along grow by the slope.
inline constexpr double kEndAspect = 3;
/// Likewise where a sharp edge ends at a tip: its skins meet there in a small triangle of the rim.
inline constexpr double kSharpEndAspect = 1.8;

/// Whether a trailing edge ends at a tip: a face looks out of the wing at its end `k` (0: where it begins, 1), and none
/// has a pole there. Normals of faces point into the material or away from it. Local, linear in the model's edges.
bool is_tip(const Model& model, bool is_material_ahead, const ChordEdge& trailing, std::size_t k);

/// What is allowed at the end of a trailing edge: less where a sharp one ends at a tip. As is_tip().
inline double end_aspect(const Model& model, bool is_material_ahead, const ChordEdge& trailing, std::size_t k) {
  return trailing.base == kNone && is_tip(model, is_material_ahead, trailing, k) ? kSharpEndAspect : kEndAspect;
}

/// Whether a line on a face that ends at `x` ends there by more than `reach` before all of its edges. Local, a search
/// of each edge of the face.
bool ends_inside(const Model& model, FaceId face, Vec3 x, double reach);

/// Bounds the stretch of boxes from `first` on, and tells patches, where they reach a side across it. `sides`: of the
/// face; `ends` tells the coedges at which it ends: across others the surface goes on. Local.
void bound_stretch_at_ends(std::span<const SpaceSide> sides, const std::function<bool(CoedgeId)>& ends,
                           std::size_t first, std::vector<RasterBox>& boxes, std::vector<GapPatch>& patches);

/// No length along is above the width of the face there: from one side across it to the other one. Local.
void bound_stretch_by_widths(std::span<const SpaceSide> sides, std::size_t first, std::vector<RasterBox>& boxes);

/// What is allowed along `direction` where the surface ends along `end` (unit vectors; `end` zero: nowhere). Infinite
/// where the end does not lie across.
double most_aspect_at(Vec3 end, Vec3 direction);

}  // namespace st
