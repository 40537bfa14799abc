#include "geometry/import/facet_plane_cut.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace st {
namespace {

constexpr double kNearEnd = 0.02;   // of a side: where it meets the plane so near to its end, the end goes there ...
constexpr double kMostMoved = 0.2;  // ... where that is less than this of the lowest height of a facet around it

class PlaneCut {
 public:
  PlaneCut(FacetMesh& mesh, const occt::SymmetryPlane& plane) : mesh_(mesh), plane_(plane) {
    for (const Corners& c : mesh.corners)
      for (const std::int32_t n : c) box_.add(mesh.x[n]);
  }

  void run() {
    put_near_nodes_on_plane();
    move_ends();
    FacetPatch all;
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t) all.triangles.push_back(t);
    all.corners = mesh_.corners;
    all.x = mesh_.x;
    std::vector<double> heights;
    for (std::size_t n = 0; n < mesh_.x.size(); ++n) {
      all.node.push_back(static_cast<std::int32_t>(n));
      heights.push_back(height(all.node.back()));
    }
    PatchDivider(mesh_).divide(all, heights);
    for (std::size_t n = heights.size(); n < mesh_.x.size(); ++n) put_on_plane(n);
    std::vector<std::uint8_t> is_kept(mesh_.corners.size());
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t)
      is_kept[t] =
          std::any_of(mesh_.corners[t].begin(), mesh_.corners[t].end(), [&](std::int32_t n) { return height(n) > 0; });
    keep_triangles(mesh_, is_kept);
  }

 private:
  double height(std::int32_t node) const { return height_above(plane_, mesh_.x[node]); }

  /// Beside a sharp edge in the plane other nodes are near it, too.
  void put_near_nodes_on_plane() {
    const Vec3 far{std::max(std::abs(box_.lo.x), std::abs(box_.hi.x)),
                   std::max(std::abs(box_.lo.y), std::abs(box_.hi.y)),
                   std::max(std::abs(box_.lo.z), std::abs(box_.hi.z))};
    std::vector<double> near(mesh_.x.size(), kSinglePrecision * std::max({far.x, far.y, far.z}));
    const std::vector<Corners> neighbours = find_neighbours(mesh_.corners);
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k)
        if (neighbours[t][k] == kNone)
          for (const int end : {k, (k + 1) % 3}) near[mesh_.corners[t][end]] = occt::kInSymmetryPlane * box_.diagonal();
    for (std::size_t n = 0; n < near.size(); ++n)
      if (std::abs(height(static_cast<std::int32_t>(n))) <= near[n]) put_on_plane(n);
  }

  void put_on_plane(std::size_t node) { component(mesh_.x[node], plane_.axis) = plane_.value; }

  /// Ends of sides that meet the plane near them, along lines between faces where there are some: else slivers remain.
  void move_ends() {
    std::vector<double> lowest(mesh_.x.size(), box_.diagonal());
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t) {
      const Corners& c = mesh_.corners[t];
      double longest = 0;
      for (int k = 0; k < 3; ++k) longest = std::max(longest, distance(mesh_.x[c[k]], mesh_.x[c[(k + 1) % 3]]));
      const double area2 = norm(area_normal(mesh_, t));
      for (const std::int32_t n : c) lowest[n] = std::min(lowest[n], longest > 0 ? area2 / longest : 0);
    }
    std::vector<std::pair<bool, Vec3>> target(mesh_.x.size());
    std::vector<std::uint8_t> moves(mesh_.x.size(), 0);
    for (std::int32_t t = 0; t < mesh_.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k)
        for (const bool is_turned : {false, true}) {
          std::int32_t a = mesh_.corners[t][k], b = mesh_.corners[t][(k + 1) % 3];
          if (is_turned) std::swap(a, b);
          const double ha = height(a), hb = height(b), share = ha / (ha - hb);
          if (!(ha * hb < 0) || share > kNearEnd) continue;
          const Vec3 x = mesh_.x[a] + share * (mesh_.x[b] - mesh_.x[a]);
          const bool is_line = mesh_.is_line[t][k];
          if (distance(x, mesh_.x[a]) > kMostMoved * lowest[a] || (moves[a] && target[a].first >= is_line)) continue;
          moves[a] = 1;
          target[a] = {is_line, x};
        }
    for (std::size_t n = 0; n < moves.size(); ++n) {
      if (!moves[n]) continue;
      mesh_.x[n] = target[n].second;
      put_on_plane(n);
    }
  }

  FacetMesh& mesh_;
  const occt::SymmetryPlane plane_;
  Box3 box_;
};

}  // namespace

void cut_at_plane(FacetMesh& mesh, const occt::SymmetryPlane& plane) { PlaneCut(mesh, plane).run(); }

}  // namespace st
