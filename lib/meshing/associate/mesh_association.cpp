#include "meshing/associate/mesh_association.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>
#include <tuple>

#include "base/error.h"
#include "meshing/associate/edge_chains.h"
#include "meshing/associate/face_regions.h"
#include "meshing/associate/places.h"

namespace st {
namespace {

constexpr double kToleranceShare = 0.05;    // of the shortest mesh edge at a node
constexpr double kLeastTolerance = 1e-6;    // of the model's diagonal: what single precision leaves
constexpr double kMaxBoxRatio = 1.5;        // of the diagonals: beyond, the unit or the model is another one
constexpr double kSameUnit = 0.05;          // relative: a ratio as near to that of two units comes from them
constexpr double kMaxBoxDifference = 0.05;  // of the diagonal: of the corners of the boxes

struct Unit {
  const char* name;
  double ratio;  // length of the mesh over that of the model when the mesh was written in it and the model is in the
                 // other
};
/// By what a mesh is too large when it is in one unit and the model in another.
constexpr Unit kUnits[] = {{"mm for m", 1000},      {"m for mm", 1e-3},          {"mm for cm", 10},
                           {"cm for mm", 0.1},      {"cm for m", 100},           {"m for cm", 0.01},
                           {"mm for inches", 25.4}, {"inches for mm", 1 / 25.4}, {"inches for m", 1 / 0.0254},
                           {"m for inches", 0.0254}};

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

Box3 box_of(const SurfaceMesh& mesh) {
  Box3 box;
  for (const Triangle& t : mesh.triangles)
    for (const NodeId n : t.n) box.add(mesh.node_xyz[n]);
  return box;
}

/// Boxes must agree: nothing else tells a wrong unit as clearly.
void require_same_box(const Box3& mesh, const Box3& model) {
  const double measured = mesh.diagonal() / model.diagonal();
  if (!(measured < kMaxBoxRatio && measured > 1 / kMaxBoxRatio)) {
    const Unit* unit = std::find_if(std::begin(kUnits), std::end(kUnits),
                                    [&](const Unit& u) { return std::abs(measured / u.ratio - 1) < kSameUnit; });
    const double ratio = unit != std::end(kUnits) ? unit->ratio : measured;
    std::string text = "the mesh is " + number(ratio > 1 ? ratio : 1 / ratio) + " times as " +
                       (ratio > 1 ? "large" : "small") + " as the geometry (diagonals " + number(mesh.diagonal()) +
                       " and " + number(model.diagonal()) + "), ";
    if (unit == std::end(kUnits))
      throw Error(ExitCode::kMismatch, text + "which no unit explains; the mesh is of another geometry");
    throw Error(ExitCode::kMismatch, text + "as if it had " + unit->name + "; scale the mesh by " + number(1 / ratio) +
                                         ", or import the geometry with the --unit of the mesh");
  }
  const double off = std::max(norm(mesh.center() - model.center()), std::abs(mesh.diagonal() - model.diagonal()));
  if (off > kMaxBoxDifference * model.diagonal())
    throw Error(ExitCode::kMismatch,
                "the mesh is at another place than the geometry, or is of another geometry: its box is around " +
                    place(mesh.center()) + ", diagonal " + number(mesh.diagonal()) + ", the geometry's around " +
                    place(model.center()) + ", diagonal " + number(model.diagonal()));
}

NodeTolerance make_tolerance(const SurfaceMesh& mesh, const MeshEdges& edges, double diagonal,
                             const AssociationOptions& options) {
  NodeTolerance tolerance;
  tolerance.adds_cad = !options.tolerance;
  tolerance.of_node.assign(mesh.node_xyz.size(), options.tolerance.value_or(1e300));
  if (options.tolerance) return tolerance;
  for (std::int32_t e = 0; e < edges.n_edges(); ++e) {
    const double own = kToleranceShare * distance(mesh.node_xyz[edges.low[e]], mesh.node_xyz[edges.high[e]]);
    for (const NodeId n : {edges.low[e], edges.high[e]}) tolerance.of_node[n] = std::min(tolerance.of_node[n], own);
  }
  for (double& t : tolerance.of_node) t = std::max(t, kLeastTolerance * diagonal);
  return tolerance;
}

/// Puts nodes and triangles into canonical order.
class Canonical {
 public:
  Canonical(const SurfaceMesh& mesh, const EdgeChains& chains, const FaceRegions& regions, const ModelTables& tables)
      : mesh_(mesh), chains_(chains), regions_(regions), t_(tables), number_(mesh.node_xyz.size(), kNone) {}

  void run(AssociatedMesh& out) {
    out_ = &out;
    for (VertexId v = 0; v < t_.n_vertices(); ++v)
      if (chains_.vertex_node[v] != kNone) add(chains_.vertex_node[v], EntityDim::kVertex, v, 0);
    for (EdgeId e = 0; e < t_.n_edges(); ++e)
      for (std::size_t i = 1; i + 1 < chains_.chain[e].node.size(); ++i)
        add(chains_.chain[e].node[i], EntityDim::kEdge, e, chains_.chain[e].t[i]);
    add_inner_nodes();
    add_triangles();
    out.mesh.labels = t_.labels;
    out.mesh.merged = chains_.merged;
  }

 private:
  void add(NodeId n, EntityDim dim, std::int32_t entity, double t) {
    SurfaceMesh& m = out_->mesh;
    number_[n] = static_cast<NodeId>(m.node_xyz.size());
    m.node_xyz.push_back(mesh_.node_xyz[n]);
    m.node_entity_dim.push_back(static_cast<std::uint8_t>(dim));
    m.node_entity.push_back(entity);
    m.node_t.push_back(t);
    m.node_size.push_back(mesh_.node_size[n]);
    out_->file_node.push_back(n);
    ++out_->report.n_nodes[static_cast<int>(dim)];
  }

  void add_inner_nodes() {
    std::vector<FaceId> face(mesh_.node_xyz.size(), kNone);
    for (TriangleId t = 0; t < mesh_.n_triangles(); ++t)
      for (const NodeId n : mesh_.triangles[t].n) face[n] = regions_.face[t];
    std::vector<std::pair<FaceId, NodeId>> inner;
    for (NodeId n = 0; n < mesh_.n_nodes(); ++n) {
      if (face[n] == kNone)
        ++out_->report.n_unused;
      else if (number_[n] == kNone)
        inner.push_back({face[n], n});
    }
    std::sort(inner.begin(), inner.end());
    for (const auto& [f, n] : inner) add(n, EntityDim::kFace, f, 0);
  }

  void add_triangles() {
    SurfaceMesh& m = out_->mesh;
    for (FaceId f = 0; f < t_.n_faces(); ++f) {
      out_->report.face_triangles.push_back(static_cast<std::int64_t>(regions_.triangles[f].size()));
      for (const TriangleId t : regions_.triangles[f]) {
        const auto& n = mesh_.triangles[t].n;
        m.triangles.push_back({{number_[n[0]], number_[n[1]], number_[n[2]]}});
        m.triangle_face.push_back(f);
        m.triangle_group.push_back(t_.labels.face_group[f]);
        for (int k = 0; k < 3; ++k) m.corner_uv.push_back(regions_.corner_uv[3 * t + k]);
        out_->file_triangle.push_back(t);
      }
    }
  }

  const SurfaceMesh& mesh_;
  const EdgeChains& chains_;
  const FaceRegions& regions_;
  const ModelTables& t_;
  std::vector<NodeId> number_;  // in the result
  AssociatedMesh* out_ = nullptr;
};

}  // namespace

AssociatedMesh associate_mesh(const SurfaceMesh& foreign, const Model& model, const AssociationOptions& options) {
  require_same_box(box_of(foreign), model.tables().box());
  SurfaceMesh mesh = foreign;
  MeshEdges edges(mesh.triangles, mesh.n_nodes());
  const NodeTolerance tolerance = make_tolerance(mesh, edges, model.tables().box().diagonal(), options);
  const EdgeChains chains = find_edge_chains(mesh, edges, model, tolerance);
  const ChainSegments segments(edges, chains);
  AssociatedMesh result;
  result.report.n_turned = orient_regions(mesh, edges, chains, segments);
  if (result.report.n_turned > 0) edges = MeshEdges(mesh.triangles, mesh.n_nodes());
  const FaceRegions regions = find_face_regions(mesh, edges, chains, segments, model, tolerance);
  Canonical(mesh, chains, regions, model.tables()).run(result);
  std::tie(result.report.max_distance, result.report.max_place) =
      chains.max_distance > regions.max_distance ? std::tie(chains.max_distance, chains.max_place)
                                                 : std::tie(regions.max_distance, regions.max_place);
  return result;
}

}  // namespace st
