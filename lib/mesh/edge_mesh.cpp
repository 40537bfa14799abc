#include "mesh/edge_mesh.h"

#include <algorithm>
#include <utility>

#include "base/limits.h"

namespace st {
namespace {

template <class T>
void add_range(std::vector<T>& to, const std::vector<T>& from, IdRange range) {
  to.insert(to.end(), from.begin() + range.first(), from.begin() + range.first() + range.size());
}

}  // namespace

EdgeMesh EdgeMesh::of_edges(EdgeId n_edges) {
  EdgeMesh mesh;
  mesh.edge_offsets.assign(static_cast<std::size_t>(n_edges) + 1, 0);
  return mesh;
}

EdgeMesh EdgeMesh::of_curve(std::vector<double> t, std::vector<Vec3> xyz, std::vector<double> size) {
  EdgeMesh mesh;
  mesh.edge_offsets = {0, checked_id(t.size(), "nodes on a curve")};
  mesh.node_t = std::move(t);
  mesh.node_xyz = std::move(xyz);
  mesh.node_size = std::move(size);
  return mesh;
}

void EdgeMesh::append(const EdgeMesh& other, EdgeId e) {
  add_range(node_t, other.node_t, other.nodes(e));
  add_range(node_xyz, other.node_xyz, other.nodes(e));
  add_range(node_size, other.node_size, other.nodes(e));
  if (edge_offsets.empty()) edge_offsets.push_back(0);
  edge_offsets.push_back(checked_id(node_t.size(), "nodes on edges"));
}

bool has_same_nodes(const EdgeMesh& a, const EdgeMesh& b, EdgeId e) {
  const auto at = [e](const EdgeMesh& m) { return m.node_xyz.begin() + m.first_node(e); };
  return std::equal(at(a), at(a) + a.n_nodes(e), at(b), at(b) + b.n_nodes(e));
}

}  // namespace st
