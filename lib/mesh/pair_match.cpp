#include "mesh/pair_match.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "base/sort_once.h"

namespace st {
namespace {

/// A direction that is none of a model's: few nodes have the same place along it.
constexpr Vec3 kAlong{0.5310, 0.6427, 0.5523};

using Corners = std::array<NodeId, 3>;

std::vector<TriangleId> triangles_of(const SurfaceMesh& m, FaceId f) {
  std::vector<TriangleId> triangles;
  for (TriangleId t = 0; t < m.n_triangles(); ++t)
    if (m.triangle_face[t] == f) triangles.push_back(t);
  return triangles;
}

std::vector<NodeId> nodes_of(const SurfaceMesh& m, const std::vector<TriangleId>& triangles) {
  std::vector<NodeId> nodes;
  for (const TriangleId t : triangles) nodes.insert(nodes.end(), m.triangles[t].n, m.triangles[t].n + 3);
  sort_once(nodes);
  return nodes;
}

Corners sorted(Corners c) {
  std::sort(c.begin(), c.end());
  return c;
}

/// Triangles of face b by their nodes, those whose partner is found taken out.
void match_triangles(const SurfaceMesh& m, const std::vector<TriangleId>& a, const std::vector<TriangleId>& b,
                     const std::map<NodeId, NodeId>& partner, PairMatch& match) {
  std::map<Corners, TriangleId> left;
  for (const TriangleId t : b) left[sorted({m.triangles[t].n[0], m.triangles[t].n[1], m.triangles[t].n[2]})] = t;
  for (const TriangleId t : a) {
    Corners image{};
    bool has_all = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto it = partner.find(m.triangles[t].n[k]);
      has_all = has_all && it != partner.end();
      if (has_all) image[k] = it->second;
    }
    if (has_all && left.erase(sorted(image)) == 0) match.triangles_alone.push_back(t);
  }
  for (const auto& [corners, t] : left)
    if (std::none_of(corners.begin(), corners.end(),
                     [&](NodeId n) { return std::binary_search(match.alone.begin(), match.alone.end(), n); }))
      match.triangles_alone.push_back(t);
  std::sort(match.triangles_alone.begin(), match.triangles_alone.end());
}

}  // namespace

PairMatch match_pair(const SurfaceMesh& m, const FacePair& pair, double tolerance) {
  const std::vector<TriangleId> a = triangles_of(m, pair.a), b = triangles_of(m, pair.b);
  std::vector<std::pair<double, NodeId>> others;
  for (const NodeId n : nodes_of(m, b)) others.emplace_back(dot(kAlong, m.node_xyz[n]), n);
  std::sort(others.begin(), others.end());
  PairMatch match;
  std::map<NodeId, NodeId> partner;
  std::vector<NodeId> taken;
  for (const NodeId n : nodes_of(m, a)) {
    const Vec3 x = pair.motion(m.node_xyz[n]);
    const double at = dot(kAlong, x);
    NodeId nearest = kNone;
    for (auto it = std::lower_bound(others.begin(), others.end(), std::pair{at - 2 * tolerance, NodeId{0}});
         it != others.end() && it->first <= at + 2 * tolerance; ++it)
      if (const double d = distance(x, m.node_xyz[it->second]);
          d <= tolerance && (nearest == kNone || d < distance(x, m.node_xyz[nearest])))
        nearest = it->second;
    if (nearest == kNone) {
      match.alone.push_back(n);
      continue;
    }
    match.nodes.emplace_back(n, nearest);
    partner[n] = nearest;
    taken.push_back(nearest);
  }
  sort_once(taken);
  for (const auto& [at, n] : others)
    if (!std::binary_search(taken.begin(), taken.end(), n)) match.alone.push_back(n);
  sort_once(match.alone);
  match_triangles(m, a, b, partner, match);
  return match;
}

double pair_tolerance(const Box3& box) {
  constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();  // of coordinates: a turn and back
  double largest = 0;
  for (const double x : {box.lo.x, box.lo.y, box.lo.z, box.hi.x, box.hi.y, box.hi.z})
    largest = std::max(largest, std::abs(x));
  return std::max(kPairMatch * box.diagonal(), kRounding * largest);
}

double pair_tolerance(const SurfaceMesh& mesh) {
  Box3 box;
  for (const Vec3& x : mesh.node_xyz) box.add(x);
  return pair_tolerance(box);
}

}  // namespace st
