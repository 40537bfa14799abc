#include "geometry/facet/facet_normals.h"

#include <algorithm>
#include <array>

#include "geometry/shape/known_neighbours.h"

namespace st {
namespace {

constexpr int kChoices = 3;     // of weights, each for all nodes
constexpr int kRelaxings = 8;   // of normals, likewise
constexpr double kOutlier = 4;  // turning per length of a side, over that of the facets around it
constexpr int kEvenPasses = 5;  // over all sides

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
    for (int pass = 0; pass < kRelaxings; ++pass) relax(Among::kInner);
    relax(Among::kAtLines);
  }

 private:
  static constexpr std::size_t kWays = 3;  // to weight facets: as on a sphere, by angles, by areas

  /// Between two fans of facets.
  struct Side {
    std::int32_t a, b;
    Vec3 way;  // unit
  };

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
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k)
        if (mesh_.is_line[t][k]) at_line_[fan(t, k)] = at_line_[fan(t, k + 1)] = 1;
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k) {
        if (mesh_.is_line[t][k] || neighbours[t][k] < t || (at_line_[fan(t, k)] && at_line_[fan(t, k + 1)])) continue;
        sides_.push_back({fan(t, k), fan(t, k + 1), normalized(mesh_.x[node(t, k + 1)] - mesh_.x[node(t, k)])});
      }
  }

  /// For each fan the weights that make arcs of the sides around.
  void choose() {
    std::vector<std::array<double, kWays>> misfit(mesh_.normal.size(), {0, 0, 0});
    for (const Side& s : sides_) {
      if (at_line_[s.a] || at_line_[s.b]) continue;
      const double at_a = dot(mesh_.normal[s.a], s.way), at_b = dot(mesh_.normal[s.b], s.way);
      for (std::size_t way = 0; way < kWays; ++way) {
        const double from_a = dot(ways_[way][s.a], s.way) + at_b, from_b = at_a + dot(ways_[way][s.b], s.way);
        misfit[s.a][way] += from_a * from_a;
        misfit[s.b][way] += from_b * from_b;
      }
    }
    for (std::size_t n = 0; n < misfit.size(); ++n)
      mesh_.normal[n] = ways_[std::min_element(misfit[n].begin(), misfit[n].end()) - misfit[n].begin()][n];
  }

  enum class Among { kInner, kAtLines };

  /// Normals go towards what makes arcs of their sides: half of the way for both ends of inner ones, all of it for
  /// those at lines.
  void relax(Among among) {
    std::vector<Vec3> change(mesh_.normal.size());
    std::vector<std::int32_t> n_sides(mesh_.normal.size(), 0);
    const bool is_inner = among == Among::kInner;
    for (const Side& s : sides_) {
      if (is_inner == (at_line_[s.a] || at_line_[s.b])) continue;
      const Vec3 misfit = dot(mesh_.normal[s.a] + mesh_.normal[s.b], s.way) * s.way;
      for (const std::int32_t n : {s.a, s.b})
        if (is_inner || at_line_[n]) {
          change[n] -= misfit;
          ++n_sides[n];
        }
    }
    for (std::size_t n = 0; n < change.size(); ++n)
      if (n_sides[n] > 0)
        mesh_.normal[n] = normalized(mesh_.normal[n] + (is_inner ? 0.5 : 1.0) / n_sides[n] * change[n]);
  }

  std::int32_t node(std::int32_t t, int k) const { return mesh_.corners[t][k % 3]; }
  std::int32_t fan(std::int32_t t, int k) const { return mesh_.corner_normal[t][k % 3]; }

  FacetMesh& mesh_;
  std::array<std::vector<Vec3>, kWays> ways_;  // [fans] unit
  std::vector<std::uint8_t> at_line_;          // [fans]
  std::vector<Side> sides_;
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
