#include "mesh/quad_pairs.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mesh/adjacency.h"

namespace st {
namespace {

constexpr double kLargestSkew = 0.5;    // cosine of the sharpest corner: 60 degrees, and 120
constexpr double kLeastAspect = 1.5;    // of the mean lengths of opposite sides
constexpr double kLeastFlatness = 0.9;  // cosine between the normals of the two triangles: 26 degrees

struct Candidate {
  double skew = 0;  // largest cosine of a corner, without its sign
  Quadrilateral quad;
  TriangleId other = kNone;
};

/// The quadrilateral around the common side of two triangles, if it is one that rows are made of.
std::optional<Candidate> make_quad(const SurfaceMesh& m, SideId a, SideId b) {
  const auto corner = [&](SideId side, int step) { return m.triangles[side / 3].n[(side % 3 + step) % 3]; };
  const std::array<NodeId, 4> n = {corner(a, 2), corner(a, 0), corner(b, 2), corner(a, 1)};
  std::array<Vec3, 4> side{};
  for (std::size_t k = 0; k < 4; ++k) side[k] = m.node_xyz[n[(k + 1) % 4]] - m.node_xyz[n[k]];
  const Vec3 u = cross(side[0], side[3]), v = cross(side[2], side[1]);
  if (!(dot(u, v) >= kLeastFlatness * norm(u) * norm(v)) || !(norm(u) > 0)) return std::nullopt;
  const double width = norm(side[0]) + norm(side[2]), height = norm(side[1]) + norm(side[3]);
  if (std::max(width, height) < kLeastAspect * std::min(width, height)) return std::nullopt;
  Candidate c;
  for (std::size_t k = 0; k < 4; ++k)
    c.skew = std::max(c.skew, std::abs(dot(normalized(side[k]), normalized(side[(k + 1) % 4]))));
  if (c.skew > kLargestSkew) return std::nullopt;
  c.quad = {n, std::min(a / 3, b / 3)};
  c.other = std::max(a / 3, b / 3);
  return c;
}

}  // namespace

QuadPairs all_triangles(const SurfaceMesh& m) {
  QuadPairs result;
  for (std::size_t t = 0; t < m.triangles.size(); ++t) result.triangles.push_back(static_cast<TriangleId>(t));
  return result;
}

QuadPairs pair_triangles(const SurfaceMesh& m) {
  std::vector<Candidate> candidates;
  EdgeTable(m.triangles, m.n_nodes()).for_each_edge([&](NodeId, NodeId, std::span<const SideId> sides) {
    if (sides.size() != 2 || run_alike(m.triangles, sides[0], sides[1])) return;
    if (m.triangle_face[sides[0] / 3] != m.triangle_face[sides[1] / 3]) return;
    if (const auto c = make_quad(m, sides[0], sides[1])) candidates.push_back(*c);
  });
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.skew, a.quad.triangle, a.other) < std::tie(b.skew, b.quad.triangle, b.other);
  });
  QuadPairs result;
  std::vector<std::uint8_t> is_taken(m.triangles.size(), 0);
  for (const Candidate& c : candidates) {
    if (is_taken[c.quad.triangle] || is_taken[c.other]) continue;
    is_taken[c.quad.triangle] = is_taken[c.other] = 1;
    result.quads.push_back(c.quad);
  }
  std::sort(result.quads.begin(), result.quads.end(),
            [](const Quadrilateral& a, const Quadrilateral& b) { return a.triangle < b.triangle; });
  for (std::size_t t = 0; t < m.triangles.size(); ++t)
    if (!is_taken[t]) result.triangles.push_back(static_cast<TriangleId>(t));
  return result;
}

}  // namespace st
