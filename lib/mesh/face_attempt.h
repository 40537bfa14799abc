// What is known of a CAD face that could not be meshed: to look at, not to mesh on.
#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "mesh/surface_mesh.h"

namespace st {

/// The boundary of a face as it was given to the mesher, the triangles it had made when it gave up, and the places that
/// stopped it.
struct FaceAttempt {
  FacePatch patch;  ///< all its nodes are inner ones: first those of the boundary (a seam's twice); (u,v) NaN where the
                    ///< face has no usable trimming curves. Triangles so far, counter-clockwise in (u,v), need not fit
                    ///< together; no corner has a (u,v) of its own
  std::vector<std::int32_t> segment_nodes;  ///< [2*n_segments] in the direction of the loop, interior to the left in
                                            ///< (u,v)
  std::vector<std::int32_t> segment_loop;   ///< [n_segments] loop of the face, from 0
  std::vector<EdgeId> segment_edge;         ///< [n_segments] CAD edge
  std::vector<Vec3> places;                 ///< where the loops cross, or where the triangulation broke

  FaceId face() const { return patch.face; }
  static auto fields(auto& f) { return std::tie(f.patch, f.segment_nodes, f.segment_loop, f.segment_edge, f.places); }
};

}  // namespace st
