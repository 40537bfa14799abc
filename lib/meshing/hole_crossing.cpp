#include "meshing/hole_crossing.h"

#include <numeric>

#include "mesh/patch_crossing.h"

namespace st {
namespace {

bool meet(const Box3& a, const Box3& b) {
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y && a.lo.z <= b.hi.z && b.lo.z <= a.hi.z;
}

Box3 box_of(const SurfaceMesh& m, TriangleId t) {
  Box3 box;
  for (NodeId n : m.triangles[t].n) box.add(m.node_xyz[n]);
  return box;
}

std::vector<TriangleId> first_of_faces(const SurfaceMesh& m, std::size_t n_faces) {
  std::vector<TriangleId> begin(n_faces + 1, 0);
  for (FaceId f : m.triangle_face) ++begin[f + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  return begin;
}

/// Boxes of the new triangles of each face that has some.
struct NewParts {
  std::vector<char> is_dirty;  // [n_faces]
  std::vector<Box3> boxes;
};

NewParts find_new_parts(const SurfaceMesh& m, const std::vector<TriangleId>& begin) {
  NewParts parts;
  for (std::size_t f = 0; f + 1 < begin.size(); ++f) {
    Box3 box;
    parts.is_dirty.push_back(0);
    for (TriangleId t = begin[f]; t < begin[f + 1]; ++t) {
      if (m.triangle_previous[t] != kNone) continue;
      parts.is_dirty[f] = 1;
      for (NodeId n : m.triangles[t].n) box.add(m.node_xyz[n]);
    }
    if (parts.is_dirty[f]) parts.boxes.push_back(box);
  }
  return parts;
}

/// Triangles whose box meets that of some face's new part.
struct NearTriangles {
  std::vector<TriangleId> id;
  std::vector<Triangle> triangles;
  std::vector<TriangleId> face_begin{0};
};

NearTriangles find_near(const SurfaceMesh& m, const std::vector<TriangleId>& begin, const std::vector<Box3>& boxes) {
  NearTriangles near;
  for (std::size_t f = 0; f + 1 < begin.size(); ++f) {
    Box3 face;
    for (TriangleId t = begin[f]; t < begin[f + 1]; ++t)
      for (NodeId n : m.triangles[t].n) face.add(m.node_xyz[n]);
    std::vector<Box3> close;
    for (const Box3& b : boxes)
      if (meet(b, face)) close.push_back(b);
    for (TriangleId t = begin[f]; !close.empty() && t < begin[f + 1]; ++t) {
      const Box3 box = box_of(m, t);
      bool is_near = false;
      for (std::size_t b = 0; !is_near && b < close.size(); ++b) is_near = meet(box, close[b]);
      if (!is_near) continue;
      near.id.push_back(t);
      near.triangles.push_back(m.triangles[t]);
    }
    near.face_begin.push_back(static_cast<TriangleId>(near.id.size()));
  }
  return near;
}

}  // namespace

std::vector<TrianglePair> find_new_crossings(const SurfaceMesh& m, std::span<const std::int32_t> face_shell) {
  const std::vector<TriangleId> begin = first_of_faces(m, face_shell.size());
  const NewParts parts = find_new_parts(m, begin);
  const NearTriangles near = find_near(m, begin, parts.boxes);
  std::vector<TrianglePair> found;
  for (TrianglePair p : find_crossing_patches({m.node_xyz, near.triangles, near.face_begin, face_shell, parts.is_dirty})) {
    p.a = near.id[p.a], p.b = near.id[p.b];
    if (p.n_shared != 1 && (m.triangle_previous[p.a] == kNone || m.triangle_previous[p.b] == kNone)) found.push_back(p);
  }
  return found;
}

}  // namespace st
