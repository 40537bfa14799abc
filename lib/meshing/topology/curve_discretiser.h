// Nodes on the CAD edges: each topological edge once, for all its faces.
#pragma once

#include <vector>

#include "base/ids.h"
#include "geometry/shape/curve.h"
#include "mesh/edge_mesh.h"
#include "sizing/size_field.h"

namespace st {

struct CurveMeshOptions {
  double max_turning_deg = 30;  ///< largest turning of the tangent along one segment
  int min_segments = 1;         ///< 3 for a closed edge that is a loop of its own, 2 for one of two edges of a loop
};

/// Spaces nodes by the integral of 1/size along the curve: as many segments as the integral says (rounded, at least
/// min_segments), each with the same share. Where the tangent turns faster than max_turning per length, the turning
/// counts instead, as far as the chord's distance from the curve matters: radii below 0.4 of the requested length and
/// of the curve's own get larger angles, so that places where the curve turns within next to no length do not make rows
/// of tiny segments. A corner (more than max_turning at once) is one node, unless within a quarter of a length of an
/// end or another corner. Local, pure.
EdgeMesh discretise_curve(const Curve& curve, const SizeField& field, const CurveMeshOptions& options);

/// Moves the end nodes to the vertices, which lie off the curve's ends by up to the CAD's tolerance. Where that is much
/// against the segments, inner nodes that the vertex passed are left out, so that no segment runs back; at least
/// `min_segments` stay.
void end_at_vertices(EdgeMesh& nodes, const Vec3& first, const Vec3& last, int min_segments);

}  // namespace st
