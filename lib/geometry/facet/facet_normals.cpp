#include "geometry/facet/facet_normals.h"

#include <algorithm>
#include <array>

#include "base/eigen.h"
#include "base/lists_by_key.h"
#include "base/threads.h"
#include "geometry/shape/known_neighbours.h"

namespace st {
namespace {

constexpr int kChoices = 3;                   // of weights, each for all nodes
constexpr int kMostPasses = 100;              // of normals, over those that still turn
constexpr double kStill = 1e-3;               // radians: a normal that would turn by less stays
constexpr double kHeld = 0.05;                // of the weight of its sides: a normal's own, where these run one way
constexpr double kMostTilt = 0.9;             // cosine to the facets' normal, at least
constexpr double kOutlier = 4;                // turning per length of a side, over that of the facets around it
constexpr std::size_t kFansPerPiece = 16384;  // whose weights a thread chooses at once
constexpr int kEvenPasses = 5;                // over all sides

/// Normals at the ends of an arc are square, in sum, to its chord: so are they at the sides of facets on a smooth
/// surface, to the second order.
class ArcNormals {
 public:
  ArcNormals(FacetMesh& mesh, const std::vector<Corners>& neighbours, const std::vector<Vec3>& triangle_normal)
      : mesh_(mesh) {
    find_ways(neighbours, triangle_normal);
    find_sides(neighbours);
  }

  void run() {
    mesh_.normal = ways_[0];
    for (int pass = 0; pass < kChoices; ++pass) choose();
    relax();
    for (std::size_t n = 0; n < at_line_.size(); ++n)
      if (at_line_[n]) follow_arcs(static_cast<std::int32_t>(n));
  }

 private:
  static constexpr std::size_t kWays = 3;  // to weight facets: as on a sphere, by angles, by areas

  void find_ways(std::vector<Corners> smooth, const std::vector<Vec3>& triangle_normal) {
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k)
        if (mesh_.is_line[t][k]) smooth[t][k] = kNone;
    const std::vector<std::int32_t> fans = find_fans(mesh_.corners, smooth);
    mesh_.corner_normal.resize(mesh_.corners.size());
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k) {
        const std::int32_t fan = fans[3 * t + k];
        if (fan == static_cast<std::int32_t>(ways_[0].size()))
          for (auto& way : ways_) way.emplace_back();
        const Vec3 x = mesh_.x[node(t, k)], a = mesh_.x[node(t, k + 1)] - x, b = mesh_.x[node(t, k + 2)] - x;
        const double area = norm(cross(a, b)), sides2 = norm2(a) * norm2(b);
        if (sides2 > 0) ways_[0][fan] += area / sides2 * triangle_normal[t];
        ways_[1][fan] += angle_between(a, b) * triangle_normal[t];
        ways_[2][fan] += area * triangle_normal[t];
        mesh_.corner_normal[t][k] = fan;
      }
    for (auto& way : ways_)
      for (Vec3& n : way) n = normalized(n);
  }

  /// Without those along lines: there facets lie on one side alone.
  void find_sides(const std::vector<Corners>& neighbours) {
    at_line_.assign(ways_[0].size(), 0);
    node_.resize(at_line_.size());
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k) {
        node_[fan(t, k)] = node(t, k);
        if (mesh_.is_line[t][k]) at_line_[fan(t, k)] = at_line_[fan(t, k + 1)] = 1;
      }
    beside_ = {at_line_.size(), [&](const auto& visit) {
                 for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t)
                   for (int k = 0; k < 3; ++k) {
                     const std::int32_t a = fan(t, k), b = fan(t, k + 1);
                     if (mesh_.is_line[t][k] || neighbours[t][k] <= t || (at_line_[a] && at_line_[b])) continue;
                     visit(a, b);
                     visit(b, a);
                   }
               }};
  }

  /// Calls visit(other fan, unit vector there) for the sides of a fan.
  template <class Visit>
  void for_each_beside(std::int32_t n, const Visit& visit) const {
    for (const std::int32_t other : beside_[static_cast<std::size_t>(n)])
      visit(other, normalized(mesh_.x[node_[other]] - mesh_.x[node_[n]]));
  }

  /// For each fan the weights that make arcs of the sides around.
  void choose() {
    const std::vector<Vec3> before = mesh_.normal;
    parallel_for(before.size(), kFansPerPiece, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n)
        if (!at_line_[n]) mesh_.normal[n] = ways_[best_way(static_cast<std::int32_t>(n), before)][n];
    });
  }

  std::size_t best_way(std::int32_t n, const std::vector<Vec3>& before) const {
    std::array<double, kWays> misfit{};
    for_each_beside(n, [&](std::int32_t other, Vec3 side) {
      if (at_line_[other]) return;
      const double there = dot(before[other], side);
      for (std::size_t way = 0; way < kWays; ++way) {
        const double sum = dot(ways_[way][n], side) + there;
        misfit[way] += sum * sum;
      }
    });
    return static_cast<std::size_t>(std::min_element(misfit.begin(), misfit.end()) - misfit.begin());
  }

  /// Normals turn to what makes arcs of their sides, one after the other, until all stay.
  void relax() {
    const std::vector<Vec3> facets_normal = mesh_.normal;
    std::vector<std::uint8_t> turns(at_line_.size(), 1);
    bool is_still = false;
    for (int pass = 0; pass < kMostPasses && !is_still; ++pass) {
      is_still = true;
      for (std::size_t n = 0; n < turns.size(); ++n) {
        if (!turns[n] || at_line_[n]) continue;
        turns[n] = 0;
        const auto own = static_cast<std::int32_t>(n);
        const Vec3 normal = relaxed(own);
        if (distance(normal, mesh_.normal[n]) < kStill || dot(normal, facets_normal[n]) < kMostTilt) continue;
        mesh_.normal[n] = normal;
        is_still = false;
        turns[n] = 1;
        for (const std::int32_t other : beside_[n]) turns[other] = 1;
      }
    }
  }

  Vec3 relaxed(std::int32_t n) const {
    const Vec3 own = mesh_.normal[n];
    Eigen::Matrix3d sides = Eigen::Matrix3d::Zero();
    Vec3 misfit{};
    double n_sides = 0;
    for_each_beside(n, [&](std::int32_t other, Vec3 side) {
      if (at_line_[other]) return;
      sides += to_eigen(side) * to_eigen(side).transpose();
      misfit += dot(own + mesh_.normal[other], side) * side;
      ++n_sides;
    });
    if (!(n_sides > 0)) return own;
    sides += n_sides * (to_eigen(own) * to_eigen(own).transpose() + kHeld * Eigen::Matrix3d::Identity());
    const auto change = solve<3>(sides, to_eigen(misfit), 0);
    return change ? normalized(own - to_vec3(*change)) : own;
  }

  /// At a line, all of the way to what makes arcs of the sides that end there.
  void follow_arcs(std::int32_t n) {
    Vec3 misfit{};
    double n_sides = 0;
    for_each_beside(n, [&](std::int32_t other, Vec3 side) {
      misfit += dot(mesh_.normal[n] + mesh_.normal[other], side) * side;
      ++n_sides;
    });
    if (n_sides > 0) mesh_.normal[n] = normalized(mesh_.normal[n] - misfit / n_sides);
  }

  std::int32_t node(std::int32_t t, int k) const { return mesh_.corners[t][k % 3]; }
  std::int32_t fan(std::int32_t t, int k) const { return mesh_.corner_normal[t][k % 3]; }

  FacetMesh& mesh_;
  std::array<std::vector<Vec3>, kWays> ways_;  // [fans] unit
  std::vector<std::uint8_t> at_line_;          // [fans]
  std::vector<std::int32_t> node_;             // [fans]
  ListsByKey<> beside_;                        // other fans across sides, by fan
};

/// Ends of a short side, as needles have it, get one normal where it would turn by far more per length than the facets
/// around it do: no surface bends like that.
void even_out_normals(FacetMesh& mesh) {
  std::vector<double> sum(mesh.normal.size(), 0), area(mesh.normal.size(), 0);
  const auto rate = [&](std::int32_t t, int k) {
    const double length = distance(mesh.x[mesh.corners[t][k]], mesh.x[mesh.corners[t][(k + 1) % 3]]);
    const Corners& n = mesh.corner_normal[t];
    return length > 0 ? distance(mesh.normal[n[k]], mesh.normal[n[(k + 1) % 3]]) / length : 0.0;
  };
  for (std::int32_t t = 0; t < mesh.n_triangles(); ++t) {
    const double own = norm(area_normal(mesh, t)), most = std::max({rate(t, 0), rate(t, 1), rate(t, 2)});
    for (const std::int32_t n : mesh.corner_normal[t]) {
      sum[n] += own * most;
      area[n] += own;
    }
  }
  for (std::int32_t t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::int32_t a = mesh.corner_normal[t][k], b = mesh.corner_normal[t][(k + 1) % 3];
      if (!(rate(t, k) > kOutlier * std::max(sum[a] / area[a], sum[b] / area[b]))) continue;
      mesh.normal[a] = mesh.normal[b] = normalized(mesh.normal[a] + mesh.normal[b]);
    }
}

}  // namespace

void set_corner_normals(FacetMesh& mesh, const std::vector<Corners>& neighbours,
                        const std::vector<Vec3>& triangle_normal) {
  ArcNormals(mesh, neighbours, triangle_normal).run();
  for (int pass = 0; pass < kEvenPasses; ++pass) even_out_normals(mesh);
}

}  // namespace st
