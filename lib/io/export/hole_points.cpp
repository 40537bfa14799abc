#include "io/export/hole_points.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "mesh/adjacency.h"
#include "sizing/cut_cells.h"

namespace st {
namespace {

constexpr std::size_t kTriedTriangles = 12;
constexpr double kDeepest = 2, kShallowest = 1e-3;  // of the size of the triangle above
constexpr double kAround[] = {1, 0.8, 1.25};        // of the depth: so the point does not lie on the other side

/// A connected part of the mesh.
struct Component {
  std::vector<Triangle> triangles;
  double volume = 0;  // signed
  bool is_closed = true, has_far_field = false;
};

Vec3 area_vector(const SurfaceView& s, TriangleId t) {
  return 0.5 * cross(s.corner(t, 1) - s.corner(t, 0), s.corner(t, 2) - s.corner(t, 0));
}

Vec3 middle_of(const SurfaceView& s, TriangleId t) { return (s.corner(t, 0) + s.corner(t, 1) + s.corner(t, 2)) / 3; }

bool is_far_field(const FaceLabels& labels, std::int32_t group) {
  if (group < 0 || static_cast<std::size_t>(group) >= labels.group_name.size()) return false;
  return role_of(labels, static_cast<std::size_t>(group)) == "farfield";
}

void measure(std::span<const Vec3> nodes, Component& c) {
  const SurfaceView surface{nodes, c.triangles};
  const Vec3 origin = surface.corner(0, 0);
  for (TriangleId t = 0; t < static_cast<TriangleId>(c.triangles.size()); ++t)
    c.volume += dot(middle_of(surface, t) - origin, area_vector(surface, t)) / 3;
  EdgeTable(c.triangles, static_cast<std::int64_t>(nodes.size()))
      .for_each_edge([&](NodeId, NodeId, std::span<const SideId> sides) {
        if (sides.size() != 2 || run_alike(c.triangles, sides[0], sides[1])) c.is_closed = false;
      });
}

std::vector<Component> find_components(const SurfaceMesh& mesh) {
  std::int32_t n = 0;
  const std::vector<std::int32_t> of_node = node_components(mesh.triangles, mesh.n_nodes(), n);
  std::vector<Component> components(static_cast<std::size_t>(n));
  for (TriangleId t = 0; t < mesh.n_triangles(); ++t) {
    Component& c = components[of_node[mesh.triangles[t].n[0]]];
    c.triangles.push_back(mesh.triangles[t]);
    c.has_far_field = c.has_far_field || is_far_field(mesh.labels, mesh.triangle_group[t]);
  }
  if (n > 1)
    for (Component& c : components) measure(mesh.node_xyz, c);
  return components;
}

/// A point that the closed component winds around, and not one on its surface.
std::optional<Vec3> point_inside(std::span<const Vec3> nodes, const Component& c) {
  const SurfaceView surface{nodes, c.triangles};
  std::vector<TriangleId> order(c.triangles.size());
  for (std::size_t t = 0; t < order.size(); ++t) order[t] = static_cast<TriangleId>(t);
  const std::size_t n = std::min(kTriedTriangles, order.size());
  std::vector<double> area;
  for (const TriangleId t : order) area.push_back(norm(area_vector(surface, t)));
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(n), order.end(),
                    [&](TriangleId a, TriangleId b) { return area[a] != area[b] ? area[a] > area[b] : a < b; });
  const double inward = c.volume > 0 ? -1 : 1;
  for (double depth = kDeepest; depth >= kShallowest; depth /= 4)
    for (std::size_t i = 0; i < n; ++i) {
      const TriangleId t = order[i];
      if (!(area[t] > 0)) continue;
      const Vec3 down = inward * depth / std::sqrt(area[t]) * area_vector(surface, t), from = middle_of(surface, t);
      if (std::all_of(std::begin(kAround), std::end(kAround),
                      [&](double share) { return winding_number(surface, from + share * down) != 0; }))
        return from + down;
    }
  return std::nullopt;
}

}  // namespace

HolePoints find_hole_points(const SurfaceMesh& mesh) {
  HolePoints holes;
  const std::vector<Component> components = find_components(mesh);
  if (components.size() < 2) return holes;
  const auto outer =
      std::find_if(components.begin(), components.end(), [](const Component& c) { return c.has_far_field; });
  for (const Component& c : components) {
    if (!c.is_closed || c.volume == 0 || c.has_far_field) continue;
    const bool is_in_air = outer != components.end() && outer->is_closed &&
                           winding_number({mesh.node_xyz, outer->triangles}, mesh.node_xyz[c.triangles[0].n[0]]) != 0;
    if (c.volume > 0 && !is_in_air) continue;
    if (const std::optional<Vec3> x = point_inside(mesh.node_xyz, c))
      holes.points.push_back(*x);
    else
      ++holes.n_not_found;
  }
  return holes;
}

}  // namespace st
