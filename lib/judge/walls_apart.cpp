#include "judge/walls_apart.h"

#include <algorithm>

#include "geometry/shape/wall_gap.h"

namespace st {
namespace {

WallTriangle wall_of(const SurfaceMesh& mesh, TriangleId t) {
  WallTriangle wall;
  for (int k = 0; k < 3; ++k) {
    wall.x[k] = mesh.node_xyz[mesh.triangles[t].n[k]];
    wall.uv[k] = mesh.corner_uv[3 * static_cast<std::size_t>(t) + k];
  }
  return wall;
}

}  // namespace

bool WallsApart::are_of_one_body(const TrianglePair& pair) const {
  const std::int32_t body = face_body_[mesh_.triangle_face[pair.a]];
  return body != kNone && body == face_body_[mesh_.triangle_face[pair.b]];
}

bool WallsApart::are_of_body_and_sheet(const TrianglePair& pair) const {
  const std::vector<std::int32_t>& solid = model_.tables().face_solid;
  return (solid[mesh_.triangle_face[pair.a]] == kNone) != (solid[mesh_.triangle_face[pair.b]] == kNone);
}

bool WallsApart::are_apart(const TrianglePair& pair) {
  if (mesh_.corner_uv.empty()) return false;
  const FaceId a = mesh_.triangle_face[pair.a], b = mesh_.triangle_face[pair.b];
  const ModelTables& t = model_.tables();
  if (a == b || (t.face_type[a] == SurfaceType::kPlane && t.face_type[b] == SurfaceType::kPlane)) return false;
  Tries& known = known_[std::minmax(a, b)];
  if (!known.is_apart && known.n_tried == kTried) return false;
  ++known.n_tried;
  const auto gap = measure_gap(*model_.surface(a), wall_of(mesh_, pair.a), *model_.surface(b), wall_of(mesh_, pair.b),
                               meeting_distance(t, a, b));
  if (!gap || !gap->is_apart) return false;
  known.is_apart = true;
  return true;
}

}  // namespace st
