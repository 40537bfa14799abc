#include "mesh/edge_mesh.h"

#include <algorithm>

#include "base/limits.h"

namespace st {
namespace {

template <class T>
void add_range(std::vector<T>& to, const std::vector<T>& from, IdRange range) {
  to.insert(to.end(), from.begin() + range.first(), from.begin() + range.first() + range.size());
}

void end_edge(EdgeMesh& m) {
  if (m.edge_offsets.empty()) m.edge_offsets.push_back(0);
  m.edge_offsets.push_back(checked_id(m.node_t.size(), "nodes on edges"));
}

}  // namespace

EdgeMesh EdgeMesh::of_edges(EdgeId n_edges) {
  EdgeMesh mesh;
  mesh.edge_offsets.assign(static_cast<std::size_t>(n_edges) + 1, 0);
  return mesh;
}

void EdgeMesh::append(const CurveNodes& nodes) {
  node_t.insert(node_t.end(), nodes.t.begin(), nodes.t.end());
  node_xyz.insert(node_xyz.end(), nodes.x.begin(), nodes.x.end());
  node_size.insert(node_size.end(), nodes.h.begin(), nodes.h.end());
  end_edge(*this);
}

void EdgeMesh::append(const EdgeMesh& other, EdgeId e) {
  add_range(node_t, other.node_t, other.nodes(e));
  add_range(node_xyz, other.node_xyz, other.nodes(e));
  add_range(node_size, other.node_size, other.nodes(e));
  end_edge(*this);
}

bool has_same_nodes(const EdgeMesh& a, const EdgeMesh& b, EdgeId e) {
  const auto at = [e](const EdgeMesh& m) { return m.node_xyz.begin() + m.first_node(e); };
  return std::equal(at(a), at(a) + a.n_nodes(e), at(b), at(b) + b.n_nodes(e));
}

}  // namespace st
