#include "geometry/model/facet_shape.h"

#include <algorithm>

#include "geometry/model/id_checks.h"
#include "geometry/model/model.h"

namespace st {

Chart FacetShape::chart(FaceId f) const {
  const auto first = static_cast<std::ptrdiff_t>(face_node_offsets[f]),
             last = static_cast<std::ptrdiff_t>(face_node_offsets[f + 1]);
  const std::span<const Corners> t = triangles(f);
  return {{node_xyz.begin() + first, node_xyz.begin() + last},
          {node_normal.begin() + first, node_normal.begin() + last},
          {node_uv.begin() + first, node_uv.begin() + last},
          {t.begin(), t.end()}};
}

std::string FacetShape::contradiction(const ModelTables& t) const {
  const auto n_faces = static_cast<std::size_t>(t.n_faces()), n_edges = static_cast<std::size_t>(t.n_edges());
  if (node_normal.size() != node_xyz.size() || node_uv.size() != node_xyz.size() ||
      !are_offsets(face_node_offsets, n_faces, node_xyz.size()))
    return "nodes of its faces";
  if (!are_offsets(face_triangle_offsets, n_faces, triangle_nodes.size())) return "triangles of its faces";
  if (!are_offsets(edge_point_offsets, n_edges, edge_xyz.size())) return "points of its edges";
  if (!are_offsets(coedge_node_offsets, t.coedge_edge.size(), coedge_nodes.size())) return "nodes of its loops";
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    if (triangles(f).empty()) return "triangles of its faces";
    for (const Corners& c : triangles(f))
      if (!are_below(c, nodes(f).size())) return "triangles of its faces";
    for (const CoedgeId c : t.coedges(f)) {
      const EdgeId e = t.coedge_edge[c];
      const std::span<const std::int32_t> own =
          std::span(coedge_nodes)
              .subspan(static_cast<std::size_t>(coedge_node_offsets[c]),
                       static_cast<std::size_t>(coedge_node_offsets[c + 1] - coedge_node_offsets[c]));
      if (own.size() < 2 || own.size() != points(e).size() || !are_below(own, nodes(f).size()))
        return "nodes of its loops";
    }
  }
  return "";
}

}  // namespace st
