#include "mesh/feature_sides.h"

#include "mesh/adjacency.h"

namespace st {
namespace {

Vec3 normal_of(const SurfaceMesh& m, TriangleId t) {
  const auto& n = m.triangles[t].n;
  return cross(m.node_xyz[n[1]] - m.node_xyz[n[0]], m.node_xyz[n[2]] - m.node_xyz[n[0]]);
}

}  // namespace

std::vector<std::array<NodeId, 2>> feature_sides(const SurfaceMesh& m, double angle_deg) {
  std::vector<std::array<NodeId, 2>> found;
  const std::span<const Triangle> triangles(m.triangles);
  EdgeTable(triangles, m.n_nodes()).for_each_edge([&](NodeId low, NodeId high, std::span<const SideId> sides) {
    bool is_feature = sides.size() != 2;
    if (!is_feature) {
      const TriangleId a = sides[0] / 3, b = sides[1] / 3;
      const Vec3 second = normal_of(m, b);
      const double turn = angle_between(normal_of(m, a), run_alike(triangles, sides[0], sides[1]) ? -second : second);
      is_feature = m.triangle_group[a] != m.triangle_group[b] || turn >= radians(angle_deg);
    }
    if (is_feature) found.push_back({low, high});
  });
  return found;
}

}  // namespace st
