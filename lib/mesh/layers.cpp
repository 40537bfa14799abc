#include "mesh/layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "base/box_tree.h"
#include "base/lists_by_key.h"
#include "base/threads.h"

namespace st {
namespace {

constexpr double kSharp = -0.5;       // cosine between normals of neighbours, at most: 120 degrees, where one direction
                                      // makes layers 1 / cos(60 degrees) = 2 times as high
constexpr double kOtherPlane = 0.01;  // square of the sine between normals of two planes, at least: 6 degrees
constexpr std::size_t kNodesPerPiece = 4096;

/// Where a segment from `x` along `way` meets a triangle, as a share of `way` (Moeller and Trumbore 1997).
std::optional<double> meets(Vec3 x, Vec3 way, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 ab = b - a, ac = c - a, p = cross(way, ac);
  const double det = dot(ab, p);
  if (det == 0) return std::nullopt;
  const Vec3 ax = x - a, q = cross(ax, ab);
  const double u = dot(ax, p) / det, v = dot(way, q) / det, t = dot(ac, q) / det;
  if (u < 0 || v < 0 || u + v > 1 || t <= 0 || t >= 1) return std::nullopt;
  return t;
}

/// Segments from a point, and boxes they may meet.
class Segment {
 public:
  Segment(Vec3 x, Vec3 way) : x_(x), per_way_{1 / way.x, 1 / way.y, 1 / way.z} {}

  /// May be true for boxes that are missed by rounding.
  bool meets(const Box3& box) const {
    double from = 0, to = 1;
    const auto clip = [&](double x, double per_way, double lo, double hi) {
      const double a = (lo - x) * per_way, b = (hi - x) * per_way;
      if (std::isnan(a) || std::isnan(b)) return;  // runs in one of the box's planes
      from = std::max(from, std::min(a, b));
      to = std::min(to, std::max(a, b));
    };
    clip(x_.x, per_way_.x, box.lo.x, box.hi.x);
    clip(x_.y, per_way_.y, box.lo.y, box.hi.y);
    clip(x_.z, per_way_.z, box.lo.z, box.hi.z);
    return from <= to * kAbove;
  }

 private:
  static constexpr double kAbove = 1 + 1e-12;
  Vec3 x_, per_way_;
};

class LayersCheck {
 public:
  LayersCheck(const SurfaceMesh& mesh, std::span<const LayerRole> roles, const LayerOptions& options)
      : mesh_(mesh),
        roles_(roles),
        options_(options),
        triangles_(cells_of_nodes(mesh.triangles, static_cast<std::size_t>(mesh.n_nodes()))) {
    find_normals();
  }

  LayersReport run() {
    check_edges();
    set_boxes();
    const auto n = static_cast<std::size_t>(mesh_.n_nodes());
    std::vector<NodeAnswer> answers(n);
    parallel_for(n, kNodesPerPiece, [&](std::size_t begin, std::size_t end) {
      std::vector<Vec3> normals;
      for (std::size_t i = begin; i < end; ++i) answers[i] = answer(static_cast<NodeId>(i), normals);
    });
    for (std::size_t i = 0; i < n; ++i) take(static_cast<NodeId>(i), answers[i]);
    return std::move(report_);
  }

 private:
  struct NodeAnswer {
    double cosine = 2;  // least between direction and normals; 2: not on a wall
    double room = 1;
  };

  LayerRole role(TriangleId t) const { return roles_[mesh_.triangle_group[t]]; }
  Vec3 corner(TriangleId t, std::size_t k) const { return mesh_.node_xyz[mesh_.triangles[t].n[k]]; }

  void find_normals() {
    normal_.resize(static_cast<std::size_t>(mesh_.n_triangles()));
    std::vector<double> sides;
    for (TriangleId t = 0; t < mesh_.n_triangles(); ++t) {
      const Vec3 area = cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
      normal_[t] = (options_.is_inside ? -1.0 : 1.0) * normalized(area);
      if (role(t) == LayerRole::kWall) sides.push_back(std::sqrt(norm(area) * 2 / std::sqrt(3.0)));
    }
    if (sides.empty()) return;
    const auto middle = sides.begin() + static_cast<std::ptrdiff_t>(sides.size() / 2);
    std::nth_element(sides.begin(), middle, sides.end());
    report_.median = *middle;
  }

  void check_edges() {
    is_sharp_.assign(static_cast<std::size_t>(mesh_.n_nodes()), 0);
    edges_of(mesh_).for_each_edge([&](NodeId low, NodeId high, std::span<const SideId> sides) {
      if (sides.size() != 2) return;
      const TriangleId a = sides[0] / 3, b = sides[1] / 3;
      if (role(a) != LayerRole::kWall || role(b) != LayerRole::kWall || dot(normal_[a], normal_[b]) > kSharp) return;
      const NodeId apex = mesh_.triangles[b].n[(sides[1] + 2) % 3];
      const Vec3 x = mesh_.node_xyz[low], y = mesh_.node_xyz[high];
      const bool is_wedge = dot(normal_[a], mesh_.node_xyz[apex] - x) > 0;
      const DefectPlace place{0.5 * (x + y), mesh_.triangle_face[a], mesh_.triangle_face[b]};
      (is_wedge ? report_.wedges : report_.fans).add(place);
      (is_wedge ? report_.wedge_length : report_.fan_length) += distance(x, y);
      is_sharp_[low] = is_sharp_[high] = 1;
    });
  }

  void set_boxes() {
    for (TriangleId t = 0; t < mesh_.n_triangles(); ++t) {
      if (role(t) != LayerRole::kWall) continue;
      boxes_.emplace_back();
      walls_.push_back(t);
      for (std::size_t k = 0; k < 3; ++k) boxes_.back().add(corner(t, k));
    }
    tree_ = BoxTree(boxes_);
  }

  NodeAnswer answer(NodeId node, std::vector<Vec3>& normals) const {
    normals.clear();
    std::array<Vec3, 2> planes = {};  // on the line between two planes: both, square to each other
    for (const TriangleId t : triangles_[node]) {
      const Vec3 n = normal_[t];
      if (role(t) == LayerRole::kWall && norm2(n) > 0) normals.push_back(n);
      if (role(t) != LayerRole::kPlane) continue;
      if (norm2(planes[0]) == 0) planes[0] = n;
      const Vec3 rest = n - dot(n, planes[0]) * planes[0];
      if (norm2(planes[1]) == 0 && norm2(rest) > kOtherPlane) planes[1] = normalized(rest);
    }
    if (normals.empty()) return {};
    Vec3 direction = smallest_cone(normals);
    for (const Vec3 plane : planes) direction = normalized(direction - dot(direction, plane) * plane);
    NodeAnswer own{1, 1};
    for (const Vec3 n : normals) own.cosine = std::min(own.cosine, dot(n, direction));
    if (own.cosine > 0) own.room = room(node, 2 * options_.height * direction);
    return own;
  }

  /// How far a wall that does not touch the node is along `way`, as a share of it; at most 1.
  double room(NodeId node, Vec3 way) const {
    const Vec3 x = mesh_.node_xyz[node];
    double least = 1;
    const Segment segment(x, way);
    tree_.visit_near(
        x, [&](std::int32_t at, double) { return segment.meets(tree_.nodes()[at].box); },
        [&](std::int32_t item) {
          const TriangleId t = walls_[item];
          const auto& own = mesh_.triangles[t].n;
          if (std::ranges::find(own, node) != std::end(own) || !segment.meets(boxes_[item])) return;
          if (const auto share = meets(x, way, corner(t, 0), corner(t, 1), corner(t, 2)))
            least = std::min(least, *share);
        });
    return least;
  }

  void take(NodeId node, const NodeAnswer& own) {
    if (own.cosine > 1.5) return;
    ++report_.n_nodes;
    const DefectPlace place{mesh_.node_xyz[node], mesh_.triangle_face[triangles_[node].front()], kNone};
    const double angle = std::acos(std::clamp(own.cosine, -1.0, 1.0));
    if (angle > report_.widest) {
      report_.widest = angle;
      report_.widest_at = place.xyz;
    }
    if (own.cosine <= 0 && !is_sharp_[node]) report_.blind.add(place);
    if (own.room < 1) report_.tight.add(place);
    report_.room = std::min(report_.room, own.room);
  }

  const SurfaceMesh& mesh_;
  std::span<const LayerRole> roles_;
  const LayerOptions options_;
  const ListsByKey<> triangles_;  // by node
  LayersReport report_;
  std::vector<Vec3> normal_;            // [n_triangles] into the flow, unit
  std::vector<std::uint8_t> is_sharp_;  // [n_nodes] 1: on a fan's or wedge's edge
  std::vector<TriangleId> walls_;
  std::vector<Box3> boxes_;
  BoxTree tree_;
};

}  // namespace

Vec3 smallest_cone(std::span<const Vec3> directions) {
  constexpr double kInside = 1e-9;
  Vec3 axis = directions[0];
  double cosine = 1;
  const auto set = [&](Vec3 own, Vec3 on_rim) {
    axis = normalized(own);
    cosine = dot(axis, on_rim);
  };
  const auto is_outside = [&](Vec3 x) { return dot(axis, x) < cosine - kInside; };
  for (std::size_t i = 1; i < directions.size(); ++i) {
    const Vec3 a = directions[i];
    if (!is_outside(a)) continue;
    set(a, a);
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3 b = directions[j];
      if (!is_outside(b)) continue;
      set(a + b, a);
      for (std::size_t k = 0; k < j; ++k) {
        const Vec3 c = directions[k];
        if (!is_outside(c)) continue;
        const Vec3 around = cross(b - a, c - a);
        set(dot(around, a) < 0 ? -1.0 * around : around, a);
      }
    }
  }
  return axis;
}

LayersReport check_layers(const SurfaceMesh& mesh, std::span<const LayerRole> roles, const LayerOptions& options) {
  return LayersCheck(mesh, roles, options).run();
}

double boundary_layer_thickness(double reynolds, double length) { return 0.37 * length / std::pow(reynolds, 0.2); }

}  // namespace st
