#include "meshing/engine/joined_patches.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <utility>

#include "base/limits.h"

namespace st {

FaceId JoinedPatches::face_of(TriangleId t) const {
  return static_cast<FaceId>(std::upper_bound(face_begin.begin(), face_begin.end(), t) - face_begin.begin()) - 1;
}

RefinementPoint JoinedPatches::refinement_of(TriangleId t) const {
  const Vec3 a = points[triangles[t].n[0]], b = points[triangles[t].n[1]], c = points[triangles[t].n[2]];
  const auto [shortest, longest] = std::minmax({distance(a, b), distance(b, c), distance(c, a)});
  const bool spans_face = std::max({triangles[t].n[0], triangles[t].n[1], triangles[t].n[2]}) < n_boundary;
  return {(a + b + c) / 3, 0.5 * (spans_face ? std::max(shortest, 0.5 * longest) : longest)};
}

JoinedPatches join_patches(const BoundaryNumbering& numbering, const std::vector<FacePatch>& patches) {
  JoinedPatches m;
  const ModelTables& t = numbering.tables;
  const EdgeMesh& edges = numbering.edges;
  std::size_t n_points = numbering.first_inner.back(), n_triangles = 0;
  for (const FacePatch& p : patches) n_points += p.inner_xyz.size(), n_triangles += p.triangles.size();
  require_countable(n_points, "nodes of all patches");
  require_countable(n_triangles, "triangles of all patches", kMaxTriangles);
  m.points.reserve(n_points);
  m.triangles.reserve(n_triangles);
  m.n_boundary = numbering.first_inner.back();
  m.points.assign(t.vertex_xyz.begin(), t.vertex_xyz.end());
  m.points.resize(numbering.first_inner.back());
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    for (std::int32_t i = 1; i + 1 < edges.n_nodes(e); ++i)
      m.points[numbering.first_inner[e] + i - 1] = edges.node_xyz[edges.first_node(e) + i];
  m.face_begin.push_back(0);
  std::vector<std::int32_t> number;
  for (const FacePatch& p : patches) {
    number.resize(p.n_boundary);
    for (std::int32_t i = 0; i < p.n_boundary; ++i)
      number[i] = p.boundary_dim[i] == 0 ? p.boundary_entity[i]
                                         : numbering.edge_node(p.boundary_entity[i], p.boundary_index[i]);
    const std::int32_t first_inner = static_cast<std::int32_t>(m.points.size()) - p.n_boundary;
    const auto id = [&](NodeId n) { return n < p.n_boundary ? number[n] : first_inner + n; };
    for (const Triangle& tri : p.triangles) m.triangles.push_back({{id(tri.n[0]), id(tri.n[1]), id(tri.n[2])}});
    m.points.insert(m.points.end(), p.inner_xyz.begin(), p.inner_xyz.end());
    m.face_begin.push_back(static_cast<std::int32_t>(m.triangles.size()));
  }
  return m;
}

namespace {

struct EdgeUse {
  NodeId a, b;  // a < b
  TriangleId triangle;
  auto operator<=>(const EdgeUse&) const = default;
};

/// Uses of edges between two nodes on boundaries, sorted.
std::vector<EdgeUse> uses_between_boundaries(const JoinedPatches& mesh) {
  std::vector<EdgeUse> uses;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(mesh.triangles[i].n[k], mesh.triangles[i].n[(k + 1) % 3]);
      if (b < mesh.n_boundary) uses.push_back({a, b, static_cast<TriangleId>(i)});
    }
  std::sort(uses.begin(), uses.end());
  return uses;
}

/// Segments of the CAD edges, sorted.
std::vector<std::pair<NodeId, NodeId>> boundary_segments(const BoundaryNumbering& numbering) {
  std::vector<std::pair<NodeId, NodeId>> segments;
  const EdgeMesh& edges = numbering.edges;
  for (EdgeId e = 0; e < numbering.tables.n_edges(); ++e)
    for (std::int32_t i = 1; i < edges.n_nodes(e); ++i)
      segments.push_back(std::minmax({numbering.edge_node(e, i - 1), numbering.edge_node(e, i)}));
  std::sort(segments.begin(), segments.end());
  return segments;
}

}  // namespace

std::vector<TrianglePair> find_repeated_chords(const BoundaryNumbering& numbering, const JoinedPatches& mesh,
                                               std::span<const char> face_is_fresh) {
  const std::vector<EdgeUse> uses = uses_between_boundaries(mesh);
  const auto segments = boundary_segments(numbering);
  std::vector<TrianglePair> pairs;
  for (std::size_t i = 0, j = 0; i < uses.size(); i = j) {
    while (j < uses.size() && uses[j].a == uses[i].a && uses[j].b == uses[i].b) ++j;
    const TriangleId first = uses[i].triangle, last = uses[j - 1].triangle;
    const FaceId f = mesh.face_of(first), g = mesh.face_of(last);
    if (j - i < 3 || f == g || !(face_is_fresh[f] || face_is_fresh[g])) continue;
    if (!std::binary_search(segments.begin(), segments.end(), std::pair{uses[i].a, uses[i].b}))
      pairs.push_back({first, last, 2});
  }
  return pairs;
}

}  // namespace st
