#include "meshing/hole/hole_mesh.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "base/error.h"
#include "base/finite.h"
#include "meshing/topology/small_features.h"

namespace st {
namespace {

constexpr auto kOnVertex = static_cast<std::uint8_t>(EntityDim::kVertex),
               kOnEdge = static_cast<std::uint8_t>(EntityDim::kEdge),
               kInFace = static_cast<std::uint8_t>(EntityDim::kFace);

[[noreturn]] void fail(const std::string& what) {
  throw Error(ExitCode::kInput, "the mesh " + what + "; make it again with st-merge");
}

void require_valid(const SurfaceMesh& m, const ModelTables& t) {
  const std::int32_t limit[] = {t.n_vertices(), t.n_edges(), t.n_faces()};
  for (std::size_t n = 0; n < m.node_xyz.size(); ++n) {
    const std::string node = "node " + std::to_string(n);
    if (!is_finite(m.node_xyz[n]) || !std::isfinite(m.node_t[n])) fail("has no finite coordinates at " + node + "");
    if (!(m.node_size[n] > 0) || !std::isfinite(m.node_size[n])) fail("has no positive length at " + node);
    if (m.node_entity_dim[n] > kInFace || m.node_entity[n] < 0 || m.node_entity[n] >= limit[m.node_entity_dim[n]])
      fail("has " + node + " on an entity that the geometry does not have");
    if (n &&
        std::tie(m.node_entity_dim[n], m.node_entity[n]) < std::tie(m.node_entity_dim[n - 1], m.node_entity[n - 1]))
      fail("is not in the order that st-merge writes");
  }
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    if (m.triangle_face[i] < 0 || m.triangle_face[i] >= t.n_faces())
      fail("has a triangle on a face that the geometry does not have");
    if (i && m.triangle_face[i] < m.triangle_face[i - 1]) fail("is not in the order that st-merge writes");
  }
  for (const Vec2 uv : m.corner_uv)
    if (!is_finite(uv)) fail("has (u,v) that are not finite");
}

/// Sum of the signed areas in (u,v) of a face's triangles.
double uv_area(const SurfaceMesh& m, TriangleId begin, TriangleId end) {
  double sum = 0;
  for (TriangleId i = begin; i < end; ++i) {
    const Vec2 a = m.corner_uv[3 * i], b = m.corner_uv[3 * i + 1] - a, c = m.corner_uv[3 * i + 2] - a;
    sum += b.x * c.y - b.y * c.x;
  }
  return sum;
}

}  // namespace

HoleMesh::HoleMesh(const SurfaceMesh& m, const ModelTables& of_cad, const Model* model)
    : mesh(m), topology(of_cad, m.merged), tables(topology.tables()) {
  const ModelTables& t = tables;
  require_valid(m, t);
  const auto n_nodes = static_cast<NodeId>(m.node_xyz.size());
  vertex_node.assign(t.n_vertices(), kNone);
  node_on_edge.assign(n_nodes, kNone);
  std::vector<NodeId> first_on_edge(t.n_edges() + 1, 0);
  inner_begin.assign(t.n_faces() + 1, 0);
  NodeId n = 0;
  for (; n < n_nodes && m.node_entity_dim[n] == kOnVertex; ++n) vertex_node[m.node_entity[n]] = n;
  for (EdgeId e = 0; e <= t.n_edges(); ++e) {
    first_on_edge[e] = n;
    while (e < t.n_edges() && n < n_nodes && m.node_entity_dim[n] == kOnEdge && m.node_entity[n] == e) ++n;
  }
  for (FaceId f = 0; f <= t.n_faces(); ++f) {
    inner_begin[f] = n;
    while (f < t.n_faces() && n < n_nodes && m.node_entity[n] == f) ++n;
  }
  const StripNodes strips = closed_strip_nodes(first_on_edge, model);
  edges.edge_offsets.push_back(0);
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    add_edge(e, first_on_edge, strips);
    edges.edge_offsets.push_back(static_cast<std::int32_t>(edge_node.size()));
  }
  std::sort(segments.begin(), segments.end(), [](const CadSegment& a, const CadSegment& b) {
    return std::tie(a.low, a.high, a.index) < std::tie(b.low, b.high, b.index);
  });
  face_begin.assign(t.n_faces() + 1, 0);
  for (FaceId f : m.triangle_face) ++face_begin[f + 1];
  for (FaceId f = 0; f < t.n_faces(); ++f) face_begin[f + 1] += face_begin[f];
  for (FaceId f = 0; f < t.n_faces(); ++f) face_is_turned.push_back(uv_area(m, face_begin[f], face_begin[f + 1]) < 0);
}

void HoleMesh::add_edge(EdgeId e, const std::vector<NodeId>& first_on_edge, const StripNodes& strips) {
  const ModelTables& t = tables;
  const NodeId first = vertex_node[t.edge_vertices[2 * e]], last = vertex_node[t.edge_vertices[2 * e + 1]];
  if (t.edge_is_degenerate[e] || first == kNone || last == kNone) return;
  const auto add = [&](NodeId node, double at) {
    edges.node_t.push_back(at);
    edges.node_xyz.push_back(mesh.node_xyz[node]);
    edges.node_size.push_back(mesh.node_size[node]);
    edge_node.push_back(node);
  };
  add(first, t.edge_range[2 * e]);
  if (const auto strip = strips.find(e); strip != strips.end()) {
    for (const auto& [node, at] : strip->second) {
      if (mesh.node_entity[node] == e) node_on_edge[node] = static_cast<std::int32_t>(edge_node.size());
      add(node, at);
    }
  } else {
    for (NodeId k = first_on_edge[e]; k < first_on_edge[e + 1]; ++k) {
      node_on_edge[k] = static_cast<std::int32_t>(edge_node.size());
      add(k, mesh.node_t[k]);
    }
  }
  add(last, t.edge_range[2 * e + 1]);
  for (std::size_t i = edges.edge_offsets.back() + 1; i < edge_node.size(); ++i) {
    if (!(edges.node_t[i] > edges.node_t[i - 1])) fail("has nodes on edge " + std::to_string(e + 1) + " out of order");
    const auto [low, high] = std::minmax(edge_node[i - 1], edge_node[i]);
    segments.push_back({low, high, e, static_cast<std::int32_t>(i) - 1});
  }
}

/// Nodes inside the closed edges of strips as st-mesh made them: where a strip is closed, those of its kept edge.
HoleMesh::StripNodes HoleMesh::closed_strip_nodes(const std::vector<NodeId>& first_on_edge, const Model* model) const {
  StripNodes result;
  if (!model) return result;
  for (const MeshTopology::Strip& strip : topology.strips()) {
    const EdgeId kept = strip.kept, closed = strip.closed;
    const NodeId begin = first_on_edge[kept], end = first_on_edge[kept + 1];
    const std::vector<double> mirrored =
        mirror_nodes(*model->curve(kept), std::span(mesh.node_t).subspan(begin, end - begin), *model->curve(closed),
                     strip.is_opposed)
            .node_t;
    NodeId own = first_on_edge[closed];
    auto& on_closed = result[closed];
    for (std::size_t k = 1; k + 1 < mirrored.size(); ++k) {
      const NodeId i = strip.mirrored(static_cast<std::int32_t>(k), static_cast<std::int32_t>(mirrored.size()));
      const bool is_open = own < first_on_edge[closed + 1] && mesh.node_t[own] == mirrored[k];
      on_closed.push_back({is_open ? own++ : begin + i - 1, mirrored[k]});
    }
    if (own != first_on_edge[closed + 1])
      fail("does not have the nodes on edge " + std::to_string(closed + 1) + " that go with those on edge " +
           std::to_string(kept + 1));
  }
  return result;
}

std::span<const CadSegment> HoleMesh::segments_between(NodeId a, NodeId b) const {
  const auto [low, high] = std::minmax(a, b);
  const auto first =
      std::lower_bound(segments.begin(), segments.end(), std::pair(low, high),
                       [](const CadSegment& s, const auto& key) { return std::pair(s.low, s.high) < key; });
  auto last = first;
  while (last != segments.end() && last->low == low && last->high == high) ++last;
  return {first, last};
}

}  // namespace st
