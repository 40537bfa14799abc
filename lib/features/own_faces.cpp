#include "features/own_faces.h"

#include <vector>

namespace st {

void keep_own(const ModelTables& t, std::span<const std::uint8_t> is_concave, LiftingSurface& surface) {
  std::vector<std::int32_t> offsets;
  std::vector<FaceId> edge_faces, todo;
  t.edge_faces(offsets, edge_faces);
  std::vector<std::uint8_t> is_crossed(static_cast<std::size_t>(t.n_faces()), 0), is_own = is_crossed;
  for (const FaceId f : surface.faces) is_crossed[f] = 1;
  const auto take_faces_at = [&](EdgeId e) {
    for (std::int32_t k = offsets[e]; k < offsets[e + 1]; ++k) {
      const FaceId f = edge_faces[k];
      if (!is_crossed[f] || is_own[f]) continue;
      is_own[f] = 1;
      todo.push_back(f);
    }
  };
  for (const ChordEdge& edge : surface.trailing) take_faces_at(edge.edge);
  while (!todo.empty()) {
    const FaceId f = todo.back();
    todo.pop_back();
    for (const EdgeId e : t.edges_of(f))
      if (!is_concave[e] && !t.edge_is_degenerate[e]) take_faces_at(e);
  }
  std::erase_if(surface.faces, [&](FaceId f) { return !is_own[f]; });
  for (ChordEdge& edge : surface.trailing)
    for (ChordStation& s : edge.stations)
      if (s.is_measured && !is_own[s.nose_face]) s = {s.share, s.trailing};
}

}  // namespace st
