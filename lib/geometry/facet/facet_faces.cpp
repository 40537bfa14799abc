#include "geometry/facet/facet_faces.h"

#include <algorithm>
#include <cmath>

#include "base/disjoint_sets.h"
#include "geometry/facet/facet_normals.h"
#include "geometry/shape/known_neighbours.h"

namespace st {
namespace {

constexpr double kNeedle = 1e-3;     // height over longest side: below, the normal is not reliable
constexpr double kFolded = 0.05;     // likewise: below, not where it opposes those of all neighbours
constexpr double kSameSide = 0.94;   // cosine between facets of one side: 20 degrees
constexpr double kShortLine = 0.02;  // of the diagonal: a line that ends inside a region and is shorter is noise
constexpr int kIsland = 3;           // facets: lines around so few within one region are noise
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
    if (drop_islands(find_regions())) find_regions();
    drop_short_ends();
    set_corner_normals(mesh_, neighbours_, normal_);
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
        if (behind != kNone && !is_beside_knife(t, behind) && (height < kNeedle || (height < kFolded && is_folded(t))))
          normal_[t] = normal_[behind];
      }
  }

  /// At a sharp trailing edge, with one side of the wing and turned against the other one, `behind`.
  bool is_beside_knife(std::int32_t t, std::int32_t behind) const {
    return dot(normal_[t], normal_[behind]) < kKnife && std::ranges::any_of(neighbours_[t], [&](std::int32_t other) {
             return other != kNone && dot(normal_[t], normal_[other]) > kSameSide;
           });
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

  /// Returns how many there are.
  std::int32_t find_regions() {
    DisjointSets sets(mesh_.n_triangles());
    for_each_smooth([&](std::int32_t t, int, std::int32_t other) { sets.join(t, other); });
    mesh_.face.assign(mesh_.corners.size(), kNone);
    std::int32_t n_faces = 0;
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t)
      mesh_.face[t] = sets.find(t) == t ? n_faces++ : mesh_.face[sets.find(t)];
    return n_faces;
  }

  /// Lines around a few facets that one other region encloses. Returns whether there were any.
  bool drop_islands(std::int32_t n_regions) {
    constexpr FaceId kSeveral = kNone - 1;
    std::vector<std::int32_t> n_facets(static_cast<std::size_t>(n_regions), 0);
    std::vector<FaceId> around(n_facets.size(), kNone);
    for (const FaceId f : mesh_.face) ++n_facets[f];
    const auto for_each_line = [&](const auto& visit) {
      for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t)
        for (int k = 0; k < 3; ++k)
          if (n_facets[mesh_.face[t]] <= kIsland && mesh_.is_line[t][k]) visit(t, k, neighbours_[t][k]);
    };
    for_each_line([&](std::int32_t t, int, std::int32_t other) {
      FaceId& own = around[mesh_.face[t]];
      const FaceId there = other == kNone || mesh_.part[t] != mesh_.part[other] ? kSeveral : mesh_.face[other];
      own = own == kNone || own == there ? there : kSeveral;
    });
    bool is_any = false;
    for_each_line([&](std::int32_t t, int k, std::int32_t) {
      if (around[mesh_.face[t]] < 0) return;
      drop(t, k);
      is_any = true;
    });
    return is_any;
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
