#include "sizing/surface_metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/box_tree.h"
#include "base/threads.h"
#include "sizing/multiscale_metric.h"
#include "sizing/symmetric_tensor.h"

namespace st {
namespace {

/// Whether a node has more than the one long length that node_size tells.
bool are_triaxial(const BackgroundMesh& mesh) {
  constexpr double kEqual = 0.999;  // of 1/length^2: less is rounding of a file
  return std::any_of(mesh.node_metric.begin(), mesh.node_metric.end(), [](const SymmetricTensor& m) {
    const PrincipalAxes axes = principal_axes(matrix_of(m));
    return axes.value[1] < kEqual * axes.value[2];
  });
}

/// The tangent planes of a model, a piece for each cell of each face.
class TangentPlanes {
 public:
  TangentPlanes(const FaceCells& faces, const OctreeView& raster) {
    for (std::size_t i = 0; i < faces.leaf.size(); ++i) {
      const float *n = faces.plane[i].normal, *c = faces.plane[i].center;
      const Vec3 normal{n[0], n[1], n[2]};
      if (!(norm2(normal) > 0)) continue;
      const Vec3 centre = raster.leaf_center(faces.leaf[i]);
      const double half = 0.5 * raster.cell_edge(raster.leaf_levels[faces.leaf[i]]);
      cell_.push_back({centre - half * Vec3{1, 1, 1}, centre + half * Vec3{1, 1, 1}});
      point_.push_back(faces.origin + Vec3{c[0], c[1], c[2]});
      normal_.push_back(normalized(normal));
    }
    tree_ = BoxTree(cell_);
  }

  struct Nearest {
    double distance = 0;
    Vec3 normal;
    std::optional<Vec3> beyond_edge;  // of another face as near, at a sharp edge
  };
  /// nullopt: there is no plane.
  std::optional<Nearest> nearest_to(Vec3 x) const {
    constexpr double kSharp = 0.866;  // cosine of 30 degrees, from which on edges count as sharp
    constexpr double kAsNear = 0.05;  // of a cell's edge: more than planes of cells are off
    double best = kInfinity;
    const std::int32_t first = find(x, best, [](std::int32_t) { return true; });
    if (first < 0) return std::nullopt;
    Nearest nearest{best, normal_[first], {}};
    double other = best + kAsNear * (cell_[first].hi.x - cell_[first].lo.x);
    const std::int32_t second =
        find(x, other, [&](std::int32_t i) { return std::abs(dot(normal_[i], normal_[first])) < kSharp; });
    if (second >= 0) nearest.beyond_edge = normal_[second];
    return nearest;
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  /// To the plane's part in its cell, about.
  double distance_to(std::int32_t i, Vec3 x) const {
    const Vec3 foot = x - dot(x - point_[i], normal_[i]) * normal_[i], lo = cell_[i].lo, hi = cell_[i].hi;
    return distance(x,
                    {std::clamp(foot.x, lo.x, hi.x), std::clamp(foot.y, lo.y, hi.y), std::clamp(foot.z, lo.z, hi.z)});
  }

  /// The nearest that counts and is nearer than `best`, the first of equal ones; -1: none.
  template <class Counts>
  std::int32_t find(Vec3 x, double& best, const Counts& counts) const {
    std::int32_t found = -1;
    tree_.visit_near(
        x, [&](std::int32_t, double d2) { return d2 <= best * best; },
        [&](std::int32_t i) {
          if (!counts(i)) return;
          const double d = distance_to(i, x);
          if (!(d < best || (d == best && found >= 0 && i < found))) return;
          best = d;
          found = i;
        });
    return found;
  }

  std::vector<Box3> cell_;
  std::vector<Vec3> point_, normal_;  // of each
  BoxTree tree_;
};

/// The metric in the plane, and across it the lesser of its two eigenvalues there (1) or the larger one (2).
SymmetricTensor in_plane(const SymmetricTensor& t, Vec3 normal, std::size_t across) {
  const Eigen::Vector3d n = to_eigen(normal);
  const Eigen::Matrix3d onto = Eigen::Matrix3d::Identity() - n * n.transpose(), own = onto * matrix_of(t) * onto;
  return tensor_of(Eigen::Matrix3d(own + principal_axes(own).value[across] * n * n.transpose()));
}

LocalSize as_seen_from(const TangentPlanes::Nearest& faces, const SymmetricTensor& metric) {
  constexpr std::size_t kLong = 1, kShort = 2;
  if (!faces.beyond_edge) return size_of_metric(in_plane(metric, faces.normal, kShort));
  const LocalSize both =
      size_of_metric(intersection(in_plane(metric, faces.normal, kLong), in_plane(metric, *faces.beyond_edge, kLong)));
  const double least = size_of_metric(metric).length;  // in space: no plane cuts less
  return uniaxial({std::max(both.length, least), std::max(both.along, least), both.direction});
}

/// Those with a corner further from the faces than its longest edge.
void leave_out_far_tets(const std::vector<double>& distance_of, BackgroundMesh& mesh) {
  std::vector<std::array<std::int32_t, 4>> near;
  for (const auto& tet : mesh.tets) {
    double longest = 0, farthest = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      farthest = std::max(farthest, distance_of[tet[i]]);
      for (std::size_t k = 0; k < i; ++k)
        longest = std::max(longest, distance(mesh.node_xyz[tet[i]], mesh.node_xyz[tet[k]]));
    }
    if (farthest <= longest) near.push_back(tet);
  }
  if (near.empty()) return;
  mesh.tets = std::move(near);
  const std::vector<std::int32_t> kept = number_used_nodes(mesh);
  keep_only(kept, mesh.node_xyz);
  keep_only(kept, mesh.node_size);
}

}  // namespace

bool project_metrics(const ModelPlanes& model, BackgroundMesh& mesh) {
  if (!are_triaxial(mesh)) {
    mesh.node_metric.clear();
    return false;
  }
  constexpr std::size_t kPerPiece = 1024;
  const TangentPlanes planes(model.faces, model.raster);
  std::vector<double> distance_of(mesh.node_xyz.size(), 0);
  parallel_for(mesh.node_xyz.size(), kPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      const auto nearest = planes.nearest_to(mesh.node_xyz[n]);
      if (!nearest) continue;
      distance_of[n] = nearest->distance;
      mesh.node_size[n] = as_seen_from(*nearest, mesh.node_metric[n]);
    }
  });
  mesh.node_metric.clear();
  leave_out_far_tets(distance_of, mesh);
  return true;
}

}  // namespace st
