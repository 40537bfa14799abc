#include "features/face_roles.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace st {
namespace {

constexpr double kNearlySame = 0.01;  // difference of diagonals: 2 % of the triangles

FaceRole role_of(const ModelTables& t, FaceId f) {
  const std::size_t i = f;
  const std::int32_t group = i < t.labels.face_group.size() ? t.labels.face_group[i] : kNone;
  if (group < 0) return FaceRole::kWall;
  const std::string& role = t.labels.group_role[group];
  return role == "farfield"    ? FaceRole::kFarfield
         : role == "symmetry"  ? FaceRole::kSymmetry
         : role == "interface" ? FaceRole::kInterface
                               : FaceRole::kWall;
}

/// Whether a face is in a group of one of these roles.
bool has_group_of(const ModelTables& t, std::initializer_list<std::string_view> roles) {
  return std::ranges::any_of(t.labels.face_group, [&](std::int32_t group) {
    return group >= 0 && std::ranges::find(roles, t.labels.group_role[group]) != roles.end();
  });
}

FaceRoles roles_along(OwnAxes own, const ModelTables& t) {
  FaceRoles roles;
  roles.own = std::move(own);
  for (FaceId f = 0; f < t.n_faces(); ++f) roles.role.push_back(role_of(t, f));
  const auto has = [&](FaceRole role) {
    return std::find(roles.role.begin(), roles.role.end(), role) != roles.role.end();
  };
  roles.is_passage = !has(FaceRole::kFarfield) && has_group_of(t, {"periodic"}) && has_group_of(t, {"inlet", "outlet"});
  if (!has(FaceRole::kFarfield))
    std::replace(roles.role.begin(), roles.role.end(), FaceRole::kInterface, FaceRole::kWall);
  if (!has(FaceRole::kWall)) std::fill(roles.role.begin(), roles.role.end(), FaceRole::kWall);
  Box3 walls;
  for (FaceId f = 0; f < t.n_faces(); ++f)
    if (roles.role[f] == FaceRole::kWall) walls.add(roles.own.face_box[f]);
  roles.reference_diagonal = walls.diagonal();
  return roles;
}

}  // namespace

FaceRoles face_roles(const Model& model, const Executor& executor) {
  FaceRoles in_space = face_roles(model.tables());
  OwnAxes own = find_own_axes(model, executor);
  if (own.axis == in_space.own.axis) return in_space;
  FaceRoles along = roles_along(std::move(own), model.tables());
  const double change = std::abs(along.reference_diagonal - in_space.reference_diagonal);
  if (change > kNearlySame * in_space.reference_diagonal) return along;
  in_space.own.facets = std::move(along.own.facets);
  in_space.own.deflection = along.own.deflection;
  return in_space;
}

FaceRoles face_roles(const ModelTables& t) {
  OwnAxes of_space;
  of_space.face_box = t.face_box;
  return roles_along(std::move(of_space), t);
}

bool is_material_ahead(const ModelTables& t, const FaceRoles& roles) {
  const auto has = [&](FaceRole role) {
    return std::find(roles.role.begin(), roles.role.end(), role) != roles.role.end();
  };
  return roles.is_passage || (has(FaceRole::kFarfield) && has(FaceRole::kWall)) || (t.volume && *t.volume < 0);
}

}  // namespace st
