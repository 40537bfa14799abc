// Patches in sections.
#pragma once

#include <vector>

#include "mesh/corner_uv.h"
#include "mesh/surface_mesh.h"

namespace st::test {

/// The first half of the triangles, which owns all nodes inside, and the other half.
inline std::vector<FacePatch> in_two(const FacePatch& whole) {
  const std::vector<Vec2> uv = corner_uvs(whole);
  const std::size_t n = whole.triangles.size(), ends[] = {0, n / 2, n};
  std::vector<FacePatch> two;
  for (int i = 0; i < 2; ++i) {
    FacePatch s = whole;
    s.triangles.assign(whole.triangles.begin() + static_cast<std::ptrdiff_t>(ends[i]),
                       whole.triangles.begin() + static_cast<std::ptrdiff_t>(ends[i + 1]));
    for (std::int32_t k = 0; i == 0 && k < whole.n_boundary; ++k) s.boundary_number.push_back(k);
    for (std::int32_t k = 0; i == 1 && k < std::ssize(whole.inner_xyz); ++k) s.owner.push_back({0, k});
    set_corner_uvs(std::span(uv).subspan(3 * ends[i], 3 * s.triangles.size()), s);
    two.push_back(std::move(s));
  }
  return two;
}

}  // namespace st::test
