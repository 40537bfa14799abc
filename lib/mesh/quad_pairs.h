// Pairs of triangles that make a quadrilateral: what rows of stretched triangles were cut from.
#pragma once

#include <array>
#include <vector>

#include "mesh/surface_mesh.h"

namespace st {

/// Two triangles as one element.
struct Quadrilateral {
  std::array<NodeId, 4> n;      ///< around it, counter-clockwise seen from outside the solid
  TriangleId triangle = kNone;  ///< the lower of the two
};

/// Every triangle of a mesh once, alone or in a pair.
struct QuadPairs {
  std::vector<TriangleId> triangles;  ///< alone, ascending
  std::vector<Quadrilateral> quads;   ///< by their lower triangle, ascending
};

/// No pairs.
QuadPairs all_triangles(const SurfaceMesh& mesh);

/// Pairs of triangles of one face whose quadrilateral is nearly a rectangle and clearly longer than wide. Where a
/// triangle could be in several, the squarest corners win, then the lowest triangles. The mesh may have any topology.
QuadPairs pair_triangles(const SurfaceMesh& mesh);

}  // namespace st
