#include "stages/report_faces.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "geometry/model/joined_tables.h"

namespace st {

std::vector<TriangleId> by_group_and_face(const SurfaceMesh& mesh) {
  std::vector<TriangleId> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {},
                           [&](TriangleId t) { return std::pair(mesh.triangle_group[t], mesh.triangle_face[t]); });
  return order;
}

nlohmann::ordered_json faces_to_pick(const SurfaceMesh& mesh, std::span<const TriangleId> order,
                                     const ModelTables* tables) {
  const FaceLabels& labels = mesh.labels;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (std::size_t i = 0, end; i < order.size(); i = end) {
    const FaceId f = mesh.triangle_face[order[i]];
    for (end = i + 1; end < order.size() && mesh.triangle_face[order[end]] == f;) ++end;
    const bool has_part = static_cast<std::size_t>(f) < labels.face_part.size();
    list.push_back({f + 1, end - i, labels.face_name[f], has_part ? labels.face_part[f] : kNone,
                    tables ? tables->face_area[f] : 0.0});
  }
  return list;
}

nlohmann::ordered_json unmeshed_faces(std::span<const FaceFailure> failures, const FaceLabels& labels) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const FaceFailure& f : failures)
    list.push_back({{"face", f.face + 1},
                    {"name", labels.face_name[f.face]},
                    {"cause", f.cause},
                    {"remedy", f.remedy},
                    {"is_closed", f.is_closed},
                    {"xyz", {f.xyz.x, f.xyz.y, f.xyz.z}}});
  return list;
}

nlohmann::ordered_json cad_numbers(const GeometryArtifact& geometry) {
  using Json = nlohmann::ordered_json;
  if (geometry.composites.empty()) return Json::object();
  const JoinedTables joined = join_tables(geometry.cad, geometry.composites);
  Json faces(joined.face_of.size(), Json::array()), edges = Json::array();
  for (std::size_t f = 0; f < joined.face_of.size(); ++f)
    faces[static_cast<std::size_t>(joined.face_of[f])].push_back(f + 1);
  for (EdgeId e = 0; e < joined.tables.n_edges(); ++e) {
    Json pieces = Json::array();
    for (const EdgePiece& p : joined.pieces_of(e)) pieces.push_back(p.edge + 1);
    edges.push_back(std::move(pieces));
  }
  return {{"cad_faces", std::move(faces)}, {"cad_edges", std::move(edges)}};
}

}  // namespace st
