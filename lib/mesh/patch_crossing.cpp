#include "mesh/patch_crossing.h"

#include <algorithm>
#include <utility>

#include "base/assert.h"
#include "base/threads.h"
#include "mesh/patch_blocks.h"
#include "mesh/triangle_tree.h"

namespace st {
namespace {

/// Of the triangles of each face.
std::vector<Box3> boxes_of_faces(const PatchTriangles& mesh) {
  std::vector<Box3> boxes(mesh.face_body.size());
  parallel_for(boxes.size(), 1, [&](std::size_t f, std::size_t) {
    for (TriangleId t = mesh.face_begin[f]; t < mesh.face_begin[f + 1]; ++t)
      for (const NodeId n : mesh.triangles[t].n) boxes[f].add(mesh.points[n]);
  });
  return boxes;
}

}  // namespace

std::vector<TrianglePair> find_crossing_patches(const PatchTriangles& mesh) {
  bool was_ended = false;
  return find_crossing_patches(mesh, was_ended);
}

std::vector<TrianglePair> find_crossing_patches(const PatchTriangles& mesh, bool& was_ended) {
  ST_ASSERT(mesh.face_begin.size() == mesh.face_body.size() + 1 && mesh.face_begin.front() == 0);
  ST_ASSERT(std::is_sorted(mesh.face_begin.begin(), mesh.face_begin.end()));
  ST_ASSERT(static_cast<std::size_t>(mesh.face_begin.back()) == mesh.triangles.size());
  ST_ASSERT(mesh.face_is_dirty.empty() || mesh.face_is_dirty.size() == mesh.face_body.size());
  const auto n_faces = static_cast<FaceId>(mesh.face_body.size());
  const auto is_dirty = [&](FaceId f) { return mesh.face_is_dirty.empty() || mesh.face_is_dirty[f]; };
  std::vector<std::pair<FaceId, FaceId>> searches;
  for (FaceId f = 0; f < n_faces; ++f)
    if (is_dirty(f)) searches.push_back({f, f});
  if (n_faces > 1)
    for (const auto& [f, g] : meeting_pairs(boxes_of_faces(mesh)))
      if ((is_dirty(f) || is_dirty(g)) && mesh.face_body[f] == mesh.face_body[g]) searches.push_back({f, g});
  return find_pairs({mesh.points, mesh.triangles, mesh.face_begin, mesh.triangle_previous}, WithinGroup::kUnlessAlike,
                    std::move(searches), was_ended);
}

std::vector<TrianglePair> find_crossings_between(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                                 std::int32_t n_first, bool& was_ended, std::int64_t* n_compared) {
  const std::int32_t begin[] = {0, n_first, static_cast<std::int32_t>(triangles.size())};
  ST_ASSERT(0 <= n_first && n_first <= begin[2]);
  was_ended = false;
  if (n_first == 0 || n_first == begin[2]) return {};
  return find_pairs({points, triangles, begin}, WithinGroup::kAll, {{0, 1}}, was_ended, n_compared);
}

}  // namespace st
