#include "mesh/row_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace st {
namespace {

constexpr double kRowEndAspect = 0.7;     // of the last quadrilateral that continues a row: along over across
constexpr double kContinuedLeanDeg = 20;  // largest difference of its angles from 90
constexpr int kLeastNeighbours = 2;       // of it, in rows: a block has no loose ends

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

/// Of its first and third side over the other two.
double first_over_second(const Quad& q) {
  return (distance(q[0], q[1]) + distance(q[2], q[3])) / (distance(q[1], q[2]) + distance(q[3], q[0]));
}

bool has_angles_within(const Quad& q, double least_deg, double most_deg) {
  for (std::size_t k = 0; k < 4; ++k) {
    const double angle = degrees(angle_between(q[(k + 1) % 4] - q[k], q[(k + 3) % 4] - q[k]));
    if (angle < least_deg || angle > most_deg) return false;
  }
  return true;
}

/// Quadrilaterals by their triangles: each has a diagonal, and counted from it a first and a second side. The first
/// sides of both triangles are opposite, as are the second ones.
class Rows {
 public:
  explicit Rows(const SurfaceMesh& mesh)
      : mesh_(mesh),
        beyond_(3 * mesh.triangles.size(), kNone),
        diagonal_(mesh.triangles.size(), kNone),
        along_(mesh.triangles.size(), 0) {}

  /// Two sides of one edge within a face.
  void join(SideId a, SideId b) {
    if (run_alike(mesh_.triangles, a, b)) return;
    beyond_[a] = b;
    beyond_[b] = a;
    if (!is_longest(mesh_, a) || !is_longest(mesh_, b)) return;
    diagonal_[a / 3] = a;
    diagonal_[b / 3] = b;
  }
  bool is_diagonal(SideId side) const { return diagonal_[side / 3] == side; }
  /// Makes the quadrilateral of a diagonal one of a row, along its longer sides.
  void begin(SideId diagonal, double first_over_second) { take(diagonal / 3, first_over_second > 1 ? 1 : 2); }
  /// Follows rows from what has begun; returns the number of quadrilaterals found.
  std::int64_t follow() {
    const std::size_t n_begun = queue_.size();
    for (std::size_t i = 0; i < queue_.size(); ++i)
      for (const int k : {1, 2}) follow(queue_[i], k);
    std::int64_t n_found = static_cast<std::int64_t>(queue_.size() - n_begun) / 2;
    std::vector<char> may_go(along_.size(), 0);
    for (std::size_t i = n_begun; i < queue_.size(); ++i) may_go[queue_[i]] = 1;
    for (std::size_t i = n_begun; i < queue_.size(); ++i) {
      const TriangleId t = queue_[i], other = beyond_[diagonal_[t]] / 3;
      if (!may_go[t] || !has(t) || n_neighbours(t) + n_neighbours(other) >= kLeastNeighbours) continue;
      along_[t] = along_[other] = 0;
      --n_found;
      for (const TriangleId half : {t, other})
        for (const int k : {1, 2})
          if (const SideId side = over(half, k); side != kNone && has(side / 3)) queue_.push_back(side / 3);
    }
    return n_found;
  }
  bool has(TriangleId t) const { return along_[t] != 0; }

 private:
  void take(TriangleId t, int along) {
    const TriangleId other = beyond_[diagonal_[t]] / 3;
    along_[t] = along_[other] = static_cast<char>(along);
    queue_.push_back(t);
    queue_.push_back(other);
  }
  /// Over side `k` of triangle `t`, counted from its diagonal; kNone where the face or the mesh ends.
  SideId over(TriangleId t, int k) const { return beyond_[3 * t + (diagonal_[t] + k) % 3]; }
  int n_neighbours(TriangleId t) const {
    int n = 0;
    for (const int k : {1, 2})
      if (const SideId side = over(t, k); side != kNone) n += has(side / 3);
    return n;
  }
  void follow(TriangleId t, int k) {
    const SideId side = over(t, k);
    if (side == kNone) return;
    const TriangleId next = side / 3;
    if (diagonal_[next] == kNone || has(next)) return;
    const Quad quad = quad_of(mesh_, diagonal_[next], beyond_[diagonal_[next]]);
    if (!has_angles_within(quad, 90 - kContinuedLeanDeg, 90 + kContinuedLeanDeg)) return;
    const int own = (side - diagonal_[next] + 3) % 3;
    const int along = k == along_[t] ? own : 3 - own;
    const double first = first_over_second(quad);
    if ((along == 1 ? first : 1 / first) >= kRowEndAspect) take(next, along);
  }

  const SurfaceMesh& mesh_;
  std::vector<SideId> beyond_;    // [side] the same edge's other one, kNone at the face's end
  std::vector<SideId> diagonal_;  // [triangle] kNone: of no quadrilateral
  std::vector<char> along_;       // [triangle] which side runs along its row: 1 or 2, 0 outside rows
  std::vector<TriangleId> queue_;
};

}  // namespace

RowStats measure_rows(const SurfaceMesh& mesh, const EdgeTable& edges, std::span<const double> quality) {
  RowStats stats;
  Rows rows(mesh);
  edges.for_each_edge([&](NodeId, NodeId, std::span<const SideId> sides) {
    if (sides.size() != 2) return;
    const TriangleId a = sides[0] / 3, b = sides[1] / 3;
    const auto [low, high] = std::minmax({area_of(mesh, a), area_of(mesh, b)});
    if (!(low > 0)) return;
    const double growth = std::sqrt(high / low);
    stats.growth = std::max(stats.growth, growth);
    stats.n_grown += growth > kMostRowGrowth;
    if (mesh.triangle_face[a] != mesh.triangle_face[b]) return;
    rows.join(sides[0], sides[1]);
    if (!rows.is_diagonal(sides[0])) return;
    const Quad quad = quad_of(mesh, sides[0], sides[1]);
    const double aspect = first_over_second(quad);
    if (!(std::max(aspect, 1 / aspect) > kRowAspect)) return;
    ++stats.n_quads;
    stats.n_good += has_angles_within(quad, kLeastRowAngleDeg, kMostRowAngleDeg);
    rows.begin(sides[0], aspect);
  });
  stats.n_continued = rows.follow();
  std::vector<double> others;
  for (std::size_t t = 0; t < quality.size(); ++t)
    if (!rows.has(static_cast<TriangleId>(t))) others.push_back(quality[t]);
  stats.n_others = static_cast<std::int64_t>(others.size());
  if (others.empty()) return stats;
  for (const double q : others) stats.mean += q / static_cast<double>(others.size());
  std::nth_element(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(others.size() / 100), others.end());
  stats.p1 = others[others.size() / 100];
  return stats;
}

}  // namespace st
