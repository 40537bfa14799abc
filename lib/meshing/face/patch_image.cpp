#include "meshing/face/patch_image.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace st {
namespace {

/// Corners 1 and 2 of each triangle change places.
void turn_over(FacePatch& p) {
  for (Triangle& t : p.triangles) std::swap(t.n[1], t.n[2]);
  std::vector<std::pair<std::int32_t, Vec2>> corners;
  for (std::size_t i = 0; i < p.uv_corner.size(); ++i) {
    const std::int32_t c = p.uv_corner[i], k = c % 3;
    corners.push_back({c - k + (3 - k) % 3, p.own_uv[i]});
  }
  std::sort(corners.begin(), corners.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < corners.size(); ++i) std::tie(p.uv_corner[i], p.own_uv[i]) = corners[i];
}

}  // namespace

FacePatch image_of(const FacePatch& patch, const FaceImage& image) {
  FacePatch p = patch;
  p.face = image.face;
  p.inner_previous.clear();
  p.triangle_previous.clear();
  std::vector<std::pair<RimPlace, std::int32_t>> places;
  for (std::int32_t i = 0; i < patch.n_boundary; ++i)
    places.push_back({image.boundary({patch.boundary_dim[i], patch.boundary_entity[i], patch.boundary_index[i]}), i});
  std::sort(places.begin(), places.end());
  std::vector<NodeId> number(patch.n_boundary + patch.inner_xyz.size());
  std::iota(number.begin(), number.end(), 0);
  for (std::int32_t i = 0; i < patch.n_boundary; ++i) {
    std::tie(p.boundary_dim[i], p.boundary_entity[i], p.boundary_index[i]) = places[i].first;
    number[places[i].second] = i;
  }
  for (Vec3& x : p.inner_xyz) x = image.motion(x);
  for (Triangle& t : p.triangles)
    for (NodeId& n : t.n) n = number[n];
  if (image.is_turned_over) turn_over(p);
  return p;
}

}  // namespace st
