#include "mesh/node_normals.h"

namespace st {

std::vector<Vec3> node_normals(std::span<const Vec3> node_xyz, std::span<const Triangle> triangles) {
  std::vector<Vec3> normal(node_xyz.size());
  for (const Triangle& t : triangles) {
    const Vec3 a = node_xyz[t.n[0]], twice = cross(node_xyz[t.n[1]] - a, node_xyz[t.n[2]] - a);
    for (const NodeId n : t.n) normal[n] = normal[n] + twice;
  }
  for (Vec3& n : normal) n = normalized(n);
  return normal;
}

}  // namespace st
