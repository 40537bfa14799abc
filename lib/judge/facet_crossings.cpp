#include "judge/facet_crossings.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "base/boxes.h"
#include "mesh/crossing.h"

namespace st {
namespace {

/// The facets of all faces over common nodes: those of faces that meet are at one place, bit by bit.
struct CommonFacets {
  std::vector<Vec3> x;
  std::vector<Triangle> triangles;

  explicit CommonFacets(const FacetShape& shape) {
    const auto& all = shape.node_xyz;
    const auto key = [&](std::int32_t n) { return std::array{all[n].x, all[n].y, all[n].z}; };
    std::vector<std::int32_t> order(all.size()), common(all.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) { return key(a) < key(b); });
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (i == 0 || key(order[i]) != key(order[i - 1])) x.push_back(all[order[i]]);
      common[order[i]] = static_cast<std::int32_t>(x.size()) - 1;
    }
    for (std::size_t f = 0; f + 1 < shape.face_node_offsets.size(); ++f)
      for (const Corners& c : shape.triangles(static_cast<FaceId>(f))) {
        const std::int32_t first = shape.face_node_offsets[f];
        triangles.push_back({{common[first + c[0]], common[first + c[1]], common[first + c[2]]}});
      }
  }
  std::array<Vec3, 3> corners(TriangleId t) const {
    const auto& n = triangles[t].n;
    return {x[n[0]], x[n[1]], x[n[2]]};
  }
};

Box3 box_of(const std::array<Vec3, 3>& corners) {
  Box3 box;
  for (const Vec3 x : corners) box.add(x);
  return box;
}

/// Where sides of `a` pass through the plane of `b`; empty where none does.
Box3 passages(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) {
  const Vec3 normal = cross(b[1] - b[0], b[2] - b[0]);
  Box3 box;
  for (int k = 0; k < 3; ++k) {
    const Vec3 p = a[k], q = a[(k + 1) % 3];
    const double from = dot(normal, p - b[0]), to = dot(normal, q - b[0]);
    if ((from <= 0) != (to <= 0)) box.add(p + from / (from - to) * (q - p));
  }
  return box;
}

/// Of facets that cross: along the line of both planes; of those in one plane, where their boxes meet.
Box3 place_of(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) {
  const Box3 of_a = passages(a, b), of_b = passages(b, a);
  return meet(of_a, of_b) ? common_box(of_a, of_b) : common_box(box_of(a), box_of(b));
}

}  // namespace

FacetCrossings::FacetCrossings(const FacetShape& shape) {
  const CommonFacets facets(shape);
  bool was_ended = false;
  for (const TrianglePair& p : find_crossing_triangles(facets.x, facets.triangles, was_ended))
    places_.push_back(place_of(facets.corners(p.a), facets.corners(p.b)));
  tree_ = BoxTree(places_);
}

bool FacetCrossings::is_near(Vec3 x, double reach) const {
  const Box3 box{x, x};
  bool is_found = false;
  tree_.visit_near(
      x,
      [&](std::int32_t node, double) {
        return !is_found && meet(tree_.nodes()[static_cast<std::size_t>(node)].box, box, reach);
      },
      [&](std::int32_t item) { is_found = is_found || meet(places_[static_cast<std::size_t>(item)], box, reach); });
  return is_found;
}

}  // namespace st
