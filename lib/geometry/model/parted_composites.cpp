#include "geometry/model/parted_composites.h"

#include <algorithm>
#include <iterator>

namespace st {
namespace {

template <class T>
void add(const std::vector<T>& from, std::int32_t begin, std::int32_t end, std::vector<T>& to) {
  to.insert(to.end(), from.begin() + begin, from.begin() + end);
}

void add_chart(const Composites& c, std::int32_t i, Composites& kept) {
  add(c.member, c.member_offsets[i], c.member_offsets[i + 1], kept.member);
  add(c.node_xyz, c.node_offsets[i], c.node_offsets[i + 1], kept.node_xyz);
  add(c.node_uv, c.node_offsets[i], c.node_offsets[i + 1], kept.node_uv);
  add(c.triangle_nodes, c.triangle_offsets[i], c.triangle_offsets[i + 1], kept.triangle_nodes);
  add(c.triangle_face, c.triangle_offsets[i], c.triangle_offsets[i + 1], kept.triangle_face);
  add(c.triangle_uv, c.triangle_offsets[i], c.triangle_offsets[i + 1], kept.triangle_uv);
  add(c.triangle_pole, c.triangle_offsets[i], c.triangle_offsets[i + 1], kept.triangle_pole);
  add(c.uv_bounds, 4 * i, 4 * i + 4, kept.uv_bounds);
  kept.member_offsets.push_back(static_cast<std::int32_t>(kept.member.size()));
  kept.node_offsets.push_back(static_cast<std::int32_t>(kept.node_xyz.size()));
  kept.triangle_offsets.push_back(static_cast<std::int32_t>(kept.triangle_nodes.size()));
}

void add_rim(const Composites& c, std::size_t r, Composites& kept) {
  kept.rim_coedge.push_back(c.rim_coedge[r]);
  add(c.rim_t, c.rim_offsets[r], c.rim_offsets[r + 1], kept.rim_t);
  add(c.rim_node, c.rim_offsets[r], c.rim_offsets[r + 1], kept.rim_node);
  add(c.rim_triangle, c.rim_offsets[r], c.rim_offsets[r + 1], kept.rim_triangle);
  kept.rim_offsets.push_back(static_cast<std::int32_t>(kept.rim_t.size()));
}

}  // namespace

void mark_apart(const Composites& c, std::span<const FaceId> faces, std::vector<std::uint8_t>& is_apart) {
  if (c.empty()) return;
  std::vector<std::int32_t> composite_of(static_cast<std::size_t>(std::ranges::max(c.member)) + 1, kNone);
  for (std::int32_t i = 0; i < c.size(); ++i)
    for (const FaceId f : c.members(i).subspan(1)) composite_of[f] = i;
  for (const FaceId f : faces)
    if (static_cast<std::size_t>(f) < composite_of.size() && composite_of[f] != kNone) is_apart[composite_of[f]] = 1;
}

Composites without(const Composites& c, const std::vector<std::uint8_t>& is_apart, const ModelTables& cad) {
  Composites kept;
  std::vector<std::uint8_t> is_of_apart(static_cast<std::size_t>(cad.n_edges()), 0),
      is_its_end(static_cast<std::size_t>(cad.n_vertices()), 0),
      keeps_rim(static_cast<std::size_t>(cad.n_coedges()), 0);
  for (std::int32_t i = 0; i < c.size(); ++i) {
    if (!is_apart[i]) add_chart(c, i, kept);
    for (const FaceId f : c.members(i))
      for (const CoedgeId coedge : cad.coedges(f)) {
        keeps_rim[coedge] = !is_apart[i];
        if (is_apart[i]) is_of_apart[cad.coedge_edge[coedge]] = 1;
      }
  }
  for (std::size_t r = 0; r < c.rim_coedge.size(); ++r)
    if (keeps_rim[c.rim_coedge[r]]) add_rim(c, r, kept);
  for (EdgeId e = 0; e < cad.n_edges(); ++e)
    for (const std::size_t k : {0, 1})
      if (const VertexId v = cad.edge_vertices[2 * static_cast<std::size_t>(e) + k]; is_of_apart[e] && v != kNone)
        is_its_end[v] = 1;
  std::ranges::copy_if(c.joined_edges, std::back_inserter(kept.joined_edges),
                       [&](EdgeId e) { return !is_of_apart[e]; });
  std::ranges::copy_if(c.joined_vertices, std::back_inserter(kept.joined_vertices),
                       [&](VertexId v) { return !is_its_end[v]; });
  return kept;
}

}  // namespace st
