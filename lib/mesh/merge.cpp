#include "mesh/merge.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "base/assert.h"
#include "base/error.h"
#include "base/limits.h"
#include "base/sort_once.h"
#include "base/threads.h"
#include "mesh/corner_uv.h"

namespace st {

namespace {

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
      p.inner_size.size() != p.inner_xyz.size() ||
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
  if (!has_all_uv(p)) throw_bad_patch(p.face, "lacks the (u,v) of corners on its boundary");
}

/// Nodes of a patch that its triangles have, ascending.
struct UsedNodes {
  std::vector<std::int32_t> boundary;  // of the patch's boundary nodes
  std::vector<std::int32_t> inner;     // places in inner_*
};

UsedNodes used_nodes(const FacePatch& p) {
  std::vector<char> is_used(p.n_boundary + p.inner_xyz.size(), 0);
  for (const Triangle& t : p.triangles)
    for (const NodeId n : t.n) is_used[n] = 1;
  UsedNodes used;
  used.inner.reserve(p.inner_xyz.size());
  for (std::int32_t i = 0; i < p.n_boundary; ++i)
    if (is_used[i]) used.boundary.push_back(i);
  for (std::size_t i = 0; i < p.inner_xyz.size(); ++i)
    if (is_used[p.n_boundary + i]) used.inner.push_back(static_cast<std::int32_t>(i));
  return used;
}

/// What is inside patch i, and its triangles, in their places.
void place_patch(const EdgeMesh& edges, std::size_t n_vertices, const FacePatch& p, const UsedNodes& used,
                 std::size_t i, WeldedPatches& welded) {
  constexpr std::size_t kPerPiece = 65'536;
  std::vector<NodeId> number(p.n_boundary + p.inner_xyz.size(), kNone);
  for (const std::int32_t n : used.boundary)
    number[n] = welded.boundary[boundary_id_of(static_cast<VertexId>(n_vertices), edges, p, n)];
  const std::int32_t begin = welded.inner_begin[i];
  for (std::size_t k = 0; k < used.inner.size(); ++k) {
    const NodeId n = welded.n_boundary + begin + static_cast<NodeId>(k);
    number[p.n_boundary + used.inner[k]] = n;
    welded.points[n] = p.inner_xyz[used.inner[k]];
    welded.inner[begin + k] = used.inner[k];
  }
  Triangle* const triangles = welded.triangles.data() + welded.patch_begin[i];
  parallel_for(p.triangles.size(), kPerPiece, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t)
      for (int k = 0; k < 3; ++k) triangles[t].n[k] = number[p.triangles[t].n[k]];
  });
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

/// What the mesh says of the inner nodes and the triangles of one face. `inner`: its inner nodes that are in the mesh.
void describe_patch(const MergeInput& in, const FacePatch& p, std::span<const std::int32_t> inner, SurfaceMesh& mesh) {
  for (const std::int32_t i : inner) describe_node(mesh, EntityDim::kFace, p.face, 0, p.inner_size[i]);
  const std::vector<Vec2> uv = corner_uvs(p);
  mesh.corner_uv.insert(mesh.corner_uv.end(), uv.begin(), uv.end());
  const bool has_group = static_cast<std::size_t>(p.face) < in.face_group.size();
  mesh.triangle_face.insert(mesh.triangle_face.end(), p.triangles.size(), p.face);
  mesh.triangle_group.insert(mesh.triangle_group.end(), p.triangles.size(), has_group ? in.face_group[p.face] : 0);
}

/// Numbers of inner nodes and triangles in the mesh that a remeshing started from.
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

void reserve_previous(SurfaceMesh& mesh, std::size_t n_nodes, std::size_t n_triangles) {
  mesh.node_previous.reserve(n_nodes);
  mesh.triangle_previous.reserve(n_triangles);
}

/// Index on its edge of each node on one; nodes on vertices: 0.
std::vector<std::int32_t> boundary_indices(const SurfaceMesh& mesh, const EdgeMesh& edges) {
  std::vector<std::int32_t> index;
  const auto is_on = [&](std::size_t n, EntityDim dim) {
    return n < mesh.node_xyz.size() && mesh.node_entity_dim[n] == static_cast<std::uint8_t>(dim);
  };
  while (is_on(index.size(), EntityDim::kVertex)) index.push_back(0);
  for (std::size_t n = index.size(); is_on(n, EntityDim::kEdge); ++n) {
    const EdgeId e = mesh.node_entity[n];
    const auto t = edges.node_t.begin() + edges.first_node(e);
    index.push_back(static_cast<std::int32_t>(std::lower_bound(t, t + edges.n_nodes(e), mesh.node_t[n]) - t));
  }
  return index;
}

/// What of a mesh belongs to one face.
struct FaceRange {
  FaceId face;
  TriangleId begin, end;
  NodeId first, last;  // inner nodes
};

/// Nodes on the boundary of the face, ascending.
std::vector<NodeId> boundary_nodes(const SurfaceMesh& mesh, const FaceRange& r) {
  std::vector<NodeId> nodes;
  for (TriangleId i = r.begin; i < r.end; ++i)
    for (const NodeId n : mesh.triangles[i].n)
      if (n < r.first) nodes.push_back(n);
  sort_once(nodes);
  return nodes;
}

/// Nodes of the face's triangles are inside it or on edges and vertices, as split_patches() relies on.
void require_own_nodes(const SurfaceMesh& mesh, const FaceRange& r, std::size_t n_boundary) {
  for (TriangleId i = r.begin; i < r.end; ++i)
    for (const NodeId n : mesh.triangles[i].n)
      if (static_cast<std::size_t>(n) >= n_boundary && (n < r.first || n >= r.last))
        throw Error(ExitCode::kInput, "triangle " + std::to_string(i + 1) + " of face " + std::to_string(r.face + 1) +
                                          " has a node inside another face; the mesh is damaged: make it again");
}

FacePatch patch_of(const SurfaceMesh& mesh, const FaceRange& r, const std::vector<std::int32_t>& index) {
  require_own_nodes(mesh, r, index.size());
  const auto part = [](auto& to, const auto& from, std::size_t begin, std::size_t end) {
    if (!from.empty()) to.assign(from.begin() + begin, from.begin() + end);
  };
  FacePatch p;
  p.face = r.face;
  const std::vector<NodeId> boundary = boundary_nodes(mesh, r);
  p.n_boundary = static_cast<std::int32_t>(boundary.size());
  for (const NodeId n : boundary) {
    p.boundary_dim.push_back(mesh.node_entity_dim[n]);
    p.boundary_entity.push_back(mesh.node_entity[n]);
    p.boundary_index.push_back(index[n]);
  }
  part(p.inner_xyz, mesh.node_xyz, r.first, r.last);
  part(p.inner_size, mesh.node_size, r.first, r.last);
  part(p.inner_previous, mesh.node_previous, r.first, r.last);
  part(p.triangles, mesh.triangles, r.begin, r.end);
  part(p.triangle_previous, mesh.triangle_previous, r.begin, r.end);
  const std::span<const Vec2> uv = std::span(mesh.corner_uv).subspan(3 * std::size_t(r.begin), 3 * p.triangles.size());
  p.inner_uv.resize(p.inner_xyz.size());
  for (std::size_t corner = 0; corner < uv.size(); ++corner) {
    NodeId& n = p.triangles[corner / 3].n[corner % 3];
    if (n >= r.first) p.inner_uv[n - r.first] = uv[corner];
    n = n >= r.first ? p.n_boundary + n - r.first
                     : static_cast<NodeId>(std::lower_bound(boundary.begin(), boundary.end(), n) - boundary.begin());
  }
  set_corner_uvs(uv, p);
  return p;
}

}  // namespace

Welder::Welder(const EdgeMesh& edges, std::span<const Vec3> vertex_xyz) : edges_(edges), vertex_xyz_(vertex_xyz) {
  welded_.boundary.assign(vertex_xyz.size() + edges.node_xyz.size(), kNone);
  welded_.patch_begin.push_back(0);
  welded_.inner_begin.push_back(0);
}

std::int32_t boundary_id_of(VertexId n_vertices, const EdgeMesh& edges, const FacePatch& p, std::int32_t i) {
  const std::int32_t entity = p.boundary_entity[i];
  if (p.boundary_dim[i] == static_cast<std::uint8_t>(EntityDim::kVertex)) return entity;
  return boundary_id(n_vertices, edges, entity, p.boundary_index[i]);
}

std::int32_t Welder::id_of(const FacePatch& p, std::int32_t i) const {
  return boundary_id_of(static_cast<VertexId>(vertex_xyz_.size()), edges_, p, i);
}

void Welder::number_boundary(std::size_t n_inner, std::size_t n_triangles) {
  std::vector<NodeId>& number = welded_.boundary;
  const std::size_t n_unused = std::count(number.begin(), number.end(), kNone),
                    n_nodes = number.size() - n_unused + n_inner;
  require_countable(n_nodes, "nodes of all patches");
  require_countable(n_triangles, "triangles of all patches", kMaxTriangles);
  welded_.points.reserve(n_nodes);
  welded_.triangles.reserve(n_triangles);
  for (std::size_t i = 0; i < number.size(); ++i)
    if (number[i] != kNone)
      number[i] = add_point(i < vertex_xyz_.size() ? vertex_xyz_[i] : edges_.node_xyz[i - vertex_xyz_.size()]);
  welded_.n_boundary = static_cast<NodeId>(welded_.points.size());
}

void describe_node(SurfaceMesh& mesh, EntityDim dim, std::int32_t entity, double t, double size) {
  mesh.node_entity_dim.push_back(static_cast<std::uint8_t>(dim));
  mesh.node_entity.push_back(entity);
  mesh.node_t.push_back(t);
  mesh.node_size.push_back(size);
}

WeldedPatches weld_patches(const EdgeMesh& edges, std::span<const Vec3> vertex_xyz,
                           std::span<const FacePatch* const> patches) {
  ST_ASSERT(std::is_sorted(edges.edge_offsets.begin(), edges.edge_offsets.end()));
  Welder welder(edges, vertex_xyz);
  std::vector<UsedNodes> used(patches.size());
  parallel_for(patches.size(), 1, [&](std::size_t i, std::size_t) {
    require_valid(edges, vertex_xyz.size(), *patches[i]);
    used[i] = used_nodes(*patches[i]);
  });
  std::size_t n_inner = 0, n_triangles = 0;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    for (const std::int32_t n : used[i].boundary) welder.use(welder.id_of(*patches[i], n));
    n_inner += used[i].inner.size();
    n_triangles += patches[i]->triangles.size();
  }
  welder.number_boundary(n_inner, n_triangles);
  WeldedPatches welded = welder.take();
  for (std::size_t i = 0; i < patches.size(); ++i) {
    welded.patch_begin.push_back(welded.patch_begin.back() + static_cast<TriangleId>(patches[i]->triangles.size()));
    welded.inner_begin.push_back(welded.inner_begin.back() + static_cast<std::int32_t>(used[i].inner.size()));
  }
  welded.points.resize(static_cast<std::size_t>(welded.n_boundary) + n_inner);
  welded.triangles.resize(n_triangles);
  welded.inner.resize(n_inner);
  parallel_for(patches.size(), 1, [&](std::size_t i, std::size_t) {
    place_patch(edges, vertex_xyz.size(), *patches[i], used[i], i, welded);
  });
  return welded;
}

SurfaceMesh describe_boundary(const MergeInput& in, const WeldedPatches& w) {
  SurfaceMesh mesh;
  reserve(mesh, w.points.capacity(), w.triangles.capacity());
  const std::vector<double> size = vertex_sizes(in);
  const auto n_vertices = static_cast<VertexId>(in.vertex_xyz.size());
  for (VertexId v = 0; v < n_vertices; ++v)
    if (w.boundary[v] != kNone) describe_node(mesh, EntityDim::kVertex, v, 0, size[v]);
  for (EdgeId e = 0; e < in.edges.n_edges(); ++e)
    for (const std::int32_t i : in.edges.nodes(e))
      if (w.boundary[n_vertices + i] != kNone)
        describe_node(mesh, EntityDim::kEdge, e, in.edges.node_t[i], in.edges.requests()[i]);
  if (in.edges.node_previous.empty()) return mesh;
  reserve_previous(mesh, w.points.capacity(), w.triangles.capacity());
  mesh.node_previous.assign(w.n_boundary, kNone);
  for (EdgeId e = 0; e < in.edges.n_edges(); ++e)
    for (const std::int32_t i : in.edges.nodes(e)) {
      const IdRange nodes = in.edges.nodes(e);
      const bool is_first = i == nodes.first(), is_last = i + 1 == nodes.first() + nodes.size();
      const NodeId n = w.boundary[is_first || is_last ? in.edge_vertices[2 * e + (is_first ? 0 : 1)] : n_vertices + i];
      if (n != kNone) mesh.node_previous[n] = in.edges.node_previous[i];
    }
  return mesh;
}

std::vector<FacePatch> split_patches(const SurfaceMesh& mesh, const EdgeMesh& edges, FaceId n_faces) {
  const std::vector<std::int32_t> index = boundary_indices(mesh, edges);
  const auto n_triangles = static_cast<TriangleId>(mesh.triangles.size());
  std::vector<FacePatch> patches;
  FaceRange r{0, 0, 0, static_cast<NodeId>(index.size()), static_cast<NodeId>(index.size())};
  for (; r.face < n_faces; ++r.face, r.begin = r.end, r.first = r.last) {
    while (r.end < n_triangles && mesh.triangle_face[r.end] == r.face) ++r.end;
    while (r.last < mesh.n_nodes() && mesh.node_entity[r.last] == r.face) ++r.last;
    patches.push_back(patch_of(mesh, r, index));
  }
  return patches;
}

SurfaceMesh merge_patches(const MergeInput& input, OrientationReport& report) {
  ST_ASSERT(2 * input.edges.edge_offsets.size() == input.edge_vertices.size() + 2);
  const std::vector<const FacePatch*> patches = patches_by_face(input.patches);
  WeldedPatches welded = weld_patches(input.edges, input.vertex_xyz, patches);
  const bool has_previous = !input.edges.node_previous.empty();
  SurfaceMesh mesh = describe_boundary(input, welded);
  mesh.node_xyz = std::move(welded.points);
  mesh.triangles = std::move(welded.triangles);
  if (has_previous) mesh.node_previous.resize(mesh.node_xyz.size(), kNone);
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
