#include "mesh/merge.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "base/assert.h"
#include "base/error.h"
#include "base/limits.h"

namespace st {

namespace {

constexpr NodeId kUsed = 0;

/// Where patch nodes end up in the merged mesh: one entry per vertex and per edge node, kNone when no triangle uses it.
struct NodeNumbers {
  std::vector<NodeId> vertex;     ///< [n_vertices]
  std::vector<NodeId> edge_node;  ///< [edge_offsets.back()]
};

[[noreturn]] void throw_bad_patch(FaceId face, const std::string& what) {
  throw Error(ExitCode::kInput, "face " + std::to_string(face + 1) + ": its patch " + what + "; mesh the model again");
}

std::vector<const FacePatch*> patches_by_face(std::span<const FacePatch> patches) {
  std::vector<const FacePatch*> sorted;
  for (const FacePatch& p : patches) sorted.push_back(&p);
  std::sort(sorted.begin(), sorted.end(), [](const FacePatch* a, const FacePatch* b) { return a->face < b->face; });
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (sorted[i]->face < 0) throw_bad_patch(sorted[i]->face, "has no face id");
    if (i && sorted[i]->face == sorted[i - 1]->face) throw_bad_patch(sorted[i]->face, "occurs twice");
  }
  return sorted;
}

void require_valid(const MergeInput& in, const FacePatch& p) {
  const auto n_boundary = static_cast<std::size_t>(p.n_boundary);
  if (p.n_boundary < 0 || p.boundary_dim.size() != n_boundary || p.boundary_entity.size() != n_boundary ||
      p.boundary_index.size() != n_boundary || p.inner_uv.size() != p.inner_xyz.size() ||
      p.inner_size.size() != p.inner_xyz.size() || p.corner_uv.size() != 3 * p.triangles.size() ||
      (!p.inner_previous.empty() && p.inner_previous.size() != p.inner_xyz.size()) ||
      (!p.triangle_previous.empty() && p.triangle_previous.size() != p.triangles.size()))
    throw_bad_patch(p.face, "has arrays of inconsistent lengths");
  const EdgeId n_edges = in.edges.n_edges();
  for (std::size_t i = 0; i < n_boundary; ++i) {
    const std::int32_t entity = p.boundary_entity[i], index = p.boundary_index[i];
    const bool on_vertex = p.boundary_dim[i] == static_cast<std::uint8_t>(EntityDim::kVertex);
    if (on_vertex ? entity < 0 || entity >= static_cast<std::int64_t>(in.vertex_xyz.size())
                  : entity < 0 || entity >= n_edges)
      throw_bad_patch(p.face, std::string("names ") + (on_vertex ? "vertex " : "edge ") + std::to_string(entity + 1) +
                                  ", which does not exist");
    if (!on_vertex && (p.boundary_dim[i] != static_cast<std::uint8_t>(EntityDim::kEdge) || index < 1 ||
                       index + 1 >= in.edges.n_nodes(entity)))
      throw_bad_patch(p.face, "names node " + std::to_string(index) + " of edge " + std::to_string(entity + 1) +
                                  ", which is not one of its inner nodes");
  }
  const auto n_nodes = static_cast<std::int64_t>(n_boundary + p.inner_xyz.size());
  for (const Triangle& t : p.triangles)
    for (const NodeId n : t.n)
      if (n < 0 || n >= n_nodes)
        throw_bad_patch(p.face, "has a triangle with node " + std::to_string(n) + " of " + std::to_string(n_nodes));
}

NodeId& boundary_number(NodeNumbers& numbers, const MergeInput& in, const FacePatch& p, std::int32_t i) {
  const std::int32_t entity = p.boundary_entity[i];
  if (p.boundary_dim[i] == static_cast<std::uint8_t>(EntityDim::kVertex)) return numbers.vertex[entity];
  return numbers.edge_node[in.edges.first_node(entity) + p.boundary_index[i]];
}

std::vector<std::uint8_t> used_nodes(const FacePatch& p) {
  std::vector<std::uint8_t> used(p.n_boundary + p.inner_xyz.size(), 0);
  for (const Triangle& t : p.triangles)
    for (const NodeId n : t.n) used[n] = 1;
  return used;
}

/// Marks the vertices and edge nodes that triangles use; counts nodes and triangles of the result.
NodeNumbers mark_used(const MergeInput& in, std::span<const FacePatch* const> patches, std::size_t& n_inner,
                      std::size_t& n_triangles) {
  NodeNumbers numbers;
  numbers.vertex.assign(in.vertex_xyz.size(), kNone);
  numbers.edge_node.assign(in.edges.node_xyz.size(), kNone);
  n_inner = n_triangles = 0;
  for (const FacePatch* p : patches) {
    require_valid(in, *p);
    const std::vector<std::uint8_t> used = used_nodes(*p);
    for (std::int32_t i = 0; i < p->n_boundary; ++i)
      if (used[i]) boundary_number(numbers, in, *p, i) = kUsed;
    n_inner += std::count(used.begin() + p->n_boundary, used.end(), 1);
    n_triangles += p->triangles.size();
  }
  return numbers;
}

/// Requested length at each vertex: from the edge of lowest id that ends there.
std::vector<double> vertex_sizes(const MergeInput& in) {
  std::vector<double> size(in.vertex_xyz.size(), 0);
  for (EdgeId e = 0; e < in.edges.n_edges(); ++e) {
    const IdRange nodes = in.edges.nodes(e);
    if (nodes.empty()) continue;
    for (int k = 0; k < 2; ++k)
      if (double& s = size[in.edge_vertices[2 * e + k]]; s == 0)
        s = in.edges.requests()[k ? nodes.first() + nodes.size() - 1 : nodes.first()];
  }
  return size;
}

void append_node(SurfaceMesh& mesh, Vec3 xyz, EntityDim dim, std::int32_t entity, double t, double size) {
  mesh.node_xyz.push_back(xyz);
  mesh.node_entity_dim.push_back(static_cast<std::uint8_t>(dim));
  mesh.node_entity.push_back(entity);
  mesh.node_t.push_back(t);
  mesh.node_size.push_back(size);
}

/// Numbers and appends the used vertices, then the used nodes of the edges.
void append_boundary_nodes(const MergeInput& in, NodeNumbers& numbers, SurfaceMesh& mesh) {
  const std::vector<double> size = vertex_sizes(in);
  const auto number = [&](NodeId& n) {
    if (n == kNone) return false;
    n = static_cast<NodeId>(mesh.node_xyz.size());
    return true;
  };
  for (std::size_t v = 0; v < numbers.vertex.size(); ++v)
    if (number(numbers.vertex[v]))
      append_node(mesh, in.vertex_xyz[v], EntityDim::kVertex, static_cast<std::int32_t>(v), 0, size[v]);
  for (EdgeId e = 0; e < in.edges.n_edges(); ++e)
    for (const std::int32_t i : in.edges.nodes(e))
      if (number(numbers.edge_node[i]))
        append_node(mesh, in.edges.node_xyz[i], EntityDim::kEdge, e, in.edges.node_t[i], in.edges.requests()[i]);
}

/// Appends the inner nodes and the triangles of one face.
void append_patch(const MergeInput& in, const FacePatch& p, NodeNumbers& numbers, SurfaceMesh& mesh) {
  const std::vector<std::uint8_t> used = used_nodes(p);
  std::vector<NodeId> patch_to_mesh(used.size(), kNone);
  for (std::int32_t i = 0; i < p.n_boundary; ++i) patch_to_mesh[i] = boundary_number(numbers, in, p, i);
  for (std::size_t i = 0; i < p.inner_xyz.size(); ++i) {
    if (!used[p.n_boundary + i]) continue;
    patch_to_mesh[p.n_boundary + i] = static_cast<NodeId>(mesh.node_xyz.size());
    append_node(mesh, p.inner_xyz[i], EntityDim::kFace, p.face, 0, p.inner_size[i]);
  }
  for (const Triangle& t : p.triangles)
    mesh.triangles.push_back({{patch_to_mesh[t.n[0]], patch_to_mesh[t.n[1]], patch_to_mesh[t.n[2]]}});
  mesh.corner_uv.insert(mesh.corner_uv.end(), p.corner_uv.begin(), p.corner_uv.end());
  const bool has_group = static_cast<std::size_t>(p.face) < in.face_group.size();
  mesh.triangle_face.insert(mesh.triangle_face.end(), p.triangles.size(), p.face);
  mesh.triangle_group.insert(mesh.triangle_group.end(), p.triangles.size(), has_group ? in.face_group[p.face] : 0);
}

/// Numbers in the mesh that a remeshing started from, in the order of append_*; nothing when no patch has them.
void append_previous(const MergeInput& in, std::span<const FacePatch* const> patches, const NodeNumbers& numbers,
                     SurfaceMesh& mesh) {
  if (in.edges.node_previous.empty()) return;
  mesh.node_previous.assign(mesh.node_xyz.size(), kNone);
  for (EdgeId e = 0; e < in.edges.n_edges(); ++e)
    for (const std::int32_t i : in.edges.nodes(e)) {
      const bool is_first = i == in.edges.first_node(e),
                 is_last = i + 1 == in.edges.first_node(e) + in.edges.n_nodes(e);
      const NodeId n =
          is_first || is_last ? numbers.vertex[in.edge_vertices[2 * e + (is_first ? 0 : 1)]] : numbers.edge_node[i];
      if (n != kNone) mesh.node_previous[n] = in.edges.node_previous[i];
    }
  NodeId n =
      std::count_if(mesh.node_entity_dim.begin(), mesh.node_entity_dim.end(), [](std::uint8_t d) { return d < 2; });
  for (const FacePatch* p : patches) {
    const std::vector<std::uint8_t> used = used_nodes(*p);
    for (std::size_t i = 0; i < p->inner_xyz.size(); ++i)
      if (used[p->n_boundary + i]) mesh.node_previous[n++] = p->inner_previous.empty() ? kNone : p->inner_previous[i];
    if (p->triangle_previous.empty())
      mesh.triangle_previous.insert(mesh.triangle_previous.end(), p->triangles.size(), kNone);
    else
      mesh.triangle_previous.insert(mesh.triangle_previous.end(), p->triangle_previous.begin(),
                                    p->triangle_previous.end());
  }
}

void reserve(SurfaceMesh& mesh, std::size_t n_nodes, std::size_t n_triangles) {
  mesh.node_xyz.reserve(n_nodes);
  mesh.node_entity_dim.reserve(n_nodes);
  mesh.node_entity.reserve(n_nodes);
  mesh.node_t.reserve(n_nodes);
  mesh.node_size.reserve(n_nodes);
  mesh.triangles.reserve(n_triangles);
  mesh.triangle_face.reserve(n_triangles);
  mesh.triangle_group.reserve(n_triangles);
  mesh.corner_uv.reserve(3 * n_triangles);
}

}  // namespace

SurfaceMesh merge_patches(const MergeInput& input, OrientationReport& report) {
  ST_ASSERT(2 * input.edges.edge_offsets.size() == input.edge_vertices.size() + 2);
  ST_ASSERT(std::is_sorted(input.edges.edge_offsets.begin(), input.edges.edge_offsets.end()));
  const std::vector<const FacePatch*> patches = patches_by_face(input.patches);
  std::size_t n_inner = 0, n_triangles = 0;
  NodeNumbers numbers = mark_used(input, patches, n_inner, n_triangles);
  const auto n_used = [](const std::vector<NodeId>& v) { return v.size() - std::count(v.begin(), v.end(), kNone); };
  const std::size_t n_nodes = n_used(numbers.vertex) + n_used(numbers.edge_node) + n_inner;
  require_countable(n_nodes, "nodes of the merged mesh");
  require_countable(n_triangles, "triangles of the merged mesh", kMaxTriangles);
  SurfaceMesh mesh;
  reserve(mesh, n_nodes, n_triangles);
  append_boundary_nodes(input, numbers, mesh);
  for (const FacePatch* p : patches) append_patch(input, *p, numbers, mesh);
  append_previous(input, patches, numbers, mesh);
  report = orient_outward(mesh);
  return mesh;
}

}  // namespace st
