#include "features/own_faces.h"
#include "geometry/model/edge_faces.h"

namespace st {

std::vector<std::uint8_t> find_own_faces(const ModelTables& t, std::span<const std::uint8_t> is_concave,
                                         std::span<const std::uint8_t> is_allowed, const LiftingSurface& surface) {
  const EdgeFaces faces_at(t);
  std::vector<FaceId> todo;
  std::vector<std::uint8_t> is_own(static_cast<std::size_t>(t.n_faces()), 0);
  const auto take_faces_at = [&](EdgeId e) {
    for (const FaceId f : faces_at[e]) {
      if (!is_allowed[f] || is_own[f]) continue;
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
  return is_own;
}

std::vector<std::uint8_t> find_body_faces(const ModelTables& t, std::span<const std::uint8_t> is_concave,
                                          std::span<const std::uint8_t> is_wall, const LiftingSurface& surface) {
  const EdgeFaces faces_at(t);
  std::vector<std::uint8_t> is_allowed(is_wall.begin(), is_wall.end());
  for (const FaceId f : surface.faces)
    for (const EdgeId e : t.edges_of(f))
      if (is_concave[e])
        for (const FaceId g : faces_at[e]) is_allowed[g] = 0;
  for (const FaceId f : surface.faces) is_allowed[f] = 1;
  return find_own_faces(t, is_concave, is_allowed, surface);
}

std::vector<std::uint8_t> find_crossed_own_faces(const ModelTables& t, std::span<const std::uint8_t> is_concave,
                                                 const LiftingSurface& surface) {
  std::vector<std::uint8_t> is_crossed(static_cast<std::size_t>(t.n_faces()), 0);
  for (const FaceId f : surface.faces) is_crossed[f] = 1;
  return find_own_faces(t, is_concave, is_crossed, surface);
}

void keep_own(const ModelTables& t, std::span<const std::uint8_t> is_concave, std::span<const FaceId> covers,
              LiftingSurface& surface) {
  std::vector<std::uint8_t> is_own = find_crossed_own_faces(t, is_concave, surface);
  for (const FaceId f : covers) is_own[f] = 1;
  std::erase_if(surface.faces, [&](FaceId f) { return !is_own[f]; });
  for (ChordEdge& edge : surface.trailing)
    for (ChordStation& s : edge.stations)
      if (s.is_measured && !is_own[s.nose_face]) s = {s.share, s.trailing};
}

}  // namespace st
