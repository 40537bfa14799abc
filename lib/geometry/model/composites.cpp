#include "geometry/model/composites.h"

#include <algorithm>

#include "base/finite.h"
#include "geometry/model/id_checks.h"
#include "geometry/model/model.h"
#include "geometry/shape/member_map.h"

namespace st {
namespace {

template <class T>
bool are_finite(const std::vector<T>& values) {
  return std::ranges::all_of(values, [](const T& v) { return is_finite(v); });
}

/// Whether each joined vertex is the end of two edges that are left: chains of edges pass there, and end.
bool are_between_two(const ModelTables& t, const Composites& c, const std::vector<std::uint8_t>& is_joined) {
  std::vector<std::vector<EdgeId>> at(static_cast<std::size_t>(t.n_vertices()));
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    for (const std::size_t k : {0, 1})
      if (const VertexId v = t.edge_vertices[2 * static_cast<std::size_t>(e) + k]; v != kNone && !is_joined[e])
        at[v].push_back(e);
  return std::ranges::all_of(c.joined_vertices, [&](VertexId v) { return at[v].size() == 2 && at[v][0] != at[v][1]; });
}

/// Whether every face is a member of one composite at most.
bool are_single(std::vector<FaceId> members) {
  std::ranges::sort(members);
  return std::ranges::adjacent_find(members) == members.end();
}

}  // namespace

std::int32_t Composites::rim(CoedgeId coedge) const {
  return static_cast<std::int32_t>(std::lower_bound(rim_coedge.begin(), rim_coedge.end(), coedge) - rim_coedge.begin());
}

Chart Composites::chart(std::int32_t i) const {
  const auto part = [&](const auto& values, const std::vector<std::int32_t>& offsets) {
    return std::decay_t<decltype(values)>(values.begin() + offsets[i], values.begin() + offsets[i + 1]);
  };
  return {part(node_xyz, node_offsets), {}, part(node_uv, node_offsets), part(triangle_nodes, triangle_offsets)};
}

std::string Composites::contradiction(const ModelTables& t) const {
  if (member_offsets.empty()) return "faces of composites";
  const auto n = static_cast<std::size_t>(size());
  if (!are_offsets(member_offsets, n, member.size()) || !are_below(member, t.n_faces()) || !are_single(member))
    return "faces of composites";
  if (!are_below(joined_edges, t.n_edges()) || !are_below(joined_vertices, t.n_vertices()))
    return "edges of composites";
  if (!are_finite(node_xyz) || !are_finite(node_uv) || !are_finite(triangle_uv) || !are_finite(uv_bounds) ||
      !are_finite(rim_t))
    return "numbers of composites";
  if (!are_offsets(node_offsets, n, node_xyz.size()) || node_uv.size() != node_xyz.size()) return "nodes of composites";
  if (!are_offsets(triangle_offsets, n, triangle_nodes.size()) || triangle_face.size() != triangle_nodes.size() ||
      triangle_uv.size() != triangle_nodes.size() || triangle_pole.size() != triangle_nodes.size() ||
      uv_bounds.size() != 4 * n)
    return "triangles of composites";
  if (!are_pole_codes(triangle_pole)) return "triangles of composites";
  std::vector<std::uint8_t> is_joined(static_cast<std::size_t>(t.n_edges()), 0);
  for (const EdgeId e : joined_edges) is_joined[e] = 1;
  if (!are_between_two(t, *this, is_joined)) return "edges of composites";
  if (!are_offsets(rim_offsets, rim_coedge.size(), rim_t.size()) || rim_node.size() != rim_t.size() ||
      rim_triangle.size() != rim_t.size() || !std::is_sorted(rim_coedge.begin(), rim_coedge.end()))
    return "rims of composites";
  for (std::int32_t i = 0; i < size(); ++i) {
    const std::int32_t n_nodes = node_offsets[i + 1] - node_offsets[i],
                       n_triangles = triangle_offsets[i + 1] - triangle_offsets[i];
    if (n_triangles == 0) return "triangles of composites";
    for (std::int32_t k = triangle_offsets[i]; k < triangle_offsets[i + 1]; ++k)
      if (!are_below(triangle_nodes[k], n_nodes) || !std::ranges::binary_search(members(i), triangle_face[k]))
        return "triangles of composites";
    for (const FaceId f : members(i))
      for (const CoedgeId c : t.coedges(f)) {
        const EdgeId e = t.coedge_edge[c];
        if (is_joined[e] || t.edge_is_degenerate[e]) continue;
        const auto r = static_cast<std::size_t>(rim(c));
        if (r >= rim_coedge.size() || rim_coedge[r] != c || rim_offsets[r + 1] - rim_offsets[r] < 2)
          return "rims of composites";
        for (std::int32_t k = rim_offsets[r]; k < rim_offsets[r + 1]; ++k)
          if (!are_below(std::span(&rim_node[k], 1), n_nodes) || (k > rim_offsets[r] && !(rim_t[k - 1] < rim_t[k])) ||
              (k + 1 < rim_offsets[r + 1] && !are_below(std::span(&rim_triangle[k], 1), n_triangles)))
            return "rims of composites";
      }
  }
  return "";
}

}  // namespace st
