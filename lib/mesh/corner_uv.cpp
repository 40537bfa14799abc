#include "mesh/corner_uv.h"

#include <algorithm>

namespace st {
namespace {

NodeId node_at(const FacePatch& patch, std::size_t corner) { return patch.triangles[corner / 3].n[corner % 3]; }

/// Place in own_uv of the first corner not before this one.
std::size_t first_own(const FacePatch& patch, std::size_t corner) {
  return static_cast<std::size_t>(
      std::lower_bound(patch.uv_corner.begin(), patch.uv_corner.end(), static_cast<std::int64_t>(corner)) -
      patch.uv_corner.begin());
}

bool is_own(const FacePatch& patch, std::size_t own, std::size_t corner) {
  return own < patch.uv_corner.size() && patch.uv_corner[own] == static_cast<std::int64_t>(corner);
}

}  // namespace

Vec2 corner_uv(const FacePatch& patch, std::size_t corner) {
  const std::size_t own = first_own(patch, corner);
  if (is_own(patch, own, corner)) return patch.own_uv[own];
  return patch.inner_uv[node_at(patch, corner) - patch.n_boundary];
}

std::vector<Vec2> corner_uvs(const FacePatch& patch, std::size_t begin, std::size_t end) {
  std::vector<Vec2> uvs(3 * (end - begin));
  Vec2* uv = uvs.data();
  std::size_t c = 3 * begin, own = first_own(patch, c);
  for (std::size_t t = begin; t < end; ++t)
    for (const NodeId n : patch.triangles[t].n)
      *uv++ = is_own(patch, own, c++) ? patch.own_uv[own++] : patch.inner_uv[n - patch.n_boundary];
  return uvs;
}

void set_corner_uvs(std::span<const Vec2> all, FacePatch& patch) {
  patch.uv_corner.clear();
  patch.own_uv.clear();
  std::int32_t c = 0;
  for (const Triangle& t : patch.triangles)
    for (const NodeId n : t.n) {
      const Vec2 uv = all[c++];
      if (n >= patch.n_boundary && patch.inner_uv[n - patch.n_boundary] == uv) continue;
      patch.uv_corner.push_back(c - 1);
      patch.own_uv.push_back(uv);
    }
}

bool has_all_uv(const FacePatch& patch) {
  if (patch.uv_corner.size() != patch.own_uv.size()) return false;
  std::size_t own = 0;
  for (std::size_t c = 0; c < 3 * patch.triangles.size(); ++c) {
    if (is_own(patch, own, c))
      ++own;
    else if (node_at(patch, c) < patch.n_boundary)
      return false;
  }
  return own == patch.uv_corner.size();
}

}  // namespace st
