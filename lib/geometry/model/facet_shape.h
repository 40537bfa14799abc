// The shape of a model without CAD: faces as charts of flat facets, edges as polylines.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/ids.h"
#include "geometry/shape/chart_surface.h"

namespace st {

struct ModelTables;

/// What stands in place of a B-Rep; structure of arrays, in the order of the tables. Empty where there is a B-Rep.
struct FacetShape {
  // facets: nodes of face f are [face_node_offsets[f], face_node_offsets[f+1]), its triangles likewise
  std::vector<Vec3> node_xyz;           ///< model unit; a node of two faces stands here twice
  std::vector<Vec3> node_normal;        ///< unit, outward, smooth within a face and across cuts
  std::vector<Vec2> node_uv;            ///< model unit
  std::vector<Corners> triangle_nodes;  ///< counted within the face
  std::vector<std::int32_t> face_node_offsets, face_triangle_offsets;  ///< [n_faces+1]
  // edges: points of edge e are [edge_point_offsets[e], edge_point_offsets[e+1])
  std::vector<Vec3> edge_xyz;                     ///< along each edge, two at least
  std::vector<std::int32_t> edge_point_offsets;   ///< [n_edges+1]
  std::vector<std::int32_t> coedge_nodes;         ///< nodes within the face at the points of the edge, along the edge
  std::vector<std::int32_t> coedge_node_offsets;  ///< [n_coedges+1]

  bool empty() const { return triangle_nodes.empty(); }
  IdRange nodes(FaceId f) const { return {face_node_offsets[f], face_node_offsets[f + 1]}; }
  std::span<const Corners> triangles(FaceId f) const {
    return std::span(triangle_nodes)
        .subspan(static_cast<std::size_t>(face_triangle_offsets[f]),
                 static_cast<std::size_t>(face_triangle_offsets[f + 1] - face_triangle_offsets[f]));
  }
  std::span<const Vec3> points(EdgeId e) const {
    return std::span(edge_xyz).subspan(static_cast<std::size_t>(edge_point_offsets[e]),
                                       static_cast<std::size_t>(edge_point_offsets[e + 1] - edge_point_offsets[e]));
  }
  Chart chart(FaceId f) const;

  /// What contradicts itself or the tables, for a message; empty: nothing.
  std::string contradiction(const ModelTables& tables) const;
};

}  // namespace st
