#include "mesh/merge.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <string>

#include "base/assert.h"
#include "base/error.h"
#include "base/limits.h"
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

/// What a mesh says of its nodes and triangles, beside their places.
void make_room(SurfaceMesh& mesh, bool has_previous) {
  const std::size_t n_nodes = mesh.node_xyz.size(), n_triangles = mesh.triangles.size();
  mesh.node_entity_dim.resize(n_nodes);
  mesh.node_entity.resize(n_nodes);
  mesh.node_t.resize(n_nodes, 0);
  mesh.node_size.resize(n_nodes);
  mesh.triangle_group.resize(n_triangles, 0);
  mesh.corner_uv.resize(3 * n_triangles);
  if (!has_previous) return;
  mesh.node_previous.resize(n_nodes, kNone);
  mesh.triangle_previous.resize(n_triangles, kNone);
}

}  // namespace

std::int32_t boundary_id_of(VertexId n_vertices, const EdgeMesh& edges, const FacePatch& p, std::int32_t i) {
  const std::int32_t entity = p.boundary_entity[i];
  if (p.boundary_dim[i] == static_cast<std::uint8_t>(EntityDim::kVertex)) return entity;
  return boundary_id(n_vertices, edges, entity, p.boundary_index[i]);
}

std::vector<std::uint8_t> used_nodes(const FacePatch& p) {
  std::vector<std::uint8_t> is_used(p.n_boundary + p.inner_xyz.size(), 0);
  for (const Triangle& t : p.triangles)
    for (const NodeId n : t.n) is_used[n] = 1;
  return is_used;
}

PatchUse use_of(const EdgeMesh& edges, VertexId n_vertices, const FacePatch& p) {
  const std::vector<std::uint8_t> is_used = used_nodes(p);
  PatchUse use{
      {}, std::count(is_used.begin() + p.n_boundary, is_used.end(), 1), static_cast<std::int64_t>(p.triangles.size())};
  for (std::int32_t i = 0; i < p.n_boundary; ++i)
    if (is_used[i]) use.boundary.push_back(boundary_id_of(n_vertices, edges, p, i));
  return use;
}

PatchNumbers PatchNumbers::of_sections(std::int32_t n_boundary, std::span<const std::int32_t> n_own) {
  PatchNumbers numbers(static_cast<std::size_t>(n_boundary));
  std::iota(numbers.boundary.begin(), numbers.boundary.end(), 0);
  numbers.inner_begin = {n_boundary};
  for (const std::int32_t n : n_own) numbers.inner_begin.push_back(numbers.inner_begin.back() + n);
  return numbers;
}

void PatchNumbers::add(const PatchUse& use) {
  for (const std::int32_t id : use.boundary) {
    ST_ASSERT(id >= 0 && id < static_cast<std::int64_t>(boundary.size()));
    boundary[id] = 0;
  }
  const std::int64_t n_inner = inner_begin.back() + use.n_inner, n_all = triangle_begin.back() + use.n_triangles;
  require_countable(n_inner + static_cast<std::int64_t>(boundary.size()), "nodes of all patches");
  require_countable(n_all, "triangles of all patches", kMaxTriangles);
  inner_begin.push_back(static_cast<NodeId>(n_inner));
  triangle_begin.push_back(static_cast<TriangleId>(n_all));
}

void PatchNumbers::number() {
  NodeId n = 0;
  for (NodeId& own : boundary)
    if (own != kNone) own = n++;
  for (NodeId& begin : inner_begin) begin += n;
}

std::vector<NodeId> PatchNumbers::of_patch(const EdgeMesh& edges, const FacePatch& shape, std::size_t i) const {
  const auto n_vertices = static_cast<VertexId>(boundary.size() - edges.node_xyz.size());
  std::vector<NodeId> number(shape.n_boundary + shape.inner_xyz.size(), kNone);
  for (std::int32_t n = 0; n < shape.n_boundary; ++n) number[n] = boundary[boundary_id_of(n_vertices, edges, shape, n)];
  NodeId next = inner_begin[i];
  const bool has_all = inner_begin[i + 1] - next == std::ssize(shape.inner_xyz);
  const std::vector<std::uint8_t> is_used = has_all ? std::vector<std::uint8_t>() : used_nodes(shape);
  for (std::size_t n = shape.n_boundary; n < number.size(); ++n)
    if (has_all || is_used[n]) number[n] = next++;
  return number;
}

std::vector<NodeId> PatchNumbers::of_piece(std::size_t i, std::span<const std::int32_t> ids, std::int32_t n_own,
                                           std::span<const InnerNode> owner) const {
  std::vector<NodeId> number(ids.size() + n_own + owner.size());
  auto at = std::ranges::transform(ids, number.begin(), [&](std::int32_t id) { return boundary[id]; }).out;
  std::iota(at, at + n_own, inner_begin[i]);
  std::ranges::transform(owner, at + n_own, [&](const InnerNode& n) { return inner_begin[n.section] + n.number; });
  return number;
}

void PatchNumbers::place_boundary(const EdgeMesh& edges, std::span<const Vec3> vertex_xyz,
                                  std::vector<Vec3>& node_xyz) const {
  for (std::size_t i = 0; i < boundary.size(); ++i)
    if (boundary[i] != kNone)
      node_xyz[boundary[i]] = i < vertex_xyz.size() ? vertex_xyz[i] : edges.node_xyz[i - vertex_xyz.size()];
}

SurfaceMesh PatchNumbers::make_mesh() const {
  SurfaceMesh mesh;
  mesh.node_xyz.resize(n_nodes());
  mesh.triangles.resize(n_triangles());
  mesh.triangle_face.resize(n_triangles());
  return mesh;
}

SurfaceMesh PatchNumbers::make_mesh(const EdgeMesh& edges, std::span<const Vec3> vertex_xyz) const {
  SurfaceMesh mesh = make_mesh();
  place_boundary(edges, vertex_xyz, mesh.node_xyz);
  return mesh;
}

void PatchNumbers::place_patch(const EdgeMesh& edges, const FacePatch& shape, std::size_t i, SurfaceMesh& mesh) const {
  const std::vector<NodeId> number = of_patch(edges, shape, i);
  for (std::size_t k = 0; k < shape.inner_xyz.size(); ++k)
    if (const NodeId n = number[shape.n_boundary + k]; n != kNone) mesh.node_xyz[n] = shape.inner_xyz[k];
  place_triangles(shape, i, number, mesh);
}

void PatchNumbers::place_triangles(const FacePatch& shape, std::size_t i, std::span<const NodeId> number,
                                   SurfaceMesh& mesh) const {
  constexpr std::size_t kPerPiece = 65'536;
  const TriangleId first = triangle_begin[i];
  std::fill_n(mesh.triangle_face.begin() + first, shape.triangles.size(), shape.face);
  parallel_for(shape.triangles.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t)
      for (int k = 0; k < 3; ++k) mesh.triangles[first + t].n[k] = number[shape.triangles[t].n[k]];
  });
}

WeldedPatches weld_patches(const EdgeMesh& edges, std::span<const Vec3> vertex_xyz,
                           std::span<const FacePatch* const> patches) {
  ST_ASSERT(std::is_sorted(edges.edge_offsets.begin(), edges.edge_offsets.end()));
  std::vector<PatchUse> uses(patches.size());
  parallel_for(patches.size(), 1, [&](std::size_t i, std::size_t) {
    require_valid(edges, vertex_xyz.size(), *patches[i]);
    uses[i] = use_of(edges, static_cast<VertexId>(vertex_xyz.size()), *patches[i]);
  });
  WeldedPatches welded{{}, PatchNumbers(edges, vertex_xyz.size())};
  auto& [mesh, numbers] = welded;
  for (const PatchUse& use : uses) numbers.add(use);
  numbers.number();
  mesh = numbers.make_mesh(edges, vertex_xyz);
  parallel_for(patches.size(), 1,
               [&](std::size_t i, std::size_t) { numbers.place_patch(edges, *patches[i], i, mesh); });
  return welded;
}

void describe_boundary(const MergeInput& in, const PatchNumbers& numbers, SurfaceMesh& mesh) {
  const bool has_previous = !in.edges.node_previous.empty();
  make_room(mesh, has_previous);
  const std::vector<NodeId>& number = numbers.boundary;
  const std::vector<double> size = vertex_sizes(in);
  const auto n_vertices = static_cast<VertexId>(in.vertex_xyz.size());
  const auto describe = [&](NodeId n, EntityDim dim, std::int32_t entity, double t, double h) {
    if (n == kNone) return;
    mesh.node_entity_dim[n] = static_cast<std::uint8_t>(dim);
    mesh.node_entity[n] = entity;
    mesh.node_t[n] = t;
    mesh.node_size[n] = h;
  };
  for (VertexId v = 0; v < n_vertices; ++v) describe(number[v], EntityDim::kVertex, v, 0, size[v]);
  for (EdgeId e = 0; e < in.edges.n_edges(); ++e)
    for (const std::int32_t i : in.edges.nodes(e)) {
      describe(number[n_vertices + i], EntityDim::kEdge, e, in.edges.node_t[i], in.edges.requests()[i]);
      if (!has_previous) continue;
      const IdRange nodes = in.edges.nodes(e);
      const bool is_first = i == nodes.first(), is_last = i + 1 == nodes.first() + nodes.size();
      const NodeId n = number[is_first || is_last ? in.edge_vertices[2 * e + (is_first ? 0 : 1)] : n_vertices + i];
      if (n != kNone) mesh.node_previous[n] = in.edges.node_previous[i];
    }
}

void describe_patch(const MergeInput& in, const PatchNumbers& numbers, const FacePatch& p, std::size_t i,
                    SurfaceMesh& mesh) {
  const NodeId first = numbers.inner_begin[i], end = numbers.inner_begin[i + 1];
  std::fill(mesh.node_entity_dim.begin() + first, mesh.node_entity_dim.begin() + end,
            static_cast<std::uint8_t>(EntityDim::kFace));
  std::fill(mesh.node_entity.begin() + first, mesh.node_entity.begin() + end, p.face);
  const std::vector<NodeId> number = numbers.of_patch(in.edges, p, i);
  for (std::size_t k = 0; k < p.inner_xyz.size(); ++k)
    if (const NodeId n = number[p.n_boundary + k]; n != kNone) {
      mesh.node_size[n] = p.inner_size[k];
      if (!mesh.node_previous.empty() && !p.inner_previous.empty()) mesh.node_previous[n] = p.inner_previous[k];
    }
  const TriangleId begin = numbers.triangle_begin[i];
  if (static_cast<std::size_t>(p.face) < in.face_group.size())
    std::fill_n(mesh.triangle_group.begin() + begin, p.triangles.size(), in.face_group[p.face]);
  std::ranges::copy(corner_uvs(p), mesh.corner_uv.begin() + 3 * static_cast<std::ptrdiff_t>(begin));
  if (!mesh.triangle_previous.empty()) std::ranges::copy(p.triangle_previous, mesh.triangle_previous.begin() + begin);
}

SurfaceMesh weld_mesh(const MergeInput& input) {
  ST_ASSERT(2 * input.edges.edge_offsets.size() == input.edge_vertices.size() + 2);
  const std::vector<const FacePatch*> patches = patches_by_face(input.patches);
  WeldedPatches welded = weld_patches(input.edges, input.vertex_xyz, patches);
  auto& [mesh, numbers] = welded;
  describe_boundary(input, numbers, mesh);
  parallel_for(patches.size(), 1, [&, &m = mesh, &all = numbers](std::size_t i, std::size_t) {
    describe_patch(input, all, *patches[i], i, m);
  });
  return std::move(mesh);
}

SurfaceMesh merge_patches(const MergeInput& input, OrientationReport& report) {
  SurfaceMesh mesh = weld_mesh(input);
  report = orient_outward(mesh);
  return mesh;
}

}  // namespace st
