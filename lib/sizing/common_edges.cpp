#include "sizing/common_edges.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "base/limits.h"
#include "geometry/model/edge_faces.h"
#include "geometry/shape/projection.h"

namespace st {

CommonEdges::CommonEdges(const Model& model) : model_(model) {
  const EdgeFaces faces(model.tables());
  for (EdgeId e = 0; e < model.tables().n_edges(); ++e)
    for (std::size_t i = 0; i < faces[e].size(); ++i)
      for (std::size_t k = i + 1; k < faces[e].size(); ++k)
        if (faces[e][i] != faces[e][k]) uses_.push_back({faces[e][i], faces[e][k], e});
  std::ranges::sort(uses_);
}

std::optional<Vec3> CommonEdges::nearest(FaceId a, FaceId b, Vec3 x) const {
  if (a > b) std::swap(a, b);
  std::optional<Vec3> result;
  for (auto use = std::ranges::lower_bound(uses_, Use{a, b, 0}); use != uses_.end() && use->a == a && use->b == b;
       ++use) {
    const std::unique_ptr<Curve> curve = model_.curve(use->edge);
    if (!curve) continue;
    const Vec3 foot = closest_point(*curve, x).x;
    if (!result || distance(foot, x) < distance(*result, x)) result = foot;
  }
  return result;
}

}  // namespace st
