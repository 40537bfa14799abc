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

void require_valid(const EdgeMesh& edges, std::size_t n_vertices, const FacePatch& p) {
  const auto n_boundary = static_cast<std::size_t>(p.n_boundary);
  if (p.n_boundary < 0 || p.boundary_dim.size() != n_boundary || p.boundary_entity.size() != n_boundary ||
      p.boundary_index.size() != n_boundary || p.inner_uv.size() != p.inner_xyz.size() ||
      p.inner_size.size() != p.inner_xyz.size() || p.corner_uv.size() != 3 * p.triangles.size() ||
      (!p.inner_previous.empty() && p.inner_previous.size() != p.inner_xyz.size()) ||
      (!p.triangle_previous.empty() && p.triangle_previous.size() != p.triangles.size()))
    throw_bad_patch(p.face, "has arrays of inconsistent lengths");
  const EdgeId n_edges = edges.n_edges();
  for (std::size_t i = 0; i < n_boundary; ++i) {
    const std::int32_t entity = p.boundary_entity[i], index = p.boundary_index[i];
    const bool on_vertex = p.boundary_dim[i] == static_cast<std::uint8_t>(EntityDim::kVertex);
    if (on_vertex ? entity < 0 || entity >= static_cast<std::int64_t>(n_vertices) : entity < 0 || entity >= n_edges)
      throw_bad_patch(p.face, std::string("names ") + (on_vertex ? "vertex " : "edge ") + std::to_string(entity + 1) +
                                  ", which does not exist");
    if (!on_vertex && (p.boundary_dim[i] != static_cast<std::uint8_t>(EntityDim::kEdge) || index < 1 ||
                       index + 1 >= edges.n_nodes(entity)))
      throw_bad_patch(p.face, "names node " + std::to_string(index) + " of edge " + std::to_string(entity + 1) +
                                  ", which is not one of its inner nodes");
  }
  const auto n_nodes = static_cast<std::int64_t>(n_boundary + p.inner_xyz.size());
  for (const Triangle& t : p.triangles)
    for (const NodeId n : t.n)
      if (n < 0 || n >= n_nodes)
        throw_bad_patch(p.face, "has a triangle with node " + std::to_string(n) + " of " + std::to_string(n_nodes));
}

std::vector<std::uint8_t> used_nodes(const FacePatch& p) {
  std::vector<std::uint8_t> used(p.n_boundary + p.inner_xyz.size(), 0);
  for (const Triangle& t : p.triangles)
    for (const NodeId n : t.n) used[n] = 1;
  return used;
}

class Welder {
 public:
  Welder(const EdgeMesh& edges, std::span<const Vec3> vertex_xyz, std::span<const FacePatch* const> patches)
      : edges_(edges), vertex_xyz_(vertex_xyz), patches_(patches) {}

  WeldedPatches run() {
    mark_used();
    number_boundary();
    welded_.patch_begin.push_back(0);
    welded_.inner_begin.push_back(0);
    for (const FacePatch* p : patches_) append(*p);
    return std::move(welded_);
  }

 private:
  NodeId& boundary_number(const FacePatch& p, std::int32_t i) {
    const std::int32_t entity = p.boundary_entity[i];
    if (p.boundary_dim[i] == static_cast<std::uint8_t>(EntityDim::kVertex)) return welded_.vertex[entity];
    return welded_.edge_node[edges_.first_node(entity) + p.boundary_index[i]];
  }

  /// Marks the vertices and edge nodes that triangles use; makes room for the nodes and triangles of all.
  void mark_used() {
    welded_.vertex.assign(vertex_xyz_.size(), kNone);
    welded_.edge_node.assign(edges_.node_xyz.size(), kNone);
    std::size_t n_inner = 0, n_triangles = 0;
    for (const FacePatch* p : patches_) {
      require_valid(edges_, vertex_xyz_.size(), *p);
      const std::vector<std::uint8_t> used = used_nodes(*p);
      for (std::int32_t i = 0; i < p->n_boundary; ++i)
        if (used[i]) boundary_number(*p, i) = kUsed;
      n_inner += std::count(used.begin() + p->n_boundary, used.end(), 1);
      n_triangles += p->triangles.size();
    }
    const auto n_used = [](const std::vector<NodeId>& v) { return std::count(v.begin(), v.end(), kUsed); };
    const std::size_t n_nodes = n_used(welded_.vertex) + n_used(welded_.edge_node) + n_inner;
    require_countable(n_nodes, "nodes of all patches");
    require_countable(n_triangles, "triangles of all patches", kMaxTriangles);
    welded_.points.reserve(n_nodes);
    welded_.inner.reserve(n_inner);
    welded_.triangles.reserve(n_triangles);
  }

  NodeId add_point(Vec3 x) {
    welded_.points.push_back(x);
    return static_cast<NodeId>(welded_.points.size()) - 1;
  }

  void number_boundary() {
    for (std::size_t v = 0; v < welded_.vertex.size(); ++v)
      if (welded_.vertex[v] != kNone) welded_.vertex[v] = add_point(vertex_xyz_[v]);
    for (std::size_t i = 0; i < welded_.edge_node.size(); ++i)
      if (welded_.edge_node[i] != kNone) welded_.edge_node[i] = add_point(edges_.node_xyz[i]);
    welded_.n_boundary = static_cast<NodeId>(welded_.points.size());
  }

  void append(const FacePatch& p) {
    const std::vector<std::uint8_t> used = used_nodes(p);
    std::vector<NodeId> number(used.size(), kNone);
    for (std::int32_t i = 0; i < p.n_boundary; ++i) number[i] = boundary_number(p, i);
    for (std::size_t i = 0; i < p.inner_xyz.size(); ++i) {
      if (!used[p.n_boundary + i]) continue;
      number[p.n_boundary + i] = add_point(p.inner_xyz[i]);
      welded_.inner.push_back(static_cast<std::int32_t>(i));
    }
    for (const Triangle& t : p.triangles)
      welded_.triangles.push_back({{number[t.n[0]], number[t.n[1]], number[t.n[2]]}});
    welded_.patch_begin.push_back(static_cast<TriangleId>(welded_.triangles.size()));
    welded_.inner_begin.push_back(static_cast<NodeId>(welded_.inner.size()));
  }

  const EdgeMesh& edges_;
  std::span<const Vec3> vertex_xyz_;
  std::span<const FacePatch* const> patches_;
  WeldedPatches welded_;
};

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

void describe_node(SurfaceMesh& mesh, EntityDim dim, std::int32_t entity, double t, double size) {
  mesh.node_entity_dim.push_back(static_cast<std::uint8_t>(dim));
  mesh.node_entity.push_back(entity);
  mesh.node_t.push_back(t);
  mesh.node_size.push_back(size);
}

/// What the mesh says of its nodes on vertices and edges.
void describe_boundary_nodes(const MergeInput& in, const WeldedPatches& w, SurfaceMesh& mesh) {
  const std::vector<double> size = vertex_sizes(in);
  for (std::size_t v = 0; v < w.vertex.size(); ++v)
    if (w.vertex[v] != kNone) describe_node(mesh, EntityDim::kVertex, static_cast<std::int32_t>(v), 0, size[v]);
  for (EdgeId e = 0; e < in.edges.n_edges(); ++e)
    for (const std::int32_t i : in.edges.nodes(e))
      if (w.edge_node[i] != kNone) describe_node(mesh, EntityDim::kEdge, e, in.edges.node_t[i], in.edges.requests()[i]);
}

/// Likewise of the inner nodes and the triangles of one face. `inner`: its inner nodes that are in the mesh.
void describe_patch(const MergeInput& in, const FacePatch& p, std::span<const std::int32_t> inner, SurfaceMesh& mesh) {
  for (const std::int32_t i : inner) describe_node(mesh, EntityDim::kFace, p.face, 0, p.inner_size[i]);
  mesh.corner_uv.insert(mesh.corner_uv.end(), p.corner_uv.begin(), p.corner_uv.end());
  const bool has_group = static_cast<std::size_t>(p.face) < in.face_group.size();
  mesh.triangle_face.insert(mesh.triangle_face.end(), p.triangles.size(), p.face);
  mesh.triangle_group.insert(mesh.triangle_group.end(), p.triangles.size(), has_group ? in.face_group[p.face] : 0);
}

/// Numbers of boundary nodes in the mesh that a remeshing started from.
void add_previous_of_edges(const MergeInput& in, const WeldedPatches& w, SurfaceMesh& mesh) {
  for (EdgeId e = 0; e < in.edges.n_edges(); ++e)
    for (const std::int32_t i : in.edges.nodes(e)) {
      const bool is_first = i == in.edges.first_node(e),
                 is_last = i + 1 == in.edges.first_node(e) + in.edges.n_nodes(e);
      const NodeId n = is_first || is_last ? w.vertex[in.edge_vertices[2 * e + (is_first ? 0 : 1)]] : w.edge_node[i];
      if (n != kNone) mesh.node_previous[n] = in.edges.node_previous[i];
    }
}

/// Likewise of inner nodes and triangles.
void add_previous_of_patch(const FacePatch& p, std::span<const std::int32_t> inner, NodeId first, SurfaceMesh& mesh) {
  for (std::size_t k = 0; k < inner.size() && !p.inner_previous.empty(); ++k)
    mesh.node_previous[first + k] = p.inner_previous[inner[k]];
  if (p.triangle_previous.empty())
    mesh.triangle_previous.insert(mesh.triangle_previous.end(), p.triangles.size(), kNone);
  else
    mesh.triangle_previous.insert(mesh.triangle_previous.end(), p.triangle_previous.begin(), p.triangle_previous.end());
}

void reserve(SurfaceMesh& mesh, std::size_t n_nodes, std::size_t n_triangles) {
  mesh.node_entity_dim.reserve(n_nodes);
  mesh.node_entity.reserve(n_nodes);
  mesh.node_t.reserve(n_nodes);
  mesh.node_size.reserve(n_nodes);
  mesh.triangle_face.reserve(n_triangles);
  mesh.triangle_group.reserve(n_triangles);
  mesh.corner_uv.reserve(3 * n_triangles);
}

}  // namespace

WeldedPatches weld_patches(const EdgeMesh& edges, std::span<const Vec3> vertex_xyz,
                           std::span<const FacePatch* const> patches) {
  ST_ASSERT(std::is_sorted(edges.edge_offsets.begin(), edges.edge_offsets.end()));
  return Welder(edges, vertex_xyz, patches).run();
}

SurfaceMesh merge_patches(const MergeInput& input, OrientationReport& report) {
  ST_ASSERT(2 * input.edges.edge_offsets.size() == input.edge_vertices.size() + 2);
  const std::vector<const FacePatch*> patches = patches_by_face(input.patches);
  WeldedPatches welded = weld_patches(input.edges, input.vertex_xyz, patches);
  const bool has_previous = !input.edges.node_previous.empty();
  SurfaceMesh mesh;
  reserve(mesh, welded.points.size(), welded.triangles.size());
  describe_boundary_nodes(input, welded, mesh);
  mesh.node_xyz = std::move(welded.points);
  mesh.triangles = std::move(welded.triangles);
  if (has_previous) mesh.node_previous.assign(mesh.node_xyz.size(), kNone);
  if (has_previous) add_previous_of_edges(input, welded, mesh);
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const NodeId begin = welded.inner_begin[i], end = welded.inner_begin[i + 1];
    const std::span<const std::int32_t> inner(welded.inner.data() + begin, welded.inner.data() + end);
    describe_patch(input, *patches[i], inner, mesh);
    if (has_previous) add_previous_of_patch(*patches[i], inner, welded.n_boundary + begin, mesh);
  }
  report = orient_outward(mesh);
  return mesh;
}

}  // namespace st
