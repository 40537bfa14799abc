#include "geometry/facet/facet_bodies.h"

#include <cmath>
#include <utility>

#include "base/disjoint_sets.h"

namespace st {

std::vector<FacetBody> find_bodies(const FacetMesh& mesh) {
  const std::vector<Corners> neighbours = find_neighbours(mesh.corners);
  DisjointSets sets(mesh.n_triangles());
  for (std::int32_t t = 0; t < mesh.n_triangles(); ++t)
    for (const std::int32_t other : neighbours[t])
      if (other != kNone) sets.join(t, other);
  std::vector<FacetBody> bodies;
  for (auto& members : sets.groups()) {
    FacetBody& body = bodies.emplace_back();
    for (const std::int32_t t : members)
      for (int k = 0; k < 3; ++k) {
        body.box.add(mesh.x[mesh.corners[t][k]]);
        body.is_open |= neighbours[t][k] == kNone;
      }
    body.triangles = std::move(members);
  }
  return bodies;
}

double winding(const FacetMesh& mesh, const FacetBody& body, Vec3 p) {
  double sum = 0;
  for (const std::int32_t t : body.triangles) {
    const Corners& c = mesh.corners[t];
    const Vec3 a = mesh.x[c[0]] - p, b = mesh.x[c[1]] - p, d = mesh.x[c[2]] - p;
    const double la = norm(a), lb = norm(b), ld = norm(d);
    sum += 2 * std::atan2(dot(a, cross(b, d)), la * lb * ld + dot(a, b) * ld + dot(b, d) * la + dot(d, a) * lb);
  }
  return sum / (4 * kPi);
}

}  // namespace st
