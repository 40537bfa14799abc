#include "meshing/face/fold_repair.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include "base/eigen.h"
#include "base/sort_once.h"
#include "mesh/adjacency.h"
#include "meshing/face/scaled_field.h"
#include "meshing/face/triangle_places.h"

namespace st {
namespace {

constexpr double kLeastCosine = 0;                // between a normal and the way from the axis
constexpr std::array kCoarser = {1.0, 2.0, 4.0};  // times the requested lengths: fewer nodes may fold less
constexpr std::array kRings = {4, 3, 2, 1};       // about the folded triangles: as many as one plane allows
constexpr std::size_t kMostNodes = 2000;          // of a place: the cost is quadratic
constexpr int kMostPlaces = 200;                  // that are tried: damaged surfaces fold all over
constexpr int kSteps = 40;                        // of Newton's method
constexpr double kFound = 1e-9;                   // of the extent of the place: distance from the foot looked for

/// A line inside the body that the surface of a place can be seen from all around: lengths along it, and angles about
/// it.
struct Axis {
  Vec3 origin, along, up;  ///< up: angle 0, across `along`
  double radius = 1;       ///< model unit; length of an angle of 1
  double sign = 1;         ///< -1: the surface's normals point to the axis

  Vec3 across(Vec3 x) const { return (x - origin) - dot(x - origin, along) * along; }
  Vec2 place_of(Vec3 x) const {
    const Vec3 r = across(x);
    return {dot(x - origin, along), sign * radius * std::atan2(dot(r, cross(up, along)), dot(r, up))};
  }
  /// Change of the angle, as a length, per step at x.
  Vec3 turning(Vec3 x) const {
    const Vec3 r = across(x);
    return (sign * radius / norm2(r)) * cross(r, along);
  }
};

/// A point of a surface, its place about an axis, and which of all seeds it is.
struct Seed {
  Vec2 st, uv;
  std::size_t number;
};

struct HashOfPlace {
  std::size_t operator()(Vec2 p) const {
    constexpr std::uint64_t kMix = 0x9e3779b97f4a7c15;                                 // 2^64 over the golden ratio
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };  // of -0 as of 0
    return ((bits(p.x) * kMix ^ bits(p.y)) * kMix) >> 16;
  }
};

/// A part of a surface by its places about an axis. For one thread.
class SeenSurface final : public Surface {
 public:
  /// `nodes`: what searches begin at; some.
  SeenSurface(const Surface& surface, const Axis& axis, const std::vector<const FaceNode*>& nodes)
      : surface_(surface), axis_(axis) {
    u_min_ = v_min_ = 1e300;
    u_max_ = v_max_ = -1e300;
    for (const FaceNode* n : nodes) {
      const Vec2 st = axis_.place_of(n->x);
      seeds_.push_back({st, n->uv, seeds_.size()});
      u_min_ = std::min(u_min_, st.x), u_max_ = std::max(u_max_, st.x);
      v_min_ = std::min(v_min_, st.y), v_max_ = std::max(v_max_, st.y);
    }
    std::ranges::sort(seeds_, {}, [](const Seed& s) { return std::pair(s.st.x, s.number); });
  }

  struct Foot {
    Vec2 uv;
    SurfacePoint p;  // there, with derivatives by (s,t)
  };

  /// Of the point at a place; nullopt: not found. Each place is looked for once: meshes with other lengths ask again.
  const std::optional<Foot>& foot(Vec2 st) const {
    const auto [it, is_new] = feet_.try_emplace(st);
    if (is_new) it->second = find_foot(st);
    return it->second;
  }

  Vec3 point(Vec2 st) const override { return evaluate(st).x; }
  /// A cylinder about the axis where there is no point.
  SurfacePoint evaluate(Vec2 st) const override {
    if (const auto& found = foot(st)) return found->p;
    const double angle = axis_.sign * st.y / axis_.radius;
    const Vec3 aside = cross(axis_.up, axis_.along), out = std::cos(angle) * axis_.up + std::sin(angle) * aside;
    return {axis_.origin + st.x * axis_.along + axis_.radius * out, axis_.along, axis_.sign * cross(out, axis_.along)};
  }
  SurfacePoint2 evaluate2(Vec2 st) const override {
    const SurfacePoint p = evaluate(st);
    return {p.x, p.du, p.dv, {}, {}, {}};
  }

 private:
  std::optional<Foot> find_foot(Vec2 st) const {
    Vec2 uv = nearest_seed(st).uv;
    SurfacePoint p = surface_.evaluate(uv);
    Vec2 miss = st - axis_.place_of(p.x);
    const double enough = kFound * std::hypot(u_max_ - u_min_, v_max_ - v_min_);
    for (int step = 0; step < kSteps && norm(miss) > enough; ++step) {
      const auto way = solve(change_of(p), to_eigen(miss), 0);
      if (!way) return std::nullopt;
      double part = 1;
      for (; part > 1e-3; part *= 0.5) {
        const Vec2 next = within(uv + part * to_vec2(*way));
        const SurfacePoint there = surface_.evaluate(next);
        const Vec2 left = st - axis_.place_of(there.x);
        if (!(norm(left) < norm(miss))) continue;
        uv = next, p = there, miss = left;
        break;
      }
      if (part <= 1e-3) return std::nullopt;
    }
    if (norm(miss) > enough) return std::nullopt;
    const Eigen::Matrix2d m = change_of(p), way = adjugate(m) / m.determinant();
    return Foot{uv, {p.x, way(0, 0) * p.du + way(1, 0) * p.dv, way(0, 1) * p.du + way(1, 1) * p.dv}};
  }
  /// The first of the nearest ones: distances count, not their squares. Looks at seeds outward along s, while these may
  /// be as near by that alone.
  const Seed& nearest_seed(Vec2 st) const {
    constexpr double kSameRoot = 1 + 8 * std::numeric_limits<double>::epsilon();  // of squares: no root of more is less
    const Seed *const begin = seeds_.data(), *const end = begin + seeds_.size(), *nearest = nullptr;
    const Seed* up = std::ranges::lower_bound(begin, end, st.x, {}, [](const Seed& s) { return s.st.x; });
    const Seed* down = up;
    double nearest2 = std::numeric_limits<double>::infinity(), least = nearest2;
    const auto may_be_near = [&](const Seed& s) {
      const double along = s.st.x - st.x;
      return along * along <= kSameRoot * nearest2;
    };
    while (true) {
      const bool goes_up = up != end && may_be_near(*up), goes_down = down != begin && may_be_near(down[-1]);
      if (!goes_up && !goes_down) break;
      const Seed& s = goes_up && (!goes_down || up->st.x - st.x < st.x - down[-1].st.x) ? *up++ : *--down;
      const Vec2 way = s.st - st;
      const double d2 = dot(way, way);
      if (!(d2 <= kSameRoot * nearest2)) continue;
      const double d = std::sqrt(d2);
      if (!nearest || std::pair(d, s.number) < std::pair(least, nearest->number)) nearest = &s, least = d;
      nearest2 = std::min(nearest2, d2);
    }
    if (nearest) return *nearest;
    return *std::ranges::find(seeds_, 0u, &Seed::number);  // none is at a distance that is a number
  }
  /// Of (s,t) per (u,v).
  Eigen::Matrix2d change_of(const SurfacePoint& p) const {
    const Vec3 turning = axis_.turning(p.x);
    Eigen::Matrix2d m;
    m << dot(p.du, axis_.along), dot(p.dv, axis_.along), dot(p.du, turning), dot(p.dv, turning);
    return m;
  }
  Vec2 within(Vec2 uv) const {
    return {std::clamp(uv.x, surface_.u_min(), surface_.u_max()), std::clamp(uv.y, surface_.v_min(), surface_.v_max())};
  }

  const Surface& surface_;
  const Axis axis_;
  std::vector<Seed> seeds_;                                                  // ascending in s
  mutable std::unordered_map<Vec2, std::optional<Foot>, HashOfPlace> feet_;  // by place
};

/// The axis that points with these normals are seen from best; nullopt: none sees them all.
std::optional<Axis> find_axis(const std::vector<Vec3>& points, const std::vector<Vec3>& normals) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Vec3 mean, middle;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum += to_eigen(normals[i]) * to_eigen(normals[i]).transpose();
    mean = mean + normals[i];
    middle = middle + points[i] / static_cast<double>(points.size());
  }
  Axis axis;
  axis.along = principal_axes(sum).axis[0];
  axis.up = normalized(mean - dot(mean, axis.along) * axis.along);
  const Vec3 aside = cross(axis.up, axis.along);
  double low = 0, high = 0, extent = 0;  // the normals' angles; extent across
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double angle = std::atan2(dot(normals[i], aside), dot(normals[i], axis.up));
    low = std::min(low, angle), high = std::max(high, angle);
    extent = std::max(extent, norm(points[i] - middle));
  }
  const double turn = 0.5 * (low + high);
  axis.up = std::cos(turn) * axis.up + std::sin(turn) * aside;
  double best = kLeastCosine;
  std::optional<Axis> found;
  const Vec3 up = axis.up;
  for (const double sign : {1.0, -1.0})
    for (const double depth : {0.3, 0.6, 1.0, 2.0, 5.0, 20.0}) {
      axis.sign = sign;
      axis.up = sign * up;
      axis.radius = depth * extent;
      axis.origin = middle - axis.radius * axis.up;
      double least = 1;
      for (std::size_t i = 0; i < points.size(); ++i)
        least = std::min(least, sign * dot(normalized(axis.across(points[i])), normals[i]));
      if (least > best) best = least, found = axis;
    }
  return found;
}

class FoldRepair {
 public:
  FoldRepair(const Surface& surface, const FaceBoundary& boundary, const SizeField& field,
             const FaceMeshOptions& options, const FaceMesh& mesh)
      : surface_(surface), field_(field), options_(options), nodes_(boundary.nodes), first_inner_(nodes_.size()) {
    nodes_.insert(nodes_.end(), mesh.inner.begin(), mesh.inner.end());
    for (std::size_t i = 0; i < mesh.corners.size(); i += 3)
      triangles_.push_back({{mesh.corners[i], mesh.corners[i + 1], mesh.corners[i + 2]}});
    add_normals();
  }

  /// The folds that are left.
  std::vector<std::size_t> run() {
    std::vector<std::size_t> folds = find_folds();
    for (const int rings : kRings) {
      if (folds.empty()) break;
      std::vector<std::uint8_t> is_gone(triangles_.size(), 0);
      std::vector<Triangle> added;
      bool has_changed = false;
      for (const TrianglePlace& place :
           places_about(triangles_, static_cast<std::int64_t>(nodes_.size()), folds, rings)) {
        if (!mesh_again(place, added)) continue;
        has_changed = true;
        for (const std::size_t t : place.triangles) is_gone[t] = 1;
      }
      if (!has_changed) continue;
      std::vector<Triangle> kept;
      for (std::size_t t = 0; t < triangles_.size(); ++t)
        if (!is_gone[t]) kept.push_back(triangles_[t]);
      kept.insert(kept.end(), added.begin(), added.end());
      triangles_ = std::move(kept);
      add_normals();
      folds = find_folds();
    }
    return folds;
  }

  void store(const std::vector<std::size_t>& folds, FaceMesh& mesh) const {
    std::vector<std::int32_t> number(nodes_.size(), kNone);
    for (std::size_t i = 0; i < first_inner_; ++i) number[i] = static_cast<std::int32_t>(i);
    for (const Triangle& t : triangles_)
      for (const NodeId n : t.n) number[n] = n;
    mesh.inner.clear();
    mesh.corners.clear();
    for (std::size_t i = first_inner_; i < nodes_.size(); ++i) {
      if (number[i] == kNone) continue;
      number[i] = static_cast<std::int32_t>(first_inner_ + mesh.inner.size());
      mesh.inner.push_back(nodes_[i]);
    }
    for (const Triangle& t : triangles_)
      for (const NodeId n : t.n) mesh.corners.push_back(number[n]);
    mesh.n_folds = static_cast<int>(folds.size());
    mesh.refinement.clear();
    for (std::size_t i = 0; i < std::min(folds.size(), kMostRefined); ++i) {
      const NodeId* n = triangles_[folds[i]].n;
      const Vec3 a = nodes_[n[0]].x, b = nodes_[n[1]].x, c = nodes_[n[2]].x;
      mesh.refinement.push_back({(a + b + c) / 3, 0.5 * std::max({distance(a, b), distance(b, c), distance(c, a)})});
    }
  }

 private:
  /// A triangle for each that is turned against the surface, and for each pair that is folded onto each other.
  std::vector<std::size_t> find_folds() const {
    std::vector<std::size_t> folds;
    std::vector<Vec3> normal;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const NodeId* n = triangles_[t].n;
      normal.push_back(normalized(cross(nodes_[n[1]].x - nodes_[n[0]].x, nodes_[n[2]].x - nodes_[n[0]].x)));
      if (dot(normal[t], normal_[n[0]] + normal_[n[1]] + normal_[n[2]]) < 0) folds.push_back(t);
    }
    EdgeTable(triangles_, static_cast<std::int64_t>(nodes_.size()))
        .for_each_edge([&](NodeId, NodeId, std::span<const SideId> sides) {
          if (sides.size() != 2 || dot(normal[sides[0] / 3], normal[sides[1] / 3]) > kFoldedCosine) return;
          folds.push_back(static_cast<std::size_t>(sides[0] / 3));
        });
    return folds;
  }

  /// Of the surface at the nodes that have none yet.
  void add_normals() {
    for (std::size_t i = normal_.size(); i < nodes_.size(); ++i)
      normal_.push_back(surface_normal(surface_, nodes_[i].uv));
  }

  /// Appends the new triangles, and their nodes to all nodes. False: nothing better was found, nothing has changed.
  bool mesh_again(const TrianglePlace& place, std::vector<Triangle>& added) {
    if (place.loop.empty() || place.triangles.size() > 2 * kMostNodes || n_tried_ == kMostPlaces) return false;
    ++n_tried_;
    std::vector<NodeId> nodes;
    for (const std::size_t t : place.triangles) nodes.insert(nodes.end(), triangles_[t].n, triangles_[t].n + 3);
    sort_once(nodes);
    std::vector<const FaceNode*> of_place;
    std::vector<Vec3> points, normals;
    for (const NodeId n : nodes) {
      if (nodes_[n].is_pole) return false;
      of_place.push_back(&nodes_[n]);
      points.push_back(nodes_[n].x);
      normals.push_back(normal_[n]);
    }
    const auto axis = find_axis(points, normals);
    if (!axis) return false;
    const SeenSurface seen(surface_, *axis, of_place);
    FaceBoundary rim;
    for (std::size_t i = 0; i < place.loop.size(); ++i) {
      FaceNode n = nodes_[place.loop[i]];
      n.uv = axis->place_of(n.x);
      n.id = static_cast<std::int32_t>(i);
      rim.nodes.push_back(n);
      rim.segments.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>((i + 1) % place.loop.size())});
    }
    FaceMesh fresh;
    fresh.n_folds = place.n_seeds;
    for (const double scale : kCoarser) {
      FaceMesh trial = mesh_face(seen, rim, ScaledField(field_, scale), options_);
      if (trial.cause == FailureCause::kNone && trial.n_folds < fresh.n_folds && find_feet(seen, trial)) fresh = trial;
      if (fresh.n_folds == 0) break;
    }
    if (fresh.n_folds == place.n_seeds) return false;
    const auto first = static_cast<std::int32_t>(nodes_.size()), n_rim = static_cast<std::int32_t>(rim.nodes.size());
    nodes_.insert(nodes_.end(), fresh.inner.begin(), fresh.inner.end());
    const auto corner = [&](std::int32_t c) { return c < n_rim ? place.loop[c] : first + c - n_rim; };
    for (std::size_t i = 0; i < fresh.corners.size(); i += 3)
      added.push_back({{corner(fresh.corners[i]), corner(fresh.corners[i + 1]), corner(fresh.corners[i + 2])}});
    return true;
  }

  static bool find_feet(const SeenSurface& seen, FaceMesh& mesh) {
    for (FaceNode& n : mesh.inner) {
      const auto& foot = seen.foot(n.uv);
      if (!foot) return false;
      n.uv = foot->uv;
    }
    return true;
  }

  const Surface& surface_;
  const SizeField& field_;
  const FaceMeshOptions& options_;
  std::vector<FaceNode> nodes_;  // of the boundary, then inside
  const std::size_t first_inner_;
  std::vector<Triangle> triangles_;
  std::vector<Vec3> normal_;
  int n_tried_ = 0;  // places
};

}  // namespace

void repair_folds(const Surface& surface, const FaceBoundary& boundary, const SizeField& field,
                  const FaceMeshOptions& options, FaceMesh& mesh) {
  if (mesh.n_folds == 0 || mesh.cause != FailureCause::kNone) return;
  FoldRepair repair(surface, boundary, field, options, mesh);
  const std::vector<std::size_t> folds = repair.run();
  if (static_cast<int>(folds.size()) < mesh.n_folds) repair.store(folds, mesh);
}

}  // namespace st
