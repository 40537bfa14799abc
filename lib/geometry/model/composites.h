// CAD faces that are one face to every stage, because they go on into each other smoothly.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/ids.h"
#include "geometry/shape/chart_surface.h"

namespace st {

struct ModelTables;

/// Which faces are joined, and the chart of each composite; ids are those of the CAD. Structure of arrays.
struct Composites {
  std::vector<FaceId> member;                   ///< CAD faces, ascending in each composite
  std::vector<std::int32_t> member_offsets{0};  ///< [n_composites+1]
  std::vector<EdgeId> joined_edges;             ///< ascending: between members, no edges any more
  std::vector<VertexId> joined_vertices;        ///< ascending: where two edges go on as one
  // charts: nodes and triangles of composite i are [node_offsets[i], node_offsets[i+1]), triangles likewise
  std::vector<Vec3> node_xyz;                    ///< model unit
  std::vector<Vec2> node_uv;                     ///< of the composite
  std::vector<Corners> triangle_nodes;           ///< counted within the composite, counter-clockwise from outside
  std::vector<FaceId> triangle_face;             ///< CAD face
  std::vector<std::array<Vec2, 3>> triangle_uv;  ///< of the corners, on that face
  std::vector<std::int32_t> triangle_pole;       ///< PoleCorner::code(), or kNone
  std::vector<std::int32_t> node_offsets{0}, triangle_offsets{0};
  std::vector<double> uv_bounds;  ///< [4*n_composites] u_min, u_max, v_min, v_max of the trimming curves
  // rims: each coedge of a member whose edge stays
  std::vector<CoedgeId> rim_coedge;          ///< ascending
  std::vector<std::int32_t> rim_offsets{0};  ///< [n_rims+1]
  std::vector<double> rim_t;                 ///< parameter of the CAD edge at each point, ascending
  std::vector<std::int32_t> rim_node;        ///< node within the composite
  std::vector<std::int32_t> rim_triangle;    ///< triangle within the composite from this point to the next one

  bool empty() const { return member.empty(); }
  std::int32_t size() const { return static_cast<std::int32_t>(member_offsets.size()) - 1; }
  std::span<const FaceId> members(std::int32_t composite) const {
    return std::span(member).subspan(
        static_cast<std::size_t>(member_offsets[composite]),
        static_cast<std::size_t>(member_offsets[composite + 1] - member_offsets[composite]));
  }
  /// Row of a coedge's rim.
  std::int32_t rim(CoedgeId coedge) const;
  /// Without normals.
  Chart chart(std::int32_t composite) const;

  /// What contradicts itself or the CAD's tables, for a message; empty: nothing.
  std::string contradiction(const ModelTables& cad) const;
};

}  // namespace st
