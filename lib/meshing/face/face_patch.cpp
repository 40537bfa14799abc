#include "meshing/face/face_patch.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/parallel_reserve.h"
#include "base/threads.h"

namespace st {
namespace {

constexpr std::size_t kPerPiece = 65'536;

void fill_inside(const FaceMesh& mesh, FacePatch& patch) {
  const std::size_t n = mesh.inner.size();
  parallel_reserve(patch.inner_xyz, n);
  parallel_reserve(patch.inner_uv, n);
  parallel_reserve(patch.inner_size, n);
  patch.inner_xyz.resize(n);
  patch.inner_uv.resize(n);
  patch.inner_size.resize(n);
  parallel_for(n, kPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      patch.inner_xyz[i] = mesh.inner[i].x;
      patch.inner_uv[i] = mesh.inner[i].uv;
      patch.inner_size[i] = mesh.inner[i].h;
    }
  });
}

/// `number`: the patch's boundary node of each of the face's, [n_boundary_nodes].
void fill_triangles(const FaceBoundary& boundary, const FaceMesh& mesh, const std::vector<std::int32_t>& number,
                    bool is_reversed, FacePatch& patch) {
  const auto n_local = static_cast<std::int32_t>(number.size());
  const std::size_t n = mesh.corners.size() / 3;
  std::vector<std::vector<std::pair<std::int32_t, Vec2>>> own(n / kPerPiece + 1);  // (corner, (u,v)) by piece
  parallel_reserve(patch.triangles, n);
  patch.triangles.resize(n);
  parallel_for(n, kPerPiece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t c = mesh.corners[3 * t + (is_reversed ? (3 - k) % 3 : k)];
        patch.triangles[t].n[k] = c < n_local ? number[c] : patch.n_boundary + c - n_local;
        if (c < n_local) own[begin / kPerPiece].push_back({static_cast<std::int32_t>(3 * t + k), boundary.nodes[c].uv});
      }
  });
  for (const auto& some : own)
    for (const auto& [corner, uv] : some) {
      patch.uv_corner.push_back(corner);
      patch.own_uv.push_back(uv);
    }
}

}  // namespace

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
  fill_inside(mesh, patch);
  const bool is_reversed = t.face_is_reversed[face] != 0;
  fill_triangles(boundary, mesh, number, is_reversed, patch);
  return patch;
}

void drop_unused_nodes(FacePatch& patch) {
  std::vector<NodeId> number(static_cast<std::size_t>(patch.n_boundary) + patch.inner_xyz.size(), kNone);
  for (const Triangle& t : patch.triangles)
    for (const NodeId n : t.n) number[n] = n;
  FacePatch kept;
  for (std::size_t i = 0; i < patch.inner_xyz.size(); ++i) {
    NodeId& n = number[static_cast<std::size_t>(patch.n_boundary) + i];
    if (n == kNone) continue;
    n = patch.n_boundary + static_cast<NodeId>(kept.inner_xyz.size());
    kept.inner_xyz.push_back(patch.inner_xyz[i]);
    kept.inner_uv.push_back(patch.inner_uv[i]);
    kept.inner_size.push_back(patch.inner_size[i]);
    if (!patch.inner_previous.empty()) kept.inner_previous.push_back(patch.inner_previous[i]);
  }
  patch.inner_xyz = std::move(kept.inner_xyz);
  patch.inner_uv = std::move(kept.inner_uv);
  patch.inner_size = std::move(kept.inner_size);
  patch.inner_previous = std::move(kept.inner_previous);
  for (Triangle& t : patch.triangles)
    for (NodeId& n : t.n) n = n < patch.n_boundary ? n : number[n];
}

bool has_numbers_only(const FacePatch& patch) {
  // 0 times a number is 0, and 0 times anything else is none: one sum tells.
  double sum = 0;
  for (const Vec3& x : patch.inner_xyz) sum += 0 * x.x + 0 * x.y + 0 * x.z;
  for (const Vec2& uv : patch.inner_uv) sum += 0 * uv.x + 0 * uv.y;
  for (const Vec2& uv : patch.own_uv) sum += 0 * uv.x + 0 * uv.y;
  for (const double h : patch.inner_size) sum += 0 * h;
  return sum == 0;
}

FacePatch make_section(const ModelTables& t, FaceId face, Piece&& piece, const BoundaryNumbering& numbering) {
  FaceBoundary boundary;
  boundary.nodes = std::move(piece.boundary);
  FacePatch section = make_patch(t, face, boundary, piece.mesh, numbering);
  section.boundary_number = std::move(piece.boundary_number);
  section.owner = std::move(piece.owner);
  return section;
}

}  // namespace st
