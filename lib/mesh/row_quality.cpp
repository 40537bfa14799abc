#include "mesh/row_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace st {
namespace {

using Quad = std::array<Vec3, 4>;

double area_of(const SurfaceMesh& mesh, TriangleId t) {
  const auto& n = mesh.triangles[t].n;
  const Vec3 a = mesh.node_xyz[n[0]];
  return 0.5 * norm(cross(mesh.node_xyz[n[1]] - a, mesh.node_xyz[n[2]] - a));
}

double side_length(const SurfaceMesh& mesh, SideId side) {
  const auto& n = mesh.triangles[side / 3].n;
  return distance(mesh.node_xyz[n[side % 3]], mesh.node_xyz[n[(side + 1) % 3]]);
}

/// Is it the longest of its triangle?
bool is_longest(const SurfaceMesh& mesh, SideId side) {
  const SideId first = side / 3 * 3;
  const double own = side_length(mesh, side);
  for (SideId s = first; s < first + 3; ++s)
    if (s != side && side_length(mesh, s) >= own) return false;
  return true;
}

/// Of two triangles with a common side, in order around.
Quad quad_of(const SurfaceMesh& mesh, SideId side, SideId other) {
  const auto& n = mesh.triangles[side / 3].n;
  const Vec3 apex = mesh.node_xyz[mesh.triangles[other / 3].n[(other + 2) % 3]];
  return {mesh.node_xyz[n[side % 3]], apex, mesh.node_xyz[n[(side + 1) % 3]], mesh.node_xyz[n[(side + 2) % 3]]};
}

double aspect_of(const Quad& q) {
  const double a = distance(q[0], q[1]) + distance(q[2], q[3]), b = distance(q[1], q[2]) + distance(q[3], q[0]);
  return std::max(a, b) / std::min(a, b);
}

bool is_good(const Quad& q) {
  for (std::size_t k = 0; k < 4; ++k) {
    const double angle = degrees(angle_between(q[(k + 1) % 4] - q[k], q[(k + 3) % 4] - q[k]));
    if (angle < kLeastRowAngleDeg || angle > kMostRowAngleDeg) return false;
  }
  return true;
}

}  // namespace

RowStats measure_rows(const SurfaceMesh& mesh, const EdgeTable& edges, std::span<const double> quality) {
  RowStats stats;
  std::vector<char> is_in_row(mesh.triangles.size(), 0);
  edges.for_each_edge([&](NodeId, NodeId, std::span<const SideId> sides) {
    if (sides.size() != 2) return;
    const TriangleId a = sides[0] / 3, b = sides[1] / 3;
    const auto [low, high] = std::minmax({area_of(mesh, a), area_of(mesh, b)});
    if (!(low > 0)) return;
    const double growth = std::sqrt(high / low);
    stats.growth = std::max(stats.growth, growth);
    stats.n_grown += growth > kMostRowGrowth;
    if (mesh.triangle_face[a] != mesh.triangle_face[b]) return;
    if (!is_longest(mesh, sides[0]) || !is_longest(mesh, sides[1])) return;
    const Quad quad = quad_of(mesh, sides[0], sides[1]);
    if (!(aspect_of(quad) > kRowAspect)) return;
    ++stats.n_quads;
    stats.n_good += is_good(quad);
    is_in_row[a] = is_in_row[b] = 1;
  });
  std::vector<double> others;
  for (std::size_t t = 0; t < quality.size(); ++t)
    if (!is_in_row[t]) others.push_back(quality[t]);
  stats.n_others = static_cast<std::int64_t>(others.size());
  if (others.empty()) return stats;
  for (const double q : others) stats.mean += q / static_cast<double>(others.size());
  std::nth_element(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(others.size() / 100), others.end());
  stats.p1 = others[others.size() / 100];
  return stats;
}

}  // namespace st
