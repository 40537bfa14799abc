#include "sizing/model_limits.h"

#include <algorithm>
#include <string>

namespace st {
namespace {

enum class Role { kWall, kFarfield, kSymmetry };

std::vector<Role> face_roles(const ModelTables& t) {
  std::vector<Role> roles(static_cast<std::size_t>(t.n_faces()), Role::kWall);
  bool has_wall = false;
  for (std::size_t f = 0; f < roles.size(); ++f) {
    const std::int32_t group = f < t.face_group.size() ? t.face_group[f] : kNone;
    const std::string& role = group >= 0 ? t.group_role[group] : std::string();
    roles[f] = role == "farfield" ? Role::kFarfield : role == "symmetry" ? Role::kSymmetry : Role::kWall;
    has_wall = has_wall || roles[f] == Role::kWall;
  }
  if (!has_wall) std::fill(roles.begin(), roles.end(), Role::kWall);
  return roles;
}

std::optional<SamplingLimits> smaller(const std::optional<SamplingLimits>& a, const std::optional<SamplingLimits>& b) {
  if (!a || !b) return a ? a : b;
  return a->max_length <= b->max_length ? a : b;
}

}  // namespace

ModelLimits model_limits(const ModelTables& t, const SamplingLimits& wall) {
  ModelLimits limits;
  limits.far_length = wall.max_length;
  const std::vector<Role> roles = face_roles(t);
  for (std::size_t f = 0; f < roles.size(); ++f) {
    std::optional<SamplingLimits> own;
    if (roles[f] != Role::kSymmetry) own = wall;
    if (roles[f] == Role::kFarfield) own->max_length = std::max(wall.max_length, kFarLengthPerDiagonal * t.face_box[f].diagonal());
    if (own) limits.far_length = std::max(limits.far_length, own->max_length);
    limits.face.push_back(own);
  }
  limits.far = wall;
  limits.far.max_length = limits.far_length;
  std::vector<std::int32_t> offsets;
  std::vector<FaceId> faces;
  t.edge_faces(offsets, faces);
  for (std::size_t e = 0; e < static_cast<std::size_t>(t.n_edges()); ++e) {
    std::optional<SamplingLimits> own;
    for (std::int32_t k = offsets[e]; k < offsets[e + 1]; ++k) own = smaller(own, limits.face[faces[k]]);
    if (offsets[e] == offsets[e + 1]) own = wall;
    if (t.edge_is_degenerate[e]) own.reset();
    limits.edge.push_back(own);
  }
  return limits;
}

}  // namespace st
