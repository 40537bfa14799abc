#include "judge/part_crossings.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace st {
namespace {

bool overlap(const Box3& a, const Box3& b) {
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y && a.lo.z <= b.hi.z &&
         b.lo.z <= a.hi.z;
}

std::vector<std::pair<FaceId, FaceId>> near_pairs(const ModelTables& t, std::span<const std::int32_t> placement) {
  std::vector<std::pair<FaceId, FaceId>> pairs;
  for (FaceId a = 0; a < t.n_faces(); ++a)
    for (FaceId b = a + 1; b < t.n_faces(); ++b)
      if (placement[a] != placement[b] && overlap(t.face_box[a], t.face_box[b])) pairs.emplace_back(a, b);
  return pairs;
}

std::optional<PartCrossing> crossing_of(const Model& model, FaceId a, FaceId b) {
  for (const FaceContact& c : model.contacts(a, b)) {
    if (!c.passes_through) continue;
    Box3 box;
    for (const Vec3 x : c.points) box.add(x);
    return PartCrossing{a, b, c.points[c.points.size() / 2], box.diagonal()};
  }
  return std::nullopt;
}

}  // namespace

PartCrossings find_part_crossings(const Model& model, std::span<const std::int32_t> placement) {
  PartCrossings result;
  const std::vector<std::pair<FaceId, FaceId>> pairs = near_pairs(model.tables(), placement);
  result.n_near = pairs.size();
  for (const auto& [a, b] : pairs) {
    if (result.n_compared == kMaxComparedPairs || result.found.size() == kMaxCrossings) break;
    ++result.n_compared;
    if (const auto crossing = crossing_of(model, a, b)) result.found.push_back(*crossing);
  }
  return result;
}

}  // namespace st
