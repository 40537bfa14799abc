#include "stages/foreign_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/hash.h"
#include "base/length.h"
#include "io/foreign/triangulation_reader.h"

namespace st {
namespace {

constexpr double kTooShort = 0.7, kTooLong = 1.4;  // of the requested length: a mean edge within was made for it

bool has_lengths(const SurfaceMesh& mesh) {
  return std::all_of(mesh.node_size.begin(), mesh.node_size.end(), [](double h) { return h > 0 && std::isfinite(h); });
}

/// Mean length of the sides at each node.
std::vector<double> mean_lengths(const SurfaceMesh& mesh) {
  std::vector<double> sum(mesh.node_xyz.size(), 0), n(mesh.node_xyz.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const NodeId a = t.n[k], b = t.n[(k + 1) % 3];
      for (const NodeId node : {a, b}) sum[node] += distance(mesh.node_xyz[a], mesh.node_xyz[b]), ++n[node];
    }
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] /= std::max(n[i], 1.0);
  return sum;
}

std::vector<double> stored_lengths(const SurfaceMesh& mesh, const ForeignMeshOptions& o) {
  if (o.made_for == nullptr && has_lengths(mesh)) return mesh.node_size;
  const SizeField* field = o.made_for ? o.made_for : o.sizes;
  const std::vector<double> mean = mean_lengths(mesh);
  if (field == nullptr) return mean;
  std::vector<double> lengths;
  int hint = 0;
  for (std::size_t n = 0; n < mean.size(); ++n) {
    const double request = field->size(mesh.node_xyz[n], hint);
    const bool fits = o.made_for || (mean[n] >= kTooShort * request && mean[n] <= kTooLong * request);
    lengths.push_back(fits ? request : mean[n]);
  }
  return lengths;
}

std::string hash_of(const SurfaceMesh& mesh) {
  return hash_hex(mesh.node_xyz.data(), mesh.node_xyz.size() * sizeof(Vec3)) +
         hash_hex(mesh.triangles.data(), mesh.triangles.size() * sizeof(Triangle));
}

}  // namespace

ForeignMesh read_foreign_mesh(const std::string& path, const Model& model, const ForeignMeshOptions& options) {
  const ModelTables& t = model.tables();
  AssociationOptions association;
  if (!options.tolerance.empty())
    association.tolerance = resolve_length(parse_length(options.tolerance, "--tolerance"),
                                           {t.reference_diagonal(), t.unit_in_m}, "--tolerance");
  const SurfaceMesh file = read_triangulation(path);
  ForeignMesh result;
  try {
    AssociatedMesh associated = associate_mesh(file, model, association);
    result.artifact.mesh = std::move(associated.mesh);
    result.file_node = std::move(associated.file_node);
    result.file_triangle = std::move(associated.file_triangle);
    result.report = std::move(associated.report);
  } catch (const Error& e) {
    throw Error(e.code(), path + ": " + e.what());
  }
  result.n_file_nodes = file.node_xyz.size();
  result.artifact.header.schema = "mesh";
  result.artifact.header.content_hash = hash_of(file);
  result.artifact.mesh.node_size = stored_lengths(result.artifact.mesh, options);
  return result;
}

Model with_vertices_of(const SurfaceMesh& mesh, Model&& model, const Composites& composites) {
  ModelTables tables = model.cad().tables();
  bool is_same = true;
  for (std::size_t n = 0;
       n < mesh.node_xyz.size() && mesh.node_entity_dim[n] == static_cast<std::uint8_t>(EntityDim::kVertex); ++n) {
    Vec3& x = tables.vertex_xyz[mesh.node_entity[n]];
    is_same &= x == mesh.node_xyz[n];
    x = mesh.node_xyz[n];
  }
  if (is_same) return std::move(model);
  if (!model.facets().empty()) return {std::move(tables), model.facets()};
  if (!composites.empty()) return {std::move(tables), model.cad().brep(), composites};
  return {std::move(tables), model.brep()};
}

std::string association_text(const std::string& path, const SurfaceMesh& mesh, const AssociationReport& r) {
  std::string text = fmt::format(
      "{}: {} triangles on {} faces; {} nodes on vertices, {} on edges, {} inside faces; farthest {:.3g} from the CAD, "
      "at ({:.6g}, {:.6g}, "
      "{:.6g})",
      path, mesh.n_triangles(), r.face_triangles.size(), r.n_nodes[0], r.n_nodes[1], r.n_nodes[2], r.max_distance,
      r.max_place.x, r.max_place.y, r.max_place.z);
  if (r.n_turned > 0) text += fmt::format("; {} triangles turned to agree with their neighbours", r.n_turned);
  if (r.n_unused > 0) text += fmt::format("; {} nodes without a triangle left out", r.n_unused);
  if (!mesh.merged.edge.empty())
    text += fmt::format("; {} short CAD edges without a mesh edge", mesh.merged.edge.size());
  return text;
}

nlohmann::json association_json(const SurfaceMesh& mesh, const AssociationReport& r) {
  return {{"farthest", r.max_distance},
          {"farthest_at", {r.max_place.x, r.max_place.y, r.max_place.z}},
          {"nodes_on_vertices", r.n_nodes[0]},
          {"nodes_on_edges", r.n_nodes[1]},
          {"nodes_in_faces", r.n_nodes[2]},
          {"triangles_turned", r.n_turned},
          {"nodes_unused", r.n_unused},
          {"merged_edges", mesh.merged.edge.size()},
          {"triangles_per_face", r.face_triangles}};
}

}  // namespace st
