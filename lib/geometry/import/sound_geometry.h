// Files that were damaged slightly are read without complaint: control points that are no numbers, or light years away.
#pragma once

#include <TopoDS_Shape.hxx>
#include <span>
#include <string>

#include "base/vec.h"

namespace st::occt {

/// Control points may be this many times as far from the middle of the model as most of its points are. A far field
/// of a thousand bodies' lengths around details of a thousandth is just within it.
inline constexpr double kFarthestPoint = 1e6;

/// Throws Error(kGeometry) naming the face or edge and the point when a vertex, a control point or a weight of a
/// spline of `shape` is not finite, beyond kLargestCoordinate, or farther away than kFarthestPoint: no stage behind
/// could end on it. Linear in the number of points.
void require_sound_geometry(const TopoDS_Shape& shape, const std::string& path);

/// The same for the nodes of facets, which are named by their numbers from 1.
void require_sound_nodes(std::span<const Vec3> nodes, const std::string& path);

/// The same for faces whose edges and surfaces have no control points: throws Error(kGeometry) when one of their boxes
/// goes beyond kLargestCoordinate.
void require_sound_boxes(std::span<const Box3> face_box, const std::string& path);

}  // namespace st::occt
