#include "sizing/model_limits.h"

#include <algorithm>

namespace st {
namespace {

std::optional<SamplingLimits> smaller(const std::optional<SamplingLimits>& a, const std::optional<SamplingLimits>& b) {
  if (!a || !b) return a ? a : b;
  return a->max_length <= b->max_length ? a : b;
}

}  // namespace

ModelLimits model_limits(const ModelTables& t, const FaceRoles& roles, const SamplingLimits& wall) {
  ModelLimits limits;
  limits.far_length = wall.max_length;
  const auto far_length = [&](std::size_t f) { return std::max(wall.max_length, kFarLengthPerDiagonal * t.face_box[f].diagonal()); };
  for (std::size_t f = 0; f < roles.role.size(); ++f) {
    std::optional<SamplingLimits> own;
    if (roles.role[f] != FaceRole::kSymmetry) own = wall;
    if (roles.role[f] == FaceRole::kFarfield) own->max_length = far_length(f);
    if (own) limits.far_length = std::max(limits.far_length, own->max_length);
    limits.face.push_back(own);
  }
  for (const FaceId f : roles.guessed) limits.far_length = std::max(limits.far_length, far_length(f));
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
