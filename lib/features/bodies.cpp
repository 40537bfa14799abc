#include "features/bodies.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/disjoint_sets.h"
#include "features/concave_edges.h"
#include "geometry/model/edge_faces.h"

namespace st {
namespace {

class BodyFinder {
 public:
  BodyFinder(const Model& model, const FaceRoles& roles, std::span<const LiftingSurface> wings)
      : t_(model.tables()), own_box_(roles.own.face_box), wings_(wings), sets_(t_.n_faces()) {
    const auto n = static_cast<std::size_t>(t_.n_faces());
    is_wing_.assign(n, 0);
    for (const LiftingSurface& wing : wings)
      for (const FaceId f : wing.faces) is_wing_[f] = 1;
    for (std::size_t f = 0; f < n; ++f) is_wall_.push_back(roles.role[f] == FaceRole::kWall);
    touches_wing_.assign(n, 0);
  }

  Bodies run(std::span<const std::uint8_t> is_concave) {
    const EdgeFaces faces_at(t_);
    for (EdgeId e = 0; e < t_.n_edges(); ++e)
      if (!is_concave[e] && !t_.edge_is_degenerate[e] && faces_at[e].size() == 2) join(faces_at[e][0], faces_at[e][1]);
    return assemble();
  }

 private:
  void join(FaceId a, FaceId b) {
    if (!is_wall_[a] || !is_wall_[b]) return;
    if (is_wing_[a]) touches_wing_[b] = 1;
    if (is_wing_[b]) touches_wing_[a] = 1;
    if (is_wing_[a] || is_wing_[b]) return;
    sets_.join(a, b);
  }

  Bodies assemble() {
    Bodies bodies;
    bodies.of_face.assign(is_wall_.size(), kNone);
    std::vector<Box3> box, own_box;
    for (FaceId f = 0; f < t_.n_faces(); ++f) {
      if (!is_wall_[f] || is_wing_[f] || t_.is_joined(f)) continue;
      const FaceId first = sets_.find(f);
      if (first == f) {
        bodies.of_face[f] = static_cast<std::int32_t>(box.size());
        box.emplace_back();
        own_box.emplace_back();
        bodies.body.emplace_back();
      }
      const std::int32_t own = bodies.of_face[f] = bodies.of_face[first];
      box[own].add(t_.face_box[f]);
      own_box[own].add(own_box_[f]);
      bodies.body[own].is_wing_piece |= touches_wing_[f] != 0;
    }
    for (std::size_t k = 0; k < box.size(); ++k) measure(own_box[k], box[k].center(), bodies.body[k]);
    return bodies;
  }

  void measure(const Box3& box, Vec3 center, Body& body) const {
    std::array<double, 3> extent = {box.hi.x - box.lo.x, box.hi.y - box.lo.y, box.hi.z - box.lo.z};
    std::sort(extent.begin(), extent.end());
    body.diagonal = box.diagonal();
    body.girth = 0.5 * kPi * (extent[0] + extent[1]);
    double nearest = -1;
    for (const LiftingSurface& wing : wings_) {
      const NearestChord own = wing.nearest_chord(center);
      if (nearest >= 0 && own.distance >= nearest) continue;
      nearest = own.distance;
      body.chord = own.chord;
    }
  }

  const ModelTables& t_;
  std::span<const Box3> own_box_;  // [n_faces]
  std::span<const LiftingSurface> wings_;
  std::vector<std::uint8_t> is_wing_, is_wall_, touches_wing_;  // [n_faces]
  DisjointSets sets_;                                           // of faces
};

}  // namespace

Bodies find_bodies(const Model& model, const FaceRoles& roles, std::span<const LiftingSurface> wings) {
  if (wings.empty()) return {{}, std::vector<std::int32_t>(roles.role.size(), kNone)};
  return BodyFinder(model, roles, wings).run(find_concave_edges(model, roles));
}

}  // namespace st
