// Triangles between polygons in a plane.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/vec.h"
#include "geometry/shape/chart_topology.h"

namespace st {

/// Triangles of every second region between nested polygons, the outermost first, counter-clockwise, on the nodes of
/// the polygons alone (OpenCASCADE's BRepMesh). `x`: [n] places in the plane, any unit; `sides`: their nodes, in any
/// order and sense. nullopt where the sides do not close, or where they cross.
std::optional<std::vector<Corners>> facets_between(std::span<const Vec2> x,
                                                   std::span<const std::pair<std::int32_t, std::int32_t>> sides);

}  // namespace st
