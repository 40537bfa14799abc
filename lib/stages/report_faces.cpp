#include "stages/report_faces.h"

#include <algorithm>
#include <numeric>
#include <utility>

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

}  // namespace st
