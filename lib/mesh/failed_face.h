// What is known of a CAD face that could not be meshed: to look at, not to mesh on.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/surface_mesh.h"

namespace st {

/// The boundary of a face as it was given to the mesher, the triangles it had made when it gave up, and the places that
/// stopped it.
struct FailedFace {
  FaceId face = kNone;
  // nodes: first those of the boundary (a seam's twice), then inner ones
  std::vector<Vec3> xyz;     ///< [n_nodes] model unit
  std::vector<Vec2> uv;      ///< [n_nodes] on the face's surface; NaN where the face has no usable trimming curves
  std::vector<double> size;  ///< [n_nodes] length asked for, model unit
  std::vector<std::int32_t> segment_nodes;  ///< [2*n_segments] in the direction of the loop, interior to the left in
                                            ///< (u,v)
  std::vector<std::int32_t> segment_loop;   ///< [n_segments] loop of the face, from 0
  std::vector<EdgeId> segment_edge;         ///< [n_segments] CAD edge
  std::vector<Triangle> triangles;          ///< so far, counter-clockwise in (u,v); need not fit together
  std::vector<Vec3> places;                 ///< where the loops cross, or where the triangulation broke

  static auto fields(auto& f) {
    return std::tie(f.face, f.xyz, f.uv, f.size, f.segment_nodes, f.segment_loop, f.segment_edge, f.triangles,
                    f.places);
  }
};

}  // namespace st
