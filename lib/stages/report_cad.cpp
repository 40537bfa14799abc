#include "stages/report_cad.h"

#include <algorithm>
#include <utility>

#include "features/face_roles.h"
#include "stages/cad_view.h"

namespace st {
namespace {

/// The kind of each edge. [n_edges]
std::vector<LineKind> line_kinds(const Model& model, std::span<const FaceId> unmeshed) {
  const ModelTables& t = model.tables();
  std::vector<LineKind> kind(t.n_edges(), LineKind::kEdge);
  for (const WingEdge& w : wing_edges_to_see(model))
    kind[w.edge] = w.kind == WingEdgeKind::kLeading ? LineKind::kLeading : LineKind::kTrailing;
  std::vector<int> n_uses(t.n_edges(), 0);
  for (const EdgeId e : t.coedge_edge) ++n_uses[e];
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    if (n_uses[e] == 1) kind[e] = LineKind::kFree;
  for (const FaceId f : unmeshed)
    for (const EdgeId e : t.edges_of(f)) kind[e] = LineKind::kUnmeshed;
  return kind;
}

/// The group of each edge. [n_edges]
std::vector<std::int32_t> line_groups(const Model& model) {
  const ModelTables& t = model.tables();
  std::vector<std::int32_t> group(t.n_edges(), 0);
  const FaceRoles roles = face_roles(t);
  for (const bool is_wall : {false, true})  // walls last, so that they win
    for (FaceId f = 0; f < t.n_faces(); ++f)
      if ((roles.role[f] == FaceRole::kWall) == is_wall)
        for (const EdgeId e : t.edges_of(f)) group[e] = t.labels.face_group[f];
  return group;
}

}  // namespace

CadLines cad_lines(const Model& model, std::span<const FaceId> unmeshed) {
  const ModelTables& t = model.tables();
  const std::vector<LineKind> kind = line_kinds(model, unmeshed);
  const std::vector<std::int32_t> group = line_groups(model);
  std::vector<EdgeId> order;
  for (EdgeId e = 0; e < t.n_edges(); ++e)
    if (!t.edge_is_degenerate[e]) order.push_back(e);
  std::ranges::stable_sort(order, {}, [&](EdgeId e) { return std::pair(kind[e], group[e]); });
  CadLines lines;
  for (const EdgeId e : order) {
    if (lines.runs.empty() || lines.runs.back().kind != kind[e] || lines.runs.back().group != group[e])
      lines.runs.push_back({kind[e], group[e], 0});
    const std::vector<Vec3> points = line_to_see(*model.curve(e));
    for (std::size_t i = 1; i < points.size(); ++i) lines.ends.insert(lines.ends.end(), {points[i - 1], points[i]});
    lines.edges.push_back({e, static_cast<std::int64_t>(points.size()) - 1});
    lines.runs.back().n_lines += lines.edges.back().n_lines;
  }
  return lines;
}

SurfaceMesh facet_mesh(const Model& model) {
  const FaceLabels& labels = model.tables().labels;
  Facets facets = facets_to_see(model);
  SurfaceMesh mesh;
  mesh.node_xyz = std::move(facets.xyz);
  for (std::size_t i = 0; i < facets.triangle.size(); ++i) {
    const auto [a, b, c] = facets.triangle[i];
    mesh.triangles.push_back({{a, b, c}});
    mesh.triangle_face.push_back(facets.face[i]);
    mesh.triangle_group.push_back(labels.face_group[facets.face[i]]);
  }
  mesh.labels = labels;
  return mesh;
}

}  // namespace st
