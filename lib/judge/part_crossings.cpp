#include "judge/part_crossings.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "base/boxes.h"

namespace st {
namespace {

/// Pairs of faces of two parts whose boxes meet.
struct NearParts {
  std::vector<std::pair<FaceId, FaceId>> faces;
  std::size_t n_compared = 0, n_found = 0;

  bool is_done() const { return n_compared == faces.size() || n_found == kMaxCrossings; }
};

/// Pairs come by the numbers of the parts.
using AllNearParts = std::map<std::pair<std::int32_t, std::int32_t>, NearParts>;

AllNearParts near_parts(const ModelTables& t, const FaceParts& parts) {
  AllNearParts all;
  for (FaceId a = 0; a < t.n_faces(); ++a)
    for (FaceId b = a + 1; b < t.n_faces(); ++b) {
      if (parts.placement[a] == parts.placement[b] || !meet(t.face_box[a], t.face_box[b])) continue;
      const std::pair<std::int32_t, std::int32_t> numbers = std::minmax(parts.part[a], parts.part[b]);
      if (!parts.left_out.contains(numbers)) all[numbers].faces.emplace_back(a, b);
    }
  return all;
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

PartCrossings find_part_crossings(const Model& model, const FaceParts& parts) {
  PartCrossings result;
  AllNearParts all = near_parts(model.tables(), parts);
  std::size_t n_compared = 0;
  for (bool goes_on = true; goes_on && n_compared < kMaxComparedPairs;) {
    goes_on = false;
    for (auto& [numbers, near] : all) {
      if (near.is_done() || n_compared == kMaxComparedPairs) continue;
      goes_on = true;
      ++n_compared;
      const auto [a, b] = near.faces[near.n_compared++];
      if (const auto crossing = crossing_of(model, a, b)) {
        result.found.push_back(*crossing);
        ++near.n_found;
      }
    }
  }
  for (const auto& [numbers, near] : all)
    if (!near.is_done()) result.n_left += near.faces.size() - near.n_compared;
  std::sort(result.found.begin(), result.found.end(), [](const PartCrossing& a, const PartCrossing& b) {
    return std::pair(a.first, a.second) < std::pair(b.first, b.second);
  });
  return result;
}

}  // namespace st
