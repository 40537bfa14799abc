// Facets of CAD faces with their places in (u,v), and how they hang together across edges.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/model/facets.h"
#include "geometry/model/model.h"
#include "geometry/shape/chart_topology.h"

namespace st {

/// Side k of triangle t, from corner k to the next one, is 3 t + k.
struct UvFacets {
  std::vector<Vec3> x;                              ///< [n_nodes] model unit; a node of two faces stands here twice
  std::vector<Corners> corners;                     ///< [n_triangles] counter-clockwise seen from outside
  std::vector<std::array<Vec2, 3>> uv;              ///< [n_triangles] of the corners, on the face's surface
  std::vector<std::int32_t> pole;                   ///< [n_triangles] PoleCorner::code(), or kNone
  std::vector<FaceId> face;                         ///< [n_triangles] ascending
  std::vector<std::int32_t> face_offsets;           ///< [n_faces+1] triangles; none where a face cannot be triangulated
  std::vector<std::int32_t> mate;                   ///< [3*n_triangles] side of the same face; kNone along its edges
  std::vector<std::vector<double>> rim_t;           ///< [n_coedges] parameters of nodes along its edge, ascending
  std::vector<std::vector<std::int32_t>> rim_side;  ///< [n_coedges] the sides between them
  std::vector<FaceId> turned;                       ///< faces with a facet that is_turned(), ascending

  /// Whether two sides are one, passed in opposite directions, within a tenth of it.
  bool fit(std::int32_t a, std::int32_t b) const;
};

/// By OpenCASCADE's BRepMesh; faces that are not wanted, whose triangles do not fill their loops or do not lie side by
/// side around a pole, or whose nodes are not those of their edges have none. Faces that a facet turns away from get
/// exact ones, whatever `limits` say. Local, on all threads. Cost: some microseconds per facet.
UvFacets make_uv_facets(const Model& model, const std::vector<std::uint8_t>& is_wanted, const FacetLimits& limits);

}  // namespace st
