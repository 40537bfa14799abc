#include "meshing/face/face_patch.h"

#include <algorithm>

namespace st {

FacePatch make_patch(const ModelTables& t, FaceId face, const FaceBoundary& boundary, const FaceMesh& mesh,
                     const BoundaryNumbering& numbering) {
  FacePatch patch;
  patch.face = face;
  const std::int32_t n_local = static_cast<std::int32_t>(boundary.nodes.size());
  std::vector<std::pair<std::int32_t, std::int32_t>> by_id;  // (global id, local)
  for (std::int32_t i = 0; i < n_local; ++i) by_id.push_back({boundary.nodes[i].id, i});
  std::sort(by_id.begin(), by_id.end());
  std::vector<std::int32_t> number(n_local);
  for (std::size_t i = 0; i < by_id.size(); ++i) {
    if (i == 0 || by_id[i].first != by_id[i - 1].first) {
      const auto entity = numbering.entity(by_id[i].first);
      patch.boundary_dim.push_back(static_cast<std::uint8_t>(entity.dim));
      patch.boundary_entity.push_back(entity.entity);
      patch.boundary_index.push_back(entity.index);
      ++patch.n_boundary;
    }
    number[by_id[i].second] = patch.n_boundary - 1;
  }
  patch.inner_xyz.reserve(mesh.inner.size());
  patch.inner_uv.reserve(mesh.inner.size());
  patch.inner_size.reserve(mesh.inner.size());
  patch.triangles.reserve(mesh.corners.size() / 3);
  for (const FaceNode& n : mesh.inner) {
    patch.inner_xyz.push_back(n.x);
    patch.inner_uv.push_back(n.uv);
    patch.inner_size.push_back(n.h);
  }
  const auto node = [&](std::int32_t c) { return c < n_local ? number[c] : patch.n_boundary + c - n_local; };
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
    std::int32_t c[3] = {mesh.corners[i], mesh.corners[i + 1], mesh.corners[i + 2]};
    if (t.face_is_reversed[face]) std::swap(c[1], c[2]);
    patch.triangles.push_back({{node(c[0]), node(c[1]), node(c[2])}});
    for (std::size_t k = 0; k < 3; ++k) {
      if (c[k] >= n_local) continue;
      patch.uv_corner.push_back(static_cast<std::int32_t>(i + k));
      patch.own_uv.push_back(boundary.nodes[c[k]].uv);
    }
  }
  return patch;
}

}  // namespace st
