// Lines inside a face along which its normal jumps.
#pragma once

#include <TopoDS_Face.hxx>
#include <optional>
#include <vector>

#include "base/vec.h"

namespace st::occt {

inline constexpr double kLeastKink = 0.35;  // radians, 20 degrees: between sections of a wing are less

struct SurfaceKinks {
  std::vector<double> u, v;  ///< lines of constant u, of constant v: ascending, inside the face's bounds
  Vec3 xyz;                  ///< a point on the first one
};

/// Where the surface of `face` (oriented forward) turns by more than kLeastKink from one side of a line of constant u
/// or v to the other, at a place with the face on both sides; nullopt: nowhere. Only knots at which the surface need
/// not be smooth are looked at: splines, and what is swept, turned or trimmed of splines.
std::optional<SurfaceKinks> find_kinks(const TopoDS_Face& face);

}  // namespace st::occt
