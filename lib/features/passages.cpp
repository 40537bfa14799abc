#include "features/passages.h"

#include <algorithm>
#include <cstdint>

#include "base/share.h"
#include "features/lifting_surface.h"

namespace st {
namespace {

/// At most stations with a nose.
bool has_curved_noses(const ModelTables& t, const LiftingSurface& surface) {
  int n = 0, n_curved = 0;
  for (const ChordEdge& edge : surface.trailing)
    for (const ChordStation& s : edge.stations) {
      if (!s.is_measured) continue;
      ++n;
      n_curved += t.face_type[s.nose_face] != SurfaceType::kPlane;
    }
  return 2 * n_curved > n;
}

}  // namespace

bool has_through_holes(const ModelTables& t) {
  std::int64_t characteristic = -std::int64_t{t.n_loops()};
  for (FaceId f = 0; f < t.n_faces(); ++f) characteristic += t.is_joined(f) ? 0 : 2;
  std::vector<std::uint8_t> is_used(static_cast<std::size_t>(t.n_vertices()), 0);  // joined faces leave some unused
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    if (t.edge_is_degenerate[e]) continue;
    --characteristic;
    for (const std::size_t k : {0, 1}) is_used[t.edge_vertices[2 * static_cast<std::size_t>(e) + k]] = 1;
  }
  for (const std::uint8_t used : is_used) characteristic += used;
  return characteristic < 2 * static_cast<std::int64_t>(t.n_shells);
}

bool has_vanes(const Model& model, FaceRoles roles, std::span<const Strip> strips, const Executor& executor) {
  const ModelTables& t = model.tables();
  if (is_material_ahead(t, roles) || !t.volume) return false;
  roles.is_passage = true;
  const std::vector<WingEdge> edges = find_wing_edges(model, roles, strips, executor);
  const std::vector<LiftingSurface> vanes = find_lifting_surfaces(model, roles, edges, executor);
  bool has_any = std::ranges::any_of(vanes, [&](const LiftingSurface& vane) { return has_curved_noses(t, vane); });
  share(executor, has_any);
  return has_any;
}

}  // namespace st
