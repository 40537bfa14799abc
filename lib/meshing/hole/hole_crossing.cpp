#include "meshing/hole/hole_crossing.h"

#include <algorithm>
#include <numeric>

#include "base/log.h"
#include "mesh/patch_crossing.h"

namespace st {
namespace {

std::vector<TriangleId> first_of_faces(const SurfaceMesh& m, std::size_t n_faces) {
  std::vector<TriangleId> begin(n_faces + 1, 0);
  for (FaceId f : m.triangle_face) ++begin[f + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  return begin;
}

std::vector<char> faces_with_new(const SurfaceMesh& m, const std::vector<TriangleId>& begin) {
  std::vector<char> is_dirty;
  for (std::size_t f = 0; f + 1 < begin.size(); ++f) {
    const auto first = m.triangle_previous.begin() + begin[f], last = m.triangle_previous.begin() + begin[f + 1];
    is_dirty.push_back(std::find(first, last, kNone) != last);
  }
  return is_dirty;
}

}  // namespace

std::vector<TrianglePair> find_new_crossings(const SurfaceMesh& m, std::span<const std::int32_t> face_body) {
  const std::vector<TriangleId> begin = first_of_faces(m, face_body.size());
  const std::vector<char> is_dirty = faces_with_new(m, begin);
  bool was_ended = false;
  std::vector<TrianglePair> found =
      find_crossing_patches({m.node_xyz, m.triangles, begin, face_body, is_dirty, m.triangle_previous}, was_ended);
  std::erase_if(found, [](const TrianglePair& p) { return p.n_shared == 1; });
  if (was_ended) log_warning("too many triangles lie in others; the search for crossings was ended, st-check has more");
  return found;
}

}  // namespace st
