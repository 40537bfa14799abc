// Bodies of facets: what hangs together, and what lies inside.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/facet/facet_mesh.h"

namespace st {

/// Facets that hang together across sides that two of them share.
struct FacetBody {
  std::vector<std::int32_t> triangles;  ///< of the mesh, ascending
  Box3 box;
  bool is_open = false;  ///< has a side that not two of them share
};

/// By their lowest triangles.
std::vector<FacetBody> find_bodies(const FacetMesh& mesh);

/// How often a body winds around a point: 1 inside, 0 outside, -1 where it is inside out; by the solid angles of its
/// facets (van Oosterom and Strackee 1983).
double winding(const FacetMesh& mesh, const FacetBody& body, Vec3 p);

}  // namespace st
