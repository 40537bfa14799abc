#include "mesh/edge_segments.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "base/sort_once.h"

namespace st {
namespace {

constexpr std::int32_t kLastNumber = std::numeric_limits<std::int32_t>::max();

/// Finds nodes of a mesh in canonical order by what they lie on.
class NodeFinder {
 public:
  NodeFinder(const SurfaceMesh& mesh, const EdgeMesh& edges, std::span<const VertexId> edge_vertices)
      : mesh_(mesh), edges_(edges), edge_vertices_(edge_vertices) {}

  std::int32_t n_nodes(EdgeId e) const { return edges_.n_nodes(e); }

  /// Node `i` of an edge; where a strip is closed the one of its kept edge. kNone: the mesh has none.
  NodeId edge_node(EdgeId e, std::int32_t i) const {
    const std::int32_t n = n_nodes(e);
    if (i == 0 || i + 1 == n) return find(EntityDim::kVertex, edge_vertices_[2 * e + (i == 0 ? 0 : 1)], 0);
    const NodeId own = find(EntityDim::kEdge, e, edges_.node_t[edges_.first_node(e) + i]);
    const auto closed = std::find(mesh_.merged.strip_closed.begin(), mesh_.merged.strip_closed.end(), e);
    if (own != kNone || closed == mesh_.merged.strip_closed.end()) return own;
    const auto strip = closed - mesh_.merged.strip_closed.begin();
    const EdgeId kept = mesh_.merged.strip_kept[strip];
    return n_nodes(kept) == n ? edge_node(kept, mesh_.merged.strip_is_opposed[strip] ? n - 1 - i : i) : kNone;
  }

 private:
  NodeId find(EntityDim dim, std::int32_t entity, double t) const {
    using Key = std::tuple<std::uint8_t, std::int32_t, double>;
    const Key wanted(static_cast<std::uint8_t>(dim), entity, t);
    const auto key = [&](NodeId n) { return Key(mesh_.node_entity_dim[n], mesh_.node_entity[n], mesh_.node_t[n]); };
    NodeId low = 0, high = static_cast<NodeId>(mesh_.n_nodes());
    while (low < high) {
      const NodeId middle = low + (high - low) / 2;
      (key(middle) < wanted ? low : high) = key(middle) < wanted ? middle + 1 : middle;
    }
    return low < mesh_.n_nodes() && key(low) == wanted ? low : kNone;
  }

  const SurfaceMesh& mesh_;
  const EdgeMesh& edges_;
  std::span<const VertexId> edge_vertices_;
};

/// Tables of the groups, the main one first.
std::vector<std::string> tables_of(const std::vector<EntityGroup>& groups) {
  std::vector<std::string> tables;
  for (const EntityGroup& g : groups)
    if (std::find(tables.begin(), tables.end(), g.table) == tables.end()) tables.push_back(g.table);
  std::stable_partition(tables.begin(), tables.end(), [](const std::string& t) { return t.empty(); });
  return tables;
}

/// The entities in a table's groups, with the number of the last of these, from 1, ascending. Ids may be anything.
std::vector<std::pair<std::int32_t, std::int32_t>> numbers_of(const std::vector<EntityGroup>& groups,
                                                              const std::string& table, NodeGroups& out) {
  std::vector<std::pair<std::int32_t, std::int32_t>> numbers;
  for (const EntityGroup& g : groups) {
    if (g.table != table) continue;
    out.group_name.push_back(g.name);
    for (const std::int32_t id : g.ids) numbers.push_back({id, static_cast<std::int32_t>(out.group_name.size())});
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

NodeGroups table_groups(const SurfaceMesh& m, const std::string& name, const std::vector<EntityGroup>& groups,
                        const std::string& table) {
  NodeGroups out;
  out.name = name + (table.empty() ? "" : "_" + table);
  out.of_node.assign(m.node_xyz.size(), 0);
  const std::vector<std::pair<std::int32_t, std::int32_t>> numbers = numbers_of(groups, table, out);
  const auto number_of = [&](std::int32_t id) {
    const auto after = std::upper_bound(numbers.begin(), numbers.end(), std::pair(id, kLastNumber));
    return after != numbers.begin() && after[-1].first == id ? after[-1].second : 0;
  };
  const auto set = [&](NodeId n, std::int32_t g) {
    if (g > 0 && (out.of_node[n] == 0 || g < out.of_node[n])) out.of_node[n] = g;
  };
  if (&groups == &m.labels.vertex_groups) {
    for (std::size_t n = 0; n < m.node_entity.size(); ++n)
      if (m.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kVertex))
        set(static_cast<NodeId>(n), number_of(m.node_entity[n]));
  } else {
    for (std::size_t i = 0; i < m.segment_nodes.size(); ++i) set(m.segment_nodes[i], number_of(m.segment_edge[i / 2]));
  }
  return out;
}

}  // namespace

void add_segments(SurfaceMesh& mesh, const EdgeMesh& edges, std::span<const VertexId> edge_vertices) {
  mesh.segment_nodes.clear();
  mesh.segment_edge.clear();
  std::vector<EdgeId> in_groups;
  for (const EntityGroup& g : mesh.labels.edge_groups) in_groups.insert(in_groups.end(), g.ids.begin(), g.ids.end());
  sort_once(in_groups);
  const NodeFinder nodes(mesh, edges, edge_vertices);
  for (const EdgeId e : in_groups) {
    if (e >= edges.n_edges()) break;
    for (std::int32_t i = 1; i < nodes.n_nodes(e); ++i) {
      const NodeId a = nodes.edge_node(e, i - 1), b = nodes.edge_node(e, i);
      if (a == kNone || b == kNone || a == b) continue;
      mesh.segment_nodes.insert(mesh.segment_nodes.end(), {a, b});
      mesh.segment_edge.push_back(e);
    }
  }
}

void add_all_segments(SurfaceMesh& mesh, std::span<const VertexId> edge_vertices) {
  const auto is_on_edge = [&](NodeId n) {
    return mesh.node_entity_dim[n] < static_cast<std::uint8_t>(EntityDim::kFace);
  };
  std::vector<std::pair<NodeId, NodeId>> sides;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const NodeId a = t.n[k], b = t.n[(k + 1) % 3];
      if (is_on_edge(a) && is_on_edge(b)) sides.push_back(std::minmax(a, b));
    }
  std::sort(sides.begin(), sides.end());
  const std::size_t n_edges = edge_vertices.size() / 2;
  const auto last = std::max_element(edge_vertices.begin(), edge_vertices.end());
  std::vector<NodeId> vertex_node(last == edge_vertices.end() ? 0 : static_cast<std::size_t>(*last) + 1, kNone);
  std::vector<std::vector<NodeId>> chain(n_edges);
  for (std::size_t n = 0; n < mesh.node_entity.size(); ++n) {
    const auto entity = static_cast<std::size_t>(mesh.node_entity[n]);
    if (mesh.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kVertex)) {
      if (entity < vertex_node.size()) vertex_node[entity] = static_cast<NodeId>(n);
    } else if (is_on_edge(static_cast<NodeId>(n)) && entity < n_edges) {
      chain[entity].push_back(static_cast<NodeId>(n));
    }
  }
  const auto node_of = [&](VertexId v) {
    return static_cast<std::size_t>(v) < vertex_node.size() ? vertex_node[v] : kNone;
  };
  mesh.segment_nodes.clear();
  mesh.segment_edge.clear();
  for (std::size_t e = 0; e < n_edges; ++e) {
    chain[e].insert(chain[e].begin(), node_of(edge_vertices[2 * e]));
    chain[e].push_back(node_of(edge_vertices[2 * e + 1]));
    for (std::size_t i = 1; i < chain[e].size(); ++i) {
      const NodeId a = chain[e][i - 1], b = chain[e][i];
      if (!std::binary_search(sides.begin(), sides.end(), std::pair<NodeId, NodeId>(std::minmax(a, b)))) continue;
      mesh.segment_nodes.insert(mesh.segment_nodes.end(), {a, b});
      mesh.segment_edge.push_back(static_cast<EdgeId>(e));
    }
  }
}

std::vector<NodeGroups> node_groups(const SurfaceMesh& mesh) {
  std::vector<NodeGroups> all;
  for (const std::string& table : tables_of(mesh.labels.edge_groups))
    all.push_back(table_groups(mesh, "edge_group", mesh.labels.edge_groups, table));
  for (const std::string& table : tables_of(mesh.labels.vertex_groups))
    all.push_back(table_groups(mesh, "vertex_group", mesh.labels.vertex_groups, table));
  return all;
}

}  // namespace st
