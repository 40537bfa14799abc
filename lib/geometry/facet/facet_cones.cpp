#include "geometry/facet/facet_cones.h"

#include <algorithm>
#include <numeric>

#include "base/axis.h"

namespace st {
namespace {

constexpr double kCone = 0.5;   // cosine of 60 degrees: a projection stretches by 2 at most
constexpr double kFold = -0.5;  // cosine of 120 degrees between neighbours

/// By the axis along which the patch is longest: the half of the triangles that lies higher is 1.
std::vector<std::int32_t> halves(const FacetPatch& patch) {
  const std::size_t n = patch.corners.size();
  Box3 box;
  for (const Vec3 x : patch.x) box.add(x);
  const int axis = longest_axis(box);
  const auto along = [&](std::size_t t) {
    const auto& [a, b, c] = patch.corners[t];
    return component(patch.x[a] + patch.x[b] + patch.x[c], axis);
  };
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return along(a) < along(b); });
  std::vector<std::int32_t> group(n, 0);
  for (std::size_t i = n / 2; i < n; ++i) group[order[i]] = n > 1 ? 1 : 0;
  return group;
}

std::vector<Vec3> normals_of(const FacetPatch& patch) {
  std::vector<Vec3> normal;
  for (const Corners& c : patch.corners)
    normal.push_back(normalized(cross(patch.x[c[1]] - patch.x[c[0]], patch.x[c[2]] - patch.x[c[0]])));
  return normal;
}

}  // namespace

bool is_folded(const FacetPatch& patch) {
  const std::vector<Vec3> normal = normals_of(patch);
  for (std::size_t t = 0; t < normal.size(); ++t)
    for (const std::int32_t other : patch.neighbours[t])
      if (other != kNone && dot(normal[t], normal[other]) < kFold) return true;
  return false;
}

std::vector<std::int32_t> part_by_normals(const FacetPatch& patch) {
  const std::size_t n = patch.corners.size();
  const std::vector<Vec3> normal = normals_of(patch);
  std::vector<double> area;
  for (const Corners& c : patch.corners)
    area.push_back(norm(cross(patch.x[c[1]] - patch.x[c[0]], patch.x[c[2]] - patch.x[c[0]])));
  std::vector<std::int32_t> seeds(n), group(n, kNone);
  std::iota(seeds.begin(), seeds.end(), 0);
  std::stable_sort(seeds.begin(), seeds.end(), [&](std::int32_t a, std::int32_t b) { return area[a] > area[b]; });
  std::int32_t n_groups = 0;
  for (const std::int32_t seed : seeds) {
    if (group[seed] != kNone) continue;
    group[seed] = n_groups;
    std::vector<std::int32_t> open{seed};
    while (!open.empty()) {
      const std::int32_t t = open.back();
      open.pop_back();
      for (const std::int32_t other : patch.neighbours[t]) {
        if (other == kNone || group[other] != kNone || !(dot(normal[other], normal[seed]) >= kCone)) continue;
        group[other] = n_groups;
        open.push_back(other);
      }
    }
    ++n_groups;
  }
  return n_groups > 1 ? group : halves(patch);
}

}  // namespace st
