// Patches in sections.
#pragma once

#include <vector>

#include "mesh/corner_uv.h"
#include "mesh/patch_section.h"

namespace st::test {

/// The first half of the triangles, which owns all nodes inside, and the other half.
inline std::vector<PatchSection> in_two(const FacePatch& whole) {
  const std::vector<Vec2> uv = corner_uvs(whole);
  const std::size_t n = whole.triangles.size(), ends[] = {0, n / 2, n};
  std::vector<PatchSection> two;
  for (int i = 0; i < 2; ++i) {
    PatchSection s{whole};
    s.patch.triangles.assign(whole.triangles.begin() + static_cast<std::ptrdiff_t>(ends[i]),
                             whole.triangles.begin() + static_cast<std::ptrdiff_t>(ends[i + 1]));
    s.is_whole_boundary = i == 1;
    for (std::int32_t k = 0; k < whole.n_boundary; ++k) s.boundary_number.push_back(k);
    for (std::int32_t k = 0; k < static_cast<std::int32_t>(whole.inner_xyz.size()); ++k) {
      s.shared.push_back(k);
      s.shared_key.push_back(inner_key(0, k));
    }
    s.n_foreign = i == 1 ? static_cast<std::int32_t>(whole.inner_xyz.size()) : 0;
    set_corner_uvs(std::span(uv).subspan(3 * ends[i], 3 * s.patch.triangles.size()), s.patch);
    two.push_back(std::move(s));
  }
  return two;
}

}  // namespace st::test
