#include "geometry/model/cad_tolerance.h"

#include <algorithm>

namespace st {

double cad_tolerance(const ModelTables& t, FaceId face) {
  double largest = t.face_tolerance[face];
  for (const EdgeId e : t.edges_of(face)) {
    largest = std::max(largest, t.edge_tolerance[e]);
    for (const int end : {0, 1}) largest = std::max(largest, t.vertex_tolerance[t.edge_vertices[2 * e + end]]);
  }
  return largest;
}

}  // namespace st
