#include "geometry/model/bodies.h"

#include <algorithm>

#include "geometry/model/cad_tolerance.h"

namespace st {

std::vector<std::int32_t> bodies_of(const ModelTables& t) {
  std::vector<std::int32_t> body(t.n_faces(), kNone);
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    if (t.face_solid[f] != kNone)
      body[f] = t.face_solid[f];
    else if (t.face_shell[f] != kNone)
      body[f] = t.n_solids + t.face_shell[f];
  }
  return body;
}

std::set<VertexId> vertices_of(const ModelTables& t, FaceId face) {
  std::set<VertexId> vertices;
  for (const EdgeId e : t.edges_of(face)) vertices.insert({t.edge_vertices[2 * e], t.edge_vertices[2 * e + 1]});
  return vertices;
}

double meeting_distance(const ModelTables& t, FaceId a, FaceId b) {
  constexpr double kMeet = 1e-6;  // of the diagonal
  return std::max({kMeet * t.box().diagonal(), cad_tolerance(t, a), cad_tolerance(t, b)});
}

}  // namespace st
