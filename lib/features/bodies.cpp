#include "features/bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace st {
namespace {

constexpr int kPlaces = 5;                // along each edge
constexpr double kConcave = radians(30);  // beyond flat: where a body stands on another one

/// One side of an edge at its places.
struct EdgeSide {
  FaceId face = kNone;
  std::array<Vec3, kPlaces> normal, inward;  // unit: out of the solid; along the face, away from the edge
};

class BodyFinder {
 public:
  BodyFinder(const Model& model, const FaceRoles& roles, std::span<const LiftingSurface> wings)
      : model_(model), t_(model.tables()), wings_(wings), is_turned_(is_material_ahead(t_, roles)) {
    const auto n = static_cast<std::size_t>(t_.n_faces());
    for (std::size_t f = 0; f < n; ++f) is_wall_.push_back(roles.role[f] == FaceRole::kWall);
    parent_.resize(n);
    std::iota(parent_.begin(), parent_.end(), 0);
    touches_wing_.assign(n, 0);
  }

  Bodies run() {
    collect_sides();
    std::erase_if(sides_, [](const auto& sides) {
      return sides.size() != 2 || sides[0].face == sides[1].face || is_concave(sides[0], sides[1]);
    });
    find_wing_faces();
    for (const std::vector<EdgeSide>& sides : sides_) join(sides);
    return assemble();
  }

 private:
  void collect_sides() {
    sides_.resize(static_cast<std::size_t>(t_.n_edges()));
    for (FaceId f = 0; f < t_.n_faces(); ++f) {
      if (!is_wall_[f]) continue;
      const auto surface = model_.surface(f);
      for (const CoedgeId c : t_.coedges(f))
        if (!t_.edge_is_degenerate[t_.coedge_edge[c]]) sides_[t_.coedge_edge[c]].push_back(side_of(f, c, *surface));
    }
  }

  /// Of the faces that profiles cross those that no concave edge parts from the trailing edge: profiles cross fairings,
  /// too.
  void find_wing_faces() {
    std::vector<std::uint8_t> is_crossed(is_wall_.size(), 0), is_trailing(static_cast<std::size_t>(t_.n_edges()), 0);
    for (const LiftingSurface& wing : wings_) {
      for (const FaceId f : wing.faces) is_crossed[f] = 1;
      for (const TrailingEdge& edge : wing.trailing) is_trailing[edge.edge] = 1;
    }
    is_wing_.assign(is_wall_.size(), 0);
    for (FaceId f = 0; f < t_.n_faces(); ++f) {
      const auto edges = t_.edges_of(f);
      is_wing_[f] = is_crossed[f] && std::any_of(edges.begin(), edges.end(), [&](EdgeId e) { return is_trailing[e]; });
    }
    for (bool has_grown = true; has_grown;) {
      has_grown = false;
      for (const std::vector<EdgeSide>& sides : sides_)
        for (std::size_t k = 0; k < 2; ++k) {
          const FaceId from = sides[k].face, to = sides[1 - k].face;
          if (!is_wing_[from] || is_wing_[to] || !is_crossed[to]) continue;
          is_wing_[to] = 1;
          has_grown = true;
        }
    }
  }

  EdgeSide side_of(FaceId f, CoedgeId c, const Surface& surface) const {
    const EdgeId e = t_.coedge_edge[c];
    const auto curve = model_.curve(e);
    const auto pcurve = model_.pcurve(f, c);
    EdgeSide side{f, {}, {}};
    for (int i = 0; i < kPlaces; ++i) {
      const double at = curve->t_min() + (curve->t_max() - curve->t_min()) * (i + 0.5) / kPlaces;
      const Vec3 n = surface_normal(surface, pcurve->point(at)), tangent = normalized(curve->evaluate(at).d1);
      side.normal[i] = (t_.face_is_reversed[f] != 0) != is_turned_ ? -n : n;
      side.inward[i] = normalized(cross(n, t_.coedge_is_reversed[c] ? -tangent : tangent));
    }
    return side;
  }

  static bool is_concave(const EdgeSide& a, const EdgeSide& b) {
    for (int i = 0; i < kPlaces; ++i)
      if (dot(b.inward[i], a.normal[i]) > 0 && angle_between(a.inward[i], b.inward[i]) <= kPi - kConcave) return true;
    return false;
  }

  FaceId root(FaceId f) {
    while (parent_[f] != f) f = parent_[f] = parent_[parent_[f]];
    return f;
  }

  void join(const std::vector<EdgeSide>& sides) {
    for (std::size_t k = 0; k < 2; ++k)
      if (is_wing_[sides[1 - k].face]) touches_wing_[sides[k].face] = 1;
    if (is_wing_[sides[0].face] || is_wing_[sides[1].face]) return;
    const FaceId a = root(sides[0].face), b = root(sides[1].face);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  Bodies assemble() {
    Bodies bodies;
    bodies.of_face.assign(is_wall_.size(), kNone);
    std::vector<Box3> box;
    for (FaceId f = 0; f < t_.n_faces(); ++f) {
      if (!is_wall_[f] || is_wing_[f]) continue;
      const FaceId first = root(f);
      if (first == f) {
        bodies.of_face[f] = static_cast<std::int32_t>(box.size());
        box.emplace_back();
        bodies.body.emplace_back();
      }
      const std::int32_t own = bodies.of_face[f] = bodies.of_face[first];
      box[own].add(t_.face_box[f]);
      bodies.body[own].is_wing_piece |= touches_wing_[f] != 0;
    }
    for (std::size_t k = 0; k < box.size(); ++k) measure(box[k], bodies.body[k]);
    return bodies;
  }

  void measure(const Box3& box, Body& body) const {
    std::array<double, 3> extent = {box.hi.x - box.lo.x, box.hi.y - box.lo.y, box.hi.z - box.lo.z};
    std::sort(extent.begin(), extent.end());
    body.diagonal = box.diagonal();
    body.girth = 0.5 * kPi * (extent[0] + extent[1]);
    double nearest = -1;
    for (const LiftingSurface& wing : wings_) {
      const NearestChord own = wing.nearest_chord(box.center());
      if (nearest >= 0 && own.distance >= nearest) continue;
      nearest = own.distance;
      body.chord = own.chord;
    }
  }

  const Model& model_;
  const ModelTables& t_;
  std::span<const LiftingSurface> wings_;
  const bool is_turned_;                                        // normals point into the material
  std::vector<std::uint8_t> is_wing_, is_wall_, touches_wing_;  // [n_faces]
  std::vector<FaceId> parent_;                                  // [n_faces] of a forest
  std::vector<std::vector<EdgeSide>> sides_;                    // of the edges of walls; later of those not concave
};

}  // namespace

Bodies find_bodies(const Model& model, const FaceRoles& roles, std::span<const LiftingSurface> wings) {
  if (wings.empty()) return {{}, std::vector<std::int32_t>(roles.role.size(), kNone)};
  return BodyFinder(model, roles, wings).run();
}

}  // namespace st
