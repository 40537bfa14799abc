#include "features/face_roles.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <string>
#include <utility>

#include "features/flow_domain.h"

namespace st {
namespace {

constexpr double kOuterExtent = 0.25;  // smallest diagonal of an outer face's box over the model's
constexpr double kBodyExtent = 0.05;   // largest diagonal of the body's box over the model's
constexpr double kRounding = 1e-6;     // of places, over the model's diagonal
constexpr double kNearlySame = 0.01;   // difference of diagonals: 2 % of the triangles

constexpr double Vec3::*kAxes[] = {&Vec3::x, &Vec3::y, &Vec3::z};

FaceRole named_role(const ModelTables& t, std::size_t f) {
  const std::int32_t group = f < t.labels.face_group.size() ? t.labels.face_group[f] : kNone;
  if (group < 0) return FaceRole::kWall;
  const std::string& role = t.labels.group_role[group];
  return role == "farfield" ? FaceRole::kFarfield : role == "symmetry" ? FaceRole::kSymmetry : FaceRole::kWall;
}

/// Large faces that share an edge with a small one, ascending.
std::vector<FaceId> touching_faces(const ModelTables& t, const std::vector<bool>& is_large) {
  std::vector<std::int32_t> offsets;
  std::vector<FaceId> faces, touching;
  t.edge_faces(offsets, faces);
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    const auto begin = faces.begin() + offsets[e], end = faces.begin() + offsets[e + 1];
    if (std::any_of(begin, end, [&](FaceId f) { return !is_large[f]; }))
      std::copy_if(begin, end, std::back_inserter(touching), [&](FaceId f) { return is_large[f]; });
  }
  std::sort(touching.begin(), touching.end());
  touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
  return touching;
}

/// Do two plane boxes face each other, across an axis?
bool are_opposite(const Box3& a, const Box3& b, double rounding) {
  for (const auto axis : kAxes) {
    const bool are_flat = a.hi.*axis - a.lo.*axis <= rounding && b.hi.*axis - b.lo.*axis <= rounding;
    if (are_flat && std::abs(a.lo.*axis - b.lo.*axis) > rounding) return true;
  }
  return false;
}

/// A body may stand on symmetry planes: planes, no two of them opposite. A wing on its tip or a plate around its bore
/// is no domain.
bool can_be_symmetry(const ModelTables& t, std::span<const Box3> box, const std::vector<FaceId>& touching,
                     double rounding) {
  for (const FaceId f : touching) {
    if (t.face_type[f] != SurfaceType::kPlane) return false;
    for (const FaceId g : touching)
      if (are_opposite(box[f], box[g], rounding)) return false;
  }
  return true;
}

bool holds(const Box3& outer, const Box3& inner, double rounding) {
  for (const auto axis : kAxes)
    if (inner.lo.*axis < outer.lo.*axis - rounding || inner.hi.*axis > outer.hi.*axis + rounding) return false;
  return true;
}

/// Large faces around a small rest; empty when the model is not of that kind.
std::vector<FaceId> guess_outer_faces(const ModelTables& t, std::span<const Box3> face_box) {
  Box3 all, body, domain;
  for (const Box3& box : face_box) all.add(box);
  std::vector<FaceId> outer;
  std::vector<bool> is_large;
  for (FaceId f = 0; f < t.n_faces(); ++f) {
    is_large.push_back(face_box[f].diagonal() >= kOuterExtent * all.diagonal());
    (is_large.back() ? domain : body).add(face_box[f]);
    if (is_large.back()) outer.push_back(f);
  }
  const double rounding = kRounding * all.diagonal();
  const bool is_body_in_domain = !outer.empty() && !body.is_empty() && body.diagonal() > 0 &&
                                 body.diagonal() <= kBodyExtent * all.diagonal() && holds(domain, body, rounding) &&
                                 can_be_symmetry(t, face_box, touching_faces(t, is_large), rounding);
  return is_body_in_domain ? outer : std::vector<FaceId>();
}

/// Outer faces that share an edge with a wall are symmetry planes, the others far field.
void set_outer_roles(const ModelTables& t, FaceRoles& roles) {
  for (const FaceId f : roles.guessed) roles.role[f] = FaceRole::kFarfield;
  std::vector<std::int32_t> offsets;
  std::vector<FaceId> faces;
  t.edge_faces(offsets, faces);
  for (EdgeId e = 0; e < t.n_edges(); ++e) {
    const auto begin = faces.begin() + offsets[e], end = faces.begin() + offsets[e + 1];
    if (std::none_of(begin, end, [&](FaceId f) { return roles.role[f] == FaceRole::kWall; })) continue;
    for (auto f = begin; f != end; ++f)
      if (roles.role[*f] == FaceRole::kFarfield) roles.role[*f] = FaceRole::kSymmetry;
  }
}

FaceRoles roles_along(OwnAxes own, const ModelTables& t, RoleGuess guess) {
  FaceRoles roles;
  roles.own = std::move(own);
  const std::vector<Box3>& box = roles.own.face_box;
  for (std::size_t f = 0; f < static_cast<std::size_t>(t.n_faces()); ++f) roles.role.push_back(named_role(t, f));
  const auto is_wall = [](FaceRole r) { return r == FaceRole::kWall; };
  if (std::none_of(roles.role.begin(), roles.role.end(), is_wall)) {
    std::fill(roles.role.begin(), roles.role.end(), FaceRole::kWall);
  } else if (guess == RoleGuess::kAllowed && std::all_of(roles.role.begin(), roles.role.end(), is_wall)) {
    roles.guessed = guess_outer_faces(t, box);
    if (roles.guessed.empty()) roles.guessed = find_flow_domain(t, box);
    set_outer_roles(t, roles);
  }
  Box3 walls;
  for (FaceId f = 0; f < t.n_faces(); ++f)
    if (is_wall(roles.role[f])) walls.add(box[f]);
  roles.reference_diagonal = walls.diagonal();
  return roles;
}

}  // namespace

FaceRoles face_roles(const Model& model, RoleGuess guess, const Executor& executor) {
  FaceRoles in_space = face_roles(model.tables(), guess);
  OwnAxes own = find_own_axes(model, executor);
  if (own.axis == in_space.own.axis) return in_space;
  FaceRoles along = roles_along(std::move(own), model.tables(), guess);
  const double change = std::abs(along.reference_diagonal - in_space.reference_diagonal);
  if (change > kNearlySame * in_space.reference_diagonal) return along;
  in_space.own.facets = std::move(along.own.facets);
  in_space.own.deflection = along.own.deflection;
  return in_space;
}

FaceRoles face_roles(const ModelTables& t, RoleGuess guess) {
  OwnAxes of_space;
  of_space.face_box = t.face_box;
  return roles_along(std::move(of_space), t, guess);
}

bool is_material_ahead(const ModelTables& t, const FaceRoles& roles) {
  const auto has = [&](FaceRole role) {
    return std::find(roles.role.begin(), roles.role.end(), role) != roles.role.end();
  };
  return (has(FaceRole::kFarfield) && has(FaceRole::kWall)) || (t.volume && *t.volume < 0);
}

}  // namespace st
