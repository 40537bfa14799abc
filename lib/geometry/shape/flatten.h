// Parameters for a triangulated patch: a plane map of it without flips and with little distortion.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "base/vec.h"
#include "geometry/shape/chart_topology.h"

namespace st {

/// Larger stretch than this is no parametrisation that a mesh can be made in.
inline constexpr double kMostStretch = 10;

/// Places in the plane for the nodes of a patch, model unit. A patch whose normals stay within 60 degrees of their mean
/// is projected along it, where its rim does not cross itself then. Else the longest loop goes to a circle by
/// mean-value weights, other loops are filled (Floater 2003), and the symmetric Dirichlet energy is lowered with a free
/// rim (Rabinovich et al. 2017); no step goes as far as the first flip or crossing of the rim.
///
/// nullopt where the patch is no disc with holes, is deep like a cup or long like a tube, has more than 20,000
/// triangles and cannot be projected, or where the result would flip or stretch more than kMostStretch: it must be cut.
/// The same input gives the same bits. Cost: microseconds per triangle for a projection, else up to a millisecond.
std::optional<std::vector<Vec2>> flatten(std::span<const Vec3> x, std::span<const Corners> corners,
                                         const PatchTopology& topology);

/// flatten(), for a patch that is not to be cut. Where that finds no places, the energy is lowered once more with a rim
/// that may cross itself on the way, as a wide patch does that a circle has bent; at the end it is clear, but for
/// notches, which may leave a fiftieth of a round. Cost: up to twice that of flatten().
std::optional<std::vector<Vec2>> flatten_whole(std::span<const Vec3> x, std::span<const Corners> corners,
                                               const PatchTopology& topology);

/// A triangle alone, as it is; flatter than 1e-3 of its longest side it is taken to be so high.
std::array<Vec2, 3> lay_triangle(Vec3 a, Vec3 b, Vec3 c);

/// flatten() without solving: the patch is projected, or its triangles are laid into the plane one by one across their
/// sides, where that changes them little. Precondition: is_disc_with_holes().
std::optional<std::vector<Vec2>> unroll(std::span<const Vec3> x, std::span<const Corners> corners,
                                        const PatchTopology& topology);

/// Whether a patch can have parameters without a cut, as far as its topology tells.
bool is_disc_with_holes(const PatchTopology& topology);

/// A map that samplers and meshers can work in: no flips, and no place of the plane that is two. `p`: [nodes].
bool is_clear(std::span<const Vec3> x, std::span<const Corners> corners, const PatchTopology& topology,
              std::span<const Vec2> p);

/// Whether a patch is no deep cup or long tube, as far as area and rims tell. Precondition: it has a loop.
bool is_shallow(std::span<const Vec3> x, std::span<const Corners> corners, const PatchTopology& topology);

/// Singular values of the map from the plane to space, larger over smaller: the largest over the triangles that are no
/// needles (height below 1e-3 of the longest side). Infinite where a triangle is flipped.
double largest_stretch(std::span<const Vec3> x, std::span<const Corners> corners, std::span<const Vec2> uv);

}  // namespace st
