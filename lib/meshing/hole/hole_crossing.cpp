#include "meshing/hole/hole_crossing.h"

#include <algorithm>
#include <numeric>

#include "base/boxes.h"
#include "base/log.h"
#include "mesh/patch_crossing.h"

namespace st {
namespace {

constexpr int kCellsAlong = 128;         // the longest side of the box of all new triangles
constexpr std::int64_t kManyCells = 64;  // a triangle that lies in more is taken to be near new ones

Box3 box_of(const SurfaceMesh& m, TriangleId t) {
  Box3 box;
  for (NodeId n : m.triangles[t].n) box.add(m.node_xyz[n]);
  return box;
}

/// Cells of a grid that the boxes of new triangles touch. Triangles that cross one of them touch such a cell.
class NewCells {
 public:
  explicit NewCells(const SurfaceMesh& m) {
    for (std::size_t t = 0; t < m.triangles.size(); ++t)
      if (m.triangle_previous[t] == kNone)
        for (NodeId n : m.triangles[t].n) all_.add(m.node_xyz[n]);
    if (!(all_.lo.x <= all_.hi.x)) return;
    const Vec3 size = all_.hi - all_.lo;
    const double length = std::max({size.x, size.y, size.z});
    per_length_ = length > 0 ? kCellsAlong / length : 0;
    for (int k = 0; k < 3; ++k) n_[k] = cell((k == 0 ? all_.hi.x : k == 1 ? all_.hi.y : all_.hi.z), k) + 1;
    is_touched_.assign(static_cast<std::size_t>(n_[0]) * n_[1] * n_[2], 0);
    for (std::size_t t = 0; t < m.triangles.size(); ++t)
      if (m.triangle_previous[t] == kNone)
        visit(range_of(box_of(m, static_cast<TriangleId>(t))),
              [&](std::size_t i) { return is_touched_[i] = 1, false; });
  }

  bool touch(const Box3& box) const {
    if (is_touched_.empty() || !meet(box, all_)) return false;
    const Range r = range_of(box);
    if (r.n_cells() > kManyCells) return true;
    return visit(r, [&](std::size_t i) { return is_touched_[i] != 0; });
  }

 private:
  struct Range {
    int lo[3], hi[3];
    std::int64_t n_cells() const { return std::int64_t{hi[0] - lo[0] + 1} * (hi[1] - lo[1] + 1) * (hi[2] - lo[2] + 1); }
  };

  /// Monotonic in x, so that boxes that meet share a cell.
  int cell(double x, int axis) const {
    const double from = axis == 0 ? all_.lo.x : axis == 1 ? all_.lo.y : all_.lo.z;
    return static_cast<int>(std::clamp((x - from) * per_length_, 0.0, static_cast<double>(kCellsAlong)));
  }
  Range range_of(const Box3& b) const {
    const auto at = [&](double x, int axis) { return std::min(cell(x, axis), n_[axis] - 1); };
    return {{at(b.lo.x, 0), at(b.lo.y, 1), at(b.lo.z, 2)}, {at(b.hi.x, 0), at(b.hi.y, 1), at(b.hi.z, 2)}};
  }

  /// Until `work` says true; did it?
  template <class Work>
  bool visit(const Range& r, const Work& work) const {
    for (int z = r.lo[2]; z <= r.hi[2]; ++z)
      for (int y = r.lo[1]; y <= r.hi[1]; ++y)
        for (int x = r.lo[0]; x <= r.hi[0]; ++x)
          if (work((static_cast<std::size_t>(z) * n_[1] + y) * n_[0] + x)) return true;
    return false;
  }

  Box3 all_;
  double per_length_ = 0;
  int n_[3] = {1, 1, 1};
  std::vector<char> is_touched_;
};

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

/// Triangles that new ones may cross, new ones included.
struct NearTriangles {
  std::vector<TriangleId> id;
  std::vector<Triangle> triangles;
  std::vector<TriangleId> face_begin{0};
};

NearTriangles find_near(const SurfaceMesh& m, const std::vector<TriangleId>& begin) {
  NearTriangles near;
  const NewCells cells(m);
  for (std::size_t f = 0; f + 1 < begin.size(); ++f) {
    for (TriangleId t = begin[f]; t < begin[f + 1]; ++t) {
      if (m.triangle_previous[t] != kNone && !cells.touch(box_of(m, t))) continue;
      near.id.push_back(t);
      near.triangles.push_back(m.triangles[t]);
    }
    near.face_begin.push_back(static_cast<TriangleId>(near.id.size()));
  }
  return near;
}

}  // namespace

std::vector<TrianglePair> find_new_crossings(const SurfaceMesh& m, std::span<const std::int32_t> face_body) {
  const std::vector<TriangleId> begin = first_of_faces(m, face_body.size());
  const std::vector<char> is_dirty = faces_with_new(m, begin);
  const NearTriangles near = find_near(m, begin);
  std::vector<TrianglePair> found;
  bool was_ended = false;
  for (TrianglePair p :
       find_crossing_patches({m.node_xyz, near.triangles, near.face_begin, face_body, is_dirty}, was_ended)) {
    p.a = near.id[p.a], p.b = near.id[p.b];
    if (p.n_shared != 1 && (m.triangle_previous[p.a] == kNone || m.triangle_previous[p.b] == kNone)) found.push_back(p);
  }
  if (was_ended) log_warning("too many triangles lie in others; the search for crossings was ended, st-check has more");
  return found;
}

}  // namespace st
