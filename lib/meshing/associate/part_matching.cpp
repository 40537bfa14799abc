#include "meshing/associate/part_matching.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/disjoint_sets.h"
#include "mesh/adjacency.h"

namespace st {
namespace {

constexpr std::int32_t kMaxParts = 3000;  // beyond, all is one

struct Extent {
  Box3 box;
  double area = 0;
};

/// Connected component of each vertex: a face connects the vertices of all its edges.
std::vector<std::int32_t> vertex_components(const ModelTables& t, std::int32_t& n) {
  DisjointSets sets(t.n_vertices());
  std::vector<char> is_used(t.n_vertices(), 0);  // not by joined edges
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    VertexId first = kNone;
    for (const EdgeId e : t.edges_of(f)) is_used[t.edge_vertices[2 * e]] = is_used[t.edge_vertices[2 * e + 1]] = 1;
    for (const CoedgeId c : t.coedges(f))
      for (const VertexId v : {t.edge_vertices[2 * t.coedge_edge[c]], t.edge_vertices[2 * t.coedge_edge[c] + 1]})
        first == kNone ? void(first = v) : sets.join(first, v);
  }
  std::vector<std::int32_t> component(t.n_vertices(), kNone);
  for (VertexId v = 0; v < t.n_vertices(); ++v)
    if (is_used[v]) component[v] = sets.find(v) == v ? n++ : component[sets.find(v)];
  return component;
}

std::vector<Extent> extents_of(const SurfaceMesh& mesh, const std::vector<std::int32_t>& part, std::int32_t n) {
  std::vector<Extent> extents(n);
  for (const Triangle& t : mesh.triangles) {
    Extent& e = extents[part[t.n[0]]];
    const Vec3 a = mesh.node_xyz[t.n[0]], b = mesh.node_xyz[t.n[1]], c = mesh.node_xyz[t.n[2]];
    for (const Vec3& x : {a, b, c}) e.box.add(x);
    e.area += 0.5 * norm(cross(b - a, c - a));
  }
  return extents;
}

std::vector<Extent> extents_of(const ModelTables& t, const std::vector<std::int32_t>& component, std::int32_t n) {
  std::vector<Extent> extents(n);
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    if (t.coedges(f).empty()) continue;
    Extent& e = extents[component[t.edge_vertices[2 * t.edges_of(f).front()]]];
    e.box.add(t.face_box[f]);
    e.area += t.face_area[f];
  }
  return extents;
}

double difference(const Extent& a, const Extent& b) {
  const double size = std::max(a.box.diagonal(), b.box.diagonal()), area = std::max(a.area, b.area);
  return (distance(a.box.lo, b.box.lo) + distance(a.box.hi, b.box.hi)) / size +
         (area > 0 ? std::abs(a.area - b.area) / area : 0);
}

}  // namespace

MatchedParts match_parts(const SurfaceMesh& mesh, const ModelTables& t) {
  MatchedParts result;
  std::int32_t n_components = 0;
  result.node_part = node_components(mesh.triangles, mesh.n_nodes(), result.n_parts);
  const std::vector<std::int32_t> component = vertex_components(t, n_components);
  if (n_components != result.n_parts || n_components > kMaxParts) {
    for (std::int32_t& part : result.node_part) part = std::min(part, 0);
    result.n_parts = 1;
    result.vertex_part.assign(t.n_vertices(), 0);
    return result;
  }
  const std::vector<Extent> cad = extents_of(t, component, n_components),
                            meshed = extents_of(mesh, result.node_part, result.n_parts);
  std::vector<std::tuple<double, std::int32_t, std::int32_t>> pairs;
  for (std::int32_t c = 0; c < n_components; ++c)
    for (std::int32_t p = 0; p < n_components; ++p) pairs.push_back({difference(cad[c], meshed[p]), c, p});
  std::sort(pairs.begin(), pairs.end());
  std::vector<std::int32_t> part_of(n_components, kNone);
  std::vector<char> is_taken(n_components, 0);
  for (const auto& [cost, c, p] : pairs) {
    if (part_of[c] != kNone || is_taken[p]) continue;
    part_of[c] = p;
    is_taken[p] = 1;
  }
  for (const std::int32_t c : component) result.vertex_part.push_back(c == kNone ? 0 : part_of[c]);
  return result;
}

}  // namespace st
