#include "geometry/facet/facet_faces.h"

#include <algorithm>
#include <cmath>

#include "base/disjoint_sets.h"
#include "geometry/shape/known_neighbours.h"

namespace st {
namespace {

constexpr double kNeedle = 1e-3;     // height over longest side: below, the normal is not reliable
constexpr double kFolded = 0.05;     // likewise: below, not where it opposes those of all neighbours
constexpr double kOutlier = 4;       // turning per length of a side, over that of the facets around it
constexpr int kChoices = 3;          // of normals, in turn for all nodes
constexpr int kEvenPasses = 5;       // over all sides
constexpr double kShortLine = 0.02;  // of the diagonal: a line that ends inside a region and is shorter is noise
constexpr int kNeedlesInARow = 3;    // that hand a normal on

class Splitter {
 public:
  Splitter(const FacetInput& input, double feature) : neighbours_(find_neighbours(input.corners)) {
    mesh_.x = input.x;
    mesh_.corners = input.corners;
    mesh_.part = input.part;
    mesh_.uv.resize(input.corners.size());
    find_normals();
    find_lines(std::cos(feature));
  }

  FacetMesh run() {
    find_regions();
    drop_short_ends();
    find_corner_normals();
    return std::move(mesh_);
  }

 private:
  void find_normals() {
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t) normal_.push_back(normalized(area_normal(mesh_, t)));
    for (int pass = 0; pass < kNeedlesInARow; ++pass)
      for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t) {
        std::array<double, 3> length2;
        for (int k = 0; k < 3; ++k) length2[k] = norm2(mesh_.x[node(t, k + 1)] - mesh_.x[node(t, k)]);
        const auto longest = std::max_element(length2.begin(), length2.end()) - length2.begin();
        const std::int32_t behind = neighbours_[t][longest];
        const double height = norm(area_normal(mesh_, t)) / length2[longest];
        if (behind != kNone && (height < kNeedle || (height < kFolded && is_folded(t)))) normal_[t] = normal_[behind];
      }
  }

  /// Turned against all its neighbours; at a sharp trailing edge it would not be against those of its own side.
  bool is_folded(std::int32_t t) const {
    return std::all_of(neighbours_[t].begin(), neighbours_[t].end(),
                       [&](std::int32_t other) { return other == kNone || dot(normal_[t], normal_[other]) < 0; });
  }

  void find_lines(double cosine) {
    mesh_.is_line.resize(mesh_.corners.size());
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k) {
        const std::int32_t other = neighbours_[t][k];
        mesh_.is_line[t][k] =
            other == kNone || mesh_.part[t] != mesh_.part[other] || dot(normal_[t], normal_[other]) < cosine;
      }
  }

  void find_regions() {
    DisjointSets sets(mesh_.n_triangles());
    for_each_smooth([&](std::int32_t t, int, std::int32_t other) { sets.join(t, other); });
    mesh_.face.assign(mesh_.corners.size(), kNone);
    std::int32_t n_faces = 0;
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t)
      mesh_.face[t] = sets.find(t) == t ? n_faces++ : mesh_.face[sets.find(t)];
  }

  /// Chains of lines that begin at a node without another line and have one region on both sides.
  void drop_short_ends() {
    Box3 box;
    for (const Vec3 x : mesh_.x) box.add(x);
    std::vector<std::vector<std::int32_t>> at(mesh_.x.size());  // sides of lines at each node, once each
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k)
        if (mesh_.is_line[t][k] && (neighbours_[t][k] == kNone || node(t, k) < node(t, k + 1)))
          for (const std::int32_t n : {node(t, k), node(t, k + 1)}) at[n].push_back(3 * t + k);
    for (std::size_t n = 0; n < at.size(); ++n) {
      if (at[n].size() != 1) continue;
      std::vector<std::int32_t> chain;
      double length = 0;
      for (std::int32_t end = static_cast<std::int32_t>(n), side = at[n][0]; side != kNone;) {
        const std::int32_t a = node(side / 3, side % 3), b = node(side / 3, side % 3 + 1);
        chain.push_back(side);
        length += distance(mesh_.x[a], mesh_.x[b]);
        end = end == a ? b : a;
        side = at[end].size() != 2 ? kNone : at[end][0] == side ? at[end][1] : at[end][0];
      }
      const bool is_inside = std::all_of(chain.begin(), chain.end(), [&](std::int32_t s) {
        const std::int32_t other = neighbours_[s / 3][s % 3];
        return other != kNone && mesh_.face[other] == mesh_.face[s / 3] && mesh_.part[other] == mesh_.part[s / 3];
      });
      if (is_inside && length < kShortLine * box.diagonal())
        for (const std::int32_t s : chain) drop(s / 3, s % 3);
    }
  }

  void drop(std::int32_t t, int k) {
    mesh_.is_line[t][k] = 0;
    const std::int32_t other = neighbours_[t][k];
    for (int m = 0; m < 3; ++m)
      if (neighbours_[other][m] == t && node(other, m) == node(t, k + 1)) mesh_.is_line[other][m] = 0;
  }

  void find_corner_normals() {
    std::vector<Corners> smooth = neighbours_;  // but for those across lines
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k)
        if (mesh_.is_line[t][k]) smooth[t][k] = kNone;
    const std::vector<std::int32_t> fans = find_fans(mesh_.corners, smooth);
    mesh_.corner_normal.resize(mesh_.corners.size());
    std::array<std::vector<Vec3>, 3> ways;  // by weights of facets: as on a round surface, their angles, areas
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k) {
        const std::int32_t fan = fans[3 * t + k];
        if (fan == static_cast<std::int32_t>(ways[0].size()))
          for (auto& way : ways) way.emplace_back();
        const Vec3 x = mesh_.x[node(t, k)], a = mesh_.x[node(t, k + 1)] - x, b = mesh_.x[node(t, k + 2)] - x;
        const double area = norm(cross(a, b)), sides2 = norm2(a) * norm2(b);
        if (sides2 > 0) ways[0][fan] += area / sides2 * normal_[t];
        ways[1][fan] += angle_between(a, b) * normal_[t];
        ways[2][fan] += area * normal_[t];
        mesh_.corner_normal[t][k] = fan;
      }
    for (auto& way : ways)
      for (Vec3& n : way) n = normalized(n);
    choose_normals(ways);
    for (int pass = 0; pass < kEvenPasses; ++pass) even_out_normals();
  }

  /// Of each fan the one that makes arcs of the sides around: normals at the ends of an arc are square, in sum, to its
  /// chord. Those at lines, with facets on one side alone, follow from the arcs that end there.
  void choose_normals(const std::array<std::vector<Vec3>, 3>& ways) {
    mesh_.normal = ways[0];
    std::vector<std::uint8_t> at_line(mesh_.normal.size(), 0);
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k)
        if (mesh_.is_line[t][k]) at_line[mesh_.corner_normal[t][k]] = at_line[mesh_.corner_normal[t][(k + 1) % 3]] = 1;
    for (int pass = 0; pass < kChoices; ++pass) {
      std::vector<std::array<double, 3>> misfit(mesh_.normal.size(), {0, 0, 0});
      for_each_side([&](std::int32_t a, std::int32_t b, Vec3 side) {
        if (at_line[a] || at_line[b]) return;
        const double at_a = dot(mesh_.normal[a], side), at_b = dot(mesh_.normal[b], side);
        for (std::size_t way = 0; way < ways.size(); ++way) {
          const double from_a = dot(ways[way][a], side) + at_b, from_b = at_a + dot(ways[way][b], side);
          misfit[a][way] += from_a * from_a;
          misfit[b][way] += from_b * from_b;
        }
      });
      for (std::size_t n = 0; n < misfit.size(); ++n)
        mesh_.normal[n] = ways[std::min_element(misfit[n].begin(), misfit[n].end()) - misfit[n].begin()][n];
    }
    follow_arcs(at_line);
  }

  void follow_arcs(const std::vector<std::uint8_t>& at_line) {
    std::vector<Vec3> change(mesh_.normal.size());
    std::vector<double> n_sides(mesh_.normal.size(), 0);
    for_each_side([&](std::int32_t a, std::int32_t b, Vec3 side) {
      if (at_line[a] == at_line[b]) return;
      const std::int32_t own = at_line[a] ? a : b;
      change[own] -= dot(mesh_.normal[a] + mesh_.normal[b], side) * side;
      ++n_sides[own];
    });
    for (std::size_t n = 0; n < change.size(); ++n)
      if (n_sides[n] > 0) mesh_.normal[n] = normalized(mesh_.normal[n] + change[n] / n_sides[n]);
  }

  template <class Visit>
  void for_each_side(const Visit& visit) const {
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k)
        visit(mesh_.corner_normal[t][k], mesh_.corner_normal[t][(k + 1) % 3],
              normalized(mesh_.x[node(t, k + 1)] - mesh_.x[node(t, k)]));
  }

  /// Ends of a short side, as needles have it, get one normal where it would turn by far more per length than the
  /// facets around it do: no surface bends like that.
  void even_out_normals() {
    std::vector<double> sum(mesh_.normal.size(), 0), area(mesh_.normal.size(), 0);
    const auto rate = [&](std::int32_t t, int k) {
      const double length = distance(mesh_.x[node(t, k)], mesh_.x[node(t, k + 1)]);
      const Corners& n = mesh_.corner_normal[t];
      return length > 0 ? distance(mesh_.normal[n[k]], mesh_.normal[n[(k + 1) % 3]]) / length : 0.0;
    };
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t) {
      const double own = norm(area_normal(mesh_, t)), most = std::max({rate(t, 0), rate(t, 1), rate(t, 2)});
      for (const std::int32_t n : mesh_.corner_normal[t]) {
        sum[n] += own * most;
        area[n] += own;
      }
    }
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k) {
        const std::int32_t a = mesh_.corner_normal[t][k], b = mesh_.corner_normal[t][(k + 1) % 3];
        if (!(rate(t, k) > kOutlier * std::max(sum[a] / area[a], sum[b] / area[b]))) continue;
        mesh_.normal[a] = mesh_.normal[b] = normalized(mesh_.normal[a] + mesh_.normal[b]);
      }
  }

  template <class Visit>
  void for_each_smooth(const Visit& visit) const {
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k)
        if (!mesh_.is_line[t][k]) visit(t, k, neighbours_[t][k]);
  }

  std::int32_t node(std::int32_t t, int k) const { return mesh_.corners[t][k % 3]; }

  std::vector<Corners> neighbours_;
  std::vector<Vec3> normal_;  // of triangles, those of needles from behind
  FacetMesh mesh_;
};

}  // namespace

FacetMesh find_smooth_faces(const FacetInput& input, double feature) { return Splitter(input, feature).run(); }

}  // namespace st
